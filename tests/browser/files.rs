//! Files that are chosen on the student's page: what is no text changes nothing, and without scripts the button says what is sent.

use crate::chromium::server::Server;
use crate::chromium::{Browser, sample};
use crate::{BROKEN, RIGHT, choose};

/// Files that are no text, each with a word of why.
fn no_texts(folder: &std::path::Path) -> Vec<(String, &'static str)> {
    let utf16 =
        std::iter::once(0xFEFF_u16).chain("#version 410 core\nvoid main() {}\n".encode_utf16().map(u16::swap_bytes));
    let files: [(&str, Vec<u8>, &str); 5] = [
        (
            "picture.png",
            std::fs::read(crate::chromium::root().join("docs/images/student.png")).expect("a picture"),
            "larger than",
        ),
        ("small.png", b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0\x01".to_vec(), "picture (PNG)"),
        ("archive.zip", b"PK\x03\x04\x14\0\0\0\x08\0ggsample06.vert".to_vec(), "ZIP archive"),
        ("swapped.vert", utf16.flat_map(u16::to_le_bytes).collect(), "makes no sense"),
        ("empty.vert", Vec::new(), "empty"),
    ];
    files
        .into_iter()
        .map(|(name, bytes, word)| {
            let path = folder.join(name);
            std::fs::write(&path, bytes).expect("a file");
            (path.to_string_lossy().into_owned(), word)
        })
        .collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_no_text_changes_nothing() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    choose(&browser, &sample(RIGHT), "full").await;
    browser.cursor_to("void main").await;
    browser.type_text("/**/").await;
    browser.until("document.querySelector('article.report .file')?.textContent === 'ggsample06.vert'").await;
    browser.until("document.querySelector('#state').textContent.startsWith('Correct')").await;
    let text = browser.editor_text().await;
    let all = "return Object.entries(localStorage).flat().join('\\n')";
    let drafts = browser.js(all).await;
    let folder = tempfile::tempdir().expect("a folder");
    for (path, word) in no_texts(folder.path()) {
        browser.keys("#file", &path).await;
        let name = path.rsplit('/').next().expect("a name");
        browser.until(&format!("document.querySelector('.note-of-file').textContent.startsWith({name:?})")).await;
        let said = browser.text(".note-of-file").await;
        assert!(said.contains(word), "{name}: {said}");
        assert_eq!(browser.editor_text().await, text, "{name}");
        assert_eq!(browser.js(all).await, drafts, "{name} in the drafts");
        assert_eq!(browser.js("return document.querySelector('#file').files.length").await, 0, "{name} is not sent");
        assert!(browser.has("article.report[data-mark=full]").await, "{name}: the report stays with its text");
    }
    // A file in an encoding of Japan is read as grading reads it, and is sent as it is.
    browser
        .js("const append = FormData.prototype.append; \
             FormData.prototype.append = function (name, value) { \
               if (name === 'text') window.part = value; \
               return append.apply(this, arguments); \
             };")
        .await;
    for (file, encoding) in [("euc-jp", "EUC-JP"), ("shift-jis", "Shift_JIS"), ("iso-2022-jp", "ISO-2022-JP")] {
        let path = sample(&format!("hostile/accepted/encodings/{file}.vert"));
        browser.keys("#file", &path).await;
        browser.until(&format!("document.querySelector('article.report .file')?.textContent === '{file}.vert'")).await;
        let shown = browser.editor_text().await;
        assert!(
            shown.chars().any(|c| ('\u{3041}'..='\u{9FFF}').contains(&c)) && !shown.contains('\u{FFFD}'),
            "{encoding}: {shown}"
        );
        let bytes = std::fs::read(&path).expect("a sample");
        assert_eq!(browser.js("return window.part.size").await, bytes.len(), "{encoding}: the file itself is sent");
    }
    // Undo brings back what the file replaced.
    browser.cursor_to("void main").await;
    for _ in 0..3 {
        browser.press("z", 90, 2).await;
    }
    browser.until("document.querySelector('#code').value.includes('/**/void main')").await;
    assert_eq!(browser.editor_text().await, text);
    // Loaded again, the page goes on with the same text.
    browser.open(&server.at("/")).await;
    assert_eq!(browser.editor_text().await, text);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn without_scripts_the_button_says_what_is_sent() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.scripts(false).await;
    browser.open(&server.at("/")).await;
    // A text is typed and a file chosen: the text is sent by its button, the file by the other.
    browser.keys("#code", "// my own words\n").await;
    browser.keys("#file", &sample(BROKEN)).await;
    browser.shot("no-script-both").await;
    browser.click("[name=send][value=text]:not([formaction])").await;
    browser.until_there("article.report .listing").await;
    assert!(browser.text("article.report .listing").await.contains("my own words"));
    // The way back keeps what was typed.
    browser.back().await;
    browser.until_there("#code").await;
    browser.click("[name=send][value=text][formaction]").await;
    browser.until_there("article.report .listing").await;
    assert!(browser.text("article.report .listing").await.contains("my own words"));
    browser.back().await;
    browser.until_there("#code").await;
    browser.keys("#file", &sample(BROKEN)).await;
    browser.click("[name=send][value=file]:not([formaction])").await;
    browser.until_there("article.report .listing").await;
    assert!(!browser.text("article.report").await.contains("my own words"));

    // What cannot be graded is said on a page; the way back leads to the same form.
    let folder = tempfile::tempdir().expect("a folder");
    for (path, word) in no_texts(folder.path()) {
        browser.open(&server.at("/")).await;
        browser.keys("#file", &path).await;
        browser.click("[name=send][value=file]:not([formaction])").await;
        browser.until_there("[data-problem]").await;
        assert!(browser.text("[data-problem]").await.contains(word), "{path}");
    }
    browser.open(&server.at("/")).await;
    browser.click("[name=send][value=file]:not([formaction])").await;
    browser.until_there("[data-problem]").await;
    assert!(browser.text("[data-problem]").await.starts_with("No file is chosen"));
    browser.open(&server.at("/")).await;
    assert_eq!(browser.count(".attempts li").await, 2, "what was refused is no attempt");
    browser.end().await;
}
