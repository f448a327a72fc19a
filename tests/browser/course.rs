//! What a lecturer sets about time, and what people judge beside the grading.

use crate::chromium::Browser;
use crate::chromium::server::{Server, TOKEN};
use crate::{RIGHT, WRONG, hand_in};

async fn login(browser: &Browser, server: &Server) {
    browser.open(&server.at("/teacher/login")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lecturer_sets_dates_and_judges() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    // The student hands in before anything is due.
    browser.open(&server.at("/")).await;
    browser.keys("#file", &crate::sample(WRONG)).await;
    browser
        .until("document.querySelector('article.report[data-mark=partial]') && !document.querySelector('[aria-busy]')")
        .await;
    hand_in(&browser).await;
    let report = browser.address().await;
    browser.click(".judgement summary").await;
    browser.check("judgement-question").await;
    browser.keys("#appeal-question", "Is slide 21 not the same?").await;
    browser.click(".judgement .primary").await;
    browser.until("document.querySelector('.judgement .said')").await;

    login(&browser, &server).await;
    browser.open(&server.at("/teacher/settings")).await;
    let roster = tempfile::NamedTempFile::with_suffix(".csv").expect("a file");
    std::fs::write(roster.path(), "number,name,group\nS1001,和田 花子,Tue\nS1002,B,Wed\n").expect("a file");
    browser.keys("#roster-file", &roster.path().to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('[role=status]')").await;
    // Due in the past; late hand-ins until the end of the century.
    browser
        .js("for (const [id, value] of Object.entries({ closes: '2020-01-01T00:00', grace: '10', \
             late_until: '2099-01-01T00:00', late_percent: '10', late_floor: '40', counting: 'chosen' })) \
             document.querySelector('#' + id).value = value")
        .await;
    browser.check("teacher-settings-late").await;
    browser.click("form[action='/teacher/settings'] .primary").await;
    browser.until("location.search === '?done=saved'").await;
    for file in [WRONG, RIGHT] {
        server.hand_in("S1001", file).await;
    }
    server.hand_in("S1002", WRONG).await;
    browser.open(&server.at("/teacher/extensions")).await;
    browser.keys("#whose", "Wed").await;
    browser.js("document.querySelector('#closes').value = '2098-01-01T00:00'").await;
    browser.keys("#reason", "a power cut").await;
    browser.click("main .primary").await;
    browser.until("document.querySelectorAll('.people tbody tr').length === 1").await;
    browser.check("teacher-extensions").await;
    browser.open(&server.at("/teacher")).await;
    browser.until("document.querySelectorAll('.people tbody tr').length === 2").await;
    browser.check("teacher-class-late").await;
    browser.click(".people tbody tr:first-child th a").await;
    browser.until("document.querySelectorAll('.attempts li').length === 2").await;
    browser.check("teacher-person-late").await;

    browser.open(&report).await;
    browser.keys("#reason-specular", "The picture is right.").await;
    browser.js("document.querySelector('#points-specular').value = '35'").await;
    browser.click("form.override:has([value=specular]) button").await;
    browser.until("document.querySelector('#rubric-specular')?.textContent.includes('The picture is right.')").await;
    browser.keys("#comment-line", "3").await;
    browser.keys("#comment-text", "What does `pv` hold here?").await;
    browser.click("form.override[action$=comments] button").await;
    browser.until("document.querySelector('#L3 .note.comment')").await;
    browser.keys("#answer", "It is; the points are yours.").await;
    browser.check("judgement-desk").await;
    for (width, height) in [(1920, 1080), (390, 844)] {
        browser.size(width, height).await;
        browser.check(&format!("judgement-desk-{width}")).await;
    }
    browser.click("[name=wish][value=answer]").await;
    browser.until("document.querySelectorAll('.judgement .said').length === 2").await;
    browser.open(&server.at("/teacher/appeals?lang=ja")).await;
    browser.check("phone-appeals-ja").await;
    browser.open(&server.at("/teacher/extensions")).await;
    browser.check("phone-extensions-ja").await;
    browser.open(&server.at("/teacher/settings")).await;
    browser.check("phone-settings-late-ja").await;

    // The student reads it all, late and early.
    browser.devtools("Network.clearBrowserCookies", serde_json::json!({})).await;
    browser.open(&report).await;
    assert!(browser.text("#rubric-specular").await.contains("35"));
    browser.check("phone-judged-ja").await;
    browser.size(1280, 900).await;
    browser.open(&server.at("/?lang=en")).await;
    assert!(browser.text(".terms-of-hand-in").await.contains("Late hand-ins until"));
    browser.check("student-late").await;
    browser.end().await;
}
