//! Texts that people type: nothing of them is cut off without a word.

use super::errors::Problem;

/// Lets a text pass that is no longer than `most` characters; `en` and `ja` say what it is.
pub fn check_length(text: &str, most: usize, (en, ja): (&str, &str)) -> Result<(), Problem> {
    let count = text.trim().chars().count();
    if count <= most {
        return Ok(());
    }
    Err(Problem::unprocessable(
        format!("{en} has {count} characters, and {most} are the most. Make it shorter; nothing was saved."),
        format!("{ja}は {most} 文字以内で入力してください（現在 {count} 文字）。保存していません。"),
    ))
}
