//! The editor: the caret stands where it is painted, what is shown is what is graded and sent, and the keyboard is as
//! in every field.

use crate::chromium::Browser;
use crate::chromium::server::Server;
use serde_json::{Value, json};

/// The column of the cursor in its line, and its line, from 1: told by a letter that is typed and taken back.
async fn cursor(browser: &Browser) -> (usize, usize) {
    browser.type_text("\u{2603}").await;
    browser.until("document.querySelector('#code').value.includes('\u{2603}')").await;
    let text = browser.editor_text().await;
    browser.press("Backspace", 8, 0).await;
    browser.until("!document.querySelector('#code').value.includes('\u{2603}')").await;
    // The editor scrolls to the cursor with its next frame.
    browser.drawn().await;
    let before = text.split('\u{2603}').next().expect("a text");
    (before.lines().last().map_or(0, |line| line.chars().count()) + 1, before.matches('\n').count() + 1)
}

/// Where the browser paints the caret, and the box in which the text is seen.
async fn caret(browser: &Browser) -> (f64, [f64; 2]) {
    let found = browser
        .js("const range = getSelection().getRangeAt(0); \
             const box = range.getClientRects()[0] ?? range.startContainer.getBoundingClientRect(); \
             const seen = document.querySelector('.cm-scroller').getBoundingClientRect(); \
             const gutter = document.querySelector('.cm-gutters').getBoundingClientRect(); \
             return [box.left, gutter.right, seen.right]")
        .await;
    let number = |index: usize| found[index].as_f64().expect("a number");
    (number(0), [number(1), number(2)])
}

/// The caret, the ends of the box, and where the last two letters begin, once the editor scrolls no more: it follows the cursor
/// some frames later, and a draft that is graded meanwhile moves it once more.
async fn settled(browser: &Browser) -> [f64; 5] {
    let mut known = [f64::NAN; 5];
    for _ in 0..100 {
        let (left, [from, to]) = caret(browser).await;
        let (last, _) = browser.painted("vc = cv;", 8 + 119).await;
        let (before, _) = browser.painted("vc = cv;", 8 + 118).await;
        let now = [left, from, to, last, before];
        if now == known {
            break;
        }
        known = now;
        browser.drawn().await;
    }
    known
}

#[tokio::test(flavor = "multi_thread")]
async fn the_caret_stands_where_it_is_painted() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.languages("en").await;
    // A desktop, a phone, and a desktop whose reader zooms to 200 %: half as many CSS pixels, twice as dense.
    for (name, width, height, scale) in [("wide", 1280, 900, 1), ("phone", 390, 844, 2), ("zoomed", 640, 450, 2)] {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": scale, "mobile": width < 500 });
        browser.devtools("Emulation.setDeviceMetricsOverride", metrics).await;
        browser.open(&server.at("/")).await;
        browser.click("[data-do=starter]").await;
        browser.until("document.querySelector('#code').value.includes('  vc = cv;')").await;
        browser.cursor_to("vc = cv;").await;
        browser.press("End", 35, 0).await;
        // A formula of 120 characters, in a line that has 10.
        browser.type_text(&"0123456789".repeat(12)).await;
        browser.until("document.querySelector('#code').value.includes('vc = cv;' + '0123456789'.repeat(12))").await;
        assert!(browser.js("return document.querySelector('.cm-scroller').scrollLeft > 0").await == true, "{name}");
        let [left, from, to, last, before] = settled(&browser).await;
        assert!(from <= left && left <= to, "{name}: the caret is painted at {left}, and seen from {from} to {to}");
        // It stands behind the last letter as that is painted.
        assert!((left - last - (last - before)).abs() < 1.5, "{name}: {left}, the last letter begins at {last}");
        assert_eq!(cursor(&browser).await, (131, 40), "{name}");
        browser.shot(&format!("editor-long-line-{name}")).await;

        // A click on a letter sets the cursor there, far to the right and, scrolled back, in column 8.
        let (x, y) = browser.painted("vc = cv;", 8 + 100).await;
        browser.click_at(x + 1.0, y).await;
        assert_eq!(cursor(&browser).await, (111, 40), "{name}");
        browser.js("document.querySelector('.cm-scroller').scrollLeft = 0").await;
        browser.drawn().await;
        let (x, y) = browser.painted("vc = cv;", 5).await;
        browser.click_at(x + 1.0, y).await;
        assert_eq!(cursor(&browser).await, (8, 40), "{name}");
        // The ends of the hand-out's own comments can be reached.
        let far = browser
            .js("const s = document.querySelector('.cm-scroller'); s.scrollLeft = 1e6; return s.scrollLeft")
            .await;
        assert!(far.as_f64().expect("a number") > 0.0, "{name}");
        let complaints = browser.complaints().await;
        assert!(complaints.is_empty(), "{name}: {complaints:?}");
        browser.narrow_enough(name).await;
    }
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_line_to_change_is_in_sight() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.languages("ja").await;
    for (width, height) in [(1280, 900), (1920, 1080), (390, 844)] {
        browser.size(width, height).await;
        browser.open(&server.at("/")).await;
        browser.until("document.querySelector('.cm-line')").await;
        let (_, y) = browser.painted("vc = cv;", 0).await;
        let found = browser
            .js("const b = document.querySelector('.cm-scroller').getBoundingClientRect(); \
                 const how = document.querySelector('#how').getBoundingClientRect(); \
                 const title = document.querySelector('h1').getBoundingClientRect(); \
                 const file = document.querySelector('header .file').getBoundingClientRect(); \
                 return [b.top, b.bottom, scrollY, innerHeight, how.top, Math.abs(title.bottom - file.bottom)]")
            .await;
        let [top, bottom, scrolled, window, below, apart] =
            [0, 1, 2, 3, 4, 5].map(|i| found[i].as_f64().expect("a number"));
        assert!(
            top < y && y < bottom && y < window && scrolled == 0.0,
            "{width}: line 40 at {y}, seen {top} to {bottom}"
        );
        if width > 1000 {
            // The editor takes what is left of the window, and no more.
            assert!(below <= window && window - bottom < 90.0, "{width}: it ends at {bottom} of {window}");
            assert!(apart < 20.0, "{width}: the file stands beside the title");
        }
        browser.shot(&format!("editor-first-{width}")).await;
    }
    browser.end().await;
}

/// How many drafts the page has sent.
async fn sent(browser: &Browser) -> Value {
    browser.js("return performance.getEntriesByType('resource').filter(e => e.name.endsWith('/draft')).length").await
}

#[tokio::test(flavor = "multi_thread")]
async fn an_input_method_is_waited_for() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("ja").await;
    browser.open(&server.at("/")).await;
    browser.cursor_to("次の行を").await;
    browser.type_text("//").await;
    browser.until("document.querySelector('article.report')").await;
    let before = sent(&browser).await;
    for text in ["k", "か", "かん", "かんj", "かんじ"] {
        let composition =
            json!({ "text": text, "selectionStart": text.chars().count(), "selectionEnd": text.chars().count() });
        browser.devtools("Input.imeSetComposition", composition).await;
    }
    browser.until("document.querySelector('#code').value.includes('//かんじ')").await;
    // Longer than the page waits after a key.
    tokio::time::sleep(std::time::Duration::from_millis(1500)).await;
    assert_eq!(sent(&browser).await, before, "nobody has decided on this text yet");
    browser.devtools("Input.insertText", json!({ "text": "漢字" })).await;
    browser.until("document.querySelector('#code').value.includes('//漢字次の行を')").await;
    browser
        .until(&format!(
            "performance.getEntriesByType('resource').filter(e => e.name.endsWith('/draft')).length > {before}"
        ))
        .await;
    assert_eq!(browser.complaints().await, [] as [String; 0]);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_keyboard_finds_undoes_and_leaves() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("ja").await;
    browser.open(&server.at("/")).await;
    browser.cursor_to("void main").await;
    // Search, in the language of the page.
    browser.press("f", 70, 2).await;
    browser.until("document.activeElement?.getAttribute('aria-label') === '検索'").await;
    browser.type_text("normalize").await;
    browser.until("document.querySelector('.cm-searchMatch')").await;
    browser.check("editor-search-ja").await;
    browser.press("Escape", 27, 0).await;
    browser.until("document.activeElement?.matches('.cm-content')").await;
    // A new line is as deep as its block, and a closing bracket goes back.
    browser.cursor_to("gl_Position").await;
    browser.press("End", 35, 0).await;
    browser.press("Enter", 13, 0).await;
    browser.type_text("if (true) {").await;
    browser.press("Enter", 13, 0).await;
    browser.type_text("vc = pv;").await;
    browser.press("Enter", 13, 0).await;
    browser.type_text("}").await;
    let typed = "\n  if (true) {\n    vc = pv;\n  }\n}\n";
    browser.until("document.querySelector('#code').value.includes('vc = pv;')").await;
    assert!(browser.editor_text().await.ends_with(typed), "{}", browser.editor_text().await);
    browser.until("document.querySelector('.cm-matchingBracket')").await;
    for _ in 0..8 {
        browser.press("z", 90, 2).await;
    }
    browser.until("!document.querySelector('#code').value.includes('if (true)')").await;
    // Tab leaves, in both directions, and the focus is seen.
    browser.press("Tab", 9, 0).await;
    browser.until("!document.activeElement.closest('[data-editor]')").await;
    browser.press("Tab", 9, 8).await;
    browser.until("document.activeElement.matches('.cm-content')").await;
    browser.press("Tab", 9, 8).await;
    browser.until("!document.activeElement.closest('[data-editor]')").await;
    browser.end().await;
}
