//! Databases for tests: an SQLite file in a folder of its own, or a database in a PostgreSQL cluster of this process.

use std::io::Read;
use std::os::unix::fs::{PermissionsExt, chown};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A database that no other test uses.
#[derive(Debug)]
pub struct Database {
    /// As `--database` takes it.
    pub location: String,
    _folder: Option<TempDir>,
}

impl Database {
    pub fn sqlite() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let location = folder.path().join("ggrade.db").display().to_string();
        Self { location, _folder: Some(folder) }
    }

    pub async fn postgres() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let cluster = tokio::task::spawn_blocking(Cluster::get).await.expect("a cluster");
        let name = format!("test_{}", NEXT.fetch_add(1, Ordering::Relaxed));
        let location = cluster.url(&name);
        let made = tokio::task::spawn_blocking(move || cluster.psql(&format!("CREATE DATABASE {name}")));
        made.await.expect("a database");
        Self { location, _folder: None }
    }

    /// The same one for another service; what it is kept in goes with the first.
    pub fn again(&self) -> Self {
        Self { location: self.location.clone(), _folder: None }
    }
}

/// A PostgreSQL server that ends with this process, and takes its files along.
#[derive(Debug)]
struct Cluster {
    folder: PathBuf,
    user: String,
    /// The server lives as long as the other end of this child's standard input.
    _server: Child,
}

/// The user that runs it where this process is root: PostgreSQL refuses root.
const NOBODY: u32 = 65534;

impl Cluster {
    fn get() -> &'static Self {
        static CLUSTER: OnceLock<Cluster> = OnceLock::new();
        CLUSTER.get_or_init(Self::start)
    }

    fn start() -> Self {
        let folder = tempfile::Builder::new().prefix("ggrade-postgres-").tempdir().expect("a folder").keep();
        std::fs::set_permissions(&folder, std::fs::Permissions::from_mode(0o700)).expect("permissions");
        let is_root = nix::unistd::Uid::effective().is_root();
        let become_nobody = if is_root {
            chown(&folder, Some(NOBODY), Some(NOBODY)).expect("a folder of nobody's");
            format!("setpriv --reuid {NOBODY} --regid {NOBODY} --clear-groups")
        } else {
            String::new()
        };
        let user = if is_root { "nobody".into() } else { std::env::var("USER").unwrap_or_else(|_| "postgres".into()) };
        let bin = binaries();
        // No disk is waited for: the server outlives what is killed in these tests.
        let script = format!(
            "cd {dir} && {nobody} {bin}/initdb -D {dir}/data -U {user} -A trust --no-sync -E UTF8 --locale=C >{dir}/log 2>&1 \
             && {{ {nobody} {bin}/postgres -D {dir}/data -k {dir} -c listen_addresses= -c fsync=off -c max_connections=200 \
             >>{dir}/log 2>&1 & }} ; read end; kill -INT $!; wait; rm -rf {dir}",
            dir = folder.display(),
            nobody = become_nobody,
            bin = bin.display(),
        );
        let server = Command::new("sh").args(["-c", &script]).stdin(Stdio::piped()).spawn().expect("a shell");
        let cluster = Self { folder, user, _server: server };
        cluster.wait();
        cluster
    }

    fn wait(&self) {
        let give_up = Instant::now() + Duration::from_secs(60);
        while !self.try_psql("SELECT 1").is_ok_and(|done| done) {
            if Instant::now() > give_up {
                let mut log = String::new();
                let file = std::fs::File::open(self.folder.join("log"));
                let _ = file.and_then(|mut file| file.read_to_string(&mut log));
                panic!("PostgreSQL did not start:\n{log}");
            }
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    fn url(&self, database: &str) -> String {
        format!("postgres://{}@localhost/{database}?host={}", self.user, self.folder.display())
    }

    fn psql(&self, sql: &str) {
        assert!(self.try_psql(sql).expect("psql"), "{sql}");
    }

    fn try_psql(&self, sql: &str) -> std::io::Result<bool> {
        let mut psql = Command::new(binaries().join("psql"));
        psql.args(["-h", &self.folder.display().to_string(), "-U", &self.user, "-d", "postgres", "-qc", sql]);
        Ok(psql.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status()?.success())
    }
}

/// Where Debian, or the machine's path, has PostgreSQL's programs.
fn binaries() -> PathBuf {
    let debian = std::fs::read_dir("/usr/lib/postgresql").into_iter().flatten().flatten();
    let mut candidates: Vec<PathBuf> = debian.map(|entry| entry.path().join("bin")).collect();
    candidates.sort();
    candidates.reverse();
    let path = std::env::var_os("PATH").unwrap_or_default();
    candidates.extend(std::env::split_paths(&path));
    let has_all = |folder: &PathBuf| ["initdb", "postgres", "psql"].iter().all(|name| folder.join(name).is_file());
    let found = candidates.into_iter().find(has_all);
    found.unwrap_or_else(|| panic!("PostgreSQL is not installed: script/bootstrap --test installs it"))
}
