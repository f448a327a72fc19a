use super::*;
use crate::report::labels::Labels;
use crate::report::samples;
use crate::report::{Hints, MapLookup, MapPlace, Picture, TermPictures};
use std::sync::Arc;

fn page(report: &Report, language: Language) -> String {
    let pictures = samples::pictures();
    let assignment = samples::assignment();
    let sources: Vec<Source> = report.sources.iter().map(|source| samples::source(&source.name)).collect();
    let page = ReportPage { assignment, report, sources: &sources, pictures: Some(&pictures), language };
    page.render().expect("a page")
}

/// What a reader sees of a page: without tags, styles and scripts, entities resolved.
fn visible(html: &str) -> String {
    let body = html.split_once("<body>").expect("a body").1;
    let body = body.split("<script>").next().unwrap_or_default();
    let text: String = body.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text).collect();
    let entities = [("&#60;", "<"), ("&#62;", ">"), ("&#34;", "\""), ("&#39;", "'"), ("&#38;", "&")];
    entities.iter().fold(text, |text, (entity, c)| text.replace(entity, c))
}

#[test]
fn a_page_refers_to_nothing_outside_itself() {
    for report in samples::all() {
        let html = page(&report, Language::Ja);
        for reference in ["http:", "https:", "src=\"//", "href=\"//", "url(", "@import", "<link", "<iframe"] {
            assert!(!html.contains(reference), "{reference}");
        }
        for attribute in ["src=\"", "href=\""] {
            for target in html.split(attribute).skip(1) {
                assert!(target.starts_with('#') || target.starts_with("data:image/png;base64,"), "{attribute}");
            }
        }
    }
}

#[test]
fn what_is_painted_in_one_picture_alone_is_told() {
    let mut report = samples::wrong();
    report.frames[1].coverage_mismatches = 1203;
    let html = page(&report, Language::En);
    let said = "1 of 25 have pixels that only one of the two pictures paints, up to 1203 in a frame";
    assert!(visible(&html).contains(said) && html.contains("· Shape pixels 1203"), "{html}");
    assert!(visible(&page(&report, Language::Ja)).contains("一方だけで描かれている画素があります"));
}

#[test]
fn every_link_in_a_page_has_its_target() {
    for report in samples::all() {
        let html = page(&report, Language::En);
        for link in html.split("href=\"#").skip(1) {
            let id = link.split('"').next().expect("a closing quote");
            assert!(html.contains(&format!(" id=\"{id}\"")), "{id}");
        }
    }
}

#[test]
fn what_a_student_writes_stays_text() {
    let mut report = samples::rejected();
    report.sources[0].name = "<script>alert('x')</script>\".vert".into();
    report.diagnostics[0].message = Text::verbatim("undeclared `<img src=x onerror=y>`");
    let html = page(&report, Language::En);
    assert!(!html.contains("<script>"), "neither the name nor line 2 of the source opens a script");
    assert!(!html.contains("<img src=x"));
    let text = visible(&html);
    assert!(text.contains("<script>alert('x')</script>\".vert"));
    assert!(text.contains("undeclared <img src=x onerror=y>"));
    assert!(text.contains("<script>alert(1)</script>"));
}

#[test]
fn every_message_is_there_in_the_chosen_language() {
    for language in [Language::En, Language::Ja] {
        let report = samples::wrong();
        let html = page(&report, language);
        assert!(html.contains(&format!("<html lang=\"{}\">", Labels::of(language).tag)));
        let text = visible(&html);
        for line in &report.rubric {
            assert!(text.contains(&line.message.get(language).replace('`', "")), "{}", line.id);
            assert!(text.contains(line.label.get(language)));
        }
        for diagnostic in &report.diagnostics {
            assert!(text.contains(diagnostic.message.get(language)));
            let hint = diagnostic.hint.as_ref().expect("a hint").get(language);
            assert!(text.contains(&hint.replace('`', "")));
        }
        let title =
            ["Half vector not normalised", "中間ベクトルが正規化されていない"][usize::from(language == Language::Ja)];
        assert!(text.contains(title) && text.contains("20240613"));
    }
}

#[test]
fn the_wrong_term_is_marked_in_words_and_not_by_colour_alone() {
    let html = page(&samples::wrong(), Language::En);
    assert_eq!(html.matches("<munder class=\"term partial\">").count(), 1);
    assert_eq!(html.matches("<munder class=\"term full\">").count(), 2);
    assert!(html.contains("<mtext>△</mtext>"));
    let specular = html.split("<div class=\"row partial\">").nth(1).expect("the specular row");
    let specular = specular.split("</div>").next().unwrap_or_default();
    assert!(specular.contains("some points:") && specular.contains("20 / 40"));
}

#[test]
fn rejected_and_stopped_show_the_diagnostics_and_no_pictures() {
    for report in [samples::rejected(), samples::stopped()] {
        let html = page(&report, Language::En);
        for absent in ["<img", "<math", "<table", "class=\"rubric\"", "<script>"] {
            assert!(!html.contains(absent), "{absent}");
        }
        let message = html.find("class=\"messages\"").expect("the messages");
        assert!(message < html.find("class=\"listing\"").expect("the source"));
    }
}

#[test]
fn the_listing_marks_the_place_and_links_to_the_rubric() {
    let html = page(&samples::wrong(), Language::En);
    // `if (a < b` behind two spaces: the warning's column 9 is `<`.
    assert!(html.contains("<div id=\"L11\" class=\"line noted\">"));
    assert!(html.contains("if (a <mark>&#60;</mark> b"));
    assert!(html.contains("<a href=\"#rubric-specular\">"));
    assert!(html.contains("<div id=\"L10\" class=\"line\">"));
}

#[test]
fn the_moving_pictures_have_a_step_for_every_pose() {
    let html = page(&samples::wrong(), Language::En);
    assert_eq!(html.matches("class=\"sheet\"").count(), 3);
    assert_eq!(html.matches("% { transform: translate(").count(), 25);
    assert_eq!(html.matches("data-caption=").count(), 25);
    assert!(html.contains("max=\"24\""));
    // Pose 6 of 25 begins at 24 % of the cycle, in the second column of the second row of 5 × 5.
    assert!(html.contains("\n24% { transform: translate(-20%, -20%); }"));
    assert!(html.contains(SCRIPT));
}

#[test]
fn the_player_starts_at_the_frame_that_differs_most() {
    // The samples cycle through differences of 0, 1, 5, 20, 90 and 255, in more pixels with each pose: of poses 5, 11, 17
    // and 23, the last. Each of 25 poses takes 0.2 seconds.
    let wrong = page(&samples::wrong(), Language::En);
    assert!(wrong.contains("from-23\" id=\"player\" data-start=\"23\""), "{wrong}");
    assert!(wrong.contains(".from-23 .sheet { animation-delay: -4.6s; }"));
    assert!(!page(&samples::correct(), Language::En).contains("data-start"));
}

#[test]
fn terms_are_shown_when_there_are_pictures_of_them() {
    let html = page(&samples::wrong(), Language::En);
    assert!(html.contains("alt=\"Yours: Specular\"") && html.contains("alt=\"Expected: Specular\""));
    let mut pictures = samples::pictures();
    pictures.terms = Arc::new([TermPictures { yours: None, ..pictures.terms[0].clone() }]);
    let report = samples::wrong();
    let page = ReportPage {
        assignment: samples::assignment(),
        report: &report,
        sources: &[],
        pictures: Some(&pictures),
        language: Language::En,
    };
    let html = page.render().expect("a page");
    assert!(html.contains(Labels::of(Language::En).unknown));
    assert!(!html.contains("href=\"#L"), "without a source there is no line to go to");
}

#[test]
fn noise_is_shown_at_a_lower_resolution_within_the_budget() {
    let mut state = 1u32;
    let mut noise = || {
        let mut byte = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        Picture::whole(640, 480, (0..640 * 480 * 4).map(|_| byte()).collect())
    };
    // Two poses of 0.9 MB a picture: 3 bytes for each of 307,200 pixels, which do not compress.
    let pictures =
        Pictures { yours: [noise(), noise()].into(), expected: vec![noise(), noise()].into(), ..Pictures::default() };
    let report = samples::wrong();
    let page = ReportPage {
        assignment: samples::assignment(),
        report: &report,
        sources: &[],
        pictures: Some(&pictures),
        language: Language::En,
    };
    let html = page.render().expect("a page");
    assert!(html.len() < 350_000, "{} bytes", html.len());
    assert!(html.contains(Labels::of(Language::En).reduced));
}

#[test]
fn each_of_several_files_has_its_own_listing_and_a_place_leads_into_its_own() {
    let html = page(&samples::two_files(), Language::En);
    for name in ["ggsample11.vert", "ggsample11.frag"] {
        assert!(html.contains(&format!("<h3><bdi>{name}</bdi></h3>")), "{html}");
    }
    assert_eq!((html.matches("id=\"L11\"").count(), html.matches("id=\"F2L11\"").count()), (1, 1));
    // The mistake is on line 11 of the second file, the warning on line 12 of the first.
    assert!(html.contains("<a href=\"#F2L11\">ggsample11.frag, line 11</a>"), "{html}");
    assert!(html.contains("<a href=\"#L12\">ggsample11.vert, line 12, column 9</a>"), "{html}");
    let noted = |anchor: &str| html.contains(&format!("<div id=\"{anchor}\" class=\"line noted\">"));
    assert_eq!(["F2L11", "L11", "L12", "F2L12"].map(noted), [true, false, true, false]);
    assert_eq!(html.matches("<dt>SHA-256</dt>").count(), 2);
    assert!(visible(&html).contains("ggsample11.vert, ggsample11.frag"));
}

#[test]
fn the_map_is_shown_with_the_places_where_it_is_looked_up() {
    let assignment = reference::assignment("ggsample11-map").expect("built in");
    let place = |at, depth| MapPlace { at, depth, stored: 0.5 };
    let lookup = MapLookup {
        frame: 1,
        pixel: [300, 200],
        // The first is what probes read.
        texture: 1,
        file: None,
        line: None,
        yours: vec![place([0.25, 0.25], Some(0.75)), place([1.5, 0.5], None)],
        right: vec![],
    };
    let report = Report { map_lookup: Some(lookup), ..samples::wrong() };
    for (language, said) in [
        (
            Language::En,
            [
                "The lookup of the map",
                "(0.2500, 0.2500), and 1 more: 0.7500 is compared with 0.5000",
                "does not read the map here",
            ],
        ),
        (
            Language::Ja,
            [
                "マップの参照位置",
                "(0.2500, 0.2500) ほか 1 か所: 0.7500 を 0.5000 と比較",
                "ここではマップを参照していません",
            ],
        ),
    ] {
        let page = ReportPage { assignment, report: &report, sources: &[], pictures: None, language };
        let html = page.render().expect("a page");
        let text = visible(&html);
        assert!(said.iter().all(|said| text.contains(said)), "{text}");
        // From below becomes from above, and what is outside lies at the edge.
        assert!(html.contains("m25 75m-2-2") && html.contains("m97.5 50m-2-2"), "the marks");
        assert!(html.contains("width=\"400\" height=\"400\""), "a map of 800 × 800, smaller");
    }
}

#[test]
fn a_reader_picks_a_place_and_sees_the_values_of_each_line() {
    let followed = Report { own_values: Some(samples::own_values()), ..samples::wrong() };
    let without = page(&samples::wrong(), Language::En);
    for (language, said) in [
        (Language::En, ["Your values, line by line", "1 · Vertex · differs", "2 · Vertex · agrees", "last of 3 times"]),
        (Language::Ja, ["1 行ずつ見る計算の値", "1 · 頂点 · 相違", "2 · 頂点 · 一致", "3 回のうち最後"]),
    ] {
        let html = page(&followed, language);
        let text = visible(&html);
        assert!(said.iter().all(|said| text.contains(said)), "{text}");
        assert!(
            text.contains("half_way()")
                && text.contains(["the half vector", "中間ベクトル"][usize::from(language == Language::Ja)])
        );
        // A place is a radio button, so that no script is needed.
        assert_eq!(html.matches("<input type=\"radio\" name=\"place\"").count(), 2);
        assert_eq!(html.matches("▸</b> 0.75</td><td class=\"v0\">1</td>").count(), 1, "the first that is wrong");
        assert_eq!(html.matches("▸</b>").count(), 1, "{html}");
        assert!(html.contains("<td class=\"v0 off\">0.25</td><td class=\"v0\">0.5</td>"), "wrong further on");
        assert!(html.contains("<td class=\"v1\">–</td>") && text.contains("(NaN, −2)"), "{text}");
        assert!(html.contains("<a href=\"#L11\">11</a>"));
        // The picture of the frame, with a mark for each place: of 640 × 480, the first is at a quarter of its width.
        assert!(html.contains("cx=\"160\" cy=\"360\"") && html.contains("cx=\"480\" cy=\"360\""), "{html}");
        assert!(html.len() < without.len() + 20_000, "{} bytes more", html.len() - without.len());
    }
}

#[test]
fn where_nothing_is_known_to_be_right_there_is_no_column_of_it() {
    let mut values = samples::own_values();
    for value in values.lines.iter_mut().flat_map(|line| &mut line.values).flatten() {
        (value.right, value.agrees) = (None, None);
    }
    let mut report = Report { own_values: Some(values), hints: Hints::Gentle, ..samples::wrong() };
    report.rubric[3].line = None;
    let html = page(&report, Language::En);
    assert!(html.contains("id=\"place-1\"") && !html.contains("Should be") && !html.contains("▸</b>"), "{html}");
}
