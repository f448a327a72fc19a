mod groups;
mod moodle;
mod rounds;

use super::raw::records;
use super::*;
use crate::class::formats::samples;
use crate::intake::Participant;
use crate::language::Language;
use encoding_rs::SHIFT_JIS;

const BOM: &str = "\u{feff}";
const HEADER: &str = "Identifier,\"Full name\",\"Email address\",Status,Grade,\"Maximum Grade\",\"Grade can be changed\",\
                      \"Last modified (submission)\",\"Online text\",\"Last modified (grade)\",\"Feedback comments\"";
const HEADER_JA: &str = "ID,氏名,メールアドレス,ステータス,評定,最大評定,評定を変更できます,最終更新日時 (提出),\
                         オンラインテキスト,最終更新日時 (評定),フィードバックコメント";

/// A row a student of [`samples::class`], from `1001`, in Moodle's way: what has a blank is quoted.
fn rows(word: &str, maximum: &str, yes: &str, end: &str) -> String {
    let row = |(index, name): (usize, &&str)| {
        let name = name.replace('"', "\"\"");
        let number = 1001 + index;
        format!(
            "\"{word}{number}\",\"{name}\",s{number}@example.jp,\"提出, 済み\",,{maximum},{yes},\"1 June 2026, 10:00 AM\",\
             \"<p>say \"\"hi\"\"\r\nto ggrade</p>\",-,{end}"
        )
    };
    samples::NASTY.iter().enumerate().map(row).collect()
}

/// What an independent reader finds in a file.
fn read(bytes: &[u8]) -> Vec<Vec<String>> {
    let bytes = bytes.strip_prefix(BOM.as_bytes()).unwrap_or(bytes);
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(bytes);
    reader.records().map(|record| record.expect("a record").iter().map(str::to_owned).collect()).collect()
}

/// The file is the same but for the cells of the columns 4 and 10.
fn assert_only_grades_changed(before: &[u8], after: &[u8]) {
    let rest = |bytes: &[u8]| {
        let mut rest = bytes.to_vec();
        for record in records(bytes, 0, b',').expect("records").iter().rev() {
            for column in [10, 4] {
                if let Some(cell) = record.get(column) {
                    rest.drain(cell.span.clone());
                }
            }
        }
        rest
    };
    assert_eq!(rest(before), rest(after));
}

#[test]
fn only_grades_and_comments_change_and_again_nothing() {
    for (language, header, word, yes) in
        [(Language::En, HEADER, "Participant ", "Yes"), (Language::Ja, HEADER_JA, "参加者", "はい")]
    {
        for mark in ["", BOM] {
            let sheet = format!("{mark}{header}\r\n{}", rows(word, "100.00", yes, "\r\n"));
            let class = samples::class(language);
            let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
            assert_only_grades_changed(sheet.as_bytes(), &filled.bytes);
            let table = read(&filled.bytes);
            let grades: Vec<&str> = table[1..7].iter().map(|row| row[4].as_str()).collect();
            assert_eq!(grades, ["100.00", "80.00", "0.00", "0.00", "", ""]);
            assert!(table[2][10].starts_with("<div class=ggrade><p>▼ ") && table[2][10].contains("<code>h</code>"));
            assert!(table[5][10].contains(if language == Language::En { "a.vert" } else { "2 つ" }));
            assert_eq!(table[6][10], "", "a failure of ours says nothing to the student");
            // Every second of four outcomes of six has a report: eight of twelve.
            assert_eq!(filled.filled, 8);
            let again = fill(&class, &filled.bytes).expect("a worksheet");
            assert_eq!(again, filled);
        }
    }
}

#[test]
fn a_new_grading_replaces_ours_and_keeps_the_teachers_words() {
    let class = samples::class(Language::En);
    let sheet = format!("{HEADER}\n\"Participant 1002\",B,b@x,,95.00,100.00,Yes,-,,-,\"<p>Well \"\"done\"\"</p>\"\n");
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    let table = read(&filled.bytes);
    assert_eq!(table[1][4], "80.00");
    assert!(table[1][10].starts_with("<p>Well \"done\"</p><div class=ggrade>"));
    let regraded = samples::class(Language::Ja);
    let filled = fill(&regraded, &filled.bytes).expect("a worksheet");
    let comment = &read(&filled.bytes)[1][10];
    assert!(comment.starts_with("<p>Well \"done\"</p><div class=ggrade>") && comment.ends_with("</div>"));
    assert_eq!(comment.matches("class=ggrade").count(), 1);
    assert!(comment.contains("鏡面反射光 20 / 40") && !comment.contains("Specular"));
}

#[test]
fn comments_are_harmless_in_every_reader() {
    let mut class = samples::class(Language::En);
    let Outcome::NotGraded(reason) = &mut class.entries[4].outcome else { panic!("not graded") };
    *reason = Text::verbatim("=1+1 \\\" <script>alert('x')</script>\r\n`a;b` \u{1b}[2J");
    let sheet = format!("{HEADER}\n{}", rows("Participant ", "100.00", "Yes", "\n"));
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    for row in &read(&filled.bytes)[1..] {
        // PHP's fgetcsv takes a backslash before a quote for an escape, so a cell of ours has neither.
        assert!(row[10].is_empty() || row[10].starts_with("<div class=ggrade>"));
        assert!(!row[10].contains(['\\', '"', '\n', '\r', '\u{1b}']) && !row[10].contains("<script"));
    }
}

#[test]
fn grades_follow_the_maximum_and_the_decimal_mark_of_the_file() {
    let class = samples::class(Language::En);
    let sheet = format!("{HEADER}\n\"Participant 1002\",B,b@x,,,\"20,00\",Yes,-,,-,\n");
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    assert!(String::from_utf8_lossy(&filled.bytes).contains("b@x,,\"16,00\",\"20,00\","));
    // As Excel saves it where the comma is the decimal mark: no need for quotes.
    let sheet = "Identifier;Grade;Maximum Grade;Feedback comments\r\nParticipant 1002;;20,0;\r\n";
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    assert!(String::from_utf8_lossy(&filled.bytes).contains("\r\nParticipant 1002;16,0;20,0;\"<div"));
}

#[test]
fn locked_foreign_and_broken_rows_stay_and_are_named() {
    let mut class = samples::class(Language::En);
    class.entries.truncate(3);
    class.entries[2].student.moodle = None;
    class.entries[2].student.name = "C".into();
    let sheet = format!(
        "{HEADER}\n\"Participant 1001\",A,a@x,,50.00,100.00,No,-,,-,old\n\"Participant 7\",Z,z@x,,,100.00,Yes,-,,-,\n\
         Participant,Y,y@x,,,100.00,Yes,-,,-,\n\nParticipant 1002,short\n"
    );
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    assert_eq!(filled.bytes, sheet.as_bytes());
    let notes: Vec<&str> = filled.notes.iter().map(|note| note.en.as_str()).collect();
    for part in [
        "cannot be changed, left as they are: 山田 太郎.",
        "without a submission in the class, left as they are: Participant 7.",
        "without a participant's number, left as they are: Participant.",
        "No number of Moodle, so not filled into the worksheet: C.",
        "no maximum grade, so no grade is filled in: O'Brien, \"Bob\".",
    ] {
        assert!(notes.iter().any(|note| note.contains(part)), "{part}: {notes:?}");
    }
    class.entries[1].student.moodle =
        class.entries[1].student.moodle.clone().map(|m| Participant { number: Some(9), ..m });
    let filled = fill(&class, sheet.as_bytes()).expect("a worksheet");
    assert!(filled.notes.iter().any(|note| note.en.starts_with("Not in the worksheet: O'Brien")));
}

#[test]
fn a_file_that_excel_saved_in_shift_jis_stays_in_it() {
    let class = samples::class(Language::Ja);
    // 表 and ソ end in a byte that is a backslash on its own.
    let sheet = "ID,氏名,評定,最大評定,フィードバックコメント\r\n参加者1002,表 ソ,,100,\r\n";
    let sheet = SHIFT_JIS.encode(sheet).0.into_owned();
    let filled = fill(&class, &sheet).expect("a worksheet");
    let (text, _, broken) = SHIFT_JIS.decode(&filled.bytes);
    assert!(!broken);
    assert!(text.contains("\r\n参加者1002,表 ソ,80,100,\"<div class=ggrade>") && text.contains("鏡面反射光 20 / 40"));
    assert_eq!(fill(&class, &filled.bytes).expect("a worksheet").bytes, filled.bytes);
}

#[test]
fn what_is_no_worksheet_is_refused() {
    let class = samples::class(Language::En);
    for bytes in [&b""[..], b"\xef\xbb\xbf", b"\xff\xfeI\0D\0", b"a,b\n1,2\n", b"Identifier,\"Grade\n"] {
        assert!(fill(&class, bytes).is_err(), "{bytes:?}");
    }
}

/// Numbers that look random and are the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) % sides) as usize
    }

    /// A cell as some program would write it.
    fn cell(&mut self, content: &str, separator: char) -> String {
        let must = content.contains(['"', '\r', '\n', separator]);
        if must || self.roll(3) == 0 { format!("\"{}\"", content.replace('"', "\"\"")) } else { content.to_owned() }
    }
}

/// Any worksheet that Moodle or a spreadsheet could have written, with other columns in other places.
fn any_sheet(dice: &mut Dice, separator: char) -> (String, usize, usize) {
    let words = [
        ["Identifier", "Grade", "Maximum Grade", "Feedback comments"],
        ["ID", "評定", "最大評定", "フィードバックコメント"],
    ];
    let words = words[dice.roll(2)];
    let end = ["\n", "\r\n", "\r"][dice.roll(3)];
    // The columns as indices into `words`; 4 is any other column, and the maximum follows the grade.
    let mut columns = vec![4, 4];
    for kind in [0, 1, 3] {
        let mut at = dice.roll(columns.len() as u64 + 1);
        // Nothing comes between a grade and its maximum.
        at += usize::from(at > 0 && columns[at - 1] == 1);
        let kinds: &[usize] = if kind == 1 { &[1, 2] } else { &[kind] };
        columns.splice(at..at, kinds.iter().copied());
    }
    let mut sheet = String::from(["", BOM][dice.roll(2)]);
    for row in 0..=samples::NASTY.len() {
        let cells: Vec<String> = columns
            .iter()
            .map(|&kind| {
                let content = match (row, kind) {
                    (0, 4) => "その他 (x)".to_owned(),
                    (0, kind) => words[kind].to_owned(),
                    (_, 0) => format!("Participant {}", 1000 + row),
                    (_, 1) => ["", "-", "12.5", "100"][dice.roll(4)].to_owned(),
                    (_, 2) => ["100", "20.00", "7,5"][dice.roll(3)].to_owned(),
                    _ => samples::NASTY[dice.roll(samples::NASTY.len() as u64)].to_owned(),
                };
                dice.cell(&content, separator)
            })
            .collect();
        sheet += &(cells.join(&separator.to_string()) + end);
    }
    let column = |kind: usize| columns.iter().position(|column| *column == kind).expect("a column");
    (sheet, column(1), column(3))
}

#[test]
fn whatever_the_worksheet_is_like_every_other_cell_stays() {
    let mut dice = Dice(6);
    let class = samples::class(Language::Ja);
    for _ in 0..300 {
        let separator = [',', ';', '\t'][dice.roll(3)];
        let (sheet, grade, feedback) = any_sheet(&mut dice, separator);
        let filled = fill(&class, sheet.as_bytes()).unwrap_or_else(|fault| panic!("{fault}: {sheet}"));
        let table = |bytes: &[u8]| -> Vec<Vec<String>> {
            let mut reader = csv::ReaderBuilder::new();
            let reader = reader.has_headers(false).delimiter(separator as u8);
            let records = reader.from_reader(bytes).into_records().map(|record| record.expect("a record"));
            records.map(|record| record.iter().map(str::to_owned).collect()).collect()
        };
        let (before, after) = (table(sheet.as_bytes()), table(&filled.bytes));
        assert_eq!(before.len(), after.len());
        for (row, (before, after)) in before.iter().zip(&after).enumerate() {
            for (column, (before, after)) in before.iter().zip(after).enumerate() {
                if row == 0 || (column != grade && column != feedback) {
                    assert_eq!(before, after, "row {row}, column {column} of {sheet}");
                }
            }
            if row > 0 && matches!(class.entries[row - 1].outcome, Outcome::Graded(_)) {
                assert!(points::read(&after[grade]).is_some() && after[feedback].ends_with("</div>"));
                // What is HTML comes through Moodle as its text.
                let words = |cell: &str| cell.split_whitespace().collect::<Vec<_>>().join(" ");
                let teachers = [&before[feedback], &moodle::exported(&before[feedback])].map(|cell| words(cell));
                let now = words(&moodle::exported(&after[feedback]).replace("&#39;", "'"));
                assert!(teachers.iter().any(|words| now.starts_with(words)), "a teacher's words stay: {now}");
            }
        }
        assert_eq!(fill(&class, &filled.bytes).expect("a worksheet"), filled);
    }
}
