//! What a save changed.

use crate::language::{Language, Text};
use crate::report::labels::mistake_title;
use crate::report::{Report, RubricLine};
use reference::Assignment;

/// What is different in `after`: the score, the lines of the rubric, the mistakes.
pub(super) fn between(assignment: &Assignment, before: &Report, after: &Report) -> Text {
    let score = score(before, after);
    let (mut en, mut ja) = (vec![score.en], vec![score.ja]);
    for line in &after.rubric {
        let same = |other: &&RubricLine| other.id == line.id;
        if let Some(other) = before.rubric.iter().find(same).filter(|other| other.points != line.points) {
            let points = format!("{} → {}", number(other.points), number(line.points));
            en.push(format!("{} {points}", line.label.en));
            ja.push(format!("{} {points}", line.label.ja));
        }
    }
    for (report, other, in_english, in_japanese) in [(after, before, "mended", "解消"), (before, after, "new", "新規")]
    {
        let missing: Vec<_> = other.mistakes.iter().filter(|mistake| !report.mistakes.contains(mistake)).collect();
        let titled = |language| {
            let titles = missing.iter().map(|id| mistake_title(assignment, id, language));
            titles.collect::<Vec<_>>().join(", ")
        };
        if !missing.is_empty() {
            en.push(format!("{in_english}: {}", titled(Language::En)));
            ja.push(format!("{in_japanese}: {}", titled(Language::Ja)));
        }
    }
    Text::new(en.join(" · "), ja.join(" · "))
}

fn score(before: &Report, after: &Report) -> Text {
    let runs = |report: &Report| report.verdict.is_drawn();
    let points = format!("{} → {} / {}", number(before.score), number(after.score), number(after.max_score));
    match (runs(before), runs(after)) {
        (false, true) => Text::new(format!("It runs now: {points}"), format!("動くようになりました: {points}")),
        (true, false) => Text::new(format!("It no longer runs: {points}"), format!("動かなくなりました: {points}")),
        _ if before.score == after.score => {
            let points = format!("{} / {}", number(after.score), number(after.max_score));
            Text::new(format!("The score stays {points}"), format!("得点は {points} のままです"))
        }
        _ => {
            let gain = after.score - before.score;
            let sign = if gain > 0.0 { "+" } else { "−" };
            let points = format!("{points} ({sign}{})", number(gain.abs()));
            Text::new(format!("Since the last save {points}"), format!("前回の保存から {points}"))
        }
    }
}

/// With at most two decimals.
fn number(value: f64) -> String {
    ((value * 100.0).round() / 100.0).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_in::HandIn;
    use crate::report::{Environment, Verdict};

    fn ggsample06() -> &'static Assignment {
        reference::assignment("ggsample06").unwrap()
    }

    fn report(verdict: Verdict, specular: f64, mistakes: &[&str]) -> Report {
        let line = |id: &str, en: &str, ja: &str, points, max_points| RubricLine {
            id: id.into(),
            label: Text::new(en, ja),
            points,
            max_points,
            mistake: None,
            message: Text::default(),
            file: None,
            line: None,
            graded: None,
        };
        let rubric =
            vec![line("shape", "Shape", "形", 10.0, 10.0), line("specular", "Specular", "鏡面反射光", specular, 40.0)];
        let assignment = ggsample06();
        let sources = crate::grade::sources(assignment, &HandIn::of_one("x.vert", ""));
        Report {
            score: 10.0 + specular,
            max_score: 50.0,
            rubric,
            mistakes: mistakes.iter().map(|id| (*id).into()).collect(),
            ..crate::grade::unfinished(assignment, sources, verdict, Vec::new(), Environment::default())
        }
    }

    #[test]
    fn a_gain_names_the_line_and_the_mistake_that_is_mended() {
        let before = report(Verdict::Wrong, 20.5, &["specular-phong", "gamma"]);
        let after = report(Verdict::Wrong, 40.0, &["gamma"]);
        let change = between(ggsample06(), &before, &after);
        assert_eq!(
            change.en,
            "Since the last save 30.5 → 50 / 50 (+19.5) · Specular 20.5 → 40 · mended: Phong's reflection vector instead \
             of Blinn's H"
        );
        assert!(
            change.ja.starts_with(
                "前回の保存から 30.5 → 50 / 50 (+19.5) · 鏡面反射光 20.5 → 40 · 解消: 中間ベクトルではなく"
            )
        );
        let back = between(ggsample06(), &after, &before).en;
        assert!(back.starts_with("Since the last save 50 → 30.5 / 50 (−19.5) · Specular 40 → 20.5 · new: Phong's"));
    }

    #[test]
    fn a_file_that_begins_or_ceases_to_run_is_told_first() {
        let before = report(Verdict::Rejected, 0.0, &[]);
        let after = report(Verdict::Correct, 40.0, &[]);
        assert!(between(ggsample06(), &before, &after).en.starts_with("It runs now: 10 → 50 / 50"));
        assert!(between(ggsample06(), &after, &before).en.starts_with("It no longer runs: 50 → 10 / 50"));
        assert_eq!(between(ggsample06(), &after, &after).en, "The score stays 50 / 50");
    }
}
