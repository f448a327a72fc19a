//! Downloads of Moodle's with everything in them that has gone wrong in one.

use crate::class::{Place, RIGHT, WRONG, ggrade, sample};
use std::fs;
use std::io::Write;
use std::process::Output;

fn zip(place: &Place, members: &[(&str, &[u8])]) {
    let mut archive = zip::ZipWriter::new(fs::File::create(place.at("class.zip")).unwrap());
    for (name, bytes) in members {
        archive.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap();
}

fn grade(place: &Place, sheet: Option<&str>) -> Output {
    let mut command = ggrade();
    command.current_dir(place.at("")).args(["batch", "class.zip", "--out", "out", "--force", "--lang", "en"]);
    command.args(["--deadline", "10"]);
    if let Some(sheet) = sheet {
        fs::write(place.at("sheet.csv"), sheet).unwrap();
        command.args(["--moodle-worksheet", "sheet.csv"]);
    }
    command.output().unwrap()
}

/// The rows of the worksheet that was written, each with its grade and its comment.
fn rows(place: &Place) -> Vec<(String, String, String)> {
    let sheet = fs::read_to_string(place.at("out/moodle-worksheet.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(sheet.trim_start_matches('\u{feff}').as_bytes());
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|column| column == name).unwrap();
    let (grade, comment) = (column("Grade"), column("Feedback comments"));
    let row = |row: csv::StringRecord| (row[0].to_owned(), row[grade].to_owned(), row[comment].to_owned());
    reader.records().map(|record| row(record.unwrap())).collect()
}

fn feedback(place: &Place) -> Vec<String> {
    let archive = zip::ZipArchive::new(fs::File::open(place.at("out/moodle-feedback.zip")).unwrap()).unwrap();
    let mut names: Vec<String> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
    names.sort();
    names
}

fn said(output: &Output) -> String {
    // Lines are broken where the terminal ends.
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn groups_are_graded_by_name_and_a_number_that_is_somebodys_grades_nobody() {
    let place = Place::new();
    zip(
        &place,
        &[
            ("チーム赤_180_assignsubmission_file/ggsample06.vert", &sample(WRONG)),
            ("A 1_11_assignsubmission_file/ggsample06.vert", &sample(RIGHT)),
            ("Default group_assignsubmission_file/ggsample06.vert", &sample(RIGHT)),
        ],
    );
    let sheet = "\u{feff}Identifier,\"Full name\",Status,Group,Grade,\"Maximum grade\",\"Feedback comments\"\r\n\
                 \"Participant 11\",\"林 夏\",Submitted,チーム赤,,100.00,\r\n\
                 \"Participant 12\",\"森 秋\",Submitted,チーム赤,,100.00,\r\n\
                 \"Participant 13\",\"木村 春\",Submitted,A_1,,100.00,\r\n\
                 \"Participant 14\",\"岡 冬\",Submitted,\"Default group\",,100.00,\r\n\
                 \"Participant 180\",\"原 実\",\"No submission\",\"Not a member of any group, so unable to make \
                 submissions.\",,100.00,\r\n";
    let output = grade(&place, Some(sheet));
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let grades: Vec<String> = rows(&place).into_iter().map(|(_, grade, _)| grade).collect();
    assert_eq!(grades, ["80.00", "80.00", "100.00", "100.00", ""]);
    assert!(said(&output).contains("Participant 180 (Not a member of any group"), "{}", said(&output));
    let people = ["岡 冬_14", "木村 春_13", "林 夏_11", "森 秋_12"];
    assert_eq!(feedback(&place), people.map(|name| format!("{name}_assignfeedback_file/feedback.html")));
    // Without the worksheet nothing tells whose number it is: no file goes to anybody, and it is said what is missing.
    let output = grade(&place, None);
    assert!(!place.at("out/moodle-feedback.zip").exists());
    assert!(said(&output).contains("--moodle-worksheet"), "{}", said(&output));
}

#[test]
fn nobody_is_left_out_unnamed() {
    let place = Place::new();
    let crafted = "Eve_36_assignsubmission_file_x_41_assignsubmission_file_ggsample06.vert";
    zip(
        &place,
        &[
            (".Dot Taro_31_assignsubmission_file_ggsample06.vert", &sample(RIGHT)),
            ("Victim_36_assignsubmission_file_ggsample06.vert", &sample(WRONG)),
            (crafted, &sample(RIGHT)),
            (".DS_Store", b"litter"),
        ],
    );
    let sheet = "Identifier;Full name;Grade;Maximum grade;Feedback comments\r\nParticipant 31;.Dot Taro;;20,00;\r\n\
                 Participant 36;Victim;;20,00;\"a < b   it&#39;s fine\"\r\nParticipant 41;Eve;;20,00;\r\n";
    let output = grade(&place, Some(sheet));
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let sheet = fs::read_to_string(place.at("out/moodle-worksheet.csv")).unwrap();
    let lines: Vec<&str> = sheet.split("\r\n").collect();
    assert!(lines[1].starts_with("Participant 31;.Dot Taro;20,00;20,00;"), "{sheet}");
    let victim = "Participant 36;Victim;16,00;20,00;\"<p>a &lt; b</p><p>it&#39;s fine</p><div class=ggrade><p>▼ ";
    assert!(lines[2].starts_with(victim), "{sheet}");
    assert_eq!(lines[3], "Participant 41;Eve;;20,00;", "the name was read as 36's or as 41's");
    assert!(said(&output).contains("Eve_36_assignsubmission_file_x_41") && said(&output).contains("Participant 41"));
    assert!(!said(&output).contains("DS_Store"));
    // Moodle takes a file that begins with a dot for a hidden one.
    assert_eq!(
        feedback(&place),
        ["Dot Taro_31_assignfeedback_file_feedback.html", "Victim_36_assignfeedback_file_feedback.html"]
    );
}
