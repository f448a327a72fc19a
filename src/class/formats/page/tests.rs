use super::*;
use crate::class::AlikeStudent;
use crate::class::formats::samples;
use crate::language::Language;
use scraper::{Html, Selector};

fn html(class: &Class) -> String {
    String::from_utf8(render(class).expect("a page")).expect("UTF-8")
}

fn select<'a>(page: &'a Html, selector: &str) -> Vec<scraper::ElementRef<'a>> {
    page.select(&Selector::parse(selector).expect("a selector")).collect()
}

fn text(element: scraper::ElementRef<'_>) -> String {
    element.text().collect::<String>().trim().to_owned()
}

/// A picture of one grey, which a PNG decoder is not asked to read.
fn png(grey: u8) -> Vec<u8> {
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\xa0\0\0\0\x78".to_vec();
    png.push(grey);
    png
}

#[test]
fn everyone_has_a_row_with_what_a_teacher_looks_for() {
    for language in [Language::En, Language::Ja] {
        let mut class = samples::class(language);
        class.entries[0].page = Some("students/s1001.html".into());
        let page = Html::parse_document(&html(&class));
        let rows = select(&page, "tbody tr");
        assert_eq!(rows.len(), class.entries.len());
        let second = select(&page, "#s-s1002")[0];
        let said = second.text().collect::<String>();
        assert!(said.contains("O'Brien, \"Bob\""));
        let (title, id) =
            (["Half vector not normalised", "中間ベクトルが正規化されていない"], "specular-half-unnormalized");
        let found = select(&page, "#s-s1002 .found b")[0];
        assert_eq!(text(found), title[usize::from(language == Language::Ja)]);
        assert_eq!((found.value().attr("title"), second.value().attr("data-mistake")), (Some(id), Some(id)));
        assert_eq!(second.value().attr("data-score"), Some("80"));
        let points: Vec<String> = select(&page, "#s-s1002 td.line").into_iter().map(text).collect();
        assert_eq!(points, ["10", "20", "30", "20"]);
        let words: Vec<String> = select(&page, "tbody .verdict").into_iter().take(8).map(text).collect();
        // What could not be graded comes first: two of the twelve under each of six outcomes.
        let [correct, wrong, rejected, stopped, nothing, fault] = Standing::ALL.map(|status| status.word(language));
        let expected = [nothing, fault, nothing, fault, correct, wrong, rejected, stopped];
        assert_eq!(words, expected);
        let links: Vec<_> = select(&page, "tbody th a").iter().filter_map(|a| a.value().attr("href")).collect();
        assert_eq!(links, ["students/s1001.html"], "only who has a page is linked");
        assert_eq!(page.root_element().value().attr("lang"), Some(if language == Language::En { "en" } else { "ja" }));
    }
}

#[test]
fn names_stay_text_and_the_page_needs_nothing_else() {
    let html = html(&samples::class(Language::En));
    let page = Html::parse_document(&html);
    assert_eq!(select(&page, "script").len(), 1);
    assert_eq!(select(&page, "style").len(), 1);
    assert!(select(&page, "img, link, iframe, [style], [onerror], [onload]").is_empty());
    let names: Vec<String> = select(&page, "tbody th bdi").into_iter().map(text).collect();
    assert!(names.contains(&"</script><script>alert(1)</script>".to_owned()));
    assert!(names.contains(&"<img src=x onerror=alert(1)>".to_owned()));
    assert!(!html.contains(['\u{202e}', '\u{1b}', '\0']));
    for reference in ["http:", "https:", "src=\"", "@import"] {
        assert!(!html.contains(reference), "{reference}");
    }
    for target in html.split("url(").skip(1) {
        assert!(target.starts_with("data:image/png;base64,"));
    }
}

#[test]
fn the_policy_names_the_style_and_the_script_that_are_there() {
    let page = Html::parse_document(&html(&samples::class(Language::Ja)));
    let policy = select(&page, "meta[http-equiv]")[0].value().attr("content").expect("a policy");
    for (directive, element) in [("style-src", "style"), ("script-src", "script")] {
        let content: String = select(&page, element)[0].text().collect();
        let hash = STANDARD.encode(Sha256::digest(content.as_bytes()));
        assert!(policy.contains(&format!("{directive} 'sha256-{hash}'")), "{policy}");
    }
    assert!(policy.starts_with("default-src 'none';"));
}

#[test]
fn the_same_picture_is_in_the_page_once() {
    let mut class = samples::class(Language::En);
    class.expected_portrait = png(0);
    for (index, entry) in class.entries.iter_mut().enumerate() {
        entry.portrait = [Some(png(0)), Some(png(1)), Some(png(2)), None][index % 4].clone();
    }
    let html = html(&class);
    assert_eq!(html.matches("url(data:").count(), 3);
    assert!(html.contains(":root { --shape: 160 / 120; }"));
    let page = Html::parse_document(&html);
    let pictures: Vec<_> = select(&page, "tbody .p:first-child").iter().map(|p| p.value().attr("class")).collect();
    assert_eq!(pictures[..4], [Some("p e"), Some("p p0"), Some("p p1"), Some("p blank")]);
    assert_eq!(select(&page, "tbody .p.e:last-child").len(), class.entries.len(), "the right one beside each");
}

#[test]
fn charts_count_everyone_who_was_graded() {
    let page = Html::parse_document(&html(&samples::class(Language::En)));
    let counts = |selector: &str| -> Vec<String> { select(&page, selector).into_iter().map(text).collect() };
    // Twelve students take turns in six outcomes.
    assert_eq!(counts(".tallies b"), ["2"; 6]);
    // Two each of 100, 80, 0 (rejected) and 0 (stopped).
    assert_eq!(counts(".columns b"), ["4", "", "", "", "", "", "", "", "2", "", "2"]);
    assert_eq!(counts(".rows button > span"), ["Half vector not normalised Specular"]);
    assert_eq!(counts(".rows small"), ["Specular"]);
    assert_eq!(counts(".rows b"), ["2"]);
    // (2 × 100 + 2 × 80 + 4 × 0) / 8, and between 0 and 80.
    assert_eq!(counts(".score dd"), ["45/ 100"]);
    assert!(counts("#scores")[0].contains("median 40, full marks 2"));
    let spoken = counts(".columns .unseen");
    assert_eq!((spoken[8].as_str(), spoken[10].as_str()), ("80 to below 90: 2 students", "100 points: 2 students"));
}

#[test]
fn a_mistake_is_labelled_by_the_lines_that_it_costs_points_in() {
    let mut class = samples::class(Language::En);
    let Outcome::Graded(report) = &mut class.entries[1].outcome else { panic!("graded") };
    report.mistakes.push("gamma".into());
    report.rubric[1].mistake = Some("gamma".into());
    report.rubric[2].mistake = Some("gamma".into());
    let labels = |class: &Class| -> Vec<String> {
        let page = Html::parse_document(&html(class));
        select(&page, ".rows small").into_iter().map(text).collect()
    };
    assert_eq!(labels(&class), ["Specular", "Ambient · Diffuse"]);
    let Outcome::Graded(report) = &mut class.entries[1].outcome else { panic!("graded") };
    report.rubric[0].mistake = Some("gamma".into());
    assert_eq!(labels(&class), ["Specular", ""]);
}

#[test]
fn who_shares_an_answer_is_listed_once() {
    let mut class = samples::class(Language::En);
    for (one, others) in [(0, vec!["s1004", "s1006"]), (3, vec!["s1001", "s1006"]), (5, vec!["s1001", "s1004"])] {
        let alike = |key: &str| AlikeStudent { key: key.to_owned(), percent: 100, is_same: true, is_earlier: false };
        class.entries[one].alike = others.into_iter().map(alike).collect();
    }
    let page = Html::parse_document(&html(&class));
    let members: Vec<_> = select(&page, ".groups li a").iter().filter_map(|a| a.value().attr("href")).collect();
    assert_eq!(members, ["#s-s1001", "#s-s1004", "#s-s1006"]);
    for target in select(&page, "a[href^=\"#\"]").iter().filter_map(|a| a.value().attr("href")) {
        assert_eq!(select(&page, target).len(), 1, "{target}");
    }
    assert!(text(select(&page, "#s-s1001 .same")[0]).contains("2 others"));
}

#[test]
fn refused_members_and_failures_are_told() {
    let page = Html::parse_document(&html(&samples::class(Language::Ja)));
    let refused = text(select(&page, "section[aria-labelledby=refused]")[0]);
    assert!(refused.contains("class.zip/../../etc/<b>passwd") && refused.contains("書庫の外"));
    assert_eq!(select(&page, "section[aria-labelledby=faults] li").len(), 2);
}

#[test]
fn an_empty_class_is_a_page_too() {
    let mut class = samples::class(Language::Ja);
    class.entries.clear();
    class.refused.clear();
    let page = Html::parse_document(&html(&class));
    assert!(select(&page, "tbody tr, .charts, .groups, .notices").is_empty());
}

#[test]
fn a_thousand_students_are_a_page_of_a_usable_size() {
    let mut class = samples::class(Language::Ja);
    let entries = std::mem::take(&mut class.entries);
    class.entries = (0..1000)
        .map(|index| {
            let mut entry = entries[index % entries.len()].clone();
            entry.student.key = format!("s{index}");
            // No two alike, and none that compresses: 1.5 KB each.
            entry.portrait =
                Some((0..1500).map(|at| (index * 31 + at * 17) as u8).chain(index.to_be_bytes()).collect());
            entry
        })
        .collect();
    let bytes = render(&class).expect("a page").len();
    assert!(bytes < 4_000_000, "{bytes}");
}
