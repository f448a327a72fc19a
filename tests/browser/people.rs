//! What a course knows of its people: likeness, insights, data; on a phone, a laptop and a wide screen.

use crate::chromium::Browser;
use crate::chromium::server::{Server, TOKEN};
use crate::{BROKEN, RIGHT, WRONG};

const SIZES: [(u32, u32); 3] = [(390, 844), (1280, 900), (1920, 1080)];

#[tokio::test(flavor = "multi_thread")]
async fn likeness_insights_and_data_fit_every_screen() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.languages("en").await;
    let class = [
        ("S1001", "wrong/ambient-added--plus.vert"),
        ("S1001", "accepted/answers/dot-by-hand.vert"),
        ("S1002", "wrong/unexplained--cosine-divided-by-itself.vert"),
        ("S1003", BROKEN),
        ("S1003", WRONG),
        ("S1003", RIGHT),
        ("S1004", "accepted/answers/dot-by-hand.vert"),
    ];
    for (student, file) in class {
        server.hand_in(student, file).await;
    }
    browser.open(&server.at("/teacher")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    let pages = [
        ("likeness", "/teacher/likeness", "document.querySelectorAll('.people tbody tr').length === 1"),
        (
            "insights",
            "/teacher/insights",
            "document.querySelector('.chart') && document.querySelector('.after tbody tr')",
        ),
        ("data", "/teacher/data", "document.querySelector('#number')"),
        ("privacy", "/privacy", "document.querySelector('.kept')"),
        ("staff", "/teacher/people", "document.querySelector('#login')"),
        ("log", "/teacher/log", "document.querySelectorAll('.people tbody tr').length > 5"),
        ("platforms", "/teacher/platforms", "document.querySelector('form [value=add], form [name=wish]')"),
    ];
    // What a phone shows in the other language.
    browser.size(390, 844).await;
    browser.languages("ja").await;
    for (name, page, is_there) in pages {
        browser.open(&server.at(page)).await;
        browser.until(is_there).await;
        browser.check(&format!("{name}-ja")).await;
        // Menus open within the page.
        for menu in 1..=browser.count(".top .menu").await {
            let open = format!("document.querySelectorAll('.top .menu')[{menu} - 1]");
            browser.js(&format!("{open}.open = true")).await;
            let within = format!(
                "(box => box.left >= 0 && box.right <= innerWidth)({open}.lastElementChild.getBoundingClientRect())"
            );
            browser.until(&within).await;
            browser.js(&format!("{open}.querySelector('a, button').focus()")).await;
            browser.press("Escape", 27, 0).await;
            browser.until(&format!("!{open}.open && document.activeElement === {open}.firstElementChild")).await;
        }
    }
    browser.languages("en").await;
    for (width, height) in SIZES {
        browser.size(width, height).await;
        for (name, page, is_there) in pages {
            browser.open(&server.at(page)).await;
            browser.until(is_there).await;
            browser.js("document.querySelectorAll('details').forEach(it => it.open = true)").await;
            browser.check(&format!("{name}-{width}")).await;
        }
        browser.open(&server.at("/teacher/likeness")).await;
        browser.click(".people tbody td a").await;
        browser.until("document.querySelectorAll('.side-by-side mark').length > 5").await;
        browser.check(&format!("side-by-side-{width}")).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_is_made_and_ended_on_every_screen() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.languages("en").await;
    browser.open(&server.at("/teacher/login")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    browser.open(&server.at("/teacher/tokens")).await;
    assert!(browser.has("main .empty").await, "a secret of the service makes no tokens");
    browser.open(&server.at("/teacher/people")).await;
    browser.keys("#login", "wada").await;
    browser.click("main .primary").await;
    browser.until("location.pathname.startsWith('/teacher/welcome/')").await;
    browser.keys("[type=password]", "a long password").await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    for (width, height) in SIZES {
        browser.size(width, height).await;
        browser.open(&server.at("/teacher/tokens")).await;
        browser.keys("#name", "grades into the archive").await;
        browser.click("main .panel .primary").await;
        browser.until("document.querySelector('.notice .link code')?.textContent.startsWith('ggrade_')").await;
        browser.check(&format!("tokens-{width}")).await;
        browser.click(".people tbody button").await;
        browser.until("location.pathname === '/teacher/tokens' && !document.querySelector('.people')").await;
    }
}
