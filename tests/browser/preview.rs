//! `ggrade assignment preview`: the open page follows the folder.

use crate::chromium::{Browser, root};
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// Widths of a phone, a laptop and a wide screen, with the heights that go with them.
const SIZES: [(u32, u32); 3] = [(390, 844), (1280, 900), (1920, 1080)];

/// A running preview of a copy of a homework.
struct Preview {
    child: Child,
    address: String,
    folder: tempfile::TempDir,
}

impl Preview {
    fn start(homework: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        for entry in std::fs::read_dir(root().join(homework)).expect("a homework") {
            let entry = entry.expect("an entry");
            std::fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("a copy");
        }
        let mut child = Command::new(env!("CARGO_BIN_EXE_ggrade"))
            .args(["assignment", "preview", "--no-open", "--lang", "en", "--deadline", "20"])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .expect("ggrade");
        let mut lines = BufReader::new(child.stdout.take().expect("standard output")).lines();
        let first = lines.next().expect("a line").expect("a text");
        let address = first.split_whitespace().next().expect("an address").to_owned();
        std::thread::spawn(move || lines.map_while(Result::ok).for_each(|line| eprintln!("{line}")));
        Self { child, address, folder }
    }

    fn path(&self, file: &str) -> PathBuf {
        self.folder.path().join(file)
    }

    fn replace(&self, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path("assignment.toml")).expect("a manifest");
        assert!(text.contains(from), "{from}");
        std::fs::write(self.path("assignment.toml"), text.replacen(from, to, 1)).expect("a file");
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Waits until the panel shows what the folder's own files score, with all pictures.
async fn until_graded(browser: &Browser) {
    browser.until("document.querySelectorAll('#preview li').length === 2").await;
    browser.until("[...document.querySelectorAll('#preview img')].every(i => i.complete && i.naturalWidth > 0)").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_open_page_follows_the_folder() {
    let (preview, browser) = (Preview::start("tests/homeworks/bumps"), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&preview.address).await;
    browser.until("document.querySelector('h1')?.textContent === 'Bumps'").await;
    until_graded(&browser).await;
    // The page may have been opened while the folder was still being read, which the browser notes.
    browser.complaints().await;
    assert_eq!(browser.count("#preview .frames img").await, 4);
    for (width, height) in SIZES {
        for language in ["ja", "en"] {
            browser.size(width, height).await;
            browser.open(&format!("{}?lang={language}", preview.address)).await;
            until_graded(&browser).await;
            browser.check(&format!("preview-{width}-{language}")).await;
        }
    }
    browser.size(1280, 900).await;
    browser.cursor_to("void main").await;
    browser.type_text("/*mine*/").await;
    browser.until("Object.values(localStorage).some(v => v.includes('/*mine*/void main'))").await;

    preview.replace("en = \"Bumps\"", "en = \"Dents\"");
    browser.until("document.querySelector('h1')?.textContent === 'Dents'").await;
    until_graded(&browser).await;
    assert!(browser.editor_text().await.contains("/*mine*/"), "what was typed is still there");
    browser.complaints().await;
    preview.replace("stage = \"fragment\"", "stage = \"pixel\"");
    browser.until("document.querySelector('h1')?.textContent === 'The folder cannot be used'").await;
    assert!(browser.text("[data-problem]").await.contains("assignment.toml, line"));
    // The page is answered with 503, which the browser notes.
    browser.complaints().await;
    for (width, height) in SIZES {
        browser.size(width, height).await;
        browser.check(&format!("preview-broken-{width}")).await;
    }
    preview.replace("stage = \"pixel\"", "stage = \"fragment\"");
    browser.until("document.querySelector('h1')?.textContent === 'Dents'").await;
    until_graded(&browser).await;
    browser.click("#preview li:first-child a").await;
    browser.until("document.querySelector('article.report .head.full')").await;
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_homework_of_one_file_and_many_pictures_fits_as_well() {
    let (preview, browser) = (Preview::start("reference/assignments/ggsample06"), Browser::start().await);
    browser.size(390, 844).await;
    browser.languages("ja").await;
    browser.open(&preview.address).await;
    until_graded(&browser).await;
    browser.complaints().await;
    browser.check("preview-one-390").await;
    browser.size(1280, 900).await;
    browser.check("preview-one-1280").await;
    browser.end().await;
}
