//! How `ggrade grade` writes a report.

use crate::class::formats::{self, exchange};
use clap::ValueEnum;
use clap::builder::PossibleValue;
use std::sync::LazyLock;

/// How a report is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    /// To be read as it is.
    Reading(ViewFormat),
    /// For an autograder or CI.
    Exchange(formats::ClassFormat),
}

/// The forms of a report that are read as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewFormat {
    /// For a person at a terminal
    Text,
    /// One JSON object (schema ggrade/report/v1)
    Json,
    /// One self-contained page with the animation
    Html,
}

impl Default for ReportFormat {
    fn default() -> Self {
        Self::Reading(ViewFormat::Text)
    }
}

impl ValueEnum for ReportFormat {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: LazyLock<Vec<ReportFormat>> = LazyLock::new(|| {
            let reading = ViewFormat::value_variants().iter().copied().map(ReportFormat::Reading);
            reading.chain(exchange::FORMATS.map(ReportFormat::Exchange)).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Self::Reading(reading) => reading.to_possible_value(),
            Self::Exchange(format) => format.to_possible_value(),
        }
    }
}
