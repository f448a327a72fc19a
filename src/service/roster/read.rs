//! Reading a roster: what a spreadsheet or Moodle saves.

use super::heading::{Heading, is_no_student};
use crate::service::errors::Problem;
use crate::service::identity::normal_number;
use crate::service::store::RosterLine;
use std::collections::HashMap;

/// Lines in which a heading is looked for: some lists begin with the name of the course.
const ABOVE: usize = 10;

/// Mistakes that one message lists.
const LISTED: usize = 5;

/// What a file says.
#[derive(Debug)]
pub struct RosterFile {
    /// The students.
    pub lines: Vec<RosterLine>,
    /// The names of the columns that were not taken.
    pub left_aside: Vec<String>,
}

/// The students of a roster: a CSV file with commas, semicolons or tabs, in whatever encoding a spreadsheet saves.
///
/// A heading says which column is which; what stands above it is left aside. Without one, the first cell of a line that is a
/// student number is the number, and the first other cell the name. A line without a number is a heading where it is the
/// first, and a mistake elsewhere.
pub fn read(bytes: &[u8]) -> Result<RosterFile, Problem> {
    if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\xd0\xcf\x11\xe0") {
        return Err(Problem::unprocessable(
            "This is an Excel workbook or an archive, not a CSV file. In Excel choose \"Save as\" and \"CSV UTF-8\". The roster was not changed.",
            "これは Excel ブックまたは ZIP で、CSV ファイルではありません。Excel で「名前を付けて保存」から「CSV UTF-8」を選んで保存してください。名簿は変更していません。",
        ));
    }
    let text = crate::source::decoded_text(bytes);
    if let Some(problem) = open_quotation(&text) {
        return Err(problem);
    }
    let records = records(&text);
    let found = records.iter().take(ABOVE).enumerate().find_map(|(at, (_, cells))| Some((at, Heading::of(cells)?)));
    let (above, heading) = found.map_or((0, None), |(at, heading)| (at + 1, Some(heading)));
    let mut roster: Vec<RosterLine> = Vec::new();
    let mut lines: HashMap<String, (usize, u64)> = HashMap::new();
    let (mut without, mut twice) = (Vec::new(), Vec::new());
    for (index, (line, cells)) in records.into_iter().enumerate().skip(above) {
        match heading.as_ref().map_or_else(|| by_shape(&cells), |heading| heading.line(&cells)) {
            None if index == 0 || is_no_student(&cells) => {}
            None => without.push(line),
            Some(found) => match lines.get(&found.number) {
                Some((at, _)) if roster[*at].name == found.name => {}
                Some((_, before)) => twice.push((found.number, *before, line)),
                None => {
                    lines.insert(found.number.clone(), (roster.len(), line));
                    roster.push(found);
                }
            },
        }
    }
    if let Some(problem) = no_number(&without).or_else(|| two_names(&twice)) {
        return Err(problem);
    }
    if roster.is_empty() {
        return Err(Problem::unprocessable(
            "The file has no line with a student number. Each line looks like `s1234567,Family Given`. The roster was not changed.",
            "学籍番号のある行がありません。各行は「s1234567,氏名」の形にしてください。名簿は変更していません。",
        ));
    }
    Ok(RosterFile { lines: roster, left_aside: heading.map(|heading| heading.left_aside).unwrap_or_default() })
}

/// The lines that have something, by their numbers.
fn records(text: &str) -> Vec<(u64, Vec<String>)> {
    let delimiters = [';', '\t', ','];
    let first = text.lines().find(|line| line.contains(delimiters)).unwrap_or_default();
    // What stands between quotation marks separates nothing.
    let outside: String = first.split('"').step_by(2).collect();
    let count = |delimiter: &char| outside.matches(*delimiter).count();
    let delimiter = delimiters.into_iter().max_by_key(count).unwrap_or(',') as u8;
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(delimiter).from_reader(text.as_bytes());
    let numbered = reader.records().filter_map(Result::ok).map(|record| {
        let line = record.position().map_or(0, csv::Position::line);
        (line, record.iter().map(one_line).collect::<Vec<_>>())
    });
    numbered.filter(|(_, cells)| cells.iter().any(|cell| !cell.is_empty())).collect()
}

/// A cell without what surrounds it, its lines behind one another.
fn one_line(cell: &str) -> String {
    cell.trim().lines().map(str::trim).collect::<Vec<_>>().join(" ")
}

/// The refusal of a quotation mark that nothing closes: all lines behind it would be one cell.
fn open_quotation(text: &str) -> Option<Problem> {
    let mut odd = text.lines().zip(1..).filter(|(line, _)| line.matches('"').count() % 2 == 1);
    let (_, line) = odd.next()?;
    (odd.count() % 2 == 0).then(|| {
        Problem::unprocessable(
            format!(
                "A quotation mark in line {line} of the file is not closed. Correct that line. The roster was not changed."
            ),
            format!(
                "ファイルの {line} 行目の引用符が閉じられていません。その行を修正してください。名簿は変更していません。"
            ),
        )
    })
}

fn by_shape(cells: &[String]) -> Option<RosterLine> {
    let number = |cell: &str| normal_number(cell).filter(|number| number.chars().any(|c| c.is_ascii_digit()));
    let place = cells.iter().position(|cell| number(cell).is_some())?;
    let moodle = cells.iter().find_map(|cell| participant(cell));
    let others = cells.iter().enumerate().filter(|(index, cell)| *index != place && !cell.is_empty());
    let name = others.map(|(_, cell)| cell.as_str()).find(|cell| participant(cell).is_none()).unwrap_or_default();
    Some(RosterLine { number: number(&cells[place])?, name: name.to_owned(), moodle, ..RosterLine::default() })
}

/// The number in `Participant 1234`, as Moodle's worksheet writes it.
pub(super) fn participant(cell: &str) -> Option<u64> {
    let rest = ["Participant", "参加者"].iter().find_map(|word| cell.strip_prefix(word))?;
    rest.trim().parse().ok()
}

/// The refusal of lines without a student number.
fn no_number(lines: &[u64]) -> Option<Problem> {
    let first = lines.first()?;
    let all: Vec<String> = lines.iter().take(LISTED).map(u64::to_string).collect();
    let more = if lines.len() > LISTED { ", …" } else { "" };
    let (en, verb) = match lines {
        [_] => (format!("Line {first}"), "has"),
        _ => (format!("Lines {}{more}", all.join(", ")), "have"),
    };
    Some(Problem::unprocessable(
        format!(
            "{en} of the file {verb} no student number. A line looks like `s1234567,Family Given`; take out lines that are no students. The roster was not changed."
        ),
        format!(
            "ファイルの {}{more} 行目に学籍番号がありません。各行は「s1234567,氏名」の形にし、学生ではない行は削除してください。名簿は変更していません。",
            all.join(", ")
        ),
    ))
}

/// The refusal of one number with two names.
fn two_names(twice: &[(String, u64, u64)]) -> Option<Problem> {
    let (number, one, other) = twice.first()?;
    Some(Problem::unprocessable(
        format!(
            "Lines {one} and {other} of the file have the same student number {number} and different names. Correct one of them. The roster was not changed."
        ),
        format!(
            "ファイルの {one} 行目と {other} 行目は学籍番号 {number} が同じで、氏名が異なります。どちらかを修正してください。名簿は変更していません。"
        ),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Vec<RosterLine> {
        read(text.as_bytes()).expect("a roster").lines
    }

    fn line(number: &str, name: &str) -> RosterLine {
        RosterLine { number: number.to_owned(), name: name.to_owned(), ..RosterLine::default() }
    }

    #[test]
    fn a_roster_is_read_in_the_forms_that_spreadsheets_write() {
        let expected = [line("S1234567", "和田 花子"), line("S1234568", "Smith, J.")];
        assert_eq!(of("\u{feff}学籍番号,氏名\r\ns1234567,和田 花子\r\n\r\nｓ1234568,\"Smith, J.\"\r\n"), expected);
        assert_eq!(of("和田 花子\ts1234567\nSmith, J.\ts1234568"), expected);
        assert_eq!(of("No;Name\ns1234567;和田 花子\ns1234568;Smith, J.\ns1234568;Smith, J.\n"), expected);
        let (sjis, _, _) = encoding_rs::SHIFT_JIS.encode("s1234567,和田 花子\n");
        assert_eq!(read(&sjis).expect("a roster").lines, [line("S1234567", "和田 花子")]);
        // Excel's “Unicode text”, and its CSV in Europe: a comma may stand in a name.
        let unicode = "\u{feff}学籍番号\t氏名\r\ns1234567\t和田 花子\r\n";
        let unicode: Vec<u8> = unicode.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(read(&unicode).expect("a roster").lines, [line("S1234567", "和田 花子")]);
        assert_eq!(of("\"Smith, J., Jr.\";s1234568\n"), [line("S1234568", "Smith, J., Jr.")]);
        assert_eq!(of("\"学籍\n番号\",氏名\ns1234567,\"和田\r\n花子\"\n"), [line("S1234567", "和田 花子")]);
    }

    #[test]
    fn what_stands_above_the_heading_is_no_student() {
        let list = "科目名,コンピュータグラフィックス 2026\n履修者数,1\n\nNo.,学籍番号,氏名,学年\n1,s1,和田 花子,3\n";
        assert_eq!(of(list), [line("S1", "和田 花子")]);
        let with_mail = RosterLine { email: "h@example.org".to_owned(), ..line("S1", "Hanako Wada") };
        assert_eq!(of("Name,SID,Email\nHanako Wada,s1,h@example.org\n"), [with_mail]);
    }

    #[test]
    fn moodles_own_lists_are_read_by_their_headings() {
        let of_moodle =
            |moodle, email: &str| RosterLine { moodle, email: email.to_owned(), ..line("S1", "和田 花子") };
        assert_eq!(
            of("姓,名,IDナンバー,メールアドレス\n和田,花子,s1,hanako@example.ac.jp\n"),
            [of_moodle(None, "hanako@example.ac.jp")]
        );
        assert_eq!(
            of("Identifier,Full name,ID number,Email address,Status\nParticipant 4711,和田 花子,s1,h@example.org,x\n"),
            [of_moodle(Some(4711), "h@example.org")]
        );
        assert_eq!(of("識別子,フルネーム,ユーザ名\n参加者 4711,和田 花子,s1\n"), [of_moodle(Some(4711), "")]);
        let of_group = RosterLine { group: "火曜 B".to_owned(), ..line("S1", "和田 花子") };
        assert_eq!(of("username,name,グループ\ns1,和田 花子,火曜 B\n"), [of_group]);
        // Whoever calls the number by its letters alone says so in a heading.
        assert_eq!(of("username,name\nhanako,和田 花子\n"), [line("HANAKO", "和田 花子")]);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let wrong = |text: &str| read(text.as_bytes()).expect_err("a problem").detail;
        let said = wrong("s1234567,A\nB only\n");
        assert!(said.en.starts_with("Line 2 ") && said.ja.contains("2 行目"), "{said:?}");
        assert!(wrong("number,name\n\ns1,A\n,B\n,C\n").en.starts_with("Lines 4, 5 "));
        assert!(wrong("number,name\n..,A\n").en.starts_with("Line 2 "));
        assert!(wrong("s1,A\ns2,B\nｓ１,C\n").en.starts_with("Lines 1 and 3 "));
        assert!(wrong("number,name\ns1,\"Wada\ns2,Ito\ns3,Abe\n").en.starts_with("A quotation mark in line 2 "));
        assert!(wrong("PK\u{3}\u{4}xl/workbook.xml").en.contains("CSV UTF-8"));
        assert!(read(b"").is_err() && read(b"number,name\n").is_err());
    }
}
