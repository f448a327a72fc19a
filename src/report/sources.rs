//! The files that a report is about, and what in it names them.

use super::Report;
use crate::hand_in;
use reference::interpreter::Stage;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::HashMap;

/// A file that was handed in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct SourceInfo {
    /// File name as handed in.
    pub name: String,
    /// The stage that it is for; none where it is for no slot of the assignment, or an older report does not say.
    #[serde(default)]
    #[cfg_attr(feature = "service", schema(value_type = Option<String>))]
    pub stage: Option<Stage>,
    /// SHA-256 of the bytes as handed in, in hexadecimal.
    pub sha256: String,
    /// Size in bytes.
    pub bytes: usize,
    /// Encoding that the text was read in, such as `utf-8` or `shift_jis`.
    pub encoding: String,
}

/// So many digits of a digest tell two editions apart.
const EDITION: usize = 12;

impl Report {
    /// What was handed in, or the first file of it.
    pub fn source(&self) -> &SourceInfo {
        static NONE: SourceInfo =
            SourceInfo { name: String::new(), stage: None, sha256: String::new(), bytes: 0, encoding: String::new() };
        self.sources.first().unwrap_or(&NONE)
    }

    /// The file that a line is in: the one that is named, or the only one.
    pub fn file_of<'a>(&'a self, file: Option<&'a str>) -> Option<&'a SourceInfo> {
        match (file, self.sources.as_slice()) {
            (None, [only]) => Some(only),
            (None, _) => None,
            (Some(file), sources) => sources.iter().find(|source| source.name == file),
        }
    }

    /// The name of a place's file, where that has to be said: a reader of a report on one file knows it.
    pub fn file_to_name<'a>(&self, file: Option<&'a str>) -> Option<&'a str> {
        file.filter(|_| self.sources.len() > 1)
    }

    /// The digest of the hand-in.
    pub fn sha256(&self) -> String {
        let files: Vec<_> = self.sources.iter().map(|source| (source.name.as_str(), source.sha256.clone())).collect();
        hand_in::digest(&files)
    }

    /// The names of all files, joined for a person.
    pub fn file_names(&self) -> String {
        self.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>().join(", ")
    }

    /// The homework with the edition of its folder, for a person: its id, and how the digest begins.
    pub fn edition(&self) -> String {
        let begin = self.assignment_digest.get(..EDITION).unwrap_or(&self.assignment_digest);
        format!("{} {begin}", self.assignment).trim_end().to_owned()
    }

    /// Names the file of each place, where there is only one.
    pub fn name_file(&mut self) {
        let [only] = self.sources.as_slice() else { return };
        let lines = self.rubric.iter_mut().filter(|line| line.line.is_some()).map(|line| &mut line.file);
        let places = self.diagnostics.iter_mut().filter(|place| place.line.is_some()).map(|place| &mut place.file);
        for file in lines.chain(places).filter(|file| file.is_none()) {
            *file = Some(only.name.clone());
        }
    }

    /// The report of the same files as others handed them in: names and sizes are each one's own. Both are in the
    /// order of the assignment.
    pub fn of_files(&mut self, sources: Vec<SourceInfo>) {
        let names: HashMap<String, String> =
            self.sources.iter().zip(&sources).map(|(mine, other)| (mine.name.clone(), other.name.clone())).collect();
        let lines = self.rubric.iter_mut().filter_map(|line| line.file.as_mut());
        let places = self.diagnostics.iter_mut().filter_map(|place| place.file.as_mut());
        let advice = self.advice.iter_mut().map(|advice| &mut advice.file);
        let followed = self.own_values.iter_mut().flat_map(|values| &mut values.lines);
        let followed = followed.filter_map(|line| line.file.as_mut());
        for file in lines.chain(places).chain(advice).chain(followed) {
            if let Some(name) = names.get(file) {
                name.clone_into(file);
            }
        }
        self.sources = sources;
    }
}

/// Files as a report has them, or the only file of a report of the first version.
pub(super) fn one_or_several<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<SourceInfo>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Sources {
        One(SourceInfo),
        Several(Vec<SourceInfo>),
    }
    Ok(match Sources::deserialize(from)? {
        Sources::One(source) => vec![source],
        Sources::Several(sources) => sources,
    })
}
