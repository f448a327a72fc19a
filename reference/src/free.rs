//! Uniforms that students add and name: what they are is found by their types, and by what the answer shows with them.
//!
//! A program that a student extends is fed by a host program of which nothing is handed in. So each new uniform is tried as all that the
//! homework says it may be. The first way in which the answer shows what is right is taken, or else the way in which it computes most of
//! it.

mod explained;
mod progress;

use crate::assignment::Uniform;
use crate::feed::Feed;
use crate::interpreter::{Program, ProgramVariable, Stage, Type};
use crate::pipeline::Pipeline;
use crate::probes::{Probe, ProbeGroup, ProbeOutput, ProbeSet};
use crate::scene::Moment;
use crate::{Assignment, Text, Value};
use std::sync::Arc;

/// What a uniform may be that a student adds.
#[derive(Clone, Debug)]
pub struct Free {
    /// Its id in reports.
    pub id: String,
    /// Its type.
    pub kind: Type,
    /// Where its value comes from.
    pub feed: Feed,
    /// What is said of an answer in which a uniform is this.
    pub note: Option<Text>,
}

/// A uniform of a student's program, and what it is taken for.
#[derive(Clone, Debug)]
pub struct RecognisedUniform<'a> {
    /// Its name in the student's files.
    pub name: String,
    /// What it is.
    pub as_what: &'a Free,
}

/// More ways than this are not tried: four matrices that may each be one of eleven make 14,641, which take some 0.1 s.
const MOST_WAYS: usize = 15_000;

/// So many are tried at more than one probe of a camera.
const MOST_LIKELY: usize = 600;

/// So many ways and probes are run at once: a run costs as much as some dozens of probes, and each of them takes memory.
const LANES: usize = 4096;

/// So many cameras are tried first.
const FEW_GROUPS: usize = 2;

/// A colour this near to the right one is right, as probes are judged.
const TOLERANCE: f64 = 2e-3;

/// So many probes of a camera are looked at, one number after the other, as long as too many ways are left.
const PROBES: [usize; 4] = [1, 2, 4, 8];

/// The ways that are right most often, in their order. `right`: how often each of some is right at so many probes of each camera.
fn likely(ways: usize, right: &dyn Fn(&[usize], usize) -> Vec<usize>) -> Vec<usize> {
    let mut left: Vec<usize> = (0..ways).collect();
    for each in PROBES {
        if left.len() <= MOST_LIKELY {
            break;
        }
        let some = left.chunks(LANES / (FEW_GROUPS * each));
        let counts: Vec<usize> = some.flat_map(|numbers| right(numbers, each)).collect();
        let mut sorted = counts.clone();
        sorted.sort_unstable_by_key(|count| std::cmp::Reverse(*count));
        // Ways that are right as often as the last one of these are not told apart yet.
        let least = sorted[MOST_LIKELY - 1];
        left = left.into_iter().zip(counts).filter(|(_, count)| *count >= least).map(|(way, _)| way).collect();
    }
    left.truncate(MOST_LIKELY);
    left
}

impl Assignment {
    /// What the uniforms of a student's program are that the homework does not know; none where it is not known what its texts do.
    /// `probes` decide where there are several ways.
    pub fn taken(&self, texts: &[(Stage, &str)], probes: &ProbeSet) -> Vec<RecognisedUniform<'_>> {
        let [mut vertex, mut fragment] = [&self.pipeline.vertex, &self.pipeline.fragment].map(Arc::clone);
        for (stage, text) in texts {
            let Ok(program) = Program::compile(text, *stage) else { return Vec::new() };
            let own = match stage {
                Stage::Vertex => &mut vertex,
                Stage::Fragment => &mut fragment,
            };
            *own = Arc::new(program);
        }
        let mut added: Vec<&ProgramVariable> = Vec::new();
        for uniform in vertex.uniforms().iter().chain(fragment.uniforms()) {
            let is_known = self.interface.uniforms.iter().any(|own| own.is(uniform) && own.kind == uniform.kind)
                || added.iter().any(|known| known.name == uniform.name);
            if !is_known && self.free.iter().any(|free| free.kind == uniform.kind) {
                added.push(uniform);
            }
        }
        let may_be: Vec<Vec<&Free>> =
            added.iter().map(|own| self.free.iter().filter(|free| free.kind == own.kind).collect()).collect();
        let ways = may_be.iter().map(Vec::len).try_fold(1, |ways: usize, of_one| ways.checked_mul(of_one));
        let way = |mut number: usize| {
            let mut taken = Vec::new();
            for (own, may_be) in added.iter().zip(&may_be) {
                taken.push(RecognisedUniform { name: own.name.clone(), as_what: may_be[number % may_be.len()] });
                number /= may_be.len();
            }
            taken
        };
        let linked = Pipeline::link(&vertex, &fragment, None).ok();
        let (Some(ways @ 2..=MOST_WAYS), Some(pipeline)) = (ways, linked) else { return way(0) };
        let extended = self.with(&way(0));
        // The probes with what the uniforms are in some ways.
        let given = |numbers: &[usize], probes: &ProbeSet| {
            let values: Vec<Vec<Value>> = probes.groups.iter().map(|group| extended.added_values(group)).collect();
            ProbeSet::joined(numbers.iter().map(|number| {
                let mut theirs = probes.clone();
                for (group, values) in theirs.groups.iter_mut().zip(&values) {
                    group.uniforms.extend(way(*number).iter().map(|taken| values[self.place(taken.as_what)].clone()));
                }
                theirs
            }))
        };
        let shown = |numbers: &[usize], probes: &ProbeSet| {
            extended.shown_once(&pipeline, &given(numbers, probes)).unwrap_or_default()
        };
        let right = |numbers: &[usize], probes: &ProbeSet| {
            let shown = shown(numbers, probes);
            let is_right = |(probe, shown): &(&Probe, &ProbeOutput)| {
                (probe.colour - shown.colour).abs().max_element() <= TOLERANCE
            };
            let own = shown.chunks(probes.probes.len().max(1));
            let mut counts: Vec<usize> = own.map(|own| probes.iter().zip(own).filter(is_right).count()).collect();
            counts.resize(numbers.len(), 0);
            counts
        };
        // What does not fit at a few probes need not be run at all of them.
        let (_, few) = probes.part(FEW_GROUPS);
        let likely = likely(ways, &|numbers, each| right(numbers, &few.thinned(each)));
        let mut counts = Vec::with_capacity(likely.len());
        for numbers in likely.chunks(LANES / few.probes.len().max(1)) {
            for (count, number) in right(numbers, &few).into_iter().zip(numbers) {
                if count == few.probes.len() && right(&[*number], probes)[0] == probes.probes.len() {
                    return way(*number);
                }
                counts.push(count);
            }
        }
        // Of one uniform alone it is taken that it is what the homework expects, where the text says nothing else: what else is wrong is
        // known by that.
        let is_alone = may_be.iter().filter(|may_be| may_be.len() > 1).count() < 2;
        let progress = self.progress(&extended, texts, &few, &likely, &given);
        let kept = |at: &usize| (progress[*at], if is_alone { 0 } else { counts[*at] }, std::cmp::Reverse(*at));
        let mut ranked: Vec<usize> = (0..likely.len()).collect();
        ranked.sort_by_key(|at| std::cmp::Reverse(kept(at)));
        let ranked: Vec<usize> = ranked.into_iter().map(|at| likely[at]).collect();
        // One mistake says more of what is wrong than two, or than none that is known.
        let explained = self.explained(&ranked, &few, &|number| shown(&[number], &few));
        way(explained.or(ranked.first().copied()).unwrap_or(0))
    }

    /// The homework, which sets these uniforms as well. Two may have one name, and different types.
    pub fn with(&self, taken: &[RecognisedUniform<'_>]) -> Self {
        let mut other = self.clone();
        other.interface.uniforms.extend(taken.iter().map(|taken| Uniform {
            path: taken.name.clone(),
            kind: taken.as_what.kind.clone(),
            feed: taken.as_what.feed.clone(),
            probe: None,
            place: None,
        }));
        other
    }

    /// Probes with what so many of the last uniforms are there, which the homework of the probes does not set.
    pub fn probes_with(&self, probes: &ProbeSet, count: usize) -> ProbeSet {
        let mut theirs = probes.clone();
        for group in &mut theirs.groups {
            let moment = self.moment_of(group);
            let added = &self.interface.uniforms[self.interface.uniforms.len() - count..];
            group.uniforms.extend(added.iter().map(|uniform| uniform.value(&moment)));
        }
        theirs
    }

    /// What everything that a uniform may be is under a camera.
    fn added_values(&self, group: &ProbeGroup) -> Vec<Value> {
        let moment = self.moment_of(group);
        let none = |free: &Free| Value::of(free.kind.clone(), vec![f64::NAN; free.kind.slots().unwrap_or(0)]);
        let value = |free: &Free| free.feed.value(&free.kind, &moment).unwrap_or_else(|| none(free));
        self.free.iter().map(value).collect()
    }

    fn place(&self, free: &Free) -> usize {
        self.free.iter().position(|own| std::ptr::eq(own, free)).unwrap_or_default()
    }

    pub(crate) fn moment_of(&self, group: &ProbeGroup) -> Moment {
        Moment { pass: group.pass, resolution: group.window, ..self.scene.moment(group.t, group.matrices) }
    }
}
