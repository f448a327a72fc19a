use super::rubric::filled;
use super::*;
use crate::report::samples;

fn text(report: &Report, language: Language, width: usize) -> String {
    render(report, &TextOptions { assignment: samples::assignment(), language, width, colour: false, excerpts: None })
}

/// Without the line breaks and indents that the width decides.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect()
}

#[test]
fn no_line_is_wider_than_the_terminal() {
    for report in samples::all() {
        for language in [Language::En, Language::Ja] {
            for width in [40, 57, 80, 100] {
                for line in text(&report, language, width).lines() {
                    assert!(columns(line) <= width, "{width}: {line}");
                }
            }
        }
    }
}

#[test]
fn wrong_says_what_where_and_how_much() {
    let report = samples::wrong();
    for language in [Language::En, Language::Ja] {
        for width in [40, 80] {
            let text = unwrapped(&text(&report, language, width));
            for line in &report.rubric {
                assert!(text.contains(&unwrapped(line.message.get(language))), "{text}");
                assert!(text.contains(&unwrapped(line.label.get(language))), "{text}");
            }
            assert!(text.contains("80/100") && text.contains("20/40"), "{text}");
            let title = ["Half vector not normalised", "中間ベクトルが正規化されていない"];
            assert!(text.contains(&unwrapped(title[usize::from(language == Language::Ja)])), "{text}");
            assert!(text.contains("seed20240613") || text.contains("シード20240613"), "{text}");
            assert!(text.contains("412ms"), "{text}");
        }
    }
    assert!(text(&report, Language::En, 80).contains("Look at line 11 first"));
    assert!(text(&report, Language::Ja, 80).contains("まず 11 行目"));
}

#[test]
fn the_strip_shades_each_frame_by_its_difference() {
    let text = text(&samples::wrong(), Language::En, 80);
    // The samples cycle through differences of 0, 1, 5, 20, 90 and 255; five frames in 25 agree.
    let cycle = "· ░░▒▒▓▓████";
    assert!(text.contains(&format!("{}·\n", cycle.repeat(4))), "{text}");
    assert!(text.contains("5 of 25 agree"), "{text}");
    assert!(text.contains("409 of 640 agree"), "{text}");
    // Frames 0, 5, 10, 15, 20 of 25, two columns each.
    let axis = "t = 0     0.2       0.4       0.6       0.8\n";
    assert!(text.contains(axis), "{text}");
}

#[test]
fn a_frame_that_differs_is_never_drawn_as_agreeing() {
    let mut report = samples::correct();
    report.verdict = Verdict::Wrong;
    report.frames[0].mismatched_pixels = 3;
    assert!(text(&report, Language::En, 80).contains("24 of 25 agree\n        ░░· "));
}

#[test]
fn correct_says_that_everything_agrees() {
    let report = samples::correct();
    let english = text(&report, Language::En, 80);
    assert!(english.contains("Every frame and every probe agrees."));
    assert!(english.contains("25 of 25 agree") && english.contains("640 of 640 agree"));
    assert!(!english.contains("Next"));
    assert!(text(&report, Language::Ja, 80).contains("すべてのフレームとすべての検査点が正解と一致しました。"));
}

#[test]
fn rejected_and_stopped_show_their_diagnostics_and_no_empty_tables() {
    for report in [samples::rejected(), samples::stopped()] {
        let text = text(&report, Language::Ja, 80);
        for diagnostic in &report.diagnostics {
            assert!(text.contains(&diagnostic.message.ja), "{text}");
        }
        assert!(!text.contains("フレーム") && !text.contains("検査点") && !text.contains("形状"), "{text}");
    }
    assert!(text(&samples::rejected(), Language::En, 80).contains("error · line 11, column 12"));
}

#[test]
fn excerpts_take_the_place_of_the_bare_diagnostics() {
    let options = TextOptions {
        assignment: samples::assignment(),
        language: Language::En,
        width: 80,
        colour: false,
        excerpts: Some("EXCERPT\n"),
    };
    let text = render(&samples::rejected(), &options);
    assert!(text.contains("\nEXCERPT\n") && !text.contains("not declared"));
}

#[test]
fn colour_adds_nothing_but_colour() {
    for report in samples::all() {
        let options = TextOptions {
            assignment: samples::assignment(),
            language: Language::Ja,
            width: 80,
            colour: true,
            excerpts: None,
        };
        let coloured = render(&report, &options);
        assert!(coloured.contains('\u{1b}'));
        let bare: String = coloured
            .split('\u{1b}')
            .enumerate()
            .map(|(i, part)| if i == 0 { part } else { part.split_once('m').expect("an SGR sequence").1 })
            .collect();
        let trimmed = |text: &str| text.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
        assert_eq!(trimmed(&bare), trimmed(&text(&report, Language::Ja, 80)));
    }
}

#[test]
fn a_name_cannot_steer_the_terminal() {
    let mut report = samples::rejected();
    report.sources[0].name = "a\u{1b}]0;owned\u{7}.vert".into();
    report.diagnostics[0].message = crate::language::Text::verbatim("\u{1b}[2J");
    assert!(!text(&report, Language::En, 80).contains('\u{1b}'));
}

#[test]
fn a_bar_is_full_or_empty_only_when_it_says_so() {
    assert_eq!([filled(0.0, 10), filled(0.001, 10), filled(0.999, 10), filled(1.0, 10)], [0, 1, 9, 10]);
    assert_eq!(filled(f64::NAN, 10), 0);
    assert_eq!(filled(0.5, 10), 5);
}

#[test]
fn numbers_are_short() {
    assert_eq!([80.0, 62.5, 33.333, f64::NAN].map(number), ["80", "62.5", "33.33", "–"]);
}

#[test]
fn with_several_files_a_place_names_its_own() {
    let report = samples::two_files();
    let options = TextOptions {
        assignment: samples::assignment(),
        language: Language::En,
        width: 80,
        colour: false,
        excerpts: None,
    };
    let text = render(&report, &options);
    assert!(text.contains("ggsample11.vert, ggsample11.frag"), "{text}");
    assert!(text.contains("warning · ggsample11.vert, line 12, column 9"), "{text}");
}

#[test]
fn what_is_painted_in_one_picture_alone_is_told() {
    let mut report = samples::wrong();
    let said = "pixels that only one of the two pictures paints";
    assert!(!text(&report, Language::En, 100).contains(said));
    // The colours of frame 0 agree, and it lacks something; frame 1 shows too much.
    (report.frames[0].coverage_mismatches, report.frames[1].coverage_mismatches) = (40, 1203);
    let text = text(&report, Language::En, 100);
    assert!(text.contains(&format!("2 of 25 have {said}, up to 1203 in a frame")), "{text}");
    assert!(text.contains("████▒▒▓▓████"), "as far off as a colour can be: {text}");
}
