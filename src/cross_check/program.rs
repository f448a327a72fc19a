//! The second opinion on a program with a fragment stage: what it shows at the probes.

use super::compare::{Relation, TOLERANCE, VertexOpinion, summed_up};
use crate::language::Text;
use crate::render::Sample;
use crate::report::CrossCheck;
use crate::source::Source;
use reference::Assignment;
use reference::interpreter::{Program, Stage};
use reference::pipeline::Pipeline;
use reference::probes::ProbeSet;
use std::sync::Arc;

/// Runs the stages that are handed in, with the homework's own, at the probes, and compares colours and positions.
pub fn check_program(
    assignment: &Assignment,
    sources: &[(Stage, &Source)],
    probes: &ProbeSet,
    samples: &[Sample],
) -> CrossCheck {
    let [mut vertex, mut fragment] = [&assignment.pipeline.vertex, &assignment.pipeline.fragment].map(Arc::clone);
    for (stage, source) in sources {
        let own = match stage {
            Stage::Vertex => &mut vertex,
            Stage::Fragment => &mut fragment,
        };
        match Program::compile(&source.text, *stage) {
            Ok(program) => *own = Arc::new(program),
            Err(refusal) => return CrossCheck::not_run(refusal.what().clone(), Some(refusal.line)),
        }
    }
    let shown = Pipeline::link(&vertex, &fragment, None).map_err(Text::from).and_then(|pipeline| {
        let lacks = || Text::new("it does not come to an end, or lacks an input", "終了しないか、入力が足りません");
        assignment.shown_at(&pipeline, probes).ok_or_else(lacks)
    });
    let shown = match shown {
        Ok(shown) => shown,
        Err(why) => return CrossCheck::not_run(why, None),
    };
    let judged = shown.iter().zip(samples).enumerate().map(|(number, (shown, sample))| {
        let is_near = |ours: f64, theirs: f32| (ours - f64::from(theirs)).abs() <= TOLERANCE * ours.abs().max(1.0);
        let mut pairs = shown.colour.to_array().into_iter().zip(sample.colour);
        let scale = shown.position.abs().max_element().max(1.0);
        let mut positions = shown.position.to_array().into_iter().zip(sample.position);
        let agrees = pairs.all(|(ours, theirs)| is_near(ours, theirs))
            && positions.all(|(ours, theirs)| is_near(ours / scale, (f64::from(theirs) / scale) as f32));
        let relation = match (agrees, shown.is_steady) {
            (true, _) => Relation::Agrees,
            (false, _) if !shown.colour.is_finite() || !shown.position.is_finite() => Relation::Undefined,
            (false, false) => Relation::Unsettled,
            (false, true) => Relation::Differs,
        };
        let [ours, theirs] =
            [shown.colour.to_array(), sample.colour_f64()].map(|colour| colour.map(|x| format!("{x:.4}")).join(", "));
        let message = (relation == Relation::Differs).then(|| {
            Text::new(
                format!("fragment {number}: the colour is {theirs} for the driver and {ours} for the interpreter"),
                format!("フラグメント {number}: 色はドライバーでは {theirs}, インタープリターでは {ours} です"),
            )
        });
        VertexOpinion { relation, message }
    });
    summed_up(judged.collect())
}
