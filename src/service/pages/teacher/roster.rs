//! The roster: a CSV file of student numbers and names.

use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::{self, TeacherPage};
use axum::extract::{Multipart, State as Shared};
use axum::response::{IntoResponse, Redirect, Response};

/// `POST /teacher/roster`: a CSV file of student numbers and names.
pub(in crate::service::pages) async fn take(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    mut form: Multipart,
) -> Result<Response, Problem> {
    let broken = |_| Problem::bad_request("The upload arrived incomplete.", "アップロードが途中で切れました。");
    let (mut csrf, mut bytes) = (String::new(), Vec::new());
    while let Some(field) = form.next_field().await.map_err(broken)? {
        match field.name().unwrap_or_default() {
            "csrf" => csrf = field.text().await.map_err(broken)?,
            "roster" => bytes = field.bytes().await.map_err(broken)?.to_vec(),
            _ => {}
        }
    }
    teacher.check_csrf(&state, &csrf)?;
    let roster = read_roster(&bytes)?;
    state.store.set_roster(&roster, state.clock.now()).await?;
    Ok(Redirect::to("/teacher/settings?done=roster").into_response())
}

/// Pairs of number and name: of each line the first cell that is a student number, and the first other one.
///
/// A line without a number is a heading where it is the first, and a mistake elsewhere.
fn read_roster(bytes: &[u8]) -> Result<Vec<(String, String)>, Problem> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.trim_start_matches('\u{feff}').to_owned(),
        Err(_) => encoding_rs::SHIFT_JIS.decode(bytes).0.into_owned(),
    };
    let delimiter = if text.lines().next().is_some_and(|line| line.contains('\t')) { b'\t' } else { b',' };
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(delimiter).from_reader(text.as_bytes());
    let mut roster = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let line = index + 1;
        let wrong = || {
            Problem::unprocessable(
                format!(
                    "Line {line} of the roster has no student number. A line looks like `s1234567,Family Given`; nothing was changed."
                ),
                format!(
                    "名簿の {line} 行目に学籍番号がありません。各行は「s1234567,氏名」の形にしてください。名簿は変更していません。"
                ),
            )
        };
        let record = record.map_err(|_| wrong())?;
        let cells: Vec<&str> = record.iter().map(str::trim).filter(|cell| !cell.is_empty()).collect();
        if cells.is_empty() {
            continue;
        }
        let has_digit = |number: &String| number.chars().any(|c| c.is_ascii_digit());
        let number = cells.iter().position(|cell| identity::normal_number(cell).as_ref().is_some_and(has_digit));
        match number {
            Some(place) => {
                let name = cells.iter().enumerate().find(|(index, _)| *index != place).map_or("", |(_, name)| name);
                roster.push((identity::normal_number(cells[place]).unwrap_or_default(), name.to_owned()));
            }
            None if line == 1 => {}
            None => return Err(wrong()),
        }
    }
    if roster.is_empty() {
        return Err(Problem::unprocessable(
            "The roster has no line with a student number; nothing was changed.",
            "名簿に学籍番号のある行がありません。名簿は変更していません。",
        ));
    }
    Ok(roster)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Vec<(String, String)> {
        read_roster(text.as_bytes()).expect("a roster")
    }

    fn pair(number: &str, name: &str) -> (String, String) {
        (number.to_owned(), name.to_owned())
    }

    #[test]
    fn a_roster_is_read_in_the_forms_that_spreadsheets_write() {
        let expected = [pair("S1234567", "和田 花子"), pair("S1234568", "Smith, J.")];
        assert_eq!(of("\u{feff}学籍番号,氏名\r\ns1234567,和田 花子\r\n\r\nｓ1234568,\"Smith, J.\"\r\n"), expected);
        assert_eq!(of("和田 花子\ts1234567\nSmith, J.\ts1234568"), expected);
        let (sjis, _, _) = encoding_rs::SHIFT_JIS.encode("s1234567,和田 花子\n");
        assert_eq!(read_roster(&sjis).expect("a roster"), [pair("S1234567", "和田 花子")]);
    }

    #[test]
    fn a_line_without_a_number_is_named() {
        let problem = read_roster("s1234567,A\nB only\n".as_bytes()).expect_err("a problem");
        assert!(problem.detail.en.starts_with("Line 2 ") && problem.detail.ja.contains("2 行目"));
        assert!(read_roster(b"").is_err() && read_roster(b"number,name\n").is_err());
    }
}
