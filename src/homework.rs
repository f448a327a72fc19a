//! A homework as the stages see it: names, draws and right pictures, made from the reference's data.

mod terms;

pub use terms::{Terms, term_pictures};

use crate::expected;
use crate::fault::Fault;
use crate::language::Text;
use crate::render::{Batch, Scene, State};
use crate::report::{Picture, SILHOUETTE};
use crate::translate::{Interface, Variable};
use reference::assignment::{Input, Stage};
use reference::interpreter::Type;
use reference::probes::{ProbeSet, Spot};
use reference::rasteriser::{Coverage, Frame};
use reference::scene::{Draw, Instance, Pose, Vertex};
use reference::{Assignment, Value, Values};
use std::ffi::CString;
use std::sync::{Arc, Mutex, PoisonError};

/// What the program feeds and takes. The fixed fragment stage is empty where that is handed in.
pub fn interface(assignment: &Assignment) -> Result<Interface, Fault> {
    let broken = |what: &str| Fault::new(Text::verbatim(format!("assignment {}: {what}", assignment.id)));
    let variable = |name: &str, kind: &Type| Variable { name: name.into(), ty: kind.to_string() };
    let fixed = assignment.fixed.iter().find(|fixed| fixed.stage == Stage::Fragment);
    let fixed = fixed.map_or("", |fixed| fixed.text.as_str());
    let output = assignment.interface.outputs.first().ok_or_else(|| broken("there is no output"))?;
    Ok(Interface {
        inputs: assignment.interface.inputs.iter().map(|input| variable(&input.name, &input.kind)).collect(),
        uniforms: assignment.interface.uniforms.iter().map(|uniform| variable(&uniform.path, &uniform.kind)).collect(),
        output: variable(&output.name, &output.kind),
        constants: assignment.constants.iter().map(|constant| constant.name.clone()).collect(),
        fragment: CString::new(fixed).map_err(|_| broken("a NUL in the fixed stage"))?,
    })
}

/// Whether a stage is handed in.
pub fn is_handed_in(assignment: &Assignment, stage: Stage) -> bool {
    assignment.files.iter().any(|file| file.stage == stage)
}

/// What is drawn for a submission: the course's animation and the probes, set after set.
pub fn scene(assignment: &Assignment, probes: &[&ProbeSet]) -> Scene {
    let scene = &assignment.scene;
    let draw = |instance: Instance<'_>| {
        let Draw { mesh, depth_test, cull, .. } = instance.draw;
        let batch = batch(assignment, &assignment.uniform_values(&instance.moment), &mesh.vertices);
        Batch { triangles: mesh.triangles.clone(), state: State { depth_test: *depth_test, cull: *cull }, ..batch }
    };
    let frame = |pose: &Pose| scene.instances(pose).into_iter().map(draw).collect();
    let frames = scene.all_poses().iter().map(frame).collect();
    let Scene { probes, pixels, shares, .. } = probed(assignment, probes);
    let textures = Arc::clone(&assignment.textures);
    let (width, height, background) = (scene.width, scene.height, scene.background);
    Scene { width, height, background, frames, probes, pixels, shares, textures }
}

/// What is run for probes, and no frames.
fn probed(assignment: &Assignment, sets: &[&ProbeSet]) -> Scene {
    let mut scene = Scene::default();
    let feeds_fragments = is_handed_in(assignment, Stage::Vertex);
    for (set, place) in sets.iter().flat_map(|set| (0..set.groups.len()).map(move |place| (set, place))) {
        let own = set.of_group(place);
        let uniforms = &set.groups[place].uniforms;
        let spots: Vec<&Spot> = own.iter().filter_map(|probe| probe.spot.as_deref()).collect();
        if spots.is_empty() {
            let vertices: Vec<Vertex> = own.iter().map(|probe| probe.vertex).collect();
            scene.probes.push(batch(assignment, uniforms, &vertices));
            continue;
        }
        let mut pixels = Batch { attributes: places(&spots), ..batch(assignment, uniforms, &[]) };
        if feeds_fragments {
            let corners: Vec<Vertex> = spots.iter().flat_map(|spot| spot.corners).collect();
            scene.probes.push(batch(assignment, uniforms, &corners));
            scene.shares.push(spots.iter().map(|spot| spot.weights).collect());
        } else {
            pixels.attributes.extend(varyings(&spots));
        }
        scene.pixels.push(pixels);
    }
    scene
}

/// Where fragments lie, as the fragment stage is told.
fn places(spots: &[&Spot]) -> Vec<(String, Values)> {
    let places = spots.iter().flat_map(|spot| spot.place).collect();
    let fronts = spots.iter().map(|spot| f64::from(u8::from(spot.is_front))).collect();
    vec![
        ("gl_FragCoord".into(), Values { kind: Type::VEC4, numbers: places }),
        ("gl_FrontFacing".into(), Values { kind: Type::BOOL, numbers: fronts }),
    ]
}

/// What the fixed vertex stage hands over, each scalar and vector by its path.
fn varyings(spots: &[&Spot]) -> Vec<(String, Values)> {
    let Some(first) = spots.first() else { return Vec::new() };
    let mut columns = Vec::new();
    for (number, (name, value)) in first.varyings.iter().enumerate() {
        let mut offset = 0;
        for (path, kind) in value.kind().parts(name) {
            let width = kind.slots().unwrap_or(0);
            let numbers = |spot: &&Spot| spot.varyings[number].1.numbers()[offset..offset + width].to_vec();
            let numbers = spots.iter().flat_map(numbers).collect();
            columns.push((path, Values { kind, numbers }));
            offset += width;
        }
    }
    columns
}

/// One draw with the program's own names; `uniforms` stand in the interface's order.
pub fn batch(assignment: &Assignment, uniforms: &[Value], vertices: &[Vertex]) -> Batch {
    let interface = &assignment.interface;
    let uniforms =
        interface.uniforms.iter().zip(uniforms).map(|(uniform, value)| (uniform.path.clone(), value.clone())).collect();
    let attribute = |input: &Input| {
        let values = vertices.iter().map(|vertex| input.stream.value(&input.kind, vertex));
        let numbers = values.flat_map(|value| value.numbers().to_vec()).collect();
        (input.name.clone(), Values { kind: input.kind.clone(), numbers })
    };
    Batch { uniforms, attributes: interface.inputs.iter().map(attribute).collect(), ..Batch::default() }
}

/// What is drawn once a process, by the digest of the assignment.
type Drawn<T> = Mutex<Vec<(String, Arc<[T]>)>>;

fn once<T>(drawn: &Drawn<T>, assignment: &Assignment, draw: impl FnOnce() -> Arc<[T]>) -> Arc<[T]> {
    let mut drawn = drawn.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = drawn.iter().find(|(digest, _)| *digest == assignment.digest) {
        return Arc::clone(known);
    }
    let new = draw();
    drawn.push((assignment.digest.clone(), Arc::clone(&new)));
    new
}

/// The reference's frames as pictures, drawn once a process.
pub fn expected_pictures(assignment: &Assignment) -> Arc<[Picture]> {
    static DRAWN: Drawn<Picture> = Mutex::new(Vec::new());
    once(&DRAWN, assignment, || expected::of_solution(assignment).map(picture).collect())
}

/// A right picture; its alpha says where it may be drawn otherwise.
fn picture(frame: Frame) -> Picture {
    let pixels = frame.pixels.iter().zip(&frame.coverage);
    let rgba = pixels.flat_map(|([r, g, b, _], coverage)| {
        [*r, *g, *b, if *coverage == Coverage::Silhouette { SILHOUETTE } else { u8::MAX }]
    });
    Picture { width: frame.width, height: frame.height, rgba: rgba.collect() }
}

/// The pose at which the picture says most: where the weakest term of the equation shows best. The brightness that each
/// term alone brings into the picture is held against the most that it brings at any pose, and the least of these shares
/// is what a pose is worth.
pub fn telling_pose(assignment: &Assignment) -> usize {
    let right = assignment.equation.right();
    let poses = assignment.scene.all_poses();
    let terms = assignment.rubric.iter().filter(|line| !line.alone_in.is_empty());
    let mut worth = vec![1.0_f64; poses.len()];
    for term in terms {
        let brightness: Vec<f64> = poses
            .iter()
            .map(|pose| assignment.term_frame(pose, &right, &term.judges).map_or(0.0, |frame| brightness(&frame)))
            .collect();
        let most = brightness.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (worth, brightness) in worth.iter_mut().zip(brightness) {
            *worth = worth.min(brightness / most);
        }
    }
    // Of equals the first: the one that the course's window opens with.
    worth.iter().enumerate().rev().max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(pose, _)| pose)
}

/// The sum of red, green and blue over what is painted.
fn brightness(frame: &Frame) -> f64 {
    let painted = frame.pixels.iter().zip(&frame.coverage).filter(|(_, coverage)| **coverage == Coverage::Interior);
    painted.map(|([red, green, blue, _], _)| f64::from(*red) + f64::from(*green) + f64::from(*blue)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pose_shows_every_term() {
        // The highlight is seen near t = 0 only, and there it is faint: see the assignment's notes on the animation.
        let assignment = reference::assignment("ggsample06").unwrap();
        let pose = &assignment.scene.all_poses()[telling_pose(assignment)];
        for term in assignment.rubric.iter().filter(|line| !line.alone_in.is_empty()) {
            let frame = assignment.term_frame(pose, &assignment.equation.right(), &term.judges).unwrap();
            assert!(brightness(&frame) > 0.0, "{} at t = {}", term.id, pose.t);
        }
    }
}
