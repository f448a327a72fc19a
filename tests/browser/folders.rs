//! A lecturer uploads a homework, looks at it and publishes it; a student hands in; a new version regrades.

use crate::chromium::Browser;
use crate::chromium::server::{Server, TOKEN};
use std::path::{Path, PathBuf};

fn waves(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves").join(name)
}

/// Packs the homework, with these points for its surface; the rest goes to its colour.
fn pack(path: &Path, points: u32) {
    let mut zip = zip::ZipWriter::new(std::fs::File::create(path).expect("a file"));
    for name in ["assignment.toml", "starter.vert", "solution.vert", "fixed.frag"] {
        let text = std::fs::read_to_string(waves(name)).expect("text");
        let text = text.replace("points = 60", &format!("points = {points}"));
        let text = text.replace("points = 40", &format!("points = {}", 100 - points));
        zip.start_file(format!("waves/{name}"), zip::write::SimpleFileOptions::default()).expect("a member");
        std::io::Write::write_all(&mut zip, text.as_bytes()).expect("its bytes");
    }
    zip.finish().expect("an archive");
}

async fn upload(browser: &Browser, server: &Server, archive: &Path) {
    browser.open(&server.at("/teacher/folders")).await;
    browser.keys("#folder", &archive.to_string_lossy()).await;
    browser.click("form[action='/teacher/folders'] .primary").await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_homework_is_uploaded_published_and_replaced() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    let folder = tempfile::tempdir().expect("a folder");
    let archive = folder.path().join("waves.zip");
    browser.open(&server.at("/teacher/login")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    // What is no homework leads back to the form, with what is wrong beside it.
    std::fs::write(&archive, "no archive").expect("a file");
    upload(&browser, &server, &archive).await;
    browser.until("document.querySelector('#folder-wrong')?.textContent.includes('no ZIP')").await;
    // A refused form is answered with 422, which the browser notes.
    browser.complaints().await;
    browser.check("folders-wrong").await;

    pack(&archive, 60);
    upload(&browser, &server, &archive).await;
    browser.until("document.querySelector('.goal img')?.naturalWidth > 0").await;
    assert_eq!(browser.text("h1").await, "Waves");
    for (width, height) in [(1920, 1080), (390, 844), (1280, 900)] {
        browser.size(width, height).await;
        browser.until("document.querySelector('.goal .window').getBoundingClientRect().height > 200").await;
        browser.check(&format!("folder-{width}")).await;
    }
    browser.click("button[value=publish]").await;
    browser.until("document.querySelector('button[value=withdraw]')").await;
    browser.open(&server.at("/teacher/folders")).await;
    for (width, height) in [(1920, 1080), (390, 844), (1280, 900)] {
        browser.size(width, height).await;
        browser.check(&format!("folders-{width}")).await;
    }

    // A student finds it in the list, and hands in what has the right surface and another colour.
    browser.open(&server.at("/")).await;
    browser.click("a[href='/a/waves']").await;
    let text = std::fs::read_to_string(waves("solution.vert")).expect("text");
    let half = folder.path().join("waves.vert");
    std::fs::write(&half, text.replace("vec3(0.2, 0.4, 0.7) + up", "vec3(0.9, 0.1, 0.1)")).expect("a file");
    crate::choose(&browser, &half.to_string_lossy(), "partial").await;
    crate::hand_in(&browser).await;
    let report = browser.address().await;
    assert!(browser.text("article.report").await.contains("60"), "{}", browser.text("article.report").await);

    // The new version gives the surface more points: first it is seen who gains, then it is adopted.
    pack(&archive, 70);
    upload(&browser, &server, &archive).await;
    browser.until("document.querySelector('button[value=publish]')").await;
    browser.check("folder-again").await;
    browser.click("button[value=publish]").await;
    browser.until("document.querySelector('form.adopt')").await;
    browser.until("document.querySelector('.people tbody')?.textContent.includes('+10')").await;
    browser.check("folder-regrading").await;
    browser.js("document.querySelector('form.adopt').submit()").await;
    browser.until("document.querySelector('.notice.good')").await;
    browser.open(&report).await;
    browser.until("document.querySelector('article.report')?.textContent.includes('70')").await;
}
