//! The upload service: its router in this process, its server in another one, on both databases.

mod api;
mod archive;
mod attacks;
mod audience;
mod bench;
mod certificates;
mod classes;
mod cluster;
mod codes;
mod counting;
mod course_api;
mod courses;
mod cross_checks;
mod deletions;
mod description;
mod extensions;
mod folders;
mod gallery;
mod handing_in;
mod hints;
mod hostile;
mod idempotency;
mod identity;
mod insights;
mod judgement;
mod killed;
mod late;
mod likeness;
mod limits;
mod lti;
mod odd_files;
mod old_database;
mod overrides;
mod own;
mod places;
mod privacy;
mod process;
mod proxied;
mod queue;
mod roster;
mod server;
mod several_files;
mod several_homeworks;
mod sign_in;
mod staff;
mod static_files;
mod student_page;
mod term;
mod tokens;
mod worksheets;
mod zone;

use ggrade::sandbox::{Pool, Settings};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// Runs a test on each of the two databases.
macro_rules! on_both {
    ($($(#[$meta:meta])* $name:ident),+ $(,)?) => {
        mod sqlite {
            $(#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
            async fn $name() { super::$name(crate::cluster::Database::sqlite()).await })+
        }
        mod postgres {
            $(#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
            async fn $name() { super::$name(crate::cluster::Database::postgres().await).await })+
        }
    };
}
pub(crate) use on_both;

/// The workers of every test in this process. A busy machine must not change what a file is, so the deadline is long.
pub fn pool() -> Arc<Pool> {
    static POOL: OnceLock<Arc<Pool>> = OnceLock::new();
    let start = || {
        let settings = Settings {
            program: Some(env!("CARGO_BIN_EXE_ggrade").into()),
            deadline: Duration::from_secs(20),
            ..Settings::new(reference::assignment("ggsample06").expect("built in").clone())
        };
        Arc::new(Pool::start(settings, 3).expect("workers"))
    };
    Arc::clone(POOL.get_or_init(start))
}

/// The bytes of a file of the corpus.
pub fn sample(name: &str) -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A right answer.
pub fn right() -> Vec<u8> {
    sample("accepted/answers/half-by-length.vert")
}

/// A right answer that no other test hands in.
pub fn right_and_new() -> Vec<u8> {
    let mut bytes = right();
    bytes.extend(format!("\n// {}\n", ggrade::service::identity::new_id()).into_bytes());
    bytes
}
