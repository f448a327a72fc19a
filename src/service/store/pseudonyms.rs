//! Whether assistants read names.

use super::{Result, Store};

/// Name of the setting.
const SETTING: &str = "pseudonyms_for_assistants";

impl Store {
    /// Whether assistants read pseudonyms in place of names and numbers.
    pub async fn has_pseudonyms(&self) -> Result<bool> {
        Ok(self.setting(SETTING).await?.is_some_and(|value| value == "on"))
    }

    /// Sets it.
    pub async fn set_pseudonyms(&self, are_wanted: bool) -> Result<()> {
        self.set_setting(SETTING, if are_wanted { "on" } else { "off" }).await
    }
}
