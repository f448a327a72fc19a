//! Charts as numbers that a template draws: scores, and mistakes over time.

use super::super::frame::PageFrame;
use crate::service::classes::Person;
use crate::service::clock::Millis;
use std::collections::HashMap;

/// Bars of the histogram: tenths of the points.
const BARS: usize = 10;
/// Stretches of time.
const STRETCHES: usize = 24;
/// Mistakes that are drawn over time.
const DRAWN: usize = 8;

/// Width and height of the drawings, in their own units.
pub(super) const WIDTH: f64 = 600.0;
pub(super) const HEIGHT: f64 = 160.0;

/// How many people have how many points.
pub(super) struct Histogram {
    pub bars: Vec<Bar>,
    pub mean: Option<f64>,
}

/// One bar.
pub(super) struct Bar {
    pub from: usize,
    pub to: usize,
    pub count: usize,
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// The points that count of everyone who has some. The last bar is full marks alone.
pub(super) fn histogram(people: &[&Person]) -> Histogram {
    let scores: Vec<f64> = people.iter().filter_map(|person| share(person)).collect();
    let mut counts = [0; BARS + 1];
    for score in &scores {
        counts[((score * BARS as f64).floor() as usize).min(BARS)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let step = WIDTH / (BARS + 1) as f64;
    let bar = |(index, count): (usize, &usize)| {
        let height = HEIGHT * *count as f64 / most as f64;
        Bar {
            from: index * 100 / BARS,
            to: if index == BARS { 100 } else { (index + 1) * 100 / BARS - 1 },
            count: *count,
            x: index as f64 * step + 3.0,
            y: HEIGHT - height,
            width: step - 6.0,
            height,
        }
    };
    let mean = (!scores.is_empty()).then(|| 100.0 * scores.iter().sum::<f64>() / scores.len() as f64);
    Histogram { bars: counts.iter().enumerate().map(bar).collect(), mean: mean.map(|mean| mean.round()) }
}

/// The share of the points that somebody's attempt that counts earned.
fn share(person: &Person) -> Option<f64> {
    let best = &person.counted()?.row;
    Some(best.total()? / best.max_score.filter(|most| *most > 0.0)?)
}

/// Every submission by its time and its score.
pub(super) struct SubmissionChart {
    pub dots: Vec<Dot>,
    /// The mean of everyone's best score so far, as the points of a line.
    pub line: String,
    pub from: Millis,
    pub to: Millis,
}

/// One submission.
pub(super) struct Dot {
    pub x: f64,
    pub y: f64,
    pub kind: &'static str,
}

/// The course of the scores; none where fewer than two files were graded.
pub(super) fn course(people: &[&Person]) -> Option<SubmissionChart> {
    struct ScoreEvent<'a> {
        at: Millis,
        who: &'a str,
        share: f64,
    }
    let mut events: Vec<ScoreEvent<'_>> = Vec::new();
    for person in people {
        for row in &person.rows {
            let (Some(score), Some(most)) = (row.row.score, row.row.max_score) else { continue };
            if most > 0.0 {
                events.push(ScoreEvent { at: row.row.submission.received_at, who: &person.key, share: score / most });
            }
        }
    }
    events.sort_by_key(|event| event.at);
    let (from, to) = (events.first()?.at, events.last()?.at);
    if events.len() < 2 || from == to {
        return None;
    }
    let x = |at: Millis| WIDTH * (at - from) as f64 / (to - from) as f64;
    let y = |share: f64| HEIGHT * (1.0 - share);
    let mut best: HashMap<&str, f64> = HashMap::new();
    let mut line = Vec::new();
    for event in &events {
        let theirs = best.entry(event.who).or_insert(event.share);
        *theirs = theirs.max(event.share);
        let mean = best.values().sum::<f64>() / best.len() as f64;
        line.push(format!("{:.1},{:.1}", x(event.at), y(mean)));
    }
    let dot = |event: &ScoreEvent<'_>| Dot {
        x: x(event.at),
        y: y(event.share),
        kind: if event.share >= 1.0 {
            "full"
        } else if event.share > 0.0 {
            "partial"
        } else {
            "none"
        },
    };
    Some(SubmissionChart { dots: events.iter().map(dot).collect(), line: line.join(" "), from, to })
}

/// A mistake: how many people's attempt that counts has it, and how often it was handed in over time.
pub(super) struct Trend {
    pub id: String,
    pub title: String,
    pub people: usize,
    /// Of the most frequent one, in percent.
    pub percent: usize,
    /// Heights of the stretches of time, as bars.
    pub bars: Vec<Bar>,
}

/// The mistakes, the most frequent first.
pub(super) fn trends(frame: &PageFrame, people: &[&Person]) -> Vec<Trend> {
    let mut standing: HashMap<&str, usize> = HashMap::new();
    for best in people.iter().filter_map(|person| person.counted()) {
        for mistake in &best.mistakes {
            *standing.entry(mistake).or_default() += 1;
        }
    }
    let mut handed_in: HashMap<&str, Vec<Millis>> = HashMap::new();
    let rows = || people.iter().flat_map(|person| &person.rows);
    for row in rows() {
        for mistake in &row.mistakes {
            handed_in.entry(mistake).or_default().push(row.row.submission.received_at);
        }
    }
    let from = rows().map(|row| row.row.submission.received_at).min().unwrap_or(0);
    let to = rows().map(|row| row.row.submission.received_at).max().unwrap_or(0);
    let mut ids: Vec<&str> = handed_in.keys().copied().collect();
    ids.sort_by_key(|id| (std::cmp::Reverse((standing.get(id).copied().unwrap_or(0), handed_in[id].len())), *id));
    let most = standing.values().copied().max().unwrap_or(0).max(1);
    let trend = |id: &str| {
        let people = standing.get(id).copied().unwrap_or(0);
        let title = frame.mistake_title(id);
        Trend { id: id.to_owned(), title, people, percent: 100 * people / most, bars: spark(&handed_in[id], from, to) }
    };
    ids.into_iter().take(DRAWN).map(trend).collect()
}

/// Width and height of a small drawing.
pub(super) const SPARK: (f64, f64) = (120.0, 24.0);

fn spark(times: &[Millis], from: Millis, to: Millis) -> Vec<Bar> {
    let mut counts = [0usize; STRETCHES];
    for at in times {
        let place = if to > from { (at - from) as f64 / (to - from) as f64 } else { 0.0 };
        counts[((place * STRETCHES as f64) as usize).min(STRETCHES - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let step = SPARK.0 / STRETCHES as f64;
    let bars = counts.iter().enumerate().filter(|(_, count)| **count > 0);
    let bar = |(index, count): (usize, &usize)| {
        let height = SPARK.1 * *count as f64 / most as f64;
        Bar {
            from: index,
            to: index,
            count: *count,
            x: index as f64 * step,
            y: SPARK.1 - height,
            width: step - 1.0,
            height,
        }
    };
    bars.map(bar).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Language;
    use crate::service::classes::samples::person;
    use crate::service::course::Course;
    use axum::http::Uri;

    #[test]
    fn full_marks_have_a_bar_of_their_own() {
        let people = [person("a", &[(0, 100.0, "")]), person("b", &[(0, 99.5, "")]), person("c", &[(0, 0.0, "")])];
        let histogram = histogram(&people.iter().collect::<Vec<_>>());
        let counts: Vec<usize> = histogram.bars.iter().map(|bar| bar.count).collect();
        assert_eq!(counts, [1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1]);
        // (100 + 99.5 + 0) / 3 = 66.5
        assert_eq!(histogram.mean, Some(67.0));
        assert!(super::histogram(&[]).mean.is_none());
    }

    #[test]
    fn the_line_is_the_mean_of_the_best_so_far() {
        // a: 0 then 100; b: 50 in between, then 40, which changes nothing.
        let people = [person("a", &[(0, 0.0, ""), (50, 100.0, "")]), person("b", &[(25, 50.0, ""), (100, 40.0, "")])];
        let course = course(&people.iter().collect::<Vec<_>>()).expect("a course");
        // Means: 0; (0 + 50)/2 = 25; (100 + 50)/2 = 75; 75. The top is 0, the bottom 160.
        assert_eq!(course.line, "0.0,160.0 150.0,120.0 300.0,40.0 600.0,40.0");
        assert_eq!(course.dots.len(), 4);
        assert!(super::course(&[&people[0]]).is_some());
        assert!(super::course(&[&person("c", &[(3, 1.0, "")])]).is_none(), "one file is no course");
    }

    #[test]
    fn a_mistake_counts_by_people_and_its_history_by_files() {
        let people =
            [person("a", &[(0, 10.0, "gamma"), (10, 20.0, "unchanged")]), person("b", &[(20, 20.0, "unchanged")])];
        let frame = PageFrame::new(
            Language::En,
            Course::default(),
            Uri::from_static("/"),
            reference::assignment("ggsample06").cloned(),
        );
        let trends = trends(&frame, &people.iter().collect::<Vec<_>>());
        let found: Vec<_> = trends.iter().map(|trend| (trend.title.as_str(), trend.people, trend.bars.len())).collect();
        assert_eq!(found, [("Handed in unchanged", 2, 2), ("Gamma or another curve on the colour", 0, 1)]);
        assert_eq!(trends[0].percent, 100);
    }
}
