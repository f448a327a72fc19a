//! What was typed is never lost: versions, two tabs, earlier attempts.

use crate::chromium::server::Server;
use crate::chromium::{Browser, sample};
use crate::{RIGHT, WRONG, choose};

/// Types a comment at the top of `main`, and waits until it is kept.
async fn note(browser: &Browser, words: &str) {
    browser.cursor_to("void main").await;
    browser.type_text(&format!("/*{words}*/")).await;
    browser.until(&format!("Object.values(localStorage).some(v => v.includes('/*{words}*/void main'))")).await;
}

/// The texts of all versions that the list shows, the newest first.
async fn versions(browser: &Browser) -> Vec<String> {
    browser.click("form.work [data-do=versions].quiet").await;
    browser.until("document.querySelector('dialog.versions').open").await;
    let found = browser
        .js("return [...document.querySelectorAll('.versions li button')].map(b => { b.click(); \
             return document.querySelector('.versions pre').textContent; })")
        .await;
    found.as_array().expect("a list").iter().map(|text| text.as_str().expect("a text").to_owned()).collect()
}

async fn close(browser: &Browser) {
    browser.click("dialog [data-do=close]").await;
    browser.until("!document.querySelector('dialog.versions').open").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_can_go_back_to_every_version() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    assert!(versions(&browser).await.is_empty());
    assert!(browser.text(".versions .none").await.starts_with("Nothing"));
    close(&browser).await;

    note(&browser, "mine").await;
    choose(&browser, &sample(RIGHT), "full").await;
    let texts = versions(&browser).await;
    assert_eq!(texts.len(), 2);
    assert!(!texts[0].contains("/*mine*/") && texts[1].contains("/*mine*/"), "{texts:?}");
    assert!(browser.text(".versions li").await.contains("File alpha-two.vert"));
    browser.check("drafts-versions").await;
    // The last one that was looked at is the typed one.
    browser.click("dialog [data-do=restore]").await;
    browser.until("document.querySelector('#code').value.includes('/*mine*/')").await;
    browser.until("document.querySelector('article.report .file')?.textContent === 'ggsample06.vert'").await;
    browser.click("[data-do=starter]").await;
    browser.until("!document.querySelector('#code').value.includes('/*mine*/')").await;
    assert_eq!(versions(&browser).await.len(), 4, "what was gone back to, and the hand-out, are versions too");
    close(&browser).await;
    // A phone's window shows all of it.
    browser.size(390, 844).await;
    browser.open(&server.at("/?lang=ja")).await;
    assert_eq!(versions(&browser).await.len(), 4);
    browser.check("drafts-versions-phone-ja").await;
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn two_tabs_keep_two_texts() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    note(&browser, "first").await;
    let first = browser.tab().await;
    let second = browser.new_tab().await;
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    browser.until("document.querySelector('#code').value.includes('/*first*/')").await;
    note(&browser, "second").await;
    // The first tab hears of it, and keeps its own text.
    browser.to_tab(&first).await;
    browser.until("document.querySelector('.note-of-drafts')?.textContent.includes('Another tab')").await;
    assert!(!browser.editor_text().await.contains("/*second*/"));
    note(&browser, "third").await;
    browser.open(&server.at("/")).await;
    let text = browser.editor_text().await;
    assert!(text.contains("/*third*/") && !text.contains("/*second*/"), "{text}");
    browser.to_tab(&second).await;
    browser.open(&server.at("/")).await;
    let text = browser.editor_text().await;
    assert!(text.contains("/*second*/") && !text.contains("/*third*/"), "a tab goes on with its own: {text}");
    assert!(browser.text(".note-of-drafts").await.contains("A newer draft"));
    browser.check("drafts-newer").await;
    let texts = versions(&browser).await;
    for words in ["first", "second", "third"] {
        assert!(texts.iter().any(|text| text.contains(&format!("/*{words}*/"))), "{words} is lost");
    }
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_earlier_attempt_overwrites_no_draft() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    choose(&browser, &sample(WRONG), "partial").await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('a[href*=\"/r/\"]') || location.pathname.startsWith('/r/')").await;
    browser.open(&server.at("/")).await;
    browser.until("document.querySelector('.attempts li a')").await;
    let attempt = browser.js("return document.querySelector('.attempts li a').pathname.slice(3)").await;
    let attempt = server.at(&format!("/a/ggsample06?from={}", attempt.as_str().expect("an id")));
    note(&browser, "newer").await;

    browser.open(&attempt).await;
    assert!(!browser.editor_text().await.contains("/*newer*/"), "the attempt is what was asked for");
    assert!(browser.text(".note-of-drafts").await.contains("A newer draft"));
    browser.click(".note-of-drafts [data-do=dismiss]").await;
    note(&browser, "edit").await;
    // Loaded again, it is still the edited text; and the newer draft is there.
    browser.js("location.reload()").await;
    browser.until("document.querySelector('#code')?.value.includes('/*edit*/')").await;
    let texts = versions(&browser).await;
    assert!(texts.iter().any(|text| text.contains("/*newer*/")) && texts.iter().any(|text| text.contains("/*edit*/")));
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_draft_of_an_earlier_release_and_a_full_browser() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/assets/none")).await;
    browser.js("localStorage.setItem('ggrade ggsample06', '// kept by 0.1.0\\nvoid main() {}\\n')").await;
    browser.open(&server.at("/")).await;
    assert_eq!(browser.editor_text().await, "// kept by 0.1.0\nvoid main() {}\n");
    // The browser has no room left: older versions make room for the newest.
    browser
        .js("for (let n = 0; n < 60; n += 1) localStorage.setItem(`ggrade ggsample06 version old${n}`, \
             JSON.stringify({ start: n, at: n, kind: 'typed', text: 'x'.repeat(60000) })); \
             let size = 2 ** 22; while (size > 0) try { localStorage.setItem('other' + size + Math.random(), \
             'y'.repeat(size)); } catch { size = Math.floor(size / 2); }")
        .await;
    note(&browser, "full").await;
    assert!(browser.js("return document.querySelector('.note-of-drafts').hidden").await == true);
    browser
        .js("for (const key of Object.keys(localStorage)) if (key.includes('version')) localStorage.removeItem(key)")
        .await;
    // And where nothing can be kept at all, it is said.
    browser.js("Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); }").await;
    browser.cursor_to("void main").await;
    browser.type_text(" ").await;
    browser.until("document.querySelector('.note-of-drafts').textContent.includes('does not keep your text')").await;
    browser.end().await;
}
