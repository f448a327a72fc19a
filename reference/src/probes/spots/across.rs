//! Rows of fragments across edges, in equal steps: what a right answer may show there in many ways is judged by its course.

use super::{FragmentCandidate, FragmentChoice, Spot};
use crate::Assignment;
use crate::pipeline::UniformsOf;
use crate::probes::{Probe, ProbeGroup, ProbeSet, Random};
use crate::scene::Vertex;
use glam::{DVec3, DVec4, Vec4Swizzles};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::ops::Range;

/// The seed of the rows; another stream than those of other probes.
const SEED: u64 = 1;
const STREAM: u64 = 2;

/// So many cameras have so many rows of so many steps.
const CAMERAS: usize = 4;
const ROWS: usize = 4;
const STEPS: usize = 32;

/// So many rows are drawn for a camera, and so many cameras, before there are no more edges.
const TRIES: usize = 60;
const MOST_CAMERAS: usize = 60;

/// How far a row goes over the map of a pass, whose squares are 1/32 wide (see `assignment/check/passes.rs`): over one edge for sure. A
/// step is 0.9 texels of 800.
const LENGTH: f64 = 1.15 / 32.0;

/// Two colours that differ by this are on two sides of an edge: fifty times what is tolerated of a probe.
const DIFFERS: f64 = 0.1;

/// What lies between two colours lies at a share of the way that is this far from both ends: the light itself changes a little over a
/// row. Defect to catch: one comparison has no such share at any edge. Margin: one of nine comparisons is 0.11.
const BETWEEN: f64 = 0.08;

/// A course that falls by so much of the way is uneven. Noise: comparisons at places that are turned at random from pixel to pixel stray
/// on their way. Defect to catch: light and shadow take turns, which is all of the way.
const FALLS: f64 = 0.6;

/// Less than one of so many edges does not count.
const FEW: usize = 4;

/// Rows of probes across edges of what a pass draws.
#[derive(Clone, Debug)]
pub struct Crossings {
    /// The probes.
    pub probes: ProbeSet,
    /// The places of each crossing among them: the first and the last are judged in themselves and differ, those between are not.
    edges: Vec<Range<usize>>,
}

/// What is wrong with the way of an answer over edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeDefect {
    /// It shows the one or the other, and nothing between.
    Abrupt,
    /// It goes back on its way.
    Uneven,
}

impl Crossings {
    /// The same with more that each probe is given.
    #[must_use]
    pub fn given(&self, probes: ProbeSet) -> Self {
        Self { probes, edges: self.edges.clone() }
    }

    /// How an answer goes over the edges, where something is wrong with that; `None` where it shows no difference there either.
    pub fn course(&self, colours: &[[f64; 3]]) -> Option<EdgeDefect> {
        let ways: Vec<Vec<f64>> = self.edges.iter().filter_map(|edge| way(colours.get(edge.clone())?)).collect();
        let few = |count: usize| count * FEW < ways.len();
        let gradual =
            ways.iter().filter(|way| way.iter().any(|share| (BETWEEN..1.0 - BETWEEN).contains(share))).count();
        let uneven = ways.iter().filter(|way| is_uneven(way)).count();
        match () {
            () if ways.is_empty() => None,
            () if few(gradual) => Some(EdgeDefect::Abrupt),
            () => (!few(uneven)).then_some(EdgeDefect::Uneven),
        }
    }
}

/// The colours of a crossing as shares of the way from the first to the last; none where these are alike.
fn way(colours: &[[f64; 3]]) -> Option<Vec<f64>> {
    let (first, last) = (DVec3::from(*colours.first()?), DVec3::from(*colours.last()?));
    let whole = last - first;
    let share = |colour: &[f64; 3]| (DVec3::from(*colour) - first).dot(whole) / whole.length_squared();
    (whole.abs().max_element() > DIFFERS / 2.0).then(|| colours.iter().map(share).collect())
}

fn is_uneven(way: &[f64]) -> bool {
    let mut most = 0.0_f64;
    way.iter().any(|share| {
        most = most.max(*share);
        most - share > FALLS
    })
}

impl Assignment {
    /// Rows across edges of what the pass draws; `None` where there is no pass, or no edge.
    pub fn crossings(&self) -> Option<Crossings> {
        self.gradual.as_ref()?;
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        random.set_stream(STREAM);
        let mut random = Random(random);
        let mut all = Crossings {
            probes: ProbeSet { seed: SEED, groups: Vec::new(), probes: Vec::new(), twins: 0 },
            edges: Vec::new(),
        };
        for _ in 0..MOST_CAMERAS {
            let number = all.probes.groups.len();
            if number == CAMERAS {
                break;
            }
            let drawn = self.group(&mut random);
            let rows = (0..TRIES).filter_map(|_| self.row(&mut random, number, &drawn));
            let rows: Vec<_> = rows.take(ROWS).collect();
            // Each camera has as many.
            if rows.len() < ROWS {
                continue;
            }
            all.probes.groups.push(drawn);
            for (probes, edges) in rows {
                let first = all.probes.probes.len();
                all.edges.extend(edges.into_iter().map(|edge| first + edge.start..first + edge.end));
                all.probes.probes.extend(probes);
            }
        }
        (!all.edges.is_empty()).then_some(all)
    }

    /// A row, and the places in it of its crossings; `None` without one.
    fn row(&self, random: &mut Random, group: usize, drawn: &ProbeGroup) -> Option<(Vec<Probe>, Vec<Range<usize>>)> {
        let (corners, weights, cull) = self.triangle(random);
        let place: DVec4 = corners.iter().zip(weights).map(|(corner, weight)| corner.position * weight).sum();
        let [view, projection] = drawn.pass;
        let to_pass = view * drawn.matrices.model;
        let axis = usize::from(random.between(0.0, 1.0) < 0.5);
        // What is moved across the view keeps its depth, and a step is the same everywhere.
        let w = (projection * to_pass * place).w;
        let whole = 2.0 * w * LENGTH / projection.col(axis)[axis];
        let across = to_pass.inverse().transform_vector3(DVec3::AXES[axis] * whole);
        let candidate = |step: usize| -> FragmentCandidate {
            let by = across * (step as f64 / (STEPS - 1) as f64 - 0.5);
            (corners.map(|corner| moved(corner, by)), weights, cull)
        };
        let located = self.located(drawn, (0..STEPS).map(candidate).collect(), FragmentChoice::FrontInPlace)?;
        if located.spots.len() < STEPS {
            return None;
        }
        let spots: Vec<&Spot> = located.spots.iter().collect();
        let uniforms = UniformsOf::All(&drawn.uniforms);
        let colours = self.colours(&self.pipeline, uniforms, &spots, &located.handed, 1)?;
        let probes = self.shown_in_place(group, drawn, located, colours.into_iter().map(|(colour, _)| colour));
        let is_judged = self.are_judged(&drawn.uniforms, &probes);
        let judged: Vec<usize> = (0..STEPS).filter(|step| is_judged[*step]).collect();
        let differ = |a: usize, b: usize| (probes[a].colour - probes[b].colour).abs().max_element() > DIFFERS;
        let edges: Vec<Range<usize>> = judged
            .windows(2)
            .filter(|pair| pair[1] > pair[0] + 1 && differ(pair[0], pair[1]))
            .map(|pair| pair[0]..pair[1] + 1)
            .collect();
        (!edges.is_empty()).then_some((probes, edges))
    }
}

/// The vertex at another place, exact in f32.
fn moved(vertex: Vertex, by: DVec3) -> Vertex {
    let position = vertex.position.xyz() + by;
    let moved = Vertex::new(position, vertex.normal.truncate())
        .textured(vertex.texture_coordinates)
        .along(vertex.tangent.truncate(), vertex.tangent.w);
    moved.numbered_as(&vertex)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossings(edges: Vec<Range<usize>>) -> Crossings {
        Crossings { probes: ProbeSet { seed: 0, groups: Vec::new(), probes: Vec::new(), twins: 0 }, edges }
    }

    /// Greys of some shares of the way from 0.2 to 0.8.
    fn greys(shares: &[f64]) -> Vec<[f64; 3]> {
        shares.iter().map(|share| [0.2 + 0.6 * share; 3]).collect()
    }

    #[test]
    fn a_step_is_abrupt_and_a_way_back_uneven() {
        let row = crossings(std::iter::once(0..6).collect());
        assert_eq!(row.course(&greys(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0])), Some(EdgeDefect::Abrupt));
        assert_eq!(row.course(&greys(&[0.0, 0.0, 0.5, 1.0, 1.0, 1.0])), None);
        assert_eq!(row.course(&greys(&[0.0, 0.25, 0.5, 0.25, 0.75, 1.0])), None);
        assert_eq!(row.course(&greys(&[0.0, 0.5, 1.0, 0.0, 0.5, 1.0])), Some(EdgeDefect::Uneven));
        // Where nothing differs nothing can be said.
        assert_eq!(row.course(&greys(&[1.0; 6])), None);
    }

    #[test]
    fn one_edge_of_many_says_nothing() {
        let rows = crossings(vec![0..3, 3..6, 6..9]);
        let mut shares = vec![0.0, 0.5, 1.0, 0.0, 0.5, 1.0, 0.0, 1.0, 1.0];
        assert_eq!(rows.course(&greys(&shares)), None);
        (shares[1], shares[4]) = (1.0, 1.0);
        assert_eq!(rows.course(&greys(&shares)), Some(EdgeDefect::Abrupt));
    }
}
