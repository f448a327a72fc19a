//! Where an answer looks up the map that a pass draws, for a pixel that is wrong, and where a right answer does.

use crate::compare::{self, ExpectedFrame};
use crate::render::Frames;
use crate::report::{FrameResult, MapLookup, MapPlace};
use crate::source::Source;
use crate::translate::Stage;
use reference::Assignment;
use reference::interpreter::{NotedLookup, Program};
use reference::pipeline::Pipeline;
use std::sync::Arc;

/// So many lookups of a pixel are told: a kernel of 7 × 7.
const MOST_PLACES: usize = 49;

/// What the files look up in the frame with the most wrong pixels. `None` where no map is drawn, nothing is wrong, or the files look no
/// map up there and a right answer does not either.
pub(super) fn of(
    assignment: &Assignment,
    sources: &[(Stage, &Source)],
    expected: &[ExpectedFrame],
    drawn: &Frames,
    results: &[FrameResult],
) -> Option<MapLookup> {
    assignment.scene.pass.as_ref()?;
    let (frame, _) = results.iter().enumerate().rev().max_by_key(|(_, result)| result.mismatched_pixels)?;
    let wrong = compare::wrong_pixels(expected.get(frame)?, drawn, u32::try_from(frame).ok()?);
    let pixel = compare::innermost(&wrong, drawn.width)?;
    let pose = *assignment.scene.all_poses().get(frame)?;
    let [mut vertex, mut fragment] = [&assignment.pipeline.vertex, &assignment.pipeline.fragment].map(Arc::clone);
    for (stage, source) in sources {
        let program = Arc::new(Program::compile(&source.text, *stage).ok()?);
        match stage {
            Stage::Vertex => vertex = program,
            Stage::Fragment => fragment = program,
        }
    }
    let own = Pipeline::link(&vertex, &fragment, None).ok()?;
    let [yours, right] = [&own, &assignment.pipeline].map(|pipeline| assignment.lookups_of(&pose, pipeline, pixel));
    let texture = yours.iter().chain(&right).next()?.texture;
    let (size, depths) = assignment.drawn_map(texture)?;
    let place = |one: &NotedLookup| {
        let texel = |axis: usize| (one.at[axis] * size[axis] as f64).clamp(0.0, size[axis] as f64 - 1.0) as usize;
        let stored = f64::from(depths[texel(1) * size[0] + texel(0)]);
        MapPlace { at: one.at, depth: one.reference, stored }
    };
    let places = |all: &[NotedLookup]| {
        let finite = all.iter().filter(|one| one.at.iter().all(|number| number.is_finite()));
        finite.take(MOST_PLACES).map(place).collect()
    };
    let file = sources.iter().find(|(stage, _)| *stage == Stage::Fragment);
    Some(MapLookup {
        frame: u32::try_from(frame).ok()?,
        pixel,
        texture: u32::try_from(texture).ok()?,
        file: file.map(|(_, source)| source.facts.name.clone()),
        line: file.and(yours.first()).map(|one| one.line),
        yours: places(&yours),
        right: places(&right),
    })
}
