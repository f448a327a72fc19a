//! What a stage's uniforms are at each sample, and where their numbers come from.

use super::columns;
use crate::assignment::{Interface, Uniform};
use crate::interpreter::{Program, ProgramVariable, Run, Scalar, Texture, Type};
use crate::{Assignment, Value};

/// The values of all uniforms, in the interface's order, at each of some samples.
#[derive(Clone, Copy)]
pub(crate) enum UniformsOf<'a> {
    /// The same at all of them.
    All(&'a [Value]),
    /// Each has its own.
    Each(&'a [&'a [Value]]),
}

impl<'a> UniformsOf<'a> {
    /// The value of one uniform at all samples, or at each.
    fn value(self, place: usize) -> Result<&'a Value, impl Iterator<Item = &'a Value>> {
        let (first, all) = match self {
            Self::All(values) => (values, &[][..]),
            Self::Each(values) => (values[0], values),
        };
        let is_same = |own: &&[Value]| std::ptr::eq(*own, first) || own[place] == first[place];
        if all.iter().all(is_same) { Ok(&first[place]) } else { Err(all.iter().map(move |own| &own[place])) }
    }

    /// A column of so many samples for each of these numbers; 0 where there is none.
    fn numbers(self, numbers: &[Option<(usize, usize)>], samples: usize) -> Vec<Vec<f64>> {
        let column = |number: &Option<(usize, usize)>| {
            let of = |own: &[Value]| number.map_or(0.0, |(place, number)| own[place].numbers()[number]);
            match self {
                Self::All(own) => vec![of(own); samples],
                Self::Each(all) => all.iter().map(|own| of(own)).collect(),
            }
        };
        numbers.iter().map(column).collect()
    }
}

/// Where the numbers of a program's uniform come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UniformSource {
    /// It is this one of the homework's.
    Whole(usize),
    /// It lies in a block of the homework's, over other members: for each of its numbers a uniform, and which of its numbers. What the
    /// homework leaves open is 0.
    Numbers(Vec<Option<(usize, usize)>>),
}

impl Interface {
    /// Where the numbers of a program's uniform come from; `None` where the homework sets none of them.
    pub fn source(&self, own: &ProgramVariable) -> Option<UniformSource> {
        let is_it = |uniform: &Uniform| uniform.is(own) && own.kind == uniform.kind;
        // Of two with one name the last counts: it is the student's own.
        if let Some(place) = self.uniforms.iter().rposition(is_it) {
            return Some(UniformSource::Whole(place));
        }
        let place = own.place.as_ref()?;
        let in_block = || {
            let all = self.uniforms.iter().enumerate();
            all.filter_map(|(number, uniform)| {
                let known = uniform.place.as_ref().filter(|known| known.block == place.block)?;
                Some((number, uniform, known))
            })
        };
        in_block().next()?;
        let is_real = |kind: &Type| matches!(kind.scalar(), Some(Scalar::Float | Scalar::Double));
        let number_at = |at: u32| {
            in_block().filter(|(_, uniform, _)| is_real(&uniform.kind) == is_real(&own.kind)).find_map(
                |(place, uniform, known)| {
                    let number = known.numbers(&uniform.kind).iter().position(|number| *number == at)?;
                    Some((place, number))
                },
            )
        };
        Some(UniformSource::Numbers(place.numbers(&own.kind).into_iter().map(number_at).collect()))
    }

    /// A run with uniforms, as far as the program has them, and textures.
    pub(super) fn fed<'a>(
        &self,
        program: &'a Program,
        samples: usize,
        uniforms: UniformsOf<'_>,
        textures: &'a [Texture],
    ) -> Option<Run<'a>> {
        let mut run = program.run(samples).textures(textures);
        if samples == 0 {
            return Some(run);
        }
        for own in program.uniforms() {
            run = match self.source(own) {
                None => run,
                Some(UniformSource::Whole(place)) => match uniforms.value(place) {
                    Ok(value) => run.uniform(&own.name, value.numbers()).ok()?,
                    Err(values) => run.uniform_of_each(&own.name, columns(own, values)).ok()?,
                },
                Some(UniformSource::Numbers(numbers)) => {
                    run.uniform_of_each(&own.name, uniforms.numbers(&numbers, samples)).ok()?
                }
            };
        }
        Some(run)
    }
}

impl Assignment {
    /// A run with uniforms, as far as the program has them, and the textures.
    pub(crate) fn fed<'a>(&'a self, program: &'a Program, samples: usize, uniforms: UniformsOf<'_>) -> Option<Run<'a>> {
        self.interface.fed(program, samples, uniforms, &self.textures)
    }
}
