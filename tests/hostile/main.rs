//! Hostile files through every surface, and beside honest ones: each gets its verdict by name, and nobody else notices.

mod canary;
mod files;
mod neighbours;
mod surfaces;
#[path = "../workers/mod.rs"]
mod workers;
