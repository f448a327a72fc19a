//! The pages that the command line writes, opened from the disk: a report, and a class.

use crate::chromium::{Browser, sample};
use crate::{BROKEN, RIGHT, WRONG};
use std::path::Path;
use std::process::Command;

const ADVISED: &str = "accepted/advice/normal-length--matrix-only.vert";
/// Widths of a phone, a laptop and a wide screen, with the heights that go with them.
const SIZES: [(u32, u32); 3] = [(390, 844), (1280, 900), (1920, 1080)];

/// Runs the program; what it says is of no interest here.
fn ggrade(folder: &Path, arguments: &[&str]) {
    let run = Command::new(env!("CARGO_BIN_EXE_ggrade")).args(arguments).current_dir(folder).output().expect("ggrade");
    // 0 or 1: graded.
    assert!(run.status.code() < Some(2), "{}", String::from_utf8_lossy(&run.stderr));
}

fn address(page: &Path) -> String {
    format!("file://{}", page.display())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_report_fits_every_screen() {
    let folder = tempfile::tempdir().expect("a folder");
    let browser = Browser::start().await;
    for (name, file, language) in
        [("wrong", WRONG, "en"), ("wrong", WRONG, "ja"), ("advice", ADVISED, "ja"), ("broken", BROKEN, "en")]
    {
        ggrade(
            folder.path(),
            &["grade", &sample(file), "--format", "html", "--output", "report.html", "--lang", language],
        );
        for (width, height) in SIZES {
            browser.size(width, height).await;
            browser.open(&address(&folder.path().join("report.html"))).await;
            browser.until("[...document.images].every(i => i.complete && i.naturalWidth > 0)").await;
            browser.check(&format!("offline-{name}-{width}-{language}")).await;
        }
        if (name, language) == ("wrong", "en") {
            browser.size(1100, 1130).await;
            browser.window("readme-report").await;
        }
    }
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_place_is_picked_with_the_keyboard_and_without_scripts() {
    let folder = tempfile::tempdir().expect("a folder");
    let browser = Browser::start().await;
    ggrade(folder.path(), &["grade", &sample(WRONG), "--format", "html", "--output", "report.html", "--lang", "ja"]);
    browser.scripts(false).await;
    for (scheme, width, height) in [("light", 1280, 900), ("dark", 1280, 900), ("light", 390, 844), ("dark", 390, 844)]
    {
        browser.scheme(scheme).await;
        browser.size(width, height).await;
        browser.open(&address(&folder.path().join("report.html"))).await;
        browser.shot(&format!("values-{scheme}-{width}")).await;
    }
    // What one place shows is seen, and nothing of the other.
    let seen = async || [browser.text(".followed p.v0").await, browser.text(".followed p.v1").await];
    let cells = async || [browser.text(".followed td.v0").await, browser.text(".followed td.v1").await];
    let of_first = seen().await;
    assert!(of_first[0].contains("t = 0") && of_first[1].is_empty(), "{of_first:?}");
    assert!(cells().await[1].is_empty());
    browser.click("label[for=place-1]").await;
    assert_eq!(browser.count("#place-1:checked").await, 1);
    let of_second = seen().await;
    assert!(of_second[0].is_empty() && of_second[1].contains("t = 0"), "{of_second:?}");
    browser.press("ArrowLeft", 37, 0).await;
    assert_eq!(browser.count("#place-0:checked").await, 1);
    assert_eq!(seen().await, of_first);
    assert!(!cells().await[0].is_empty());
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_class_fits_every_screen() {
    let folder = tempfile::tempdir().expect("a folder");
    let browser = Browser::start().await;
    let files =
        [RIGHT, WRONG, BROKEN, ADVISED, "wrong/ambient-added--plus.vert", "wrong/diffuse-unclamped--no-max.vert"];
    let names = ["佐藤 太郎", "Smith Ann", "鈴木 次郎", "高橋 花", "Brown-Featherstonehaugh Alexander", "林 空"];
    for (number, (name, file)) in names.into_iter().zip(files).enumerate() {
        let place = folder.path().join(format!("class/{name}_{}_assignsubmission_file", 5000 + number));
        std::fs::create_dir_all(&place).expect("a folder");
        std::fs::copy(sample(file), place.join("ggsample06.vert")).expect("a file");
    }
    for language in ["en", "ja"] {
        ggrade(folder.path(), &["batch", "class", "--out", "out", "--force", "--formats", "html", "--lang", language]);
        for (width, height) in SIZES {
            browser.size(width, height).await;
            browser.open(&address(&folder.path().join("out/report.html"))).await;
            browser
                .until("[...document.images].every(i => (i.loading = 'eager', i.complete && i.naturalWidth > 0))")
                .await;
            browser.check(&format!("offline-class-{width}-{language}")).await;
        }
    }
    browser.end().await;
}
