//! Writes a graded class in the formats that are wanted.

use super::Class;
use super::folder::OutputFolder;
use super::formats::{ClassFormat, KEY, exchange, feedback, gradebooks, grades, page, worksheet};
use crate::fault::Fault;
use crate::language::Text;
use clap::ValueEnum;

/// What was written, and what there is to say about it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WrittenFiles {
    /// The folder.
    pub folder: String,
    /// Each file in it, `*` for what each student has one of, with what it is.
    pub files: Vec<(String, Text)>,
    /// What a teacher should know.
    pub notes: Vec<Text>,
}

/// What a run can write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutputOptions {
    /// Whether names are pseudonyms.
    pub anonymous: bool,
    /// Whether there is a worksheet of Moodle's.
    pub worksheet: bool,
    /// Whether students have a number of Moodle's.
    pub moodle: bool,
}

/// The formats that are written: those asked for, or else all that make sense of what is given.
pub fn choose(asked: &[ClassFormat], given: OutputOptions) -> Result<Vec<ClassFormat>, Text> {
    let mut chosen: Vec<ClassFormat> = match asked {
        [] => ClassFormat::value_variants().iter().copied().filter(|format| is_usual(*format, given)).collect(),
        asked => asked.to_vec(),
    };
    if given.worksheet && !chosen.contains(&ClassFormat::MoodleWorksheet) {
        chosen.push(ClassFormat::MoodleWorksheet);
    }
    let moodle = [ClassFormat::MoodleWorksheet, ClassFormat::MoodleFeedback];
    if given.anonymous && chosen.iter().any(|format| moodle.contains(format)) {
        return Err(Text::new(
            "Moodle's files name everyone, and --anonymous names nobody. For grading without names in Moodle itself, use \
             its blind marking: its downloads then have numbers for names, and need no --anonymous",
            "Moodle 用のファイルには氏名が入るため、--anonymous とは併用できません。Moodle で匿名のまま採点するには、Moodle \
             のブラインド評定を使ってください。ダウンロードしたファイルの名前が番号になるので、--anonymous は不要です",
        ));
    }
    if chosen.contains(&ClassFormat::MoodleWorksheet) && !given.worksheet {
        return Err(Text::new(
            "the format moodle-worksheet fills in the worksheet that Moodle gives: name it with --moodle-worksheet FILE.csv",
            "moodle-worksheet 形式は Moodle からダウンロードしたワークシートに記入するものです。\
             --moodle-worksheet FILE.csv で指定してください",
        ));
    }
    chosen.sort_unstable();
    chosen.dedup();
    Ok(chosen)
}

/// What a teacher may miss of what is written.
pub fn hint(asked: &[ClassFormat], given: OutputOptions) -> Option<Text> {
    let missed = asked.is_empty() && given.moodle && !given.worksheet && !given.anonymous;
    missed.then(|| {
        Text::new(
            "For Moodle, name its grading worksheet with --moodle-worksheet FILE.csv: it is filled in, and everyone's report \
             is packed as moodle-feedback.zip",
            "Moodle に戻すには、評定ワークシートを --moodle-worksheet FILE.csv で指定してください。評定とコメントを記入し、\
             全員の採点結果を moodle-feedback.zip にまとめます",
        )
    })
}

fn is_usual(format: ClassFormat, given: OutputOptions) -> bool {
    match format {
        ClassFormat::MoodleWorksheet => given.worksheet,
        // Only the worksheet tells participants from groups.
        ClassFormat::MoodleFeedback => given.moodle && given.worksheet && !given.anonymous,
        // Their columns say what grades.csv says, for those who have that gradebook.
        ClassFormat::Nbgrader | ClassFormat::Canvas | ClassFormat::GradescopeGrades => false,
        // Programs that run a batch have results.jsonl.
        ClassFormat::Json => false,
        _ => true,
    }
}

/// What is wanted of each student besides the report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wants {
    /// The small picture.
    pub portraits: bool,
    /// The page.
    pub pages: bool,
}

/// What these formats need of each student.
pub fn wants(formats: &[ClassFormat]) -> Wants {
    let any = |with: &[ClassFormat]| formats.iter().any(|format| with.contains(format));
    Wants {
        portraits: any(&[ClassFormat::Html, ClassFormat::Gradescope]),
        pages: any(&[ClassFormat::Html, ClassFormat::MoodleFeedback]),
    }
}

/// Writes a class in each of the formats. Where one cannot be written the others are all the same, and the first fault
/// is given back beside what was written.
pub fn write(
    class: &Class,
    formats: &[ClassFormat],
    sheet: Option<&[u8]>,
    folder: &OutputFolder,
) -> (WrittenFiles, Option<Fault>) {
    let mut written = WrittenFiles { folder: folder.at("").display().to_string(), ..WrittenFiles::default() };
    let mut first = None;
    for &format in formats {
        match one(class, format, sheet, folder) {
            Ok(notes) => {
                written.notes.extend(notes);
                written.files.extend(format.files().iter().map(|file| (file.replace(KEY, "*"), format.description())));
            }
            Err(fault) => first = first.or(Some(fault)),
        }
    }
    (written, first)
}

/// Whom Moodle would give the reports of a class.
pub fn recipients<'a>(class: &'a Class, sheet: Option<&[u8]>) -> Result<Vec<feedback::Recipient<'a>>, Fault> {
    match sheet {
        Some(sheet) => worksheet::recipients(class, sheet),
        None => Ok(feedback::by_number(class)),
    }
}

/// Writes one format; what a teacher should know of it.
fn one(class: &Class, format: ClassFormat, sheet: Option<&[u8]>, folder: &OutputFolder) -> Result<Vec<Text>, Fault> {
    let file = format.files()[0];
    let whole = |bytes: Vec<u8>| folder.write(file, &bytes).map(|_| Vec::new());
    match format {
        ClassFormat::Html => whole(page::render(class)?),
        ClassFormat::Csv => whole(grades::render(class)?),
        ClassFormat::Json => whole(grades::json(class)?),
        ClassFormat::Nbgrader => whole(gradebooks::nbgrader(class)?),
        ClassFormat::Canvas => whole(gradebooks::canvas(class)?),
        ClassFormat::GradescopeGrades => whole(gradebooks::gradescope(class)?),
        ClassFormat::MoodleWorksheet => {
            let filled = worksheet::fill(class, sheet.unwrap_or_default())?;
            folder.write(file, &filled.bytes)?;
            Ok(filled.notes)
        }
        ClassFormat::MoodleFeedback => {
            let recipients = recipients(class, sheet)?;
            let packed = folder.write_by(file, |out| feedback::write(class, &recipients, out))?;
            Ok(packed.notes.into_iter().chain(sheet.is_none().then(feedback::without_worksheet)).collect())
        }
        ClassFormat::Gradescope
        | ClassFormat::Github
        | ClassFormat::ClassroomLegacy
        | ClassFormat::Junit
        | ClassFormat::Sarif
        | ClassFormat::Vpl
        | ClassFormat::Coderunner => {
            for document in exchange::documents(format, class)? {
                folder.write(&document.name, document.text.as_bytes())?;
            }
            Ok(Vec::new())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: OutputOptions = OutputOptions { anonymous: false, worksheet: true, moodle: true };

    #[test]
    fn by_default_everything_is_written_that_can_be() {
        let all = choose(&[], ALL).unwrap();
        let left_out: Vec<_> = ClassFormat::value_variants().iter().filter(|format| !all.contains(format)).collect();
        let others = [ClassFormat::Json, ClassFormat::Nbgrader, ClassFormat::Canvas, ClassFormat::GradescopeGrades];
        assert_eq!(left_out, others.iter().collect::<Vec<_>>());
        let none = choose(&[], OutputOptions::default()).unwrap();
        assert!(none.contains(&ClassFormat::Html) && !none.contains(&ClassFormat::MoodleFeedback));
    }

    #[test]
    fn what_was_asked_for_and_no_more_is_written() {
        assert_eq!(
            choose(&[ClassFormat::Csv, ClassFormat::Csv], OutputOptions::default()).unwrap(),
            [ClassFormat::Csv]
        );
        let with_sheet = OutputOptions { worksheet: true, ..OutputOptions::default() };
        assert_eq!(choose(&[ClassFormat::Csv], with_sheet).unwrap(), [ClassFormat::Csv, ClassFormat::MoodleWorksheet]);
        choose(&[ClassFormat::MoodleWorksheet], OutputOptions::default()).unwrap_err();
    }

    #[test]
    fn pseudonyms_do_not_go_with_moodles_files() {
        let anonymous = OutputOptions { anonymous: true, worksheet: false, moodle: true };
        assert!(!choose(&[], anonymous).unwrap().contains(&ClassFormat::MoodleFeedback));
        choose(&[ClassFormat::MoodleFeedback], anonymous).unwrap_err();
        choose(&[], OutputOptions { worksheet: true, ..anonymous }).unwrap_err();
    }
}
