//! Where the features of the rubric and the mistakes of a folder show.

use super::{Album, CheckWording, rubric, unseen};
use crate::compare::PIXEL_TOLERANCE;
use crate::fault::Fault;
use crate::language::Text;
use crate::pictures::picture;
use reference::Assignment;
use reference::fit;
use reference::mistake::{FoundMistake, Mistake};
use reference::probes::ProbeSet;
use reference::rasteriser::{Coverage, Frame};

/// Says it all; whether every mistake shows something of its own.
pub(super) fn say(said: CheckWording, assignment: &Assignment, album: &Album<'_>) -> Result<bool, Fault> {
    let probes = assignment.judging_probes();
    let alternatives = fit::Alternatives::new(assignment, &probes);
    let right = assignment.frames();
    let all_show = rubric::say(said, assignment, &alternatives, &probes, &right, album)?;
    for mistake in assignment.mistakes.iter().filter(|mistake| mistake.ways() > 0) {
        say_mistake(said, assignment, mistake, &probes, &right, album)?;
    }
    unseen::say(said, assignment, &probes, &right);
    Ok(say_alike(said, &alternatives) && all_show)
}

/// Says where a mistake shows in the first way in which it is written, and draws each.
fn say_mistake(
    said: CheckWording,
    assignment: &Assignment,
    mistake: &Mistake,
    probes: &ProbeSet,
    right: &[Frame],
    album: &Album<'_>,
) -> Result<(), Fault> {
    let ways = if album.is_wanted() { mistake.ways() } else { 1 };
    for form in 0..ways {
        let is_free = mistake.forms.get(form).is_some_and(|form| form.free);
        let parameter = mistake.fit.as_ref().filter(|_| is_free).map(|fit| fit.example);
        let found = FoundMistake { id: mistake.id.clone(), form, parameter };
        let frames = assignment.frames_with(&found);
        album.put(&format!("{}-{form}", mistake.id), frames.iter().flatten().map(picture).collect())?;
        if form > 0 {
            continue;
        }
        let shows = fit::showing(assignment, &found, probes, fit::TOLERANCE);
        let seen = frames.as_deref().map(|frames| seen(frames, right));
        let place = place(probes, shows, seen, right.len());
        let id = &mistake.id;
        let text = Text::new(format!("mistake `{id}`: shows {}", place.en), format!("間違い `{id}`: {}", place.ja));
        match seen {
            None | Some(1..) => said.ok(&text),
            Some(0) => said.note(&Text::new(
                format!("{}: its pictures look right, and only probes find it", text.en),
                format!("{}。画像は正しく見え、検査点だけで見つかります", text.ja),
            )),
        }
    }
    Ok(())
}

/// In how many of these frames something differs from the right ones.
pub(super) fn seen(frames: &[Frame], right: &[Frame]) -> usize {
    frames.iter().zip(right).filter(|(own, right)| is_seen(own, right)).count()
}

/// At how many probes and in how many of so many frames something shows, where that is known of frames.
pub(super) fn place(probes: &ProbeSet, shows: usize, seen: Option<usize>, count: usize) -> Text {
    let all = probes.probes.len();
    let Some(seen) = seen else {
        return Text::new(format!("at {shows} of {all} probes"), format!("検査点 {all} 点中 {shows} 点に現れる"));
    };
    Text::new(
        format!("at {shows} of {all} probes, and in {seen} of {count} frames"),
        format!("検査点 {all} 点中 {shows} 点、画像 {count} 枚中 {seen} 枚に現れる"),
    )
}

/// Whether a picture differs from the right one, edges aside.
pub(super) fn is_seen(own: &Frame, right: &Frame) -> bool {
    let width = own.width.max(1) as usize;
    let rows = own.pixels.chunks(width).zip(right.pixels.chunks(width));
    let lies = own.coverage.chunks(width).zip(right.coverage.chunks(width));
    // Most of a picture is the same to the last bit.
    let mut others = rows.zip(lies).filter(|((own, right), _)| own.as_flattened() != right.as_flattened());
    others.any(|((own, right), lies)| {
        own.iter().zip(right).zip(lies.0.iter().zip(lies.1)).any(|((own, right), lies)| {
            let is_edge = *lies.0 == Coverage::Silhouette || *lies.1 == Coverage::Silhouette;
            !is_edge && own.iter().zip(right).any(|(a, b)| a.abs_diff(*b) > PIXEL_TOLERANCE)
        })
    })
}

/// Names the mistakes that show nothing of their own.
fn say_alike(said: CheckWording, alternatives: &fit::Alternatives<'_>) -> bool {
    let alike = fit::alike(alternatives, fit::TOLERANCE);
    for (variant, other) in &alike {
        let text = match other {
            None => Text::new(
                format!("{variant}: shows at no probe; change it, or remove it"),
                format!("{variant}: どの検査点でも解答と同じになります。変えるか、取り除いてください"),
            ),
            Some(other) => Text::new(
                format!("{variant}: shows the same as {other}, which is what will be found; remove one"),
                format!("{variant}: {other} と同じ結果になり、見つかるのはそちらです。一方を取り除いてください"),
            ),
        };
        said.line(false, &text);
    }
    alike.is_empty()
}
