//! Named values of the whole service.

use super::{Result, Store, on};

impl Store {
    /// The value called `name`.
    pub async fn setting(&self, name: &str) -> Result<Option<String>> {
        const SQL: &str = "SELECT value FROM settings WHERE name = $1";
        Ok(on!(&self.read, db => sqlx::query_scalar(SQL).bind(name).fetch_optional(db).await?))
    }

    /// Sets it.
    pub async fn set_setting(&self, name: &str, value: &str) -> Result<()> {
        const SQL: &str = "INSERT INTO settings (name, value) VALUES ($1, $2) \
                           ON CONFLICT (name) DO UPDATE SET value = excluded.value";
        on!(&self.write, db => { sqlx::query(SQL).bind(name).bind(value).execute(db).await?; });
        Ok(())
    }

    /// The value called `name`; `first` from now on, where there is none.
    pub async fn setting_or(&self, name: &str, first: &str) -> Result<String> {
        const SQL: &str = "INSERT INTO settings (name, value) VALUES ($1, $2) ON CONFLICT (name) DO NOTHING";
        if let Some(value) = self.setting(name).await? {
            return Ok(value);
        }
        on!(&self.write, db => { sqlx::query(SQL).bind(name).bind(first).execute(db).await?; });
        Ok(self.setting(name).await?.unwrap_or_else(|| first.to_owned()))
    }
}
