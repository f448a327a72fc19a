//! Uniforms that students add and name: what they are is found by their types, and by what the answer shows with them.
//!
//! A program that a student extends is fed by a host program of which nothing is handed in. So each new uniform is tried as all that the
//! homework says it may be. The first way in which the answer shows what is right is taken, or else the way in which it shows most of it.

use crate::assignment::Uniform;
use crate::feed::Feed;
use crate::interpreter::{Program, ProgramVariable, Type};
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

/// More ways than this are not tried: three matrices that may each be one of eight make 512, and a run of a few probes takes 1 ms.
const MOST_WAYS: usize = 600;

/// So many cameras are tried first.
const FEW_GROUPS: usize = 2;

/// A colour this near to the right one is right, as probes are judged.
const TOLERANCE: f64 = 2e-3;

impl Assignment {
    /// What the uniforms of a student's program are that the homework does not know. `probes` decide where there are several ways.
    pub fn taken(
        &self,
        vertex: &Arc<Program>,
        fragment: &Arc<Program>,
        probes: &ProbeSet,
    ) -> Vec<RecognisedUniform<'_>> {
        let mut added: Vec<&ProgramVariable> = Vec::new();
        for uniform in vertex.uniforms().iter().chain(fragment.uniforms()) {
            let is_known =
                self.interface.uniforms.iter().any(|own| own.path == uniform.name && own.kind == uniform.kind)
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
        let linked = Pipeline::link(vertex, fragment, None).ok();
        let (Some(ways @ 2..=MOST_WAYS), Some(pipeline)) = (ways, linked) else { return way(0) };
        // What does not fit at a few probes need not be run at all of them.
        let (_, few) = probes.part(FEW_GROUPS);
        let extended = self.with(&way(0));
        let right = |taken: &[RecognisedUniform<'_>], probes: &ProbeSet| -> usize {
            let given = extended.probes_given(probes, taken.iter().map(|taken| taken.as_what));
            let Some(shown) = extended.shown_once(&pipeline, &given) else { return 0 };
            let is_right = |(probe, shown): &(&Probe, &ProbeOutput)| {
                (probe.colour - shown.colour).abs().max_element() <= TOLERANCE
            };
            probes.iter().zip(&shown).filter(is_right).count()
        };
        let open = may_be.iter().filter(|may_be| may_be.len() > 1).count();
        let mut best = (0, 0);
        for number in 0..ways {
            let taken = way(number);
            let count = right(&taken, &few);
            if count == few.probes.len() && right(&taken, probes) == probes.probes.len() {
                return taken;
            }
            // Of one uniform alone it is taken that it is what the homework expects: what else is wrong is known by that.
            if count > best.0 && open > 1 {
                best = (count, number);
            }
        }
        way(best.1)
    }

    /// The homework, which sets these uniforms as well. Two may have one name, and different types.
    pub fn with(&self, taken: &[RecognisedUniform<'_>]) -> Self {
        let mut other = self.clone();
        other.interface.uniforms.extend(taken.iter().map(|taken| Uniform {
            path: taken.name.clone(),
            kind: taken.as_what.kind.clone(),
            feed: taken.as_what.feed.clone(),
            probe: None,
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

    /// Probes with uniforms behind those of the homework.
    fn probes_given<'f>(&self, probes: &ProbeSet, added: impl Iterator<Item = &'f Free> + Clone) -> ProbeSet {
        let mut theirs = probes.clone();
        for group in &mut theirs.groups {
            let moment = self.moment_of(group);
            let none = |free: &Free| Value::of(free.kind.clone(), vec![f64::NAN; free.kind.slots().unwrap_or(0)]);
            let value = |free: &'f Free| free.feed.value(&free.kind, &moment).unwrap_or_else(|| none(free));
            group.uniforms.extend(added.clone().map(value));
        }
        theirs
    }

    pub(crate) fn moment_of(&self, group: &ProbeGroup) -> Moment {
        Moment { pass: group.pass, resolution: group.window, ..self.scene.moment(group.t, group.matrices) }
    }
}
