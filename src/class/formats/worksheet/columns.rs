//! The columns of Moodle's worksheet, found by their names in English and Japanese.

use crate::fault::Fault;
use crate::language::Text;

/// Where the columns stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WorksheetColumns {
    pub identifier: usize,
    pub grade: usize,
    pub maximum: usize,
    pub can_change: Option<usize>,
    pub feedback: Option<usize>,
    pub full_name: Option<usize>,
    /// What the university knows people by, as far as the site shows it.
    pub numbers: [Option<usize>; 2],
    /// The group that hands in together; only in assignments where groups do.
    pub group: Option<usize>,
}

// Japanese Moodle has called a grade 評点, 評定 and 成績 in its versions; each of these names goes with each of them.
const GRADE: [&str; 4] = ["grade", "評定", "評点", "成績"];
const IDENTIFIER: [&str; 5] = ["identifier", "id", "識別子", "識別番号", "参加者id"];
const FULL_NAME: [&str; 4] = ["fullname", "フルネーム", "氏名", "姓名"];
const ID_NUMBER: [&str; 4] = ["idnumber", "idナンバー", "学籍番号", "学生番号"];
const USERNAME: [&str; 3] = ["username", "ユーザ名", "ユーザー名"];
const STATUS: [&str; 3] = ["status", "ステータス", "状態"];
const GROUP: [&str; 2] = ["group", "グループ"];
const SCALE: [&str; 4] = ["scale", "尺度", "評価尺度", "評定尺度"];

impl WorksheetColumns {
    /// The columns of a header. `cells` gives what stands in a column, blank cells left out: an identifier column is
    /// known by that where its name is not.
    pub fn find(header: &[String], cells: impl Fn(usize) -> Vec<String>) -> Result<Self, Fault> {
        let names: Vec<String> = header.iter().map(|name| simplified(name)).collect();
        let position = |matches: &dyn Fn(&str) -> bool| names.iter().position(|name| matches(name));
        let missing = |en: &str, ja: &str| missing(en, ja, header);

        let has_numbers = |cells: &[String]| cells.is_empty() || cells.iter().any(|cell| participant(cell).is_some());
        let is_identifier = |cells: &[String]| !cells.is_empty() && cells.iter().all(|cell| is_participant(cell));
        let identifier = position(&|name| IDENTIFIER.contains(&name))
            .filter(|column| has_numbers(&cells(*column)))
            .or_else(|| (0..names.len()).find(|column| is_identifier(&cells(*column))));
        let maximum = position(&is_maximum);
        if maximum.is_none() && position(&|name| SCALE.contains(&name)).is_some() {
            return Err(scale());
        }
        // A profile field may be called the same (学年 is `Grade` too): Moodle's stands right before its maximum.
        let grade = maximum
            .and_then(|column| column.checked_sub(1))
            .filter(|column| GRADE.contains(&names[*column].as_str()))
            .or_else(|| position(&|name| GRADE.contains(&name)));
        let grade = grade.ok_or_else(|| missing("Grade", "評定"))?;
        // Moodle's column of the group stands between status and grade; a profile field of that name before both.
        let status = position(&|name| STATUS.contains(&name));
        let group =
            (status.map_or(0, |status| status + 1)..grade).find(|column| GROUP.contains(&names[*column].as_str()));
        Ok(Self {
            identifier: identifier.ok_or_else(|| missing("Identifier", "ID"))?,
            grade,
            maximum: maximum.ok_or_else(|| missing("Maximum grade", "最大評定"))?,
            can_change: position(&is_can_change),
            feedback: position(&is_feedback),
            full_name: position(&|name| FULL_NAME.contains(&name)),
            numbers: [position(&|name| ID_NUMBER.contains(&name)), position(&|name| USERNAME.contains(&name))],
            group,
        })
    }
}

/// A name without case, blanks and the width of its letters.
fn simplified(name: &str) -> String {
    let half_width = |c: char| match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(c as u32 - 0xfee0).unwrap_or(c),
        c => c,
    };
    let letters = name.chars().map(half_width).filter(|c| !c.is_whitespace() && *c != '\u{feff}');
    letters.flat_map(char::to_lowercase).collect()
}

fn is_maximum(name: &str) -> bool {
    let grade = GRADE[1..].iter().any(|grade| name.contains(grade)) || name.contains('点');
    matches!(name, "maximumgrade" | "maxgrade") || (grade && (name.contains("最大") || name.contains("最高")))
}

fn is_can_change(name: &str) -> bool {
    // 最終変更日時(評定) is a time.
    let japanese = name.contains("変更") && !name.contains("日時") && !name.contains("最終");
    name == "gradecanbechanged" || (japanese && GRADE[1..].iter().any(|grade| name.contains(grade)))
}

fn is_feedback(name: &str) -> bool {
    name == "feedbackcomments" || (name.contains("フィードバック") && name.contains("コメント"))
}

/// Whether a cell of "Grade can be changed" says no.
pub(super) fn says_no(cell: &str) -> bool {
    matches!(simplified(cell).as_str(), "no" | "いいえ" | "no." | "不可" | "false" | "0")
}

/// The number at the end of `Participant 1234`, `参加者1234`, `１２３４`.
pub(super) fn participant(cell: &str) -> Option<u64> {
    let cell = simplified(cell);
    let digits = cell.len() - cell.bytes().rev().take_while(u8::is_ascii_digit).count();
    cell[digits..].parse().ok()
}

/// The same where a word stands before the number, as Moodle writes it.
fn is_participant(cell: &str) -> bool {
    let cell = simplified(cell);
    let word = cell.trim_end_matches(|c: char| c.is_ascii_digit());
    word.len() < cell.len()
        && matches!(word, "participant" | "参加者" | "受講者" | "受験者" | "user" | "ユーザ" | "ユーザー")
}

fn missing(en: &str, ja: &str, header: &[String]) -> Fault {
    let header: Vec<String> = header.iter().map(|name| super::super::plain::one_line(name)).collect();
    Fault::new(Text::new(
        format!("The worksheet has no column `{en}`; its columns are: {}.", header.join(" | ")),
        format!("ワークシートに「{ja}」の列がありません。見つかった列：{}", header.join(" | ")),
    ))
    .remedy(Text::new(
        "Take the file that Moodle makes with \"Download grading worksheet\" (set Moodle to English or Japanese first).",
        "Moodle の「評定ワークシートをダウンロードする」で作ったファイルを渡してください（Moodle の表示言語は日本語か英語）。",
    ))
}

fn scale() -> Fault {
    Fault::new(Text::new(
        "The worksheet grades by a scale of words, which points cannot be turned into.",
        "ワークシートの評定が尺度（言葉による段階）になっているため、点数を記入できません。",
    ))
    .remedy(Text::new(
        "Set the assignment's grade type to Point in Moodle and download the worksheet again.",
        "Moodle の課題の設定で評定のタイプを「評点（ポイント）」にし、ワークシートをもう一度ダウンロードしてください。",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(header: &str) -> Result<WorksheetColumns, Fault> {
        let header: Vec<String> = header.split(',').map(str::to_owned).collect();
        WorksheetColumns::find(&header, |column| vec![if column == 0 { "参加者 1" } else { "x" }.to_owned()])
    }

    const EXPECTED: WorksheetColumns = WorksheetColumns {
        identifier: 0,
        grade: 3,
        maximum: 4,
        can_change: Some(5),
        feedback: Some(8),
        full_name: Some(1),
        numbers: [None, None],
        group: None,
    };

    #[test]
    fn headers_of_both_languages_are_known() {
        for header in [
            "Identifier,Full name,Email address,Grade,Maximum Grade,Grade can be changed,Last modified (submission),\
             Last modified (grade),Feedback comments",
            "Identifier,Full name,Status,Grade,Maximum grade,Grade can be changed,Online text,\
             Last modified (grade),Feedback comments",
            "ID,氏名,メールアドレス,評定,最大評定,評定を変更できます,最終更新日時 (提出),最終更新日時 (評定),フィードバックコメント",
            "識別子,フルネーム,ステータス,評点,最大評点,評点の変更可,最終更新日時（提出）,最終変更日時（評点）,フィードバック コメント",
        ] {
            assert_eq!(find(header), Ok(EXPECTED), "{header}");
        }
    }

    #[test]
    fn the_grade_before_its_maximum_is_moodles() {
        let columns = find("Identifier,Grade,Full name,Grade,Maximum Grade").expect("columns");
        assert_eq!((columns.grade, columns.can_change, columns.feedback), (3, None, None));
        // What the first column is called does not matter where its cells say what they are.
        assert_eq!(find("識別,氏名,評定,最大評定").expect("columns").identifier, 0);
    }

    #[test]
    fn the_group_behind_the_status_is_moodles() {
        let group = |header| find(header).expect("columns").group;
        assert_eq!(group("Identifier,Full name,Group,Status,Group,Grade,Maximum Grade"), Some(4));
        assert_eq!(group("ID,フルネーム,ステータス,グループ,評点,最大評点"), Some(3));
        // Fields of the profile, and nobody hands in with a group.
        assert_eq!(group("Identifier,Full name,Group,Status,Grade,Maximum Grade"), None);
        assert_eq!(group("Identifier,Full name,Status,Grade,Maximum Grade,Group"), None);
    }

    #[test]
    fn what_cannot_be_filled_is_named() {
        assert!(find("Identifier,Grade,Scale").unwrap_err().message.en.contains("scale"));
        let fault = find("Bezeichner,Bewertung,Bestwertung").unwrap_err();
        assert!(fault.message.en.contains("`Grade`") && fault.message.en.contains("Bezeichner | Bewertung"));
        assert!(find("Identifier,Grade").unwrap_err().message.ja.contains("最大評定"));
    }

    #[test]
    fn numbers_are_read_from_the_right() {
        for cell in ["Participant 1234", "参加者1234", "参加者 1234", "参加者　１２３４", " Participant 1234 ", "1234"]
        {
            assert_eq!(participant(cell), Some(1234), "{cell}");
        }
        assert_eq!(participant("Participant"), None);
        assert_eq!(participant("Participant 99999999999999999999999"), None);
        assert!(is_participant("Participant 1") && is_participant("参加者1"));
        assert!(!is_participant("1") && !is_participant("Anna 1") && !is_participant("Participant"));
    }
}
