//! What the files compute on their way, in the shape of the contract.

use super::file_of;
use crate::language::Language;
use crate::report::{OwnValues, Report, ValueAt, ValueLine, ValuePlace};
use serde::Serialize;

/// What the files compute on their way.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = OwnValues))]
pub(super) struct JsonValues<'a> {
    places: &'a [ValuePlace],
    lines: Vec<Followed<'a>>,
}

/// A statement that gives a variable its value; those are in the order in which they run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema), schema(as = ValueLine))]
struct Followed<'a> {
    file: Option<&'a str>,
    line: u32,
    name: &'a str,
    function: Option<&'a str>,
    times: u32,
    /// What it should be, in words, where that is known.
    means: Option<&'a str>,
    values: &'a [Option<ValueAt>],
}

impl<'a> JsonValues<'a> {
    pub fn of(report: &'a Report, values: &'a OwnValues, language: Language) -> Self {
        let line = |followed: &'a ValueLine| Followed {
            file: file_of(report, followed.file.as_deref(), Some(followed.line)),
            line: followed.line,
            name: &followed.name,
            function: followed.function.as_deref(),
            times: followed.times,
            means: followed.means.as_ref().map(|means| means.get(language)),
            values: &followed.values,
        };
        Self { places: &values.places, lines: values.lines.iter().map(line).collect() }
    }
}
