//! What was handed in, to be saved and never to be shown by a browser.

use super::Service;
use super::errors::Problem;
use crate::hand_in::HandIn;
use crate::intake::portable;
use crate::source::lookalikes::is_bidi;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use std::io::Write;

/// The files of a submission: one as it is, several as a ZIP.
pub async fn hand_in(service: &Service, id: &str) -> Result<Response, Problem> {
    let store = &service.store;
    let (submission, hand_in) = (store.submission(id).await?, store.hand_in(id).await?);
    let (submission, hand_in) = submission.zip(hand_in).ok_or_else(Problem::not_found)?;
    files(&submission.assignment, &hand_in)
}

/// Files to be saved; `title` is the name of several of them together.
pub fn files(title: &str, hand_in: &HandIn) -> Result<Response, Problem> {
    let (name, bytes) = match hand_in.files.as_slice() {
        [only] => (only.name.clone(), only.bytes.clone()),
        _ => (format!("{title}.zip"), zipped(hand_in).map_err(|error| Problem::internal(&error))?),
    };
    Ok(saved(&name, "application/octet-stream", bytes))
}

/// Bytes to be saved under a name.
pub fn saved(name: &str, content_type: &'static str, bytes: Vec<u8>) -> Response {
    let mut response = bytes.into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(content_type));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("private, no-store"));
    if let Ok(disposition) = HeaderValue::from_str(&attachment(name)) {
        headers.insert(header::CONTENT_DISPOSITION, disposition);
    }
    response
}

/// Rows as a table to be saved under a name.
pub fn table<R>(name: &str, rows: impl IntoIterator<Item = R>) -> Result<Response, Problem>
where
    R: IntoIterator<Item: AsRef<[u8]>>,
{
    Ok(saved(name, "text/csv; charset=utf-8", csv(rows)?))
}

/// Rows as CSV for a spreadsheet: UTF-8 with a byte-order mark and CRLF, so that Excel opens it as it is. What could be a formula is
/// text before it comes here.
pub fn csv<R>(rows: impl IntoIterator<Item = R>) -> Result<Vec<u8>, Problem>
where
    R: IntoIterator<Item: AsRef<[u8]>>,
{
    let bytes = b"\xef\xbb\xbf".to_vec();
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(bytes);
    for row in rows {
        writer.write_record(row).map_err(|error| Problem::internal(&error))?;
    }
    writer.into_inner().map_err(|error| Problem::internal(&error))
}

fn zipped(hand_in: &HandIn) -> zip::result::ZipResult<Vec<u8>> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for file in &hand_in.files {
        zip.start_file(&file.name, zip::write::SimpleFileOptions::default())?;
        zip.write_all(&file.bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

/// The name of a file that a student named, as every system takes it for a file in a folder: nothing of it leads elsewhere.
pub fn plain_name(name: &str) -> String {
    let is_plain =
        |c: char| !matches!(c, '/' | '\\' | '<' | '>' | ':' | '"' | '|' | '?' | '*') && !c.is_control() && !is_bidi(c);
    let plain: String = name.chars().map(|c| if is_plain(c) { c } else { '_' }).collect();
    let plain = plain.trim_start_matches('.');
    if plain.is_empty() { "file".to_owned() } else { portable(plain) }
}

/// A `Content-Disposition` under which a browser saves a file, whatever its name has in it (RFC 6266).
pub fn attachment(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    let ascii: String = name.chars().map(|c| if plain(c) { c } else { '_' }).collect();
    let encode = |byte: u8| if plain(byte as char) { (byte as char).to_string() } else { format!("%{byte:02X}") };
    let encoded: String = name.bytes().map(encode).collect();
    format!("attachment; filename=\"{ascii}\"; filename*=UTF-8''{encoded}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_in::HandedInFile;

    #[test]
    fn no_name_breaks_out_of_its_header() {
        assert_eq!(attachment("a.vert"), "attachment; filename=\"a.vert\"; filename*=UTF-8''a.vert");
        assert_eq!(
            attachment("課\"\r\n.vert"),
            "attachment; filename=\"____.vert\"; filename*=UTF-8''%E8%AA%B2%22%0D%0A.vert"
        );
    }

    #[test]
    fn a_plain_name_is_one_on_every_system() {
        for (name, plain) in [
            ("課題 (2).vert", "課題 (2).vert"),
            ("a<b>:\"c|d?e*.vert", "a_b___c_d_e_.vert"),
            ("..\\up/x", "_up_x"),
            ("aux.vert", "_aux.vert"),
            ("CON .vert", "_CON .vert"),
            ("end. ", "end. _"),
            ("end.", "end._"),
            ("..", "file"),
        ] {
            assert_eq!(plain_name(name), plain, "{name}");
        }
    }

    #[test]
    fn several_files_are_an_archive_of_them() {
        let files = [("課題.vert", "v"), ("b.frag", "f")].map(|(name, text)| HandedInFile::new(name, text));
        let bytes = zipped(&HandIn { files: files.clone().into() }).unwrap();
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
        let found: Vec<_> = (0..archive.len())
            .map(|index| {
                let mut member = archive.by_index(index).unwrap();
                let mut bytes = Vec::new();
                std::io::copy(&mut member, &mut bytes).unwrap();
                HandedInFile::new(member.name().unwrap(), bytes)
            })
            .collect();
        assert_eq!(found, files);
    }
}
