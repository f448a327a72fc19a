//! Many files → many reports, in and out of the formats that courses use.

pub mod class;
pub mod formats;
pub mod intake;
