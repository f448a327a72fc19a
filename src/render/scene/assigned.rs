//! The scene of an assignment: its frames, and what is run for its probes.

use super::{DrawCall, DrawState, RenderScene, WINDOW};
use crate::translate::{INSTANCE_NUMBER, VERTEX_NUMBER};
use reference::assignment::Input;
use reference::interpreter::Stage;
use reference::interpreter::Type;
use reference::probes::{ProbeSet, Spot};
use reference::scene::{Draw, Instance, Pose, Vertex};
use reference::{Assignment, Value, Values};
use std::sync::Arc;

impl RenderScene {
    /// What is drawn for a submission: the course's animation and the probes, set after set.
    pub fn of(assignment: &Assignment, probes: &[&ProbeSet]) -> Self {
        let scene = &assignment.scene;
        let draw = |instance: Instance<'_>| {
            let Draw { mesh, depth_test, cull, .. } = instance.draw;
            let batch = DrawCall::of(assignment, &assignment.uniform_values(&instance.moment), &mesh.vertices);
            DrawCall {
                triangles: mesh.triangles.clone(),
                state: DrawState { depth_test: *depth_test, cull: *cull },
                ..batch
            }
        };
        let frame = |pose: &Pose| scene.instances(pose).into_iter().map(draw).collect();
        let frames = scene.all_poses().iter().map(frame).collect();
        let Self { probes, pixels, shares, .. } = probed(assignment, probes);
        let textures = Arc::clone(&assignment.textures);
        let (width, height, background) = (scene.width, scene.height, scene.background);
        Self { width, height, background, frames, probes, pixels, shares, textures }
    }
}

/// What is run for probes, and no frames.
fn probed(assignment: &Assignment, sets: &[&ProbeSet]) -> RenderScene {
    let mut scene = RenderScene::default();
    let feeds_fragments = assignment.hands_in(Stage::Vertex);
    for (set, place) in sets.iter().flat_map(|set| (0..set.groups.len()).map(move |place| (set, place))) {
        let own = set.of_group(place);
        let uniforms = &set.groups[place].uniforms;
        let spots: Vec<&Spot> = own.iter().filter_map(|probe| probe.spot.as_deref()).collect();
        if spots.is_empty() {
            // Numbers of their own: what is looked up by the number of a vertex is not what is asked for.
            let numbered = own.iter().zip(0..).map(|(probe, number)| Vertex { number, ..probe.vertex });
            let vertices: Vec<Vertex> = numbered.collect();
            scene.probes.push(DrawCall::of(assignment, uniforms, &vertices));
            continue;
        }
        let mut pixels = DrawCall { attributes: places(&spots), ..DrawCall::of(assignment, uniforms, &[]) };
        if feeds_fragments {
            let corners: Vec<Vertex> = spots.iter().flat_map(|spot| spot.corners).collect();
            scene.probes.push(DrawCall::of(assignment, uniforms, &corners));
            scene.shares.push(spots.iter().map(|spot| weights_around(spot)).collect());
        } else {
            pixels.attributes.extend(varyings(&spots, &|spot| &spot.varyings));
            pixels.beside = [0, 1].map(|pixel| varyings(&spots, &|spot| &spot.varyings_beside[pixel]));
        }
        scene.pixels.push(pixels);
    }
    scene
}

/// The shares of the corners at a spot, at the pixel to the right, and at the one above.
fn weights_around(spot: &Spot) -> [[f64; 3]; 3] {
    let [right, above] = spot.weights_beside;
    [spot.weights, right, above]
}

/// Where fragments lie, as the fragment stage is told.
fn places(spots: &[&Spot]) -> Vec<(String, Values)> {
    let places = spots.iter().flat_map(|spot| spot.place).collect();
    let windows = spots.iter().flat_map(|spot| spot.window).collect();
    let fronts = spots.iter().map(|spot| f64::from(u8::from(spot.is_front))).collect();
    vec![
        ("gl_FragCoord".into(), Values { kind: Type::VEC4, numbers: places }),
        (WINDOW.into(), Values { kind: Type::vector(2), numbers: windows }),
        ("gl_FrontFacing".into(), Values { kind: Type::BOOL, numbers: fronts }),
    ]
}

/// What the fixed vertex stage hands over, each scalar and vector by its path.
fn varyings(spots: &[&Spot], of: &dyn Fn(&Spot) -> &[(String, Value)]) -> Vec<(String, Values)> {
    let Some(first) = spots.first() else { return Vec::new() };
    let mut columns = Vec::new();
    for (number, (name, value)) in of(first).iter().enumerate() {
        let mut offset = 0;
        for (path, kind) in value.kind().parts(name) {
            let width = kind.slots().unwrap_or(0);
            let numbers = |spot: &&Spot| of(spot)[number].1.numbers()[offset..offset + width].to_vec();
            let numbers = spots.iter().flat_map(numbers).collect();
            columns.push((path, Values { kind, numbers }));
            offset += width;
        }
    }
    columns
}

impl DrawCall {
    /// One draw with the program's own names; `uniforms` stand in the interface's order.
    pub fn of(assignment: &Assignment, uniforms: &[Value], vertices: &[Vertex]) -> Self {
        let interface = &assignment.interface;
        let uniforms = interface
            .uniforms
            .iter()
            .zip(uniforms)
            .map(|(uniform, value)| (uniform.path.clone(), value.clone()))
            .collect();
        let attribute = |input: &Input| {
            let values = vertices.iter().map(|vertex| input.stream.value(&input.kind, vertex));
            let numbers = values.flat_map(|value| value.numbers().to_vec()).collect();
            (input.name.clone(), Values { kind: input.kind.clone(), numbers })
        };
        let number = |name: &str, of: fn(&Vertex) -> u32| {
            let numbers = vertices.iter().map(|vertex| f64::from(of(vertex))).collect();
            (name.to_owned(), Values { kind: Type::INT, numbers })
        };
        let numbers =
            [number(VERTEX_NUMBER, |vertex| vertex.number), number(INSTANCE_NUMBER, |vertex| vertex.instance)];
        let attributes = interface.inputs.iter().map(attribute).chain(numbers).collect();
        Self { uniforms, attributes, ..DrawCall::default() }
    }
}
