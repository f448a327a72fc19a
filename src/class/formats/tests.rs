//! The tables and the archive, read back by readers that are not ours.

use super::samples::{NASTY, class};
use super::*;
use crate::class::{Class, Outcome};
use crate::language::Language;
use crate::report::Lateness;
use std::collections::HashSet;
use std::io::{Cursor, Read};

fn table(bytes: &[u8]) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes);
    reader.records().map(|record| record.expect("a record").iter().map(str::to_owned).collect()).collect()
}

#[test]
fn grades_open_in_a_spreadsheet_without_a_formula() {
    for language in [Language::En, Language::Ja] {
        let bytes = grades::render(&class(language)).expect("a table");
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").expect("a byte-order mark");
        let table = table(text);
        assert_eq!(
            table[0].join(","),
            "key,name,moodle_id,verdict,score,max_score,shape,ambient,diffuse,specular,mistakes,feedback,shares_with,\
             file,sha256,mistake_titles,late_minutes,late_penalty,total,alike"
        );
        assert_eq!(table.len(), 1 + NASTY.len());
        for cell in table.iter().flatten() {
            assert!(!cell.starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠', '\t', '\r']), "{cell:?}");
            assert!(!cell.contains(|c: char| c.is_control()) && !cell.contains(";="), "{cell:?}");
        }
        assert_eq!(table[1][..10], ["s1001", "山田 太郎", "1001", "correct", "100", "100", "10", "20", "30", "40"]);
        assert_eq!(table[2][..10], ["s1002", "O'Brien, \"Bob\"", "1002", "wrong", "80", "100", "10", "20", "30", "20"]);
        assert_eq!(table[2][10], "specular-half-unnormalized");
        assert_eq!(table[2][14], "3f".repeat(32));
        let title = ["Half vector not normalised", "中間ベクトルが正規化されていない"];
        assert_eq!(table[2][15], title[usize::from(language == Language::Ja)]);
        assert_eq!(table[5][3..6], ["not-graded", "", ""]);
        assert_eq!(table[6][3..6], ["fault", "", ""]);
        let place = if language == Language::En { "line 11, column 12: Max" } else { "11 行目 12 文字目: Max" };
        assert!(table[3][11].starts_with(place), "{}", table[3][11]);
    }
}

/// A score of 80 that is a day and an hour late, for which 30 points go.
fn late() -> Class {
    let mut class = class(Language::En);
    let Outcome::Graded(report) = &mut class.entries[1].outcome else { panic!("not graded") };
    report.lateness = Some(Lateness { milliseconds: 25 * 3_600_000, penalty: 30.0 });
    class
}

#[test]
fn lateness_is_a_line_of_its_own_in_every_format() {
    let class = late();
    let entry = &class.entries[1];
    let grades = table(grades::render(&class).expect("a table").strip_prefix(b"\xef\xbb\xbf").expect("a mark"));
    assert_eq!((&*grades[2][4], &grades[2][16..]), ("80", &["1500", "30", "50", ""].map(str::to_owned)[..]));
    assert_eq!(grades[1][16..], ["", "", "100", ""]);
    let nbgrader = table(&gradebooks::nbgrader(&class).expect("a table"));
    assert_eq!(nbgrader[2][7..], ["80.0", "30.0", "50.0", "100.0"]);
    let vpl = vpl::render(entry, vpl::Scale::default(), Language::En);
    assert!(vpl.contains("\nGrade :=>> 50\n"), "{vpl}");
    let [gradescope, coderunner] =
        [gradescope::render(entry, &[], Language::En), coderunner::render(entry, Language::En)];
    assert!(gradescope.contains("\"score\": 50.0,") && coderunner.contains("\"fraction\":0.5,"), "{coderunner}");
    let junit = junit::render(&class).expect("XML");
    assert!(junit.contains("name=\"total\" value=\"50\""));
    for said in [&vpl, &gradescope, &coderunner] {
        assert!(said.contains("Late by 1 day 1 hour: −30") && said.contains("Counts: 50 / 100"), "{said}");
    }
    let page = page::render(&class).expect("a page");
    assert!(String::from_utf8_lossy(&page).contains("50 (80 − 30)"), "the class page");
}

#[test]
fn nbgrader_columns_are_those_of_its_exporter() {
    let mut class = class(Language::En);
    class.entries[10].places.clear();
    let bytes = gradebooks::nbgrader(&class).expect("a table");
    let table = table(&bytes);
    // nbgrader 0.9.6, plugins/export.py.
    assert_eq!(
        table[0].join(","),
        "assignment,duedate,timestamp,student_id,last_name,first_name,email,raw_score,late_submission_penalty,score,max_score"
    );
    assert_eq!(table[2].join("|"), "ggsample06|||s1002|O'Brien, \"Bob\"|||80.0|0.0|80.0|100.0");
    assert_eq!(table[5][7..], ["", "", "", "100.0"], "two files: a teacher decides");
    assert_eq!(table[6][7..], ["", "", "", "100.0"], "a fault of ours is no zero");
    assert_eq!(table[11][7..], ["0.0", "0.0", "0.0", "100.0"], "nothing was handed in");
}

#[test]
fn canvas_reads_names_numbers_and_points() {
    let mut class = late();
    class.entries[10].places.clear();
    let canvas = table(&gradebooks::canvas(&class).expect("a table"));
    // canvas-lms, lib/gradebook_importer.rb: the columns before the first assignment, and the row of points.
    assert_eq!(canvas[0][..5], ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]);
    assert_eq!(canvas[0][5], class.assignment.title.en);
    assert_eq!(canvas[1].join("|"), "    Points Possible|||||100.0");
    assert_eq!(canvas[3].join("|"), "O'Brien, \"Bob\"||s1002|s1002||50.0", "a penalty counts");
    assert_eq!([&canvas[6][5], &canvas[7][5], &canvas[12][5]], ["", "", ""], "a teacher decides, or nothing came");
}

#[test]
fn gradescope_columns_are_those_of_its_export() {
    let mut class = late();
    class.entries[10].places.clear();
    let grades = table(&gradebooks::gradescope(&class).expect("a table"));
    assert_eq!(
        grades[0].join(","),
        "Name,SID,Email,Total Score,Max Points,Status,Submission ID,Submission Time,Lateness (H:M:S)"
    );
    assert_eq!(grades[1].join("|"), "山田 太郎|s1001||100.0|100.0|Graded|||00:00:00");
    assert_eq!(grades[2][3..].join("|"), "50.0|100.0|Graded|||25:00:00");
    assert_eq!(grades[5][3..].join("|"), "|100.0|Ungraded|||");
    assert_eq!(grades[11][3..].join("|"), "||Missing|||");
}

fn packed(class: &Class) -> (zip::ZipArchive<Cursor<Vec<u8>>>, feedback::Packed) {
    let mut bytes = Cursor::new(Vec::new());
    let packed = feedback::write(class, &feedback::by_number(class), &mut bytes).expect("an archive");
    (zip::ZipArchive::new(bytes).expect("an archive"), packed)
}

#[test]
fn the_feedback_archive_is_named_as_moodle_reads_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("s1001.html");
    std::fs::write(&page, "<!DOCTYPE html><p>満点").expect("a page");
    let mut class = class(Language::Ja);
    class.entries[0].page = Some(page);
    class.entries[1].student.moodle = None;
    let (mut archive, packed) = packed(&class);
    let mut names: Vec<String> = Vec::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).expect("a file");
        let name = file.name().expect("a name").into_owned();
        let mut text = String::new();
        file.read_to_string(&mut text).expect("text");
        assert!(text.starts_with("<!DOCTYPE html>") && !text.contains("<script>"), "{name}");
        names.push(name);
    }
    assert_eq!(names[0], "山田 太郎_1001_assignfeedback_file/feedback.html");
    // Of twelve one has no number, and two times in twelve the grading failed.
    assert_eq!((names.len(), packed.pages, packed.notes.len()), (9, 9, 2));
    for name in &names {
        let parts: Vec<&str> = name.splitn(5, '_').collect();
        assert!(parts[1].parse::<u64>().is_ok_and(|number| number > 1000), "{name}");
        assert_eq!(parts[2..], ["assignfeedback", "file/feedback.html"], "{name}");
    }
}

#[test]
fn the_feedback_archive_has_the_form_of_the_download() {
    for (form, expected) in [
        ("A_1001_assignsubmission_file_/x.vert", "_1001_assignfeedback_file_/feedback.html"),
        ("A_1001_assignsubmission_file_x.vert", "_1001_assignfeedback_file_feedback.html"),
        ("A_1001_assignsubmission_file/x_y.vert", "_1001_assignfeedback_file/feedback.html"),
        ("elsewhere.vert", "_1001_assignfeedback_file/feedback.html"),
    ] {
        let mut class = class(Language::En);
        class.entries.truncate(1);
        class.entries[0].places[0].path = format!("class.zip/{form}");
        class.entries[0].student.moodle.as_mut().expect("a participant").name = ".~A_b".into();
        let (archive, _) = packed(&class);
        let names: Vec<_> = archive.file_names().map(|name| name.expect("a name").into_owned()).collect();
        assert_eq!(names, [format!("A b{expected}")]);
    }
}

#[test]
fn a_page_that_is_gone_is_our_fault() {
    let mut class = class(Language::En);
    class.entries[0].page = Some("/nowhere/s1001.html".into());
    let fault = feedback::write(&class, &feedback::by_number(&class), Cursor::new(Vec::new())).expect_err("a fault");
    assert!(fault.message.en.contains("/nowhere/s1001.html"));
}

#[test]
fn every_format_stands_at_its_own_row() {
    for (index, row) in TABLE.iter().enumerate() {
        assert_eq!(row.format as usize, index, "{}", row.id);
        assert_eq!(ClassFormat::from_str(row.id, false), Ok(row.format));
    }
}

#[test]
fn no_two_formats_write_the_same_file() {
    let files: Vec<&str> = TABLE.iter().flat_map(|row| row.files).copied().collect();
    assert_eq!(files.iter().collect::<HashSet<_>>().len(), files.len());
    assert!(files.iter().all(|file| !file.contains("..") && !file.starts_with('/')));
}
