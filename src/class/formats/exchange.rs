//! The formats of autograders and CI by their names: the documents of a class, and the one of a single file.

use super::github::StopToken;
use super::{ClassFormat, KEY, classroom, coderunner, github, gradescope, junit, sarif, vpl};
use crate::class::{Class, ClassEntry};
use crate::fault::Fault;

/// The formats of this module.
pub const FORMATS: [ClassFormat; 7] = [
    ClassFormat::Gradescope,
    ClassFormat::Github,
    ClassFormat::ClassroomLegacy,
    ClassFormat::Junit,
    ClassFormat::Sarif,
    ClassFormat::Vpl,
    ClassFormat::Coderunner,
];

/// A file that a format writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document {
    /// Its name relative to the output folder, `/` between folders.
    pub name: String,
    /// Its content.
    pub text: String,
}

/// The files of `format` for the class; none for a format of another module.
pub fn documents(format: ClassFormat, class: &Class) -> Result<Vec<Document>, Fault> {
    let class = &*class.for_students();
    let names = format.files();
    let named = |texts: Vec<String>| -> Vec<Document> {
        names.iter().zip(texts).map(|(name, text)| Document { name: (*name).to_owned(), text }).collect()
    };
    Ok(match format {
        ClassFormat::Github => {
            named(vec![github::log(class, &StopToken::random()?), github::summary(class, github::LIMIT)])
        }
        ClassFormat::Junit => named(vec![junit::render(class)?]),
        ClassFormat::Sarif => named(vec![sarif::render(class)]),
        _ => {
            let of_entry = |entry: &ClassEntry| {
                let text = per_student(format, entry, class, vpl::Scale::default())?;
                Some(Document { name: names.first()?.replace(KEY, &entry.student.key), text })
            };
            class.entries.iter().filter_map(of_entry).collect()
        }
    })
}

/// What `ggrade grade` prints for the only student of `class`; `None` for a format of another module.
pub fn single(format: ClassFormat, class: &Class, scale: vpl::Scale) -> Result<Option<String>, Fault> {
    let class = &*class.for_students();
    Ok(match format {
        ClassFormat::Github => Some(github::log(class, &StopToken::random()?)),
        ClassFormat::Junit => Some(junit::render(class)?),
        ClassFormat::Sarif => Some(sarif::render(class)),
        _ => class.entries.first().and_then(|entry| per_student(format, entry, class, scale)),
    })
}

/// The document of one student, in the formats that have one each.
fn per_student(format: ClassFormat, entry: &ClassEntry, class: &Class, scale: vpl::Scale) -> Option<String> {
    Some(match format {
        ClassFormat::Gradescope => gradescope::render(entry, &class.expected_portrait, class.language),
        ClassFormat::ClassroomLegacy => classroom::render(entry, class),
        ClassFormat::Vpl => vpl::render(entry, scale, class.language),
        ClassFormat::Coderunner => coderunner::render(entry, class.language),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::formats::nasty;
    use clap::ValueEnum;

    #[test]
    fn every_format_writes_the_files_that_it_lists() {
        let class = nasty::class();
        for format in FORMATS {
            let written: Vec<_> =
                documents(format, &class).unwrap().into_iter().map(|document| document.name).collect();
            let listed = format.files().iter().flat_map(|file| match file.contains(KEY) {
                true => class.entries.iter().map(|entry| file.replace(KEY, &entry.student.key)).collect(),
                false => vec![(*file).to_owned()],
            });
            assert_eq!(written, listed.collect::<Vec<_>>(), "{}", format.id());
            assert!(single(format, &class, vpl::Scale::default()).unwrap().is_some());
        }
        for &format in ClassFormat::value_variants().iter().filter(|format| !FORMATS.contains(format)) {
            assert_eq!(documents(format, &class).unwrap(), []);
            assert_eq!(single(format, &class, vpl::Scale::default()).unwrap(), None);
        }
    }
}
