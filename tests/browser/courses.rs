//! An administrator makes a course, gives it homeworks, copies it to the next term and archives it; a student hands in there.

use crate::chromium::server::{Server, TOKEN};
use crate::chromium::{Browser, sample};
use crate::{RIGHT, choose};

const SIZES: [(u32, u32); 2] = [(390, 844), (1280, 900)];

async fn check(browser: &Browser, name: &str) {
    for (width, height) in SIZES {
        browser.size(width, height).await;
        browser.check(&format!("{name}-{width}")).await;
    }
}

/// Ticks, chooses and types what a field is to have.
async fn set(browser: &Browser, css: &str, value: &str) {
    browser.js(&format!("document.querySelector({css:?}).value = {value:?}")).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_course_is_made_planned_copied_and_archived() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.languages("en").await;
    browser.size(1280, 900).await;
    browser.open(&server.at("/teacher/login")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;

    browser.open(&server.at("/teacher/courses")).await;
    browser.keys("#title", "Graphics 2027").await;
    browser.keys("#id", "cg-2027").await;
    browser.click("[aria-labelledby=make] .primary").await;
    browser.until("location.pathname === '/c/cg-2027/teacher/plan'").await;
    check(&browser, "plan-empty").await;
    for homework in ["ggsample06", "phong"] {
        browser.click(&format!("[name='add.{homework}']")).await;
    }
    browser.click("form.plan > .primary").await;
    browser.until("document.querySelector('#points-phong')").await;
    set(&browser, "#points-ggsample06", "40").await;
    set(&browser, "#position-phong", "0").await;
    set(&browser, "#seen-phong", "from").await;
    set(&browser, "#from-phong", "2099-04-01T09:00").await;
    browser.click("form.plan > .primary").await;
    // What was typed stands there before the plan is kept; the new order only after it.
    browser.until("document.querySelectorAll('.plan legend a')[1]?.textContent === 'Gouraud shading'").await;
    assert_eq!(browser.js("return document.querySelector('#from-phong').value").await, "2099-04-01T09:00");
    check(&browser, "plan").await;

    // A student's way through the course: the list, the page, a draft, the hand-in, its report.
    browser.open(&server.at("/c/cg-2027/")).await;
    assert_eq!(browser.count(".homeworks > li").await, 1);
    check(&browser, "course-list").await;
    browser.click(".homeworks h2 a").await;
    browser.until("location.pathname === '/c/cg-2027/a/ggsample06'").await;
    choose(&browser, &sample(RIGHT), "full").await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('.receipt .permalink')?.pathname.startsWith('/c/cg-2027/r/')").await;
    let link = browser.js("return document.querySelector('.receipt .permalink').href").await;
    browser.open(link.as_str().expect("a link")).await;
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    check(&browser, "course-report").await;

    browser.open(&server.at("/c/cg-2027/teacher/gradebook")).await;
    assert!(browser.has(".empty").await, "nobody has a number yet");
    let student = reqwest::Client::new()
        .post(server.at("/c/cg-2027/api/v1/submissions?assignment=ggsample06&student=S1001"))
        .bearer_auth(TOKEN)
        .header("content-type", "text/plain")
        .body(std::fs::read(sample(RIGHT)).expect("a sample"));
    assert_eq!(student.send().await.expect("an answer").status(), 201);
    browser.open(&server.at("/c/cg-2027/teacher/gradebook")).await;
    assert_eq!(browser.text("tbody td:last-child").await, "40");
    check(&browser, "gradebook").await;

    browser.open(&server.at("/teacher/courses")).await;
    set(&browser, "#of", "cg-2027").await;
    browser.keys("#copy-title", "Graphics 2028").await;
    browser.keys("#copy-id", "cg-2028").await;
    browser.keys("#days", "364").await;
    browser.click("[aria-labelledby=copy] .primary").await;
    browser.until("location.pathname === '/c/cg-2028/teacher/plan'").await;
    assert_eq!(browser.js("return document.querySelector('#from-phong').value").await, "2100-03-31T09:00");

    browser.open(&server.at("/teacher/courses")).await;
    browser.click("[aria-label='Archive: Graphics 2027']").await;
    browser.until_there("[aria-label='Open again: Graphics 2027']").await;
    check(&browser, "courses").await;
    browser.open(&server.at("/c/cg-2027/a/ggsample06")).await;
    browser.until("document.body.textContent.includes('archived')").await;
    assert!(!browser.has("form.work .primary:enabled").await, "nothing can be handed in");
    check(&browser, "course-archived").await;
}
