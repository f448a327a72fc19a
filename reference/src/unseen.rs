//! Parts of a solution that show nowhere: an answer without one of them is taken for right.

use crate::accepted::{AcceptedAnswer, Computed};
use crate::assignment::Feed;
use crate::fit::{TOLERANCE, agrees};
use crate::interpreter::{ChangedPart, Scalar, Stage, Type, program_without_parts};
use crate::probes::ProbeSet;
use crate::rasteriser::Frame;
use crate::value::rounded;
use crate::{Assignment, Value};

/// What may show it is looked for at the probes of so many cameras.
const GROUPS: usize = 10;

/// A uniform is tried at its value times so much.
const FACTORS: [f64; 9] = [0.0, 0.1, 0.3, 0.6, 2.0, 4.0, 10.0, -1.0, -4.0];

/// A whole number is tried from 0 to this.
const MOST_WHOLE: u8 = 8;

/// A part without which the solution shows the same at all probes.
#[derive(Clone, Debug)]
pub struct UnseenPart {
    /// The file of the solution.
    pub file: String,
    /// The part.
    pub part: ChangedPart,
    without: AcceptedAnswer,
}

/// A value of a uniform with which a part shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Revealing {
    /// The uniform's path.
    pub uniform: String,
    /// Such a value.
    pub value: Value,
}

impl Assignment {
    /// The parts of the solution that show at none of these probes, line by line; none of them is within another.
    pub fn unseen_parts(&self, probes: &ProbeSet) -> Vec<UnseenPart> {
        let (places, few) = probes.part(1);
        let right = |place: usize| (probes.probes[place].colour, probes.probes[place].position);
        let mut unseen: Vec<UnseenPart> = Vec::new();
        for file in &self.files {
            let slips = program_without_parts(&file.solution.text, file.stage).unwrap_or_default();
            // Nothing in place of nothing is no change.
            let is_zero = |text: &str| text.trim().parse() == Ok(0.0);
            for slip in slips.into_iter().filter(|slip| !is_zero(&slip.part.own)) {
                let Some(without) = self.linked_with(file, slip.program, &slip.text) else { continue };
                let is_same = |places: &mut dyn Iterator<Item = usize>, shown: &[Computed]| {
                    places.zip(shown).all(|(place, shown)| same(&right(place), shown))
                };
                if is_same(&mut places.iter().copied(), &self.computed_by(&without, &few))
                    && is_same(&mut (0..probes.probes.len()), &self.computed_by(&without, probes))
                {
                    unseen.push(UnseenPart { file: file.solution.name.clone(), part: slip.part, without });
                }
            }
        }
        widest(unseen)
    }

    /// The uniforms of the handed-in stages whose value stays, and with other values of which the solution shows the same at all probes.
    pub fn idle_uniforms(&self, probes: &ProbeSet) -> Vec<&str> {
        let (_, few) = probes.part(GROUPS);
        let solution = self.own_answer();
        let right = self.computed_by(&solution, &few);
        let is_handed_in = |path: &str| {
            self.files.iter().filter(|file| file.program.is_none()).any(|file| {
                let program = match file.stage {
                    Stage::Vertex => &self.pipeline.vertex,
                    Stage::Fragment => &self.pipeline.fragment,
                };
                program.uniforms().iter().any(|own| own.name == path)
            })
        };
        let is_idle = |place: usize, kind: &Type| {
            let ways = ways(kind);
            let is_same = |way: &UniformChange| {
                let shown = self.computed_by(&solution, &with_uniform(&few, place, way));
                right.iter().zip(&shown).all(|(right, shown)| same(right, shown))
            };
            !ways.is_empty() && ways.iter().all(is_same)
        };
        let uniforms = self.interface.uniforms.iter().enumerate();
        let constant = uniforms.filter(|(_, uniform)| matches!(uniform.feed, Feed::Constant(_)));
        let idle = constant.filter(|(place, uniform)| is_handed_in(&uniform.path) && is_idle(*place, &uniform.kind));
        idle.map(|(_, uniform)| uniform.path.as_str()).collect()
    }

    /// Whether a part shows in one of the right pictures. `differs` says whether two pictures do.
    pub fn is_pictured(&self, unseen: &UnseenPart, right: &[Frame], differs: &dyn Fn(&Frame, &Frame) -> bool) -> bool {
        let poses = self.scene.all_poses();
        poses.iter().zip(right).any(|(pose, right)| differs(&self.drawn_by(&unseen.without, pose), right))
    }

    /// The uniform that shows each of some parts when it has another value, and such a value: the nearest of the first one.
    pub fn revealing(&self, parts: &[&UnseenPart], probes: &ProbeSet) -> Vec<Option<Revealing>> {
        let (_, few) = probes.part(GROUPS);
        let solution = self.own_answer();
        let mut found: Vec<Option<Revealing>> = vec![None; parts.len()];
        for (place, uniform) in self.interface.uniforms.iter().enumerate() {
            if !matches!(uniform.feed, Feed::Constant(_)) {
                continue;
            }
            for way in ways(&uniform.kind) {
                let other = with_uniform(&few, place, &way);
                let right = self.computed_by(&solution, &other);
                let is_defined = right.iter().all(|(colour, position)| colour.is_finite() && position.is_finite());
                if !is_defined {
                    continue;
                }
                for (unseen, found) in parts.iter().zip(&mut found).filter(|(_, found)| found.is_none()) {
                    let without = self.computed_by(&unseen.without, &other);
                    let shows = right.iter().zip(&without).position(|(right, without)| !same(right, without));
                    let value = |at: usize| other.groups[other.probes[at].group].uniforms[place].clone();
                    *found = shows.map(|at| Revealing { uniform: uniform.path.clone(), value: value(at) });
                }
            }
        }
        found
    }

    /// The solution as an answer.
    fn own_answer(&self) -> AcceptedAnswer {
        AcceptedAnswer::new("", self.pipeline.clone())
    }
}

/// The same probes with another value of the uniform at this place.
fn with_uniform(probes: &ProbeSet, place: usize, way: &UniformChange) -> ProbeSet {
    probes.with_uniforms(|group| group.uniforms[place] = way(&group.uniforms[place]))
}

/// How a value is changed.
type UniformChange = Box<dyn Fn(&Value) -> Value>;

/// The other values that a uniform of this type is tried with.
fn ways(kind: &Type) -> Vec<UniformChange> {
    let count = kind.slots().unwrap_or(0);
    match kind {
        Type::Vector(Scalar::Float, _) => {
            // The fourth of four numbers is often another thing than the others.
            let ranges = std::iter::once(0..count).chain((count == 4).then_some(3..4));
            let all = FACTORS.into_iter().flat_map(|factor| ranges.clone().map(move |scaled| (factor, scaled)));
            let way = |(factor, scaled): (f64, std::ops::Range<usize>)| -> UniformChange {
                let by: Vec<f64> = (0..count).map(|at| if scaled.contains(&at) { factor } else { 1.0 }).collect();
                Box::new(move |value| rounded(value.scaled(&by)))
            };
            all.map(way).collect()
        }
        Type::Vector(scalar @ (Scalar::Int | Scalar::Uint | Scalar::Bool), _) => {
            let most = if *scalar == Scalar::Bool { 1 } else { MOST_WHOLE };
            let way = |number: u8| -> UniformChange {
                Box::new(move |value| Value::of(value.kind().clone(), vec![f64::from(number); count]))
            };
            (0..=most).map(way).collect()
        }
        _ => Vec::new(),
    }
}

fn same(right: &Computed, other: &Computed) -> bool {
    let far = right.1.abs().max_element().max(1.0);
    agrees(right.0, other.0, TOLERANCE) && (right.1 - other.1).abs().max_element() <= TOLERANCE * far
}

/// Those that are not within another, in the order of the text.
fn widest(mut unseen: Vec<UnseenPart>) -> Vec<UnseenPart> {
    let length = |own: &UnseenPart| (own.part.lines.1 - own.part.lines.0, own.part.own.len());
    unseen.sort_by_key(|own| std::cmp::Reverse(length(own)));
    let mut kept: Vec<UnseenPart> = Vec::new();
    for own in unseen {
        let (first, last) = own.part.lines;
        let is_within =
            |other: &UnseenPart| other.file == own.file && other.part.lines.0 <= first && last <= other.part.lines.1;
        if !kept.iter().any(is_within) {
            kept.push(own);
        }
    }
    kept.sort_by(|a, b| (&a.file, a.part.lines).cmp(&(&b.file, b.part.lines)));
    kept
}
