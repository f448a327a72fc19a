//! A homework of several files in the page: an editor for each, files that find their slots, marks in the right file.

use crate::chromium::server::Server;
use crate::chromium::{Browser, root};
use serde_json::json;

/// Widths of a phone, a laptop and a wide screen, with the heights that go with them.
const SIZES: [(u32, u32); 3] = [(390, 844), (1280, 900), (1920, 1080)];
const WRONG: &str = "wrong/no-paint";

fn serve() -> Server {
    Server::serving(&[root().join("tests/homeworks/bumps")])
}

/// A file of the homework, or of a sample of it.
fn file(path: &str) -> String {
    let folders = ["tests/homeworks/bumps", "submissions/bumps"];
    let found = folders.iter().map(|folder| root().join(folder).join(path)).find(|path| path.is_file());
    found.unwrap_or_else(|| panic!("{path}")).to_string_lossy().into_owned()
}

/// Files with these texts, in a folder of their own.
fn files(folder: &std::path::Path, texts: &[(&str, &str)]) -> Vec<String> {
    let write = |(name, text): &(&str, &str)| {
        std::fs::write(folder.join(name), text).expect("a file");
        folder.join(name).to_string_lossy().into_owned()
    };
    texts.iter().map(write).collect()
}

/// Chooses files at once.
async fn choose(browser: &Browser, files: &[String]) {
    browser.keys("#file", &files.join("\n")).await;
}

/// Waits for the report with this sign.
async fn until_marked(browser: &Browser, mark: &str) {
    browser
        .until(&format!(
            "document.querySelector('.shown > article.report[data-mark={mark}]') && !document.querySelector('[aria-busy]')"
        ))
        .await;
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
}

/// What the editors hold, the first file's and the second's.
async fn texts(browser: &Browser) -> [String; 2] {
    let found = browser.js("return [...document.querySelectorAll('textarea')].map(t => t.value)").await;
    [0, 1].map(|index| found[index].as_str().expect("a text").to_owned())
}

/// The name of the file in sight.
async fn in_sight(browser: &Browser) -> String {
    let name = browser.js("return document.querySelector('[data-editor]:not([data-behind])').dataset.file").await;
    name.as_str().expect("a name").to_owned()
}

fn read(path: &str) -> String {
    std::fs::read_to_string(file(path)).expect("a text")
}

#[tokio::test(flavor = "multi_thread")]
async fn two_files_have_an_editor_each_on_every_screen() {
    let (server, browser) = (serve(), Browser::start().await);
    for language in ["ja", "en"] {
        for (width, height) in SIZES {
            browser.size(width, height).await;
            browser.open(&server.at(&format!("/?lang={language}"))).await;
            assert_eq!(browser.count("[role=tab]").await, 2);
            browser.check(&format!("several-first-{width}-{language}")).await;
        }
    }
    // The keyboard goes from tab to tab, and from there into the editor of its file.
    browser.js("document.querySelector('[role=tab]').focus()").await;
    assert_eq!(in_sight(&browser).await, "bumps.vert");
    browser.press("ArrowRight", 39, 0).await;
    assert_eq!(in_sight(&browser).await, "bumps.frag");
    browser.press("Tab", 9, 0).await;
    browser.until("document.activeElement.getAttribute('aria-label') === 'bumps.frag'").await;
    browser.press("Home", 36, 2).await;
    browser.type_text("/*mine*/").await;
    browser.until("document.querySelector('#code-2').value.startsWith('/*mine*/#version')").await;
    browser.until("document.querySelector('article.report')").await;
    browser.press("Tab", 9, 8).await;
    browser.until("document.activeElement.matches('[role=tab][aria-selected=true]')").await;
    browser.press("Home", 36, 0).await;
    assert_eq!(in_sight(&browser).await, "bumps.vert");
    assert!(!browser.has("[data-behind] :focus").await);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn files_find_their_slots_and_marks_their_files() {
    let (server, browser) = (serve(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    // Both at once, in the wrong order, under names of the student's own.
    choose(&browser, &[file("solution.frag"), file("solution.vert")]).await;
    until_marked(&browser, "full").await;
    assert_eq!(texts(&browser).await, [read("solution.vert"), read("solution.frag")]);
    assert!(browser.text("article.report .file").await.contains("solution.vert, solution.frag"));
    assert!(browser.js("return document.querySelector('.note-of-file').hidden").await == true);
    for (width, height) in SIZES {
        browser.size(width, height).await;
        browser.check(&format!("several-right-{width}")).await;
    }

    // One file alone goes to its slot, which comes into sight; the other stays. Its mistake is marked there.
    browser.size(1280, 900).await;
    let folder = tempfile::tempdir().expect("a folder");
    let broken = read("solution.frag").replace("float lit = 0.2", "float lit = nothing");
    let [one] = files(folder.path(), &[("mine.fs", &broken)]).try_into().expect("a file");
    choose(&browser, &[one]).await;
    until_marked(&browser, "none").await;
    assert_eq!(in_sight(&browser).await, "bumps.frag");
    assert_eq!(texts(&browser).await, [read("solution.vert"), broken]);
    browser.until("document.querySelector('#code-2-page .cm-gutterElement.error')?.textContent === '11'").await;
    assert!(!browser.has("#code-page .cm-gutterElement.error").await);
    assert_eq!(browser.text("[role=tab][data-mark=error]").await.replace('\n', " "), "bumps.frag has errors");
    browser.check("several-broken").await;
    // A link of the report leads there from the other file.
    browser.click("#code-tab").await;
    browser.click(".report a[href='#F2L11']").await;
    browser.until("document.activeElement.closest('#code-2-page')").await;
    assert!(browser.js("return String(getSelection())").await.as_str().expect("a text").contains("lit = nothing"));
    assert_eq!(in_sight(&browser).await, "bumps.frag");

    // What is double is named with its slot, and nothing changes.
    let twice = files(folder.path(), &[("a.frag", "// 1\n"), ("b.frag", "// 2\n")]);
    choose(&browser, &twice).await;
    browser.until("document.querySelector('.note-of-file').textContent.includes('which file is `bumps.frag`')").await;
    assert!(texts(&browser).await[1].contains("nothing"));
    // A refused request is answered with 422, which the browser notes.
    browser.complaints().await;
    browser.check("several-double").await;
    // Of many files those that are none of the homework are left aside, and it is said what was taken.
    let many = files(folder.path(), &[("main.cpp", "int main() {}\n"), ("bumps.vert", &read("solution.vert"))]);
    choose(&browser, &many).await;
    browser.until("document.querySelector('.note-of-file').textContent.includes('bumps.vert was read')").await;
    // What was read is in sight, until its report says that the mistake is in the other file.
    browser.until("document.querySelector('[data-editor]:not([data-behind])').dataset.file === 'bumps.frag'").await;

    // A ZIP of both, dropped on the page.
    let archive = folder.path().join("mine.zip");
    let mut zip = zip::ZipWriter::new(std::fs::File::create(&archive).expect("a file"));
    for name in ["starter.frag", "starter.vert"] {
        zip.start_file(format!("homework/{name}"), zip::write::SimpleFileOptions::default()).expect("a member");
        std::io::Write::write_all(&mut zip, read(name).as_bytes()).expect("its bytes");
    }
    zip.finish().expect("an archive");
    let bytes = std::fs::read(&archive).expect("an archive");
    browser
        .js(&format!(
            "const data = new DataTransfer(); \
             data.items.add(new File([new Uint8Array({})], 'mine.zip', {{ type: 'application/zip' }})); \
             dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }}));",
            json!(bytes)
        ))
        .await;
    browser.until("document.querySelector('#code-2').value.includes('0.5, 0.5, 0.5')").await;
    assert_eq!(texts(&browser).await, [read("starter.vert"), read("starter.frag")]);
    assert_eq!(browser.complaints().await, [] as [String; 0]);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn drafts_are_kept_for_each_file_and_a_hand_in_is_gone_on_with() {
    let (server, browser) = (serve(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    browser.cursor_to("void main").await;
    browser.type_text("/*first*/").await;
    browser.click("#code-2-tab").await;
    browser.js("document.querySelector('#code-2-page .cm-content').focus()").await;
    browser.press("Home", 36, 2).await;
    browser.type_text("/*second*/").await;
    browser
        .until("Object.entries(localStorage).some(([k, v]) => k.includes(' bumps.frag ') && v.includes('second'))")
        .await;
    browser.open(&server.at("/")).await;
    let [vertex, fragment] = texts(&browser).await;
    assert!(vertex.contains("/*first*/void main") && fragment.starts_with("/*second*/"), "{vertex}\n{fragment}");
    until_marked(&browser, "none").await;

    // The versions are those of the file in sight, and so is the way back to the hand-out.
    browser.click("#code-2-tab").await;
    browser.click("[data-do=starter]").await;
    browser.until("!document.querySelector('#code-2').value.includes('second')").await;
    assert!(texts(&browser).await[0].contains("first"), "the other file stays");
    browser.click("form.work [data-do=versions].quiet").await;
    browser.until("document.querySelector('dialog.versions').open").await;
    assert!(browser.text("dialog.versions h2").await.contains("bumps.frag"));
    browser.check("several-versions").await;
    browser.click("dialog [data-do=restore]").await;
    browser.until("document.querySelector('#code-2').value.startsWith('/*second*/')").await;

    // Handed in, both files are in the receipt and in the report.
    choose(&browser, &[file(&format!("{WRONG}/bumps.frag")), file(&format!("{WRONG}/bumps.vert"))]).await;
    until_marked(&browser, "partial").await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('.receipt .permalink')").await;
    let receipt = browser.text(".receipt").await;
    assert!(receipt.contains("bumps.vert") && receipt.contains("bumps.frag"), "{receipt}");
    browser.check("several-receipt").await;
    let link = browser.js("return document.querySelector('.receipt .permalink').href").await;
    for language in ["ja", "en"] {
        browser.open(&format!("{}?lang={language}", link.as_str().expect("a link"))).await;
        assert_eq!(browser.count(".listing").await, 2);
        for (width, height) in SIZES {
            browser.size(width, height).await;
            browser.check(&format!("several-report-{width}-{language}")).await;
        }
    }
    browser.size(1280, 900).await;
    browser.click(".actions a.button").await;
    browser.until("document.querySelector('#code-2')").await;
    let sample = ["bumps.vert", "bumps.frag"].map(|name| read(&format!("{WRONG}/{name}")));
    assert_eq!(texts(&browser).await, sample);
    browser.until("document.querySelector('article.report')").await;
    assert_eq!(browser.complaints().await, [] as [String; 0]);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn without_scripts_both_texts_and_both_files_are_handed_in() {
    let (server, browser) = (serve(), Browser::start().await);
    browser.languages("en").await;
    browser.scripts(false).await;
    for (width, height) in SIZES {
        browser.size(width, height).await;
        browser.open(&server.at("/")).await;
        browser.shot(&format!("several-no-script-{width}")).await;
    }
    browser.keys("#code", "// my own words\n").await;
    browser.keys("#code-2", "// and more of them\n").await;
    browser.click("[name=send][value=text]:not([formaction])").await;
    browser.until_there("article.report .listing").await;
    let report = browser.text("article.report").await;
    assert!(report.contains("my own words") && report.contains("and more of them"), "{report}");
    browser.open(&server.at("/")).await;
    choose(&browser, &[file("solution.frag"), file("solution.vert")]).await;
    browser.click("[name=send][value=file][formaction]").await;
    browser.until_there("article.report .head.full").await;
    // Only one of two: the page names the other.
    browser.open(&server.at("/")).await;
    choose(&browser, &[file("solution.frag")]).await;
    browser.click("[name=send][value=file]:not([formaction])").await;
    browser.until_there("[data-problem]").await;
    assert!(browser.text("[data-problem]").await.contains("There is no bumps.vert"));
    browser.end().await;
}
