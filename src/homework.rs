//! A homework as the stages see it: names, draws and right pictures, made from the reference's data.

use crate::compare::ExpectedFrame;
use crate::diagnose::constants;
use crate::fault::Fault;
use crate::language::Text;
use crate::render::{Batch, Scene};
use crate::report::{Hypothesis, Picture, TermPictures};
use crate::source::Source;
use crate::translate::{Interface, Variable};
use reference::Assignment;
use reference::assignment::RubricLine;
use reference::mistake::Found;
use reference::probes::ProbeSet;
use reference::rasteriser::{ClipVertex, Frame};
use reference::scene::{Matrices, Pose, Vertex};
use std::ffi::CString;
use std::sync::{Arc, Mutex, PoisonError};

/// The built-in assignment with this id.
pub fn assignment(id: &str) -> Result<&'static Assignment, Fault> {
    reference::assignment(id).ok_or_else(|| {
        let known: Vec<_> = reference::assignments().iter().map(|assignment| assignment.id.as_str()).collect();
        Fault::new(Text::new(
            format!("there is no assignment `{id}` (there is: {})", known.join(", ")),
            format!("課題 `{id}` はありません (あるもの: {})", known.join(", ")),
        ))
    })
}

/// The interface of the assignment's only file.
pub fn interface(assignment: &Assignment) -> Result<Interface, Fault> {
    let broken = |what: &str| Fault::new(Text::verbatim(format!("assignment {}: {what}", assignment.id)));
    let variable = |name: &str, kind: reference::Type| Variable { name: name.into(), ty: kind.glsl().into() };
    let file = assignment.files.first().ok_or_else(|| broken("no file is handed in"))?;
    let fixed = file.fixed.first().ok_or_else(|| broken("there is no fixed stage"))?;
    let output = assignment.interface.outputs.first().ok_or_else(|| broken("there is no output"))?;
    Ok(Interface {
        inputs: assignment.interface.inputs.iter().map(|input| variable(&input.name, input.kind)).collect(),
        uniforms: assignment.interface.uniforms.iter().map(|uniform| variable(&uniform.name, uniform.kind)).collect(),
        output: variable(&output.name, output.kind),
        constants: assignment.constants.iter().map(|constant| constant.name.clone()).collect(),
        fragment: CString::new(fixed.1.as_str()).map_err(|_| broken("a NUL in the fixed stage"))?,
    })
}

/// The reference's frames of all poses.
pub fn expected_frames(assignment: &Assignment) -> Vec<ExpectedFrame> {
    let background = assignment.scene.background;
    let poses = assignment.scene.all_poses();
    let right = assignment.equation.right();
    // One at a time: all of them together are larger than what is kept.
    poses.iter().map(|pose| ExpectedFrame::new(pose.t, &assignment.frame(pose, &right), background)).collect()
}

/// What is drawn for a submission: the course's animation and the probes.
pub fn scene(assignment: &Assignment, probes: &ProbeSet) -> Scene {
    let scene = &assignment.scene;
    let frames = scene.all_poses().iter().map(|pose| batch(assignment, &pose.matrices, &scene.triangle)).collect();
    let probes = (0..probes.groups.len())
        .map(|group| {
            let vertices: Vec<Vertex> = probes.of_group(group).iter().map(|probe| probe.vertex).collect();
            batch(assignment, &probes.groups[group].matrices, &vertices)
        })
        .collect();
    Scene { width: scene.width, height: scene.height, background: scene.background, frames, probes }
}

/// One draw with the program's own names, in f32.
pub fn batch(assignment: &Assignment, matrices: &Matrices, vertices: &[Vertex]) -> Batch {
    let interface = &assignment.interface;
    let uniforms = interface
        .uniforms
        .iter()
        .map(|uniform| (uniform.name.clone(), uniform.carries.of(matrices).as_mat4().to_cols_array()))
        .collect();
    let attributes = interface
        .inputs
        .iter()
        .map(|input| {
            let xyz = |vertex: &Vertex| input.carries.of(vertex).as_vec4().truncate().to_array();
            (input.name.clone(), vertices.iter().map(xyz).collect())
        })
        .collect();
    Batch { uniforms, attributes }
}

/// What is drawn once a process, by the id of the assignment.
type Drawn<T> = Mutex<Vec<(String, Arc<[T]>)>>;

fn once<T>(drawn: &Drawn<T>, assignment: &Assignment, draw: impl FnOnce() -> Arc<[T]>) -> Arc<[T]> {
    let mut drawn = drawn.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = drawn.iter().find(|(id, _)| *id == assignment.id) {
        return Arc::clone(known);
    }
    let new = draw();
    drawn.push((assignment.id.clone(), Arc::clone(&new)));
    new
}

/// The reference's frames as pictures, drawn once a process.
pub fn expected_pictures(assignment: &Assignment) -> Arc<[Picture]> {
    static DRAWN: Drawn<Picture> = Mutex::new(Vec::new());
    once(&DRAWN, assignment, || assignment.frames().into_iter().map(picture).collect())
}

fn picture(frame: Frame) -> Picture {
    Picture { width: frame.width, height: frame.height, rgba: frame.pixels.concat() }
}

/// Each term of the equation on its own, right and as the explanation has it, at the pose where the two differ most.
///
/// `source` is where changed constants are read from. Those of right answers are drawn once a process.
pub fn term_pictures(
    assignment: &Assignment,
    explanation: Option<&[Hypothesis]>,
    source: Option<&Source>,
) -> Arc<[TermPictures]> {
    static RIGHT: Drawn<TermPictures> = Mutex::new(Vec::new());
    let changed = source.map(|source| constants::changed(source, assignment)).unwrap_or_default();
    let values: Vec<_> = changed.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
    let theirs = explanation.and_then(|_| assignment.with_constants(&values).ok());
    let found: Vec<Found> = explanation
        .unwrap_or_default()
        .iter()
        .map(|h| Found { id: h.id.clone(), form: h.form, parameter: h.parameter })
        .collect();
    let terms = assignment.rubric.iter().filter(|line| !line.alone_in.is_empty());
    let draw = || terms.filter_map(|line| one_term(assignment, theirs.as_ref(), &found, line)).collect();
    let is_right = values.is_empty() && explanation.is_some_and(<[_]>::is_empty);
    if is_right { once(&RIGHT, assignment, draw) } else { draw() }
}

fn one_term(
    assignment: &Assignment,
    theirs: Option<&Assignment>,
    found: &[Found],
    line: &RubricLine,
) -> Option<TermPictures> {
    let poses = assignment.scene.all_poses();
    let right = assignment.equation.right();
    let variant = theirs.and_then(|theirs| Some((theirs, theirs.variant(found)?)));
    let corners = |pose: &Pose| {
        let right = assignment.term_corners(pose, &right, &line.judges);
        let theirs = variant.as_ref().and_then(|(theirs, variant)| theirs.term_corners(pose, variant, &line.judges));
        right.zip(theirs)
    };
    let difference = |pose: &&Pose| corners(pose).map_or(0.0, |(right, theirs)| visible_difference(&right, &theirs));
    // Of equals the first pose: the one that the course's window opens with.
    let pose = poses.iter().rev().max_by(|a, b| difference(a).total_cmp(&difference(b)))?;
    let expected = picture(assignment.term_frame(pose, &right, &line.judges)?);
    let is_same = corners(pose).is_some_and(|(right, theirs)| right == theirs);
    let yours = match &variant {
        Some(_) if is_same => Some(expected.clone()),
        Some((theirs, variant)) => theirs.term_frame(pose, variant, &line.judges).map(picture),
        None => None,
    };
    Some(TermPictures { id: line.id.clone(), t: pose.t, yours, expected })
}

/// How much two colourings of one triangle differ in its picture: by its area there, and at its corners.
fn visible_difference(right: &[ClipVertex; 3], theirs: &[ClipVertex; 3]) -> f64 {
    let [a, b, c] = right.map(|corner| corner.position.truncate().truncate() / corner.position.w);
    let area = (b - a).perp_dot(c - a).abs();
    let shown = |colour: glam::DVec3| colour.clamp(glam::DVec3::ZERO, glam::DVec3::ONE);
    let apart = |(right, theirs): (&ClipVertex, &ClipVertex)| {
        let apart = (shown(right.colour) - shown(theirs.colour)).abs().element_sum();
        // What is not a number is drawn as anything at all.
        if apart.is_finite() { apart } else { 3.0 }
    };
    area * right.iter().zip(theirs).map(apart).sum::<f64>()
}
