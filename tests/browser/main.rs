//! The pages in a real browser: as a student, on a phone, without scripts, as a teacher.
//!
//! Every page that is met is held to what holds for all (`Browser::check`): accessible in light and dark, no complaint
//! of the browser, no scrolling sideways. Pictures of the pages are written to `target/screenshots/`.

#[path = "../chromium/mod.rs"]
mod chromium;
mod course;
mod courses;
mod drafts;
mod editor;
mod files;
mod folders;
mod offline;
mod people;
mod preview;
mod several;
mod sign_in;
mod staying;
mod teacher;

use chromium::server::Server;
use chromium::{Browser, processes, sample};

const RIGHT: &str = "accepted/answers/alpha-two.vert";
const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";
const BROKEN: &str = "rejected/undeclared-capital-max.vert";

/// A hostile file: its name and text try to leave their place, and its loop never ends.
fn hostile(folder: &std::path::Path) -> String {
    let path = folder.join("<img src=x onerror=alert(1)>.vert");
    let text = "#version 410 core\n// </textarea></script><script>alert(1)</script>\nin vec4 pv; in vec4 cv;\n\
                uniform mat4 mw, mc, mg;\nout vec4 vc;\nvoid main() {\n  float x = 0.0;\n  while (pv.w > 0.5) x += 0.001;\n\
                vc = vec4(x);\n  gl_Position = mc * pv;\n}\n";
    std::fs::write(&path, text).expect("a file");
    path.to_string_lossy().into_owned()
}

/// Chooses a file on the student's page and waits for its result, which is a draft.
pub(crate) async fn choose(browser: &Browser, file: &str, mark: &str) {
    let name = std::path::Path::new(file).file_name().expect("a name").to_string_lossy();
    browser.keys("#file", file).await;
    browser
        .until(&format!(
            "document.querySelector('article.report[data-mark={mark}] .file')?.textContent === {name:?} && \
                            !document.querySelector('[aria-busy]')"
        ))
        .await;
}

/// Hands in, and goes from the receipt to the page of the report.
async fn hand_in(browser: &Browser) {
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('.receipt .permalink')").await;
    let link = browser.js("return document.querySelector('.receipt .permalink').href").await;
    browser.open(link.as_str().expect("a link")).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_test_that_fails_leaves_no_browser_running() {
    let profile = tokio::spawn(async {
        let browser = Browser::start().await;
        let profile = browser.profile();
        assert!(!processes::of_profile(&profile).is_empty(), "the browser is looked for by its profile");
        std::panic::panic_any(profile)
    });
    let failed = profile.await.expect_err("a panic").into_panic();
    let profile = failed.downcast::<std::path::PathBuf>().expect("a folder");
    assert_eq!(processes::of_profile(&profile), []);
    assert!(!profile.exists());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_student_uploads_right_wrong_broken_and_hostile_files() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    assert_eq!(browser.text("h1").await, "Gouraud shading");
    browser.check("student-first").await;
    // One line holds all that can be done with the text.
    for language in ["ja", "en"] {
        browser.open(&server.at(&format!("/?lang={language}"))).await;
        let middles = "[...document.querySelectorAll('.bar-of-tools :is(.pick, button.quiet, .primary)')] \
                       .map(e => e.getBoundingClientRect()).map(box => (box.top + box.bottom) / 2)";
        browser.until(&format!("Math.max(...{middles}) - Math.min(...{middles}) < 4 && {middles}.length === 4")).await;
    }

    choose(&browser, &sample(WRONG), "partial").await;
    assert_eq!(browser.text(".result .word").await, "Not right yet");
    assert_eq!(browser.text(".result .score").await.replace('\n', " "), "Score 80 / 100");
    // The half vector is not normalised in line 33: the editor marks it, and a link of the report leads there.
    browser.until("document.querySelector('.cm-gutterElement.rubric')?.textContent === '33'").await;
    browser.click(".report a[href='#L33']").await;
    browser.until("document.activeElement.matches('.cm-content')").await;
    assert_eq!(browser.js("return String(getSelection())").await, "  vec3 h = (l + v) / 2.0;      // 中間ベクトル");
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("student-wrong-draft").await;
    browser.size(1265, 1200).await;
    browser.js("getSelection().removeAllRanges(); document.activeElement.blur()").await;
    browser.window("readme-student").await;
    browser.size(1280, 900).await;
    assert!(!browser.has(".attempts").await, "a draft is no attempt");

    hand_in(&browser).await;
    assert_eq!(browser.text(".word").await, "Not right yet");
    browser.check("report-wrong").await;
    let link = browser.address().await;

    browser.open(&server.at("/")).await;
    browser.until("document.querySelectorAll('.attempts li').length === 1").await;
    choose(&browser, &sample(BROKEN), "none").await;
    assert_eq!(browser.text(".result .word").await, "Not accepted");
    assert!(browser.has(".cm-gutterElement.error").await && browser.has(".cm-line.error mark").await);
    assert!(browser.has(".cm-content[aria-invalid=true]").await);
    browser.check("student-broken").await;

    let folder = tempfile::tempdir().expect("a folder");
    choose(&browser, &hostile(folder.path()), "none").await;
    assert_eq!(browser.text(".result .word").await, "Stopped");
    assert!(browser.text(".result .file").await.contains("<img src=x onerror=alert(1)>"), "shown as it is");
    browser.check("student-hostile").await;
    hand_in(&browser).await;
    browser.check("report-hostile").await;

    browser.open(&server.at("/?lang=ja")).await;
    assert_eq!(browser.js("return document.documentElement.lang").await, "ja");
    choose(&browser, &sample(RIGHT), "full").await;
    assert_eq!(browser.text(".result .word").await, "正解");
    browser.check("student-right-ja").await;
    hand_in(&browser).await;
    browser.check("report-right-ja").await;
    browser.open(&server.at("/")).await;
    assert_eq!(browser.js("return document.documentElement.lang").await, "ja", "the choice is remembered");
    browser.until("document.querySelectorAll('.attempts li').length === 3").await;
    assert!(browser.text(".attempts .best").await.contains("100"));
    browser.check("student-attempts-ja").await;

    // Whoever has the link sees the report, with none of the student's cookies.
    browser.devtools("Network.clearBrowserCookies", serde_json::json!({})).await;
    browser.open(&link).await;
    assert_eq!(browser.text(".word").await, "Not right yet");
    browser.open(&server.at("/")).await;
    assert!(!browser.has(".attempts").await, "nobody sees another one's attempts");
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_editor_grades_what_is_typed_last() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    // The cursor goes behind `vc = ` and the answer is typed, with a slip first.
    browser.cursor_into("vc = cv;", 5).await;
    browser.press("Delete", 46, 0).await;
    browser.press("Delete", 46, 0).await;
    browser.type_text("kamb * lam").await;
    browser.until("document.querySelector('article.report[data-mark=none]')").await;
    browser.type_text("b + max(dot(n, l), 0.0) * kdiff * ldiff").await;
    browser.type_text(" + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec").await;
    browser.until("document.querySelector('article.report[data-mark=full]')").await;
    assert!(browser.text("#state").await.starts_with("Correct: 100 / 100"), "said in the live region");
    assert!(!browser.has(".cm-gutterElement.error").await, "no mark is left behind");
    browser.check("editor-typed").await;

    // The animation stops at a pose, by keyboard.
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.js("document.querySelector('.player input').focus()").await;
    browser.keys(".player input", "\u{E014}\u{E014}").await;
    browser.until("document.querySelector('.player').classList.contains('paused')").await;

    // Tab leaves the editor.
    browser.cursor_to("void main").await;
    browser.press("Tab", 9, 0).await;
    browser.until("!document.activeElement.closest('[data-editor]')").await;

    // What was typed is still there when the page is opened again, and is graded; the hand-out comes back on demand.
    browser.open(&server.at("/")).await;
    browser.until("document.querySelector('#code').value.includes('pow(max(dot(n, normalize')").await;
    browser.until("document.querySelector('article.report[data-mark=full]')").await;
    browser.click("[data-do=starter]").await;
    browser.until("document.querySelector('#code').value.includes('vc = cv;')").await;
    browser.until("document.querySelector('.brief')").await;

    // A file is dropped on the page.
    browser
        .js("const data = new DataTransfer(); data.items.add(new File(['no shader'], 'dropped.vert')); \
                dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));")
        .await;
    browser.until("document.querySelector('article.report .file')?.textContent === 'dropped.vert'").await;
    assert_eq!(browser.complaints().await, [] as [String; 0]);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_phone_and_a_browser_without_scripts_do_everything() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(320, 640).await;
    browser.languages("ja").await;
    browser.open(&server.at("/")).await;
    browser.check("phone-first").await;
    choose(&browser, &sample(WRONG), "partial").await;
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("phone-draft").await;
    hand_in(&browser).await;
    browser.check("phone-report").await;

    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.scripts(false).await;
    browser.open(&server.at("/")).await;
    browser.shot("no-script-first").await;
    assert!(!browser.has(".cm-editor").await);
    browser.keys("#file", &sample(BROKEN)).await;
    browser.click("[name=send][value=file][formaction]").await;
    browser.until_there("article.report .listing").await;
    assert!(browser.text(".about").await.starts_with("A draft"));
    browser.shot("no-script-draft").await;
    browser.open(&server.at("/")).await;
    browser.keys("#file", &sample(RIGHT)).await;
    browser.click("[name=send][value=file]:not([formaction])").await;
    browser.until_there("article.report.report .head.full").await;
    assert_eq!(browser.text(".word").await, "Correct");
    assert!(browser.text(".receipt").await.contains("100 / 100"));
    browser.shot("no-script-report").await;
    browser.end().await;
}
