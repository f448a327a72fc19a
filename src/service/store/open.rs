//! Opening the database and bringing its tables up to date.

use super::{DatabasePool, Result, Store, StoreError};
use sqlx::postgres::{PgConnectOptions, PgPoolOptions};
use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqlitePoolOptions, SqliteSynchronous};
use sqlx::{ConnectOptions, Connection};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

static SQLITE: sqlx::migrate::Migrator = sqlx::migrate!("src/service/store/migrations/sqlite");
static POSTGRES: sqlx::migrate::Migrator = sqlx::migrate!("src/service/store/migrations/postgres");

/// Longest wait for a lock of the file, or for a connection. Requests end before.
const BUSY: Duration = Duration::from_secs(5);

/// Connections that read.
const READERS: u32 = 4;

/// Where the database is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Location {
    /// An SQLite file, made when missing.
    File(PathBuf),
    /// A PostgreSQL database, as `postgres://user:password@host/name`.
    Postgres(String),
}

impl FromStr for Location {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        if text.starts_with("postgres://") || text.starts_with("postgresql://") {
            return Ok(Self::Postgres(text.into()));
        }
        let path = text.strip_prefix("sqlite://").or_else(|| text.strip_prefix("sqlite:")).unwrap_or(text);
        if path.is_empty() || path.contains("://") {
            return Err("a database is a file name, or postgres://user@host/name".into());
        }
        Ok(Self::File(path.into()))
    }
}

/// The location without a password, for messages.
impl std::fmt::Display for Location {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Postgres(url) => {
                let rest = url.split_once("://").map_or(url.as_str(), |(_, rest)| rest);
                let rest = rest.rsplit_once('@').map_or(rest, |(_, host)| host);
                write!(f, "postgres://{}", rest.split(['?', '#']).next().unwrap_or_default())
            }
        }
    }
}

impl Store {
    /// Opens the database and brings its tables up to date.
    pub async fn open(location: &Location) -> Result<Self> {
        match location {
            Location::File(path) => Self::open_file(path).await,
            Location::Postgres(url) => Self::open_postgres(url, None).await,
        }
    }

    /// Opens the tables of a course beside this one, and makes them where there are none: a file in the folder `….courses`
    /// beside this file, or a schema in this database. `id` is one that [`is_id`](crate::service::courses::is_id) takes.
    pub async fn open_course(&self, id: &str) -> Result<Self> {
        match &*self.location {
            Location::File(path) => {
                let folder = courses_of(path);
                std::fs::create_dir_all(&folder)
                    .map_err(|error| StoreError::File(format!("{}: {error}", folder.display())))?;
                Self::open_file(&folder.join(format!("{id}.db"))).await
            }
            Location::Postgres(url) => Self::open_postgres(url, Some(&schema_of(id))).await,
        }
    }

    async fn open_file(path: &Path) -> Result<Self> {
        let lock = lock(path)?;
        // An acknowledged upload outlives a power cut: each commit is on the disk before it is told.
        let options = SqliteConnectOptions::new()
            .filename(path)
            .create_if_missing(true)
            .journal_mode(SqliteJournalMode::Wal)
            .synchronous(SqliteSynchronous::Full)
            .foreign_keys(true)
            // What is deleted is overwritten: a copy of the file has nothing of it.
            .pragma("secure_delete", "ON")
            .busy_timeout(BUSY);
        let write =
            SqlitePoolOptions::new().max_connections(1).acquire_timeout(BUSY).connect_with(options.clone()).await?;
        SQLITE.run(&write).await?;
        let read =
            SqlitePoolOptions::new().max_connections(READERS).acquire_timeout(BUSY).connect_with(options).await?;
        let location = Arc::new(Location::File(path.to_owned()));
        Ok(Self {
            read: DatabasePool::Sqlite(read),
            write: DatabasePool::Sqlite(write),
            location,
            _lock: Some(Arc::new(lock)),
        })
    }

    async fn open_postgres(url: &str, schema: Option<&str>) -> Result<Self> {
        let mut options = PgConnectOptions::from_str(url)?.application_name("ggrade");
        // A pool says only that it waited in vain; one connection says why.
        let mut first = options.connect().await?;
        if let Some(schema) = schema {
            // Letters, digits and `_`: see `schema_of`.
            let sql = sqlx::AssertSqlSafe(format!("CREATE SCHEMA IF NOT EXISTS {schema}"));
            sqlx::query(sql).execute(&mut first).await?;
            options = options.options([("search_path", schema)]);
        }
        first.close().await?;
        let pool =
            PgPoolOptions::new().max_connections(2 * READERS).acquire_timeout(BUSY).connect_with(options).await?;
        POSTGRES.run(&pool).await?;
        let location = Arc::new(Location::Postgres(url.to_owned()));
        Ok(Self {
            read: DatabasePool::Postgres(pool.clone()),
            write: DatabasePool::Postgres(pool),
            location,
            _lock: None,
        })
    }
}

/// The folder of the other courses' files.
fn courses_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".courses");
    name.into()
}

/// The schema of another course.
fn schema_of(id: &str) -> String {
    format!("ggrade_course_{}", id.replace('-', "_"))
}

/// Keeps other services off the file for as long as the answer is held; the kernel lets go when the process ends.
fn lock(path: &Path) -> Result<std::fs::File> {
    let mut name = path.as_os_str().to_owned();
    name.push(".lock");
    let failed = |error: &dyn std::fmt::Display| StoreError::File(format!("{}: {error}", path.display()));
    let file =
        std::fs::OpenOptions::new().create(true).truncate(false).write(true).open(&name).map_err(|e| failed(&e))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(std::fs::TryLockError::WouldBlock) => Err(failed(&"another ggrade serve has it open")),
        Err(std::fs::TryLockError::Error(error)) => Err(failed(&error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_location_is_a_file_or_a_url() {
        let parse = |text: &str| text.parse::<Location>();
        assert_eq!(parse("ggrade.db"), Ok(Location::File("ggrade.db".into())));
        assert_eq!(parse("sqlite:///var/lib/x.db"), Ok(Location::File("/var/lib/x.db".into())));
        assert_eq!(parse("postgres://a@b/c"), Ok(Location::Postgres("postgres://a@b/c".into())));
        assert!(parse("mysql://a@b/c").is_err());
        assert!(parse("").is_err());
    }

    #[test]
    fn no_password_is_shown() {
        let shown = |url: &str| Location::Postgres(url.into()).to_string();
        assert_eq!(shown("postgres://ta:se@cret@db.local/course?password=x"), "postgres://db.local/course");
        assert_eq!(shown("postgres:///course?host=/run&password=x"), "postgres:///course");
    }
}
