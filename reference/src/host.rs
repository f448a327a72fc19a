//! A host program in C++ that is handed in instead of a shader: the numbers of one array are read from it, and nothing is run.
//!
//! What is judged is a shader of the homework, in which these numbers stand as they are written, each on its own line of the student's file. So
//! the pipeline judges it like any other shader, and what it says of a line is said of the student's line.

mod expression;
mod found;
mod meaning;
mod reader;
mod token;

use crate::probes::ProbeSet;
use crate::text::both;
use crate::{Assignment, Text};
use expression::HostExpression;
use found::{FoundArray, NumberTokens};
use reader::Reader;
use std::collections::{BTreeMap, BTreeSet};
use token::{HostToken, tokens};

/// The line of the homework's shader in whose place the numbers are put.
pub const MARK: &str = "// ggrade: numbers";

/// The numbers of an array that a homework reads.
#[derive(Clone, Debug)]
pub struct HostArray {
    /// The name that it is handed out with.
    pub name: String,
    /// The name of the matrix that the program makes of it.
    pub used_by: String,
    /// How many numbers it has.
    pub count: usize,
    /// What the program has beside: the elements of each variable, as expressions of the homework's shader.
    pub given: BTreeMap<String, Vec<String>>,
    /// The homework's shader, up to the mark and from there.
    shader: [String; 2],
    /// What is said of an answer that has a number in the place of a uniform.
    pub written_in: Option<Text>,
    /// What is said of code that stands there, or does not.
    pub notices: Vec<Notice>,
}

/// Something to say of code beside the numbers, which is not judged.
#[derive(Clone, Debug)]
pub struct Notice {
    /// The code, blanks aside; one of these.
    pub code: Vec<String>,
    /// Whether it is said where none of it stands there.
    pub is_absent: bool,
    /// What is said.
    pub message: Text,
}

/// What is read of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramListing {
    /// The homework's shader with the numbers in it.
    pub shader: String,
    /// The numbers that are written, without the sign.
    pub literals: Vec<f64>,
    /// The names that stand in what the program has beside.
    pub names: BTreeSet<String>,
    /// What is said of code beside the numbers: its line, where it stands there, and the text.
    pub notices: Vec<(Option<u32>, Text)>,
}

/// Why a program cannot be read.
#[derive(Clone, Debug, PartialEq)]
pub struct UnreadableProgram {
    /// The line that is at fault, from 1; `None` where something is missing.
    pub line: Option<u32>,
    /// What is wrong.
    pub message: Text,
    /// What to do.
    pub hint: Option<Text>,
}

impl UnreadableProgram {
    fn at(line: u32, message: Text) -> Self {
        Self { line: Some(line), message, hint: None }
    }
}

impl HostArray {
    /// The homework's shader, in which a line is the mark.
    ///
    /// # Errors
    /// What is wrong with it, for a lecturer.
    pub fn with_shader(mut self, text: &str) -> Result<Self, Text> {
        let lines: Vec<&str> = text.lines().map(|line| line.trim()).collect();
        let [version, lines @ ..] = &lines[..] else { return Err(both("is empty", "空です")) };
        if !version.starts_with("#version") || lines.iter().any(|line| line.starts_with('#')) {
            return Err(both(
                "has to begin with `#version`, and has no other line with `#`",
                "先頭を `#version` の行にしてください。`#` で始まる行はほかに書けません",
            ));
        }
        let mut parts = lines.split(|line| *line == MARK);
        let (Some(before), Some(behind), None) = (parts.next(), parts.next(), parts.next()) else {
            return Err(both(
                format!("needs one line `{MARK}`, in whose place the numbers are put"),
                format!("数値に置き換える行 `{MARK}` が 1 行必要です"),
            ));
        };
        // All of it stands on lines of the array: a comment would end there.
        let joined = |lines: &[&str]| {
            let code = lines.iter().map(|line| line.split("//").next().unwrap_or_default().trim());
            code.filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
        };
        self.shader = [format!("{version}\n{}", joined(before)), joined(behind)];
        Ok(self)
    }

    /// Reads the numbers of a program.
    ///
    /// # Errors
    /// Why the numbers cannot be had, for a student.
    pub fn read(&self, text: &str) -> Result<ProgramListing, UnreadableProgram> {
        let tokens = tokens(text);
        let FoundArray { first, last, values, is_transposed } = found::array(self, &tokens)?;
        let mut reader = Reader::new(self, &tokens);
        let mut numbers = Vec::new();
        for NumberTokens { at, line, end } in values {
            numbers.push((line, reader.read(at, end)?));
        }
        if is_transposed {
            let side = self.count.isqrt();
            numbers = (0..self.count).map(|at| numbers[at % side * side + at / side].clone()).collect();
        }
        let mut placed: Vec<(u32, usize, &HostExpression)> =
            numbers.iter().enumerate().map(|(at, (line, number))| (*line, at, number)).collect();
        placed.sort_by_key(|(line, at, _)| (*line, *at));
        let [before, behind] = &self.shader;
        let (version, prelude) = before.split_once('\n').unwrap_or((before, ""));
        let mut shader = format!("{version}\n");
        let mut at_line = 2;
        let mut go_to = |shader: &mut String, line: u32| {
            while at_line < line {
                shader.push('\n');
                at_line += 1;
            }
        };
        let first = placed.first().map_or(first, |(line, ..)| first.min(*line));
        if first < 2 {
            return Err(UnreadableProgram {
                line: Some(first),
                message: both(
                    "The array stands on the first line: this is a part of the program.",
                    "配列が 1 行目にあります。プログラムの一部だけのようです。",
                ),
                hint: Some(both("Hand in the whole file.", "ファイル全体を提出してください。")),
            });
        }
        go_to(&mut shader, first);
        shader.push_str(prelude);
        for (line, at, number) in placed {
            go_to(&mut shader, line);
            shader.push_str(&format!(" float {}{at} = {};", self.name, number.shader()));
        }
        go_to(&mut shader, last);
        shader.push(' ');
        shader.push_str(behind);
        shader.push('\n');
        let mut literals = Vec::new();
        let mut names = BTreeSet::new();
        numbers.iter().for_each(|(_, number)| number.mention(&mut literals, &mut names));
        Ok(ProgramListing { shader, literals, names, notices: self.notices(&tokens) })
    }

    /// Whether a text has the array at all.
    pub fn is_in(&self, text: &str) -> bool {
        found::array(self, &tokens(text)).is_ok()
    }

    fn notices(&self, all: &[HostToken<'_>]) -> Vec<(Option<u32>, Text)> {
        let mut said = Vec::new();
        for notice in &self.notices {
            let mut places = notice.code.iter().filter_map(|code| {
                let wanted = tokens(code);
                let is_it =
                    |window: &[HostToken<'_>]| window.iter().zip(&wanted).all(|(own, wanted)| own.text == wanted.text);
                all.windows(wanted.len().max(1)).find(|window| is_it(window)).map(|window| window[0].line)
            });
            match places.next() {
                None if notice.is_absent => said.push((None, notice.message.clone())),
                Some(line) if !notice.is_absent => said.push((Some(line), notice.message.clone())),
                _ => {}
            }
        }
        said
    }

    /// An array of this name without anything else, for [`HostArray::with_shader`].
    pub fn new(name: &str, used_by: &str, count: usize) -> Self {
        Self {
            name: name.to_owned(),
            used_by: used_by.to_owned(),
            count,
            given: BTreeMap::new(),
            shader: Default::default(),
            written_in: None,
            notices: Vec::new(),
        }
    }
}

impl Assignment {
    /// The places of the uniforms that a program has as numbers, among those for which its array may name something: what it does not
    /// name, and what it names and has as a number as well. A right answer is right only as long as they stay as they are.
    pub fn written_in(&self, array: &HostArray, listing: &ProgramListing) -> Vec<usize> {
        let uniforms = &self.interface.uniforms;
        let is_uniform = |name: &String| uniforms.iter().any(|uniform| uniform.path == *name);
        if !listing.names.iter().all(is_uniform) {
            // What depends on several of them.
            return Vec::new();
        }
        let may_be_named = |name: &str| array.given.values().flatten().any(|element| element == name);
        let still = glam::DMat4::IDENTITY;
        let resting = self.scene.moment(0.0, crate::scene::Matrices::new(still, still));
        let is_written = |place: &usize| {
            let uniform = &uniforms[*place];
            let value = uniform.value(&resting).numbers().first().map_or(0.0, |number| number.abs());
            let is_number =
                value > 0.0 && listing.literals.iter().any(|literal| (literal - value).abs() <= 1e-6 * value);
            uniform.probe.is_some()
                && may_be_named(&uniform.path)
                && (!listing.names.contains(&uniform.path) || is_number)
        };
        (0..uniforms.len()).filter(is_written).collect()
    }

    /// Probes at which these uniforms are what the course's program has.
    pub fn probes_at_rest(&self, probes: &ProbeSet, uniforms: &[usize]) -> ProbeSet {
        let theirs = probes.with_uniforms(|group| {
            let moment = self.moment_of(group);
            uniforms.iter().for_each(|place| group.uniforms[*place] = self.interface.uniforms[*place].value(&moment));
        });
        self.reprobe(&theirs)
    }
}

#[cfg(test)]
mod tests;
