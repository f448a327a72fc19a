//! What each line of the rubric is judged by.

use super::shows::{place, seen};
use super::{Album, CheckWording};
use crate::fault::Fault;
use crate::language::Text;
use crate::pictures::picture;
use reference::Assignment;
use reference::assignment::{MANIFEST, RubricItem};
use reference::fit::{self, Footprints, JudgedLine};
use reference::interpreter::Stage;
use reference::probes::ProbeSet;
use reference::rasteriser::Frame;

/// So many names of a solution are said of a line.
const MOST_NAMES: usize = 4;

/// Says it line by line, and where an answer may be wrong though no line looks there. Returns whether the solution without a line's
/// feature shows something else wherever there is a feature.
pub(super) fn say(
    said: CheckWording,
    assignment: &Assignment,
    alternatives: &fit::Alternatives<'_>,
    probes: &ProbeSet,
    right: &[Frame],
    album: &Album<'_>,
) -> Result<bool, Fault> {
    let mut all_show = true;
    let footprints = Footprints::of(alternatives, fit::TOLERANCE);
    let with_feature: Vec<usize> = footprints.lines().collect();
    // Where all is right, each line is judged that can be judged at all.
    let judged = footprints.judged(&|_| true);
    for (number, line) in assignment.rubric.iter().enumerate() {
        if !with_feature.contains(&number) {
            say_without_feature(said, assignment, number, &with_feature, &judged);
            continue;
        }
        let (id, shows) = (&line.id, footprints.of_line(number).len());
        let frames = assignment.features[number].as_ref().and_then(|feature| assignment.frames_without(feature));
        let seen = frames.as_deref().map(|frames| seen(frames, right));
        let place = place(probes, shows, seen, right.len());
        match judged_at(&judged, number) {
            _ if shows == 0 && seen == Some(0) => {
                all_show = false;
                said.line(
                    false,
                    &Text::new(
                        format!(
                            "rubric line `{id}`: its `without` shows what the solution shows, {}; change it",
                            place.en
                        ),
                        format!(
                            "採点の行 `{id}`: `without` を施しても解答と同じ結果です ({})。変えてください",
                            place.ja
                        ),
                    ),
                );
            }
            0 => said.note(&beside_others(line, &place)),
            at => said.ok(&Text::new(
                format!("rubric line `{id}`: shows {}; judged at {at} of the probes", place.en),
                format!("採点の行 `{id}`: {}。そのうち {at} 点で採点できる", place.ja),
            )),
        }
        album.put(&format!("without-{id}"), frames.iter().flatten().map(picture).collect())?;
    }
    if assignment.hands_in(Stage::Vertex) && !assignment.rubric.iter().any(|line| assignment.judges_position(line)) {
        said.note(&Text::new(
            "no line of the rubric judges where things stand: what moves them costs the lines whose feature moves something, or half of \
             every line where none does. Write `judges = \"gl_Position\"` in the line that it is to cost",
            "位置 (`gl_Position`) を採点する行がない。位置が違う答えでは、位置を動かす機能の行の点を引き、そのような行がなければすべての行の半分を引く。\
             引きたい行に `judges = \"gl_Position\"` と書く",
        ));
    }
    say_unjudged(said, footprints.unjudged(alternatives).len(), probes.probes.len());
    Ok(all_show)
}

fn judged_at(judged: &[JudgedLine], line: usize) -> usize {
    judged.iter().find(|known| known.line == line).map_or(0, |known| known.probes().len())
}

/// What there is to say of a line whose feature shows beside others everywhere, as where all that is seen is tone-mapped.
fn beside_others(line: &RubricItem, place: &Text) -> Text {
    let id = &line.id;
    let shown = Text::new(
        format!(
            "rubric line `{id}`: shows {}, always where another line shows as well, so that no probe judges it alone",
            place.en
        ),
        format!("採点の行 `{id}`: {}。いつもほかの行と同時に現れるので、検査点だけでは採点できない", place.ja),
    );
    let names: Vec<String> = line.variables.iter().take(MOST_NAMES).map(|name| format!("`{name}`")).collect();
    let more = line.variables.len() - names.len();
    let (and_more, more_ja) = match more {
        0 => (String::new(), String::new()),
        _ => (format!(" or {more} more"), format!(" ほか {more} 個")),
    };
    match names.is_empty() {
        true => Text::new(
            format!("{}: an answer that no mistake explains loses its points", shown.en),
            format!("{}。間違いで説明できない答えでは、この行の点は残りません", shown.ja),
        ),
        false => Text::new(
            format!(
                "{}. It is judged by the text of an answer: a slip that is found in {}{and_more} costs this line; where none is found, no line that shows \
                 there keeps its points",
                shown.en,
                names.join(", ")
            ),
            format!(
                "{}。答えの文面で採点し、{}{more_ja} に見つかった間違いはこの行から引きます。間違いの場所が分からない答えでは、そこに現れる行の点は残りません",
                shown.ja,
                names.join("、")
            ),
        ),
    }
}

/// Says how a line is judged that says no `without`, and where it stands.
fn say_without_feature(
    said: CheckWording,
    assignment: &Assignment,
    number: usize,
    with_feature: &[usize],
    judged: &[JudgedLine],
) {
    let line = &assignment.rubric[number];
    let place = assignment.line_of_rubric(&line.id).map_or_else(String::new, |line| format!("{MANIFEST}:{line}: "));
    let id = &line.id;
    let text = |en: String, ja: String| {
        Text::new(format!("{place}rubric line `{id}`: {en}"), format!("{place}採点の行 `{id}`: {ja}"))
    };
    let definition = assignment.equation.index(&line.judges).filter(|own| *own != assignment.equation.colour());
    let is_of_colour = |other: &usize| {
        let own = &assignment.rubric[*other];
        let is_all = assignment.equation.index(&own.judges).is_none_or(|own| own == assignment.equation.colour());
        is_all && !with_feature.contains(other) && !assignment.judges_position(own)
    };
    let rests = (0..assignment.rubric.len()).filter(is_of_colour).count();
    match definition {
        _ if assignment.judges_position(line) => {
            said.ok(&text("judges where things stand, `gl_Position`".into(), "位置 (`gl_Position`) を採点する".into()));
        }
        _ if !line.numbers.is_empty() => {}
        Some(_) => {
            let name = &line.judges;
            said.ok(&text(format!("judges the value of `{name}`"), format!("`{name}` の値を採点する")));
        }
        None if with_feature.is_empty() && rests == 1 => {
            said.ok(&text("judges all of the colour".into(), "色全体を採点する".into()));
        }
        None if rests == 1 => {
            let at = judged_at(judged, number);
            let all = text(
                format!(
                    "has no `without`, so it judges the colour where no other line shows, or only such as are right: {at} of the probes \
                     where all are right"
                ),
                format!(
                    "`without` がないので、ほかの行が現れないところと、正しい行だけが現れるところの色を採点する (ほかがすべて正しければ検査点 {at} 点)"
                ),
            );
            said.ok(&all);
        }
        None => said.note(&text(
            format!(
                "has no `without`, and neither has another line of the colour, so nothing tells what each of them judges: an answer that no \
                 mistake explains loses the points of all {rests}. Write `without = {{ replace = [[\"text of the solution\", \"text without it\"]] }}` \
                 to all of them but one"
            ),
            format!(
                "`without` がなく、色を採点するほかの行にもないため、それぞれが何を採点するのか決まりません。間違いで説明できない答えでは、これら \
                 {rests} 行の点は残りません。1 行を除いて `without = {{ replace = [[\"解答の文\", \"それを除いた文\"]] }}` と書いてください"
            ),
        )),
    }
}

/// Says that an answer may be wrong where no line of the rubric looks.
fn say_unjudged(said: CheckWording, count: usize, all: usize) {
    if count < fit::FEWEST {
        return;
    }
    said.note(&Text::new(
        format!(
            "rubric: no line shows at {count} of {all} probes: an answer that is wrong only there keeps all points. Add a line \
             without `without`, which judges all of the picture"
        ),
        format!(
            "採点の行: 検査点 {all} 点中 {count} 点にはどの行も現れません。そこだけが間違っている答えは満点のままです。画像全体を採点する、\
             `without` のない行を加えてください"
        ),
    ));
}
