//! Hostile files through every surface, and beside honest ones: each gets its verdict by name, and nobody else notices.

mod canary;
mod files;
mod neighbours;
mod surfaces;
#[path = "../workers/mod.rs"]
mod workers;

use ggrade::sandbox::Settings;
use std::time::Duration;

/// Settings for a machine that is busy with other tests: here it is not the deadline that has to end a file.
fn settings() -> Settings {
    Settings { deadline: Duration::from_secs(60), ..workers::settings() }
}
