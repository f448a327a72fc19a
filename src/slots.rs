//! Which file of a hand-in is for which slot of a homework.
//!
//! A slot is a file that the homework asks for, with its name and its stage. The slot's own name comes first, in any
//! case; then that name with the mark of a copy (`ggsample06 (1).vert`); then another shader of the slot's stage; then a
//! file that was renamed on its way (`.vert.txt`, `vertex.glsl`, `.glsl`); then a text that reads like the stage. Two files of the same
//! rank that differ are a question to the student, never a guess.

mod fit;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod wording;

pub(crate) use fit::tells;
pub use fit::{NameFit, fit};
pub use reference::assignment::HandedIn as Slot;

use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::source;
use reference::Assignment;
use reference::interpreter::Stage;
use std::collections::HashSet;

/// A slot for which there is no file, or for which there are several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SlotProblem {
    /// No file is for this slot.
    Missing {
        /// Which slot.
        slot: usize,
    },
    /// Several files are as good as each other.
    Several {
        /// Which slot.
        slot: usize,
        /// Which files.
        files: Vec<usize>,
    },
}

/// What is known of a file before it is chosen.
pub trait Offered {
    /// Its own name.
    fn name(&self) -> &str;

    /// Its bytes, where they can be had.
    fn bytes(&self) -> Option<Vec<u8>>;
}

impl Offered for HandedInFile {
    fn name(&self) -> &str {
        &self.name
    }

    fn bytes(&self) -> Option<Vec<u8>> {
        Some(self.bytes.clone())
    }
}

/// How much the files say for themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// They lie where the student's files lie, with whatever else lies there.
    Found,
    /// A person named them: where one slot is left and one file, the file is for the slot, whatever its name is.
    Named,
}

/// The file of each slot, in the slots' order.
///
/// # Errors
/// What is missing or double, in the slots' order.
pub fn fill<F: Offered>(slots: &[Slot], files: &[F], trust: Trust) -> Result<Vec<usize>, Vec<SlotProblem>> {
    let mut filling = Filling::ranked(slots, files);
    if trust == Trust::Named {
        filling.last();
    }
    filling.done()
}

/// The file of each slot for which there is one, in the slots' order. A slot without a file is no problem here.
///
/// # Errors
/// What is double, in the slots' order.
pub fn place<F: Offered>(slots: &[Slot], files: &[F]) -> Result<Vec<Option<usize>>, Vec<SlotProblem>> {
    let mut filling = Filling::ranked(slots, files);
    filling.sort();
    if filling.problems.is_empty() { Ok(filling.of_slot) } else { Err(filling.problems) }
}

/// Files of which it is known that each is for the slot in its place, under names by which [`fill`] finds the same: their
/// own names where these do, else those of the slots.
pub fn keep_order(slots: &[Slot], mut hand_in: HandIn) -> HandIn {
    if fill(slots, &hand_in.files, Trust::Named) != Ok((0..slots.len()).collect()) {
        for (file, slot) in hand_in.files.iter_mut().zip(slots) {
            file.name.clone_from(&slot.name);
        }
    }
    hand_in
}

/// The files of a hand-in that the slots ask for, in the slots' order.
///
/// # Errors
/// Why the hand-in cannot be graded, for its student.
pub fn arrange(slots: &[Slot], hand_in: &HandIn, trust: Trust) -> Result<HandIn, Text> {
    match fill(slots, &hand_in.files, trust) {
        Ok(chosen) => {
            let files = chosen.into_iter().map(|index| hand_in.files[index].clone()).collect();
            Ok(tell_apart(slots, HandIn { files }))
        }
        Err(problems) => {
            let names: Vec<String> = hand_in.files.iter().map(|file| file.name.clone()).collect();
            Err(wording::unfilled(slots, &names, &problems))
        }
    }
}

/// The files in the slots' order; where two have the same name (`a/x.txt`, `b/x.txt`), each with that of its slot, so that
/// a place in one is not taken for a place in the other.
pub fn tell_apart(slots: &[Slot], mut hand_in: HandIn) -> HandIn {
    let mut names = HashSet::new();
    if !hand_in.files.iter().all(|file| names.insert(file.name.clone())) {
        for (file, slot) in hand_in.files.iter_mut().zip(slots) {
            file.name.clone_from(&slot.name);
        }
    }
    hand_in
}

struct Filling<'a, F> {
    slots: &'a [Slot],
    files: &'a [F],
    of_slot: Vec<Option<usize>>,
    problems: Vec<SlotProblem>,
}

impl<'a, F: Offered> Filling<'a, F> {
    /// What the names and the texts of the files say.
    fn ranked(slots: &'a [Slot], files: &'a [F]) -> Self {
        let mut filling = Self { slots, files, of_slot: vec![None; slots.len()], problems: Vec::new() };
        for rank in NameFit::CHOSEN {
            filling.rank(rank);
        }
        filling
    }

    /// Fills the slots for which there are files of this rank.
    fn rank(&mut self, rank: NameFit) {
        let open: Vec<usize> = (0..self.slots.len()).filter(|&slot| self.is_open(slot)).collect();
        let fitting: Vec<Vec<usize>> = open.iter().map(|&slot| self.fitting(slot, rank)).collect();
        for (&slot, files) in open.iter().zip(&fitting) {
            let is_sought_by_others =
                fitting.iter().filter(|others| files.iter().any(|f| others.contains(f))).count() > 1;
            match files.as_slice() {
                [] => {}
                [first, others @ ..] if !is_sought_by_others && self.are_same(*first, others) => {
                    self.of_slot[slot] = Some(*first);
                }
                _ => self.problems.push(SlotProblem::Several { slot, files: files.clone() }),
            }
        }
    }

    /// Gives the last file to the last slot.
    fn last(&mut self) {
        let open: Vec<usize> = (0..self.slots.len()).filter(|&slot| self.is_open(slot)).collect();
        // A file that is given twice is one file.
        let is_double = |file: usize| self.of_slot.iter().flatten().any(|&taken| self.are_same(file, &[taken]));
        let is_left = |&file: &usize| !self.is_taken(file) && !is_double(file);
        let left: Vec<usize> = (0..self.files.len()).filter(is_left).collect();
        if let ([slot], [file]) = (open.as_slice(), left.as_slice()) {
            self.of_slot[*slot] = Some(*file);
        }
    }

    fn done(mut self) -> Result<Vec<usize>, Vec<SlotProblem>> {
        let open = (0..self.slots.len()).filter(|&slot| self.is_open(slot)).map(|slot| SlotProblem::Missing { slot });
        let missing: Vec<SlotProblem> = open.collect();
        self.problems.extend(missing);
        self.sort();
        if self.problems.is_empty() { Ok(self.of_slot.into_iter().flatten().collect()) } else { Err(self.problems) }
    }

    fn sort(&mut self) {
        self.problems.sort_by_key(|problem| match problem {
            SlotProblem::Missing { slot } | SlotProblem::Several { slot, .. } => *slot,
        });
    }

    /// Whether nothing is decided for a slot.
    fn is_open(&self, slot: usize) -> bool {
        let is_of = |problem: &SlotProblem| matches!(problem, SlotProblem::Several { slot: of, .. } if *of == slot);
        self.of_slot[slot].is_none() && !self.problems.iter().any(is_of)
    }

    fn is_taken(&self, file: usize) -> bool {
        let is_in =
            |problem: &SlotProblem| matches!(problem, SlotProblem::Several { files, .. } if files.contains(&file));
        self.of_slot.contains(&Some(file)) || self.problems.iter().any(is_in)
    }

    /// The files that nobody has taken and that fit the slot so well.
    fn fitting(&self, slot: usize, rank: NameFit) -> Vec<usize> {
        let slot = &self.slots[slot];
        let fits = |&file: &usize| fit(self.files[file].name(), slot) == rank && self.reads_as(file, slot, rank);
        (0..self.files.len()).filter(|&file| !self.is_taken(file)).filter(fits).collect()
    }

    /// Whether the text of a file whose name does not tell its stage is one for the slot: it reads like the slot's stage,
    /// or at least like none that another slot has.
    fn reads_as(&self, file: usize, slot: &Slot, rank: NameFit) -> bool {
        if rank < NameFit::Renamed || rank == NameFit::Renamed && fit::tells_stage(self.files[file].name()) {
            return true;
        }
        let bytes = self.files[file].bytes();
        if let Some(program) = &slot.program {
            let text = bytes.and_then(|bytes| source::code(&bytes));
            return text.is_some_and(|text| program.array.is_in(&text));
        }
        let stage = bytes.and_then(|bytes| stage_of(&bytes));
        match stage {
            Some(stage) if stage == slot.stage => true,
            Some(stage) => rank == NameFit::Renamed && !self.slots.iter().any(|other| other.stage == stage),
            None => rank == NameFit::Renamed,
        }
    }

    fn are_same(&self, first: usize, others: &[usize]) -> bool {
        let bytes = |file: usize| self.files[file].bytes();
        others.is_empty()
            || bytes(first).is_some_and(|first| others.iter().all(|&other| bytes(other).as_ref() == Some(&first)))
    }
}

/// The stage that a text is written for, where it has what only one stage has.
fn stage_of(bytes: &[u8]) -> Option<Stage> {
    const OF_FRAGMENT: [&str; 6] =
        ["gl_FragCoord", "gl_FragColor", "gl_FragData", "gl_FragDepth", "gl_FrontFacing", "discard"];
    let code = source::code(bytes)?;
    let has = |word: &str| code.contains(word);
    // A fragment shader without any of these still has an output that is a colour, and no position.
    let has_colour = || code.split([';', '{', '}']).any(is_colour_output);
    if has("gl_Position") {
        Some(Stage::Vertex)
    } else if OF_FRAGMENT.into_iter().any(has) || has_colour() {
        Some(Stage::Fragment)
    } else {
        None
    }
}

/// Whether a statement declares an output of type vec4 or vec3.
fn is_colour_output(statement: &str) -> bool {
    let mut words = statement.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty());
    words.any(|word| word == "out") && words.next().is_some_and(|word| word == "vec4" || word == "vec3")
}

/// The files that the assignment hands out, as if somebody handed them in again.
pub fn handed_out(assignment: &Assignment) -> HandIn {
    let file = |slot: &Slot| HandedInFile::new(&slot.name, slot.starter.as_bytes());
    HandIn { files: assignment.files.iter().map(file).collect() }
}

/// The assignment's solution, as if somebody handed it in.
pub fn solution(assignment: &Assignment) -> HandIn {
    let file = |slot: &Slot| HandedInFile::new(&slot.name, slot.solution_as_written().as_bytes());
    HandIn { files: assignment.files.iter().map(file).collect() }
}
