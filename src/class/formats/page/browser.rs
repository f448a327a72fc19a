//! The page in a real browser: its policy lets its own script run, and the script does what a teacher asks of it.

use super::render;
use crate::class::formats::samples;
use crate::language::Language;
use scraper::{ElementRef, Html, Selector};
use std::process::Command;

/// The page of the sample class as Chromium has it after loading, opened at `#fragment`.
fn opened(fragment: &str) -> Html {
    let folder = tempfile::tempdir().expect("a folder");
    let page = folder.path().join("report.html");
    std::fs::write(&page, render(&samples::class(Language::En)).expect("a page")).expect("a file");
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
        .arg(format!("file://{}#{fragment}", page.display()))
        .output()
        .expect("chromium (script/bootstrap --test installs it)");
    Html::parse_document(&String::from_utf8(output.stdout).expect("UTF-8"))
}

fn select<'a>(page: &'a Html, selector: &str) -> Vec<ElementRef<'a>> {
    page.select(&Selector::parse(selector).expect("a selector")).collect()
}

fn shown(page: &Html) -> Vec<String> {
    let ids = select(page, "tbody tr:not([hidden])").into_iter().filter_map(|row| row.value().id());
    ids.map(str::to_owned).collect()
}

#[test]
fn verdicts_are_filtered_and_scores_sorted() {
    let page = opened("verdict=correct&verdict=wrong&sort=score%3A1");
    // Of six outcomes that take turns the first two: 100 and 80.
    assert_eq!(shown(&page), ["s-s1002", "s-s1008", "s-s1001", "s-s1007"]);
    assert_eq!(select(&page, ".sheet.cards").len(), 1, "the contact sheet is what opens");
    assert!(select(&page, ".tools[hidden]").is_empty() && select(&page, "[data-kind][disabled]").is_empty());
    let status: String = select(&page, "output")[0].text().collect();
    assert_eq!(status, "4 of 12 shown");
    assert_eq!(select(&page, ".tallies [aria-pressed=true]").len(), 2);
    assert_eq!(select(&page, "th[aria-sort=ascending][data-sort=score]").len(), 1);
}

#[test]
fn mistakes_scores_and_words_narrow_each_other_down() {
    let page = opened("mistake=specular-half-unnormalized&bin=8&q=OBSERVE&view=table");
    assert!(shown(&page).is_empty());
    assert!(select(&page, ".empty[hidden]").is_empty(), "an empty result says so");
    // Full-width letters find half-width ones.
    let page = opened("mistake=specular-half-unnormalized&bin=8&q=%EF%BC%A2%EF%BD%8F%EF%BD%82&view=table");
    assert_eq!(shown(&page), ["s-s1002"]);
    assert!(select(&page, ".sheet.cards").is_empty());
    let filters: Vec<String> = select(&page, ".active button").into_iter().map(|b| b.text().collect()).collect();
    assert_eq!(filters, ["80 to below 90", "Half vector not normalised", "Clear all filters"]);
}
