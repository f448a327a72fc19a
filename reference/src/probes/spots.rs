//! Probes of a program with a fragment stage: one fragment each, somewhere within a triangle.
//!
//! The corners are vertices of what the homework draws, moved and turned a little together, so that what is interpolated
//! between them is like what the homework's own fragments are given. Where a colour depends on the last bits of what it is
//! computed from, at the edge of a step, no fragment is probed: there a right answer may have another one.

mod across;
mod handed;
mod pictured;
mod revealing;
mod seen;
mod shown;

use super::{Probe, ProbeGroup, ProbeSet, Random};
use crate::Assignment;
use crate::Value;
use crate::equation::Evaluation;
use crate::interpreter::WindowCoordinates;
use crate::pipeline::UniformsOf;
use crate::scene::{Cull, Vertex};
pub use across::{Crossings, EdgeDefect};
use glam::{DQuat, DVec2, DVec3, DVec4};
pub use handed::linear;
pub(crate) use handed::{FragmentInputs, handed_at};
use handed::{HandedAround, mixed};
pub use pictured::Pictured;
use rand_chacha::ChaCha8Rng;
use seen::{seen_at, weights_at};
pub use shown::ProbeOutput;
use shown::WAYS;

/// How far from its own place a triangle may be moved, as a share of its mesh's size.
const ASIDE: f64 = 0.05;

/// By how much the normals of a triangle's corners are turned apart, in radians: what is interpolated between them is shorter
/// than 1, also on a flat face.
const APART: f64 = 0.25;

/// So often fragments are drawn for a camera, and so many cameras are tried, before a camera stays with fewer of them.
const ROUNDS: usize = 4;
const CAMERAS: usize = 40;

/// A fragment within a triangle.
#[derive(Clone, Debug)]
pub struct Spot {
    /// The corners of the triangle, as the vertex stage is given them.
    pub corners: [Vertex; 3],
    /// The share of each corner in what is interpolated; the last one's values are those of `flat` variables.
    pub weights: [f64; 3],
    /// The same at the pixel to the right and at the one above.
    pub weights_beside: [[f64; 3]; 2],
    /// `gl_FragCoord`, by OpenGL's own rules.
    pub place: [f64; 4],
    /// Width and height of the window that it lies in.
    pub window: [f64; 2],
    /// `gl_FrontFacing`.
    pub is_front: bool,
    /// What the right vertex stage hands over there, exact in f32: for each of its outputs.
    pub varyings: Vec<(String, Value)>,
    /// The same at the pixel to the right and at the one above.
    pub varyings_beside: [Vec<(String, Value)>; 2],
    /// Where it puts the first corner, in clip space.
    pub(crate) position: DVec4,
    /// Whether that is what it does with the uniforms of the probe.
    pub(crate) is_known: bool,
}

/// A fragment before it is known whether it is seen: the corners of a triangle, a share for each, and which triangles are left out.
type FragmentCandidate = ([Vertex; 3], [f64; 3], Cull);

/// Which fragments are taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FragmentChoice {
    /// In the middle of a pixel, on either side of a triangle.
    AnySide,
    /// The same on the fronts only, where both sides are drawn.
    Front,
    /// On the fronts, just where they are.
    FrontInPlace,
}

/// Fragments that are seen, and what is handed over there.
struct LocatedSpots {
    spots: Vec<Spot>,
    handed: HandedAround,
}

/// A number `at` so many pixels to the right and above, where it is known here and at the two pixels `beside`. What a driver
/// interpolates within 2 × 2 pixels is as good as linear.
pub fn at_pixel(here: f64, beside: [f64; 2], at: [f64; 2]) -> f64 {
    let moved = here + (beside[0] - here) * at[0] + (beside[1] - here) * at[1];
    if moved.is_finite() { moved } else { here }
}

impl Assignment {
    /// Probes under `count` cameras.
    pub(super) fn draw_spots(&self, seed: u64, random: ChaCha8Rng, count: usize) -> ProbeSet {
        let mut random = Random(random);
        let mut set = ProbeSet { seed, groups: Vec::new(), probes: Vec::new(), twins: 0 };
        for group in 0..count {
            let (drawn, probes) = self.spots_of_group(&mut random, group);
            set.groups.push(drawn);
            set.probes.extend(probes);
        }
        set
    }

    /// A camera and its probes.
    fn spots_of_group(&self, random: &mut Random, group: usize) -> (ProbeGroup, Vec<Probe>) {
        let wanted = self.probing.per_group;
        let mut best: (ProbeGroup, Vec<Probe>) = (self.group(random), Vec::new());
        for camera in 0..2 * CAMERAS {
            // Of a closed surface nobody sees the inside, so an answer may do there what it likes. The outside of a mesh whose
            // triangles all run with the clock is never found.
            let taken = if camera < CAMERAS { self.usual_sides() } else { FragmentChoice::AnySide };
            if camera >= CAMERAS && !best.1.is_empty() {
                break;
            }
            let drawn = self.group(random);
            let mut probes = Vec::new();
            for _ in 0..ROUNDS {
                let some = (0..wanted).map(|_| self.triangle(random)).collect();
                probes.extend(self.probed(group, &drawn, some, taken).unwrap_or_default());
                // What lies behind the eye altogether lies there for every triangle.
                if probes.is_empty() || probes.len() >= wanted {
                    break;
                }
            }
            if probes.len() > best.1.len() || best.1.is_empty() {
                best = (drawn, probes);
            }
            if best.1.len() >= wanted {
                break;
            }
        }
        let (drawn, mut probes) = best;
        self.reveal(random, group, &drawn, &mut probes);
        // Each camera has as many: the last ones are the first again.
        let own = probes.len();
        (own..wanted).for_each(|place| probes.extend(probes.get(place % own.max(1)).cloned()));
        probes.truncate(wanted);
        (drawn, probes)
    }

    /// The sides of triangles of which both are drawn.
    fn usual_sides(&self) -> FragmentChoice {
        if self.probing.takes_backs { FragmentChoice::AnySide } else { FragmentChoice::Front }
    }

    /// A triangle of what is drawn, moved and turned, a share for each corner, and which triangles are left out.
    fn triangle(&self, random: &mut Random) -> FragmentCandidate {
        let draws: Vec<_> = self.scene.views.iter().flat_map(|view| &view.draws).collect();
        let draw = draws[random.below(draws.len())];
        let mesh = &draw.mesh;
        let numbers = mesh.triangles[random.below(mesh.triangles.len())];
        let own = numbers.map(|number| mesh.vertices[number as usize]);
        let (low, high) = mesh.bounds();
        let aside = random.direction() * random.between(0.0, ASIDE) * (high - low).length();
        // In what fills the window a texture coordinate is the pixel's share of it, and an answer may take the one for the other.
        let is_moved = if mesh.fills_window { 0.0 } else { 1.0 };
        let aside = aside * is_moved;
        let turned = DQuat::from_axis_angle(random.direction(), random.between(0.0, std::f64::consts::PI));
        // Texture coordinates stay within the picture where the triangle's are.
        let coordinates = own.map(|vertex| vertex.texture_coordinates);
        let low = coordinates[0].min(coordinates[1]).min(coordinates[2]);
        let high = coordinates[0].max(coordinates[1]).max(coordinates[2]);
        let shift = |low: f64, high: f64, random: &mut Random| match (low, high) {
            (low, high) if low >= 0.0 && high <= 1.0 => random.between(-low, 1.0 - high + f64::MIN_POSITIVE),
            _ => 0.0,
        };
        let shift = DVec2::new(shift(low.x, high.x, random), shift(low.y, high.y, random)) * is_moved;
        let corners = own.map(|vertex| {
            let apart = DQuat::from_axis_angle(random.direction(), random.between(0.0, APART)) * turned;
            let moved = Vertex::new(vertex.position.truncate() + aside, apart * vertex.normal.truncate())
                .textured(vertex.texture_coordinates + shift)
                .along(apart * vertex.tangent.truncate(), vertex.tangent.w);
            moved.numbered_as(&vertex)
        });
        // Evenly over the triangle.
        let (along, across) = (random.between(0.0, 1.0).sqrt(), random.between(0.0, 1.0));
        (corners, [1.0 - along, along * (1.0 - across), along * across], draw.cull)
    }

    /// The probes at those of these fragments that are seen, and have a colour that stays when they are moved a little.
    fn probed(
        &self,
        group: usize,
        drawn: &ProbeGroup,
        some: Vec<FragmentCandidate>,
        taken: FragmentChoice,
    ) -> Option<Vec<Probe>> {
        let located = self.located(drawn, some, taken)?;
        let spots: Vec<&Spot> = located.spots.iter().collect();
        let uniforms = UniformsOf::All(&drawn.uniforms);
        let colours = self.colours(&self.pipeline, uniforms, &spots, &located.handed, WAYS)?;
        let is_steady: Vec<bool> = colours.iter().map(|(_, is_steady)| *is_steady).collect();
        let probes = self.shown_in_place(group, drawn, located, colours.into_iter().map(|(colour, _)| colour));
        let known = probes
            .into_iter()
            .zip(is_steady)
            .filter(|(probe, is_steady)| *is_steady && probe.colour.is_finite() && probe.position.is_finite());
        Some(self.judged(&drawn.uniforms, known.map(|(probe, _)| probe).collect()))
    }

    /// The probes at these fragments, with the colours that the solution shows there.
    fn shown_in_place(
        &self,
        group: usize,
        drawn: &ProbeGroup,
        located: LocatedSpots,
        colours: impl Iterator<Item = DVec3>,
    ) -> Vec<Probe> {
        let LocatedSpots { spots, handed } = located;
        let right = self.equation.right();
        let probe = |((at, spot), shown): ((usize, Spot), DVec3)| {
            let attributes = self.read_at(at, &handed[0], shown, spot.position);
            let outcome: Evaluation<'_> = right.evaluate(&drawn.uniforms, &attributes);
            Probe {
                group,
                vertex: spot.corners[0],
                attributes,
                region: right.first_region(&self.regions),
                colour: outcome.colour(),
                position: outcome.position(),
                spot: Some(Box::new(spot)),
            }
        };
        spots.into_iter().enumerate().zip(colours).map(probe).collect()
    }

    /// Those of these fragments that lie before the eye, and are not left out.
    fn located(&self, drawn: &ProbeGroup, some: Vec<FragmentCandidate>, taken: FragmentChoice) -> Option<LocatedSpots> {
        let pipeline = &self.pipeline;
        let vertices: Vec<Vertex> = some.iter().flat_map(|(corners, ..)| corners).copied().collect();
        let (positions, written) = self.handed_by(&pipeline.vertex, UniformsOf::All(&drawn.uniforms), &vertices)?;
        let mut spots = Vec::new();
        let mut shares = Vec::new();
        // No pixel lies outside, so that an answer may count there as it likes.
        let is_bounded = pipeline.fragment.inputs().iter().any(|input| WindowCoordinates::of(&input.name).is_some());
        let is_in_window = |[x, y, ..]: [f64; 4]| {
            !is_bounded || (0.0..drawn.window[0]).contains(&x) && (0.0..drawn.window[1]).contains(&y)
        };
        for (number, (corners, weights, cull)) in some.into_iter().enumerate() {
            let ends = [0, 1, 2].map(|corner| positions[3 * number + corner]);
            let Some((weights, place, is_front)) = seen_at(ends, weights, drawn.window, taken) else { continue };
            if !is_in_window(place) {
                continue;
            }
            let [x, y, ..] = place;
            // A triangle without an area has no fragments, and one that begins here has no neighbours before the eye.
            let beside = [[x, y], [x + 1.0, y], [x, y + 1.0]].map(|at| weights_at(ends, at, drawn.window));
            let [Some(_), Some(right), Some(above)] = beside else { continue };
            let weights_beside = [right, above];
            let is_left_out = matches!((cull, is_front), (Cull::Back, false) | (Cull::Front, true));
            if is_left_out || (taken != FragmentChoice::AnySide && cull == Cull::None && !is_front) {
                continue;
            }
            shares.push((number, [weights, weights_beside[0], weights_beside[1]]));
            let (varyings, varyings_beside) = Default::default();
            spots.push(Spot {
                corners,
                weights,
                weights_beside,
                place,
                window: drawn.window,
                is_front,
                varyings,
                varyings_beside,
                position: ends[0],
                is_known: true,
            });
        }
        let mut handed = [0, 1, 2].map(|pixel| {
            let shares: Vec<_> = shares.iter().map(|(number, weights)| (*number, weights[pixel])).collect();
            mixed(pipeline, &written, &positions, &shares)
        });
        let numbers = handed.iter_mut().flatten().flatten().flatten();
        numbers.for_each(|number| *number = f64::from(*number as f32));
        for (at, spot) in spots.iter_mut().enumerate() {
            let [here, right, above] = &handed;
            let values = |handed: &FragmentInputs| -> Vec<(String, Value)> {
                let value = |(output, columns): (&crate::interpreter::ProgramVariable, &Vec<Vec<f64>>)| {
                    let numbers = columns.iter().map(|column| column[at]).collect();
                    Some((output.name.clone(), Value::new(output.kind.clone(), numbers)?))
                };
                pipeline.vertex.outputs().iter().zip(handed).filter_map(value).collect()
            };
            (spot.varyings, spot.varyings_beside) = (values(here), [values(right), values(above)]);
        }
        Some(LocatedSpots { spots, handed })
    }
}
