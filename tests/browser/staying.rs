//! What stays in the student's page while it works: the report, the text, the page itself.

use crate::chromium::server::{Server, TOKEN};
use crate::chromium::{Browser, sample};
use crate::{WRONG, choose};
use serde_json::json;

/// Counts what the page sends from now on.
const COUNT: &str = "window.sent = []; const send = window.fetch; \
                     window.fetch = (...asked) => { window.sent.push(String(asked[0])); return send(...asked); };";

/// Puts the cursor into the editor.
const FOCUS: &str = "(document.querySelector('[data-editor] [contenteditable=true]') ?? document.querySelector('#code')) \
                     .focus({ preventScroll: true })";

async fn number(browser: &Browser, script: &str) -> f64 {
    browser.js(script).await.as_f64().unwrap_or_else(|| panic!("{script}: no number"))
}

async fn offline(browser: &Browser, is: bool) {
    let conditions = json!({ "offline": is, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1 });
    browser.devtools("Network.emulateNetworkConditions", conditions).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_slip_while_typing_leaves_the_report_where_it_is() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    // The goal picture stands at a pose in which every term shows.
    assert_eq!(browser.js("return document.querySelector('.goal .sheet').getAnimations().length").await, 2);
    choose(&browser, &sample(WRONG), "partial").await;
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    // The only frame that differs is the first; the pictures stand still there.
    assert_eq!(browser.js("return document.querySelector('.player input').value").await, "0");
    assert!(browser.has(".player.paused").await);
    browser.js("scrollTo({ top: 700, behavior: 'instant' })").await;
    let before = number(&browser, "return document.documentElement.scrollHeight").await;
    let top = number(&browser, "return document.querySelector('.player').getBoundingClientRect().top").await;

    browser.js(FOCUS).await;
    type_text(&browser, "x").await;
    browser.until("document.querySelector('.interruption a[href^=\"#L\"]')").await;
    assert_eq!(number(&browser, "return document.documentElement.scrollHeight").await, before);
    assert_eq!(number(&browser, "return document.querySelector('.player').getBoundingClientRect().top").await, top);
    assert!(browser.has(".stale .player").await, "the pictures are still there, dimmed");
    assert!(browser.has(".shown > article.report[data-mark=partial]").await);
    browser.check("typing-slip").await;
    // All that there is to say about it can be opened, and the editor is led to the line.
    browser.click(".interruption button").await;
    browser.until("document.querySelector('.interruption .messages .message').checkVisibility()").await;
    browser.check("typing-slip-open").await;

    browser.js(FOCUS).await;
    type_text(&browser, "\u{8}").await;
    browser.until("!document.querySelector('.stale') && !document.querySelector('.interruption > *')").await;
    browser.end().await;
}

/// Types where the cursor is, as the keyboard does; `\u{8}` deletes backwards.
async fn type_text(browser: &Browser, text: &str) {
    if text == "\u{8}" {
        for kind in ["rawKeyDown", "keyUp"] {
            let key = json!({ "type": kind, "key": "Backspace", "code": "Backspace", "windowsVirtualKeyCode": 8 });
            browser.devtools("Input.dispatchKeyEvent", key).await;
        }
    } else {
        browser.devtools("Input.insertText", json!({ "text": text })).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_being_composed_is_not_graded() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.open(&server.at("/")).await;
    browser.js(COUNT).await;
    browser.js(FOCUS).await;
    for text in ["え", "えい", "えいご"] {
        let composition = json!({ "text": text, "selectionStart": 0, "selectionEnd": 0 });
        browser.devtools("Input.imeSetComposition", composition).await;
        // Longer than the pause after which a text is graded.
        tokio::time::sleep(std::time::Duration::from_millis(600)).await;
    }
    assert_eq!(browser.js("return window.sent.length").await, 0);
    browser.devtools("Input.insertText", json!({ "text": "英語" })).await;
    browser.until("window.sent.length === 1").await;
    browser.until("document.querySelector('article.report')").await;
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn handing_in_gives_a_receipt_even_where_the_connection_was_gone() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    choose(&browser, &sample(WRONG), "partial").await;
    let page = browser.address().await;
    browser.js(COUNT).await;
    offline(&browser, true).await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('#state').textContent.includes('not handed in yet')").await;
    // Somebody who is impatient hands nothing in twice.
    browser.click("form.work .primary").await;
    offline(&browser, false).await;
    browser.until("document.querySelector('.receipt')").await;
    assert_eq!(browser.address().await, page, "the page is not left");
    let receipt = browser.text(".receipt").await;
    for said in ["Handed in", "specular-half-unnormalized--average.vert", "80 / 100", "SHA-256"] {
        assert!(receipt.contains(said), "{said}: {receipt}");
    }
    let link = browser.js("return document.querySelector('.receipt .permalink').textContent").await;
    assert!(link.as_str().expect("a link").starts_with(&server.at("/r/")), "{link}");
    browser.until("document.querySelectorAll('.attempts li').length === 1").await;
    // Requests that found no connection are complaints of the browser's.
    browser.complaints().await;
    browser.check("receipt").await;
    // What is typed without a connection is graded when it is back.
    offline(&browser, true).await;
    browser.js(FOCUS).await;
    type_text(&browser, "// new\n").await;
    browser.until("document.querySelector('#state').dataset.kind === 'waiting'").await;
    offline(&browser, false).await;
    browser.until("document.querySelector('#state').textContent.includes('draft, not handed in')").await;
    assert_eq!(browser.js("return document.querySelectorAll('.attempts li').length").await, 1);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_page_that_is_open_says_when_handing_in_ends() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    close(&browser, "2099-01-01T00:00").await;
    browser.open(&server.at("/")).await;
    let left = browser.text(".terms-of-hand-in .left").await;
    assert!(left.contains("days") && left.contains("left"), "{left}");
    assert!(browser.has("form.work .primary").await);
    // The deadline comes while the page is open: the service's, and the one that the page has seen.
    close(&browser, "2020-01-01T00:00").await;
    browser.js("const now = Date.now; Date.now = () => now() + 5e12;").await;
    browser.until("document.querySelector('.handing-in').textContent.includes('Handing in is over')").await;
    assert!(!browser.has("form.work .primary").await);
    assert!(browser.text(".terms-of-hand-in").await.contains("Closed since"));
    assert!(!browser.text(".brief").await.contains("content"));
    browser.js(FOCUS).await;
    type_text(&browser, "// practice\n").await;
    browser.until("document.querySelector('#state').textContent.includes('practice, not handed in')").await;
    browser.check("student-practice").await;
    browser.end().await;
}

/// Sets the end of handing in, as a teacher does, from a page that stays open.
async fn close(browser: &Browser, at: &str) {
    let script = format!(
        "const csrf = async (path) => new DOMParser().parseFromString(await (await fetch(path)).text(), 'text/html') \
           .querySelector('main [name=csrf]')?.value; \
         const post = (path, form) => fetch(path, {{ method: 'POST', body: new URLSearchParams(form) }}); \
         const login = await csrf('/teacher/login'); \
         if (login) await post('/teacher/login', {{ csrf: login, password: '{TOKEN}' }}); \
         const form = {{ closes: '{at}', hints: 'full', audience: 'open', practice: 'on' }}; \
         const set = await post('/teacher/settings', {{ csrf: await csrf('/teacher/settings'), ...form }}); \
         return set.url"
    );
    let done = browser.js(&format!("return (async () => {{ {script} }})()")).await;
    assert!(done.as_str().is_some_and(|url| url.ends_with("?done=saved")), "{done}");
}
