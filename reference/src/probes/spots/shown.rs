//! What a program shows at fragments, and whether it stays when what it reads is moved a little.

use super::Spot;
use super::handed::{HandedAround, handed_at, known};
use crate::equation::DISCARDED;
use crate::interpreter::{Scalar, WindowCoordinates};
use crate::pipeline::{Pipeline, UniformsOf, scalars, slices};
use crate::probes::{Probe, ProbeSet};
use crate::scene::Vertex;
use crate::{Assignment, Value};
use glam::{DVec3, DVec4};

/// What a program reads is moved by so much, relative to it where it is more than 1. Noise: 1e-6, some operations in f32 in the
/// stage before.
const MOVED: f64 = 1e-5;

/// The pixels beside are moved by so much less, in some of the ways, so that what depends on the last bits of a derivative is seen. Noise:
/// 1e-7, the rounding of what is interpolated; a pixel is some hundredths wide.
const MOVED_APART: f64 = 1e-6;

/// A colour that changes by more than this when what it is computed from is moved is not probed: a tenth of the tolerance
/// with which probes are judged is 2e-4, and a power of 200 of a cosine changes by 2e-3.
const SUDDEN: f64 = 2e-3;

/// A run of the fragment stage at a spot.
#[derive(Clone, Copy)]
struct Lane {
    spot: usize,
    /// Which way what it reads is moved; 0 is not at all.
    way: usize,
    /// By how many pixels it lies beside, within 2 × 2 pixels.
    beside: [f64; 2],
}

impl Lane {
    /// The scalar with this number, moved.
    fn moved(self, value: f64, number: usize) -> f64 {
        let bit = |bit: usize| if number >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let direction = match self.way {
            0 => return value,
            1 => bit(0),
            2 => -bit(0),
            3 => bit(1),
            _ => -bit(1),
        };
        let apart = if self.way > 2 && self.beside != [0.0, 0.0] { MOVED_APART } else { 0.0 };
        value + direction * (MOVED - apart) * value.abs().max(1.0)
    }
}

/// The ways in which what is read is moved.
pub(super) const WAYS: usize = 5;

/// 2 × 2 pixels, as the interpreter takes them.
const QUAD: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

/// What a program shows at a probe.
#[derive(Clone, Copy, Debug)]
pub struct ProbeOutput {
    /// The colour, clamped; [`DISCARDED`] where the fragment is thrown away, no number where it is undefined.
    pub colour: DVec3,
    /// The position of the first corner in clip space; the origin's where no vertex stage is handed in.
    pub position: DVec4,
    /// Whether the colour stays when what it is computed from is moved a little.
    pub is_steady: bool,
}

impl Assignment {
    /// The colours of fragments, each with its uniforms, and whether each is a number that stays when what it is computed from is moved
    /// a little, in so many ways.
    pub(super) fn colours(
        &self,
        pipeline: &Pipeline,
        uniforms: UniformsOf<'_>,
        spots: &[&Spot],
        handed: &HandedAround,
        ways: usize,
    ) -> Option<Vec<(DVec3, bool)>> {
        let lane = |spot, way, beside| Lane { spot, way, beside };
        let in_quads = pipeline.needs_quads(&self.textures);
        let of_spot = |spot: usize| -> Vec<Lane> {
            let ways = 0..ways;
            match in_quads {
                false => ways.map(|way| lane(spot, way, [0.0, 0.0])).collect(),
                // A pixel is one of four. It is the first of them for all that draw it, so that its differences to the others are the same.
                true => ways.flat_map(|way| QUAD.map(|beside| lane(spot, way, beside))).collect(),
            }
        };
        let lanes: Vec<Lane> = (0..spots.len()).flat_map(of_spot).collect();
        let own: Vec<&[Value]> = match uniforms {
            UniformsOf::All(_) => Vec::new(),
            UniformsOf::Each(own) => lanes.iter().map(|lane| own[lane.spot]).collect(),
        };
        let uniforms = if own.is_empty() { uniforms } else { UniformsOf::Each(&own) };
        let colours = self.run_lanes(pipeline, uniforms, spots, handed, &lanes)?;
        let each = (lanes.len() / spots.len().max(1)).max(1);
        let of_lanes = |(own, lanes): (&[DVec3], &[Lane])| {
            let at_spot = lanes.iter().zip(own).filter(|(lane, _)| lane.beside == [0.0, 0.0]);
            let first = own[0];
            let stays = |(_, colour): (&Lane, &DVec3)| (*colour - first).abs().max_element() <= SUDDEN;
            (first, first.is_finite() && at_spot.into_iter().all(stays))
        };
        Some(colours.chunks(each).zip(lanes.chunks(each)).map(of_lanes).collect())
    }

    /// Runs the fragment stage. What is thrown away has the colour [`DISCARDED`], what is undefined is no number.
    fn run_lanes(
        &self,
        pipeline: &Pipeline,
        uniforms: UniformsOf<'_>,
        spots: &[&Spot],
        handed: &HandedAround,
        lanes: &[Lane],
    ) -> Option<Vec<DVec3>> {
        let program = &pipeline.fragment;
        let column = |of: &dyn Fn(&Lane) -> f64| lanes.iter().map(of).collect::<Vec<f64>>();
        let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
        for (place, input) in program.inputs().iter().enumerate() {
            let columns = match input.name.as_str() {
                name if let Some(window) = WindowCoordinates::of(name) => (0..4)
                    .map(|axis| {
                        column(&|lane| {
                            let Spot { place, window: [_, rows], .. } = spots[lane.spot];
                            let at = place[axis];
                            let there =
                                at + lane.beside.get(axis).copied().unwrap_or_else(|| lane.moved(at, axis) - at);
                            window.along(axis, there, *rows)
                        })
                    })
                    .collect(),
                "gl_FrontFacing" => vec![column(&|lane| f64::from(u8::from(spots[lane.spot].is_front)))],
                _ => {
                    let Some(varying) = pipeline.varyings.iter().find(|varying| varying.input == place) else {
                        continue;
                    };
                    let is_real = matches!(input.kind.scalar(), Some(Scalar::Float | Scalar::Double) | None);
                    let columns = varying.scalars.clone().enumerate();
                    columns
                        .map(|(scalar, number)| {
                            let here = &handed[0][varying.output][scalar];
                            let beside = |pixel: usize| {
                                handed[pixel].get(varying.output).map_or(here, |columns| &columns[scalar])
                            };
                            let [right, above] = [1, 2].map(beside);
                            column(&|lane| {
                                let spot = lane.spot;
                                let beside = [right[spot], above[spot]];
                                match is_real {
                                    true => lane.moved(pipeline.at_pixel(here[spot], beside, lane.beside), number),
                                    false => here[spot],
                                }
                            })
                        })
                        .collect()
                }
            };
            given.push((&input.name, columns));
        }
        let given: Vec<(&str, Vec<&[f64]>)> = given.iter().map(|(name, columns)| (*name, slices(columns))).collect();
        let mut run = self.fed(program, lanes.len(), uniforms)?;
        for (name, columns) in &given {
            run = run.input(name, columns).ok()?;
        }
        let outputs = run.outputs().ok()?;
        let columns = scalars(&outputs, pipeline.colour);
        let colour = |at: usize| match outputs.discarded[at] {
            true => DISCARDED,
            false => {
                let channel = |channel: usize| columns.get(channel).map_or(0.0, |column| column[at].clamp(0.0, 1.0));
                DVec3::new(channel(0), channel(1), channel(2))
            }
        };
        Some((0..lanes.len()).map(colour).collect())
    }

    /// What another program shows at each probe, and whether that is steady; `None` where it cannot be run.
    pub fn shown_at(&self, pipeline: &Pipeline, probes: &ProbeSet) -> Option<Vec<ProbeOutput>> {
        self.shown(pipeline, probes, WAYS)
    }

    /// The same where nobody asks whether it is steady.
    pub(crate) fn shown_once(&self, pipeline: &Pipeline, probes: &ProbeSet) -> Option<Vec<ProbeOutput>> {
        self.shown(pipeline, probes, 1)
    }

    /// What a program shows at probes with the same uniforms.
    pub(crate) fn shown_of_group(
        &self,
        pipeline: &Pipeline,
        uniforms: &[Value],
        probes: &[Probe],
    ) -> Option<Vec<ProbeOutput>> {
        self.shown_in(pipeline, [UniformsOf::All(uniforms); 2], probes, 1)
    }

    /// All groups run at once: to begin a run costs as much as some dozens of probes.
    fn shown(&self, pipeline: &Pipeline, probes: &ProbeSet, ways: usize) -> Option<Vec<ProbeOutput>> {
        let of_spots: Vec<&[Value]> =
            probes.iter().filter(|probe| probe.spot.is_some()).map(|probe| probes.uniforms(probe)).collect();
        let of_corners: Vec<&[Value]> = of_spots.iter().flat_map(|own| [*own; 3]).collect();
        let uniforms = [UniformsOf::Each(&of_corners), UniformsOf::Each(&of_spots)];
        self.shown_in(pipeline, uniforms, &probes.probes, ways)
    }

    /// The uniforms are those of the corners, and of the fragments.
    fn shown_in(
        &self,
        pipeline: &Pipeline,
        [of_corners, of_spots]: [UniformsOf<'_>; 2],
        probes: &[Probe],
        ways: usize,
    ) -> Option<Vec<ProbeOutput>> {
        let spots: Vec<&Spot> = probes.iter().filter_map(|probe| probe.spot.as_deref()).collect();
        let is_known = pipeline.hands_over_as(&self.pipeline) && spots.iter().all(|spot| spot.is_known);
        let (positions, handed): (Vec<DVec4>, _) = if is_known {
            (spots.iter().map(|spot| spot.position).collect(), known(pipeline, &spots))
        } else {
            let vertices: Vec<Vertex> = spots.iter().flat_map(|spot| spot.corners).collect();
            let (corners, written) = self.handed_by(&pipeline.vertex, of_corners, &vertices)?;
            let handed = handed_at(pipeline, &written, &corners, &spots, pipeline.has_derivatives());
            (corners.into_iter().step_by(3).collect(), handed)
        };
        let colours = self.colours(pipeline, of_spots, &spots, &handed, ways)?;
        let shown = |(position, (colour, is_steady))| ProbeOutput {
            colour,
            position: self.equation.position.map_or(DVec4::W, |_| position),
            is_steady,
        };
        Some(positions.into_iter().zip(colours).map(shown).collect())
    }
}
