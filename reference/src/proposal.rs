//! A homework's folder, written from a solution: what there is to say of it is read from its text, the rest is guessed by name.
//!
//! - `source`: a solution as it is given, compiled by the interpreter
//! - `names`, `guess`: what names usually mean, and what values they usually have
//! - `starter`: the solution without what students write
//! - `uniforms`, `stages`, `scene`: what feeds the solution, and what is drawn
//! - `reveal`: bounds of values so that all of the solution shows
//! - `rubric`: parts of the solution that can be told apart, each tried
//! - `writing`: `assignment.toml`
//! - `shader_test`: piglit's tests as solutions

mod guess;
mod names;
mod reveal;
mod rubric;
mod scene;
mod shader_test;
mod source;
mod stages;
mod starter;
mod uniforms;
mod writing;

use crate::assignment::{AssignmentError, MANIFEST};
use crate::interpreter::{Stage, Type};
use crate::text::both;
use crate::{Assignment, Folder, Text};
use rubric::ProposedLine;
use source::SolutionFile;
use uniforms::{ProposedAttribute, ProposedUniform};

/// The name of the schema in a folder. A hidden file is no part of the homework.
pub const SCHEMA: &str = ".assignment.schema.json";

/// A file that a lecturer gives.
#[derive(Clone, Debug)]
pub struct Given {
    /// Its name, without folders.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A homework, written.
#[derive(Debug)]
pub struct Proposal {
    /// Its files.
    pub folder: Folder,
    /// What was read and guessed, one line each.
    pub remarks: Vec<ProposalRemark>,
    /// What still has to be changed before it grades.
    pub trouble: Option<AssignmentError>,
}

/// What was read or guessed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProposalRemark {
    /// Whether it is sure.
    pub kind: RemarkKind,
    /// What it is.
    pub text: Text,
}

/// How sure a remark is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemarkKind {
    /// The solution says it.
    Read,
    /// Its names suggest it.
    Guessed,
    /// Somebody has to look.
    Attention,
}

/// All of a homework before it is written.
struct FolderPlan {
    id: String,
    sources: Vec<SolutionFile>,
    starters: Vec<String>,
    fixed: Option<stages::FixedFile>,
    attributes: Vec<ProposedAttribute>,
    uniforms: Vec<ProposedUniform>,
    scene: scene::Proposed,
    rubric: Vec<ProposedLine>,
    remarks: Vec<ProposalRemark>,
}

impl FolderPlan {
    fn read(&mut self, en: impl Into<String>, ja: impl Into<String>) {
        self.remarks.push(ProposalRemark { kind: RemarkKind::Read, text: both(en, ja) });
    }

    fn guessed(&mut self, en: impl Into<String>, ja: impl Into<String>) {
        self.remarks.push(ProposalRemark { kind: RemarkKind::Guessed, text: both(en, ja) });
    }

    fn attention(&mut self, en: impl Into<String>, ja: impl Into<String>) {
        self.remarks.push(ProposalRemark { kind: RemarkKind::Attention, text: both(en, ja) });
    }

    fn hands_in(&self, stage: Stage) -> bool {
        self.sources.iter().any(|source| source.stage == stage)
    }

    /// The files of the folder.
    fn folder(&self) -> Folder {
        let mut files = vec![(MANIFEST.to_owned(), writing::manifest(self).into_bytes())];
        for (source, starter) in self.sources.iter().zip(&self.starters) {
            let extension = source.extension();
            files.push((format!("solution.{extension}"), source.text.clone().into_bytes()));
            files.push((format!("starter.{extension}"), starter.clone().into_bytes()));
        }
        files.extend(self.fixed.iter().map(|fixed| (fixed.name(), fixed.text.clone().into_bytes())));
        Folder::of(files)
    }
}

/// Writes a homework from a solution: a vertex shader, a fragment shader, both, or a `.shader_test`. `id`: its name.
///
/// # Errors
/// The files are no solution: file, line, and what to write instead.
pub fn propose(id: &str, given: &[Given]) -> Result<Proposal, AssignmentError> {
    match given {
        [one] if one.name.ends_with(".shader_test") => {
            let test = shader_test::read(one)?;
            propose_with(id, &test.stages, Some(&test))
        }
        _ => propose_with(id, given, None),
    }
}

fn propose_with(
    id: &str,
    given: &[Given],
    test: Option<&shader_test::ShaderTest>,
) -> Result<Proposal, AssignmentError> {
    let sources = source::read_all(id, given)?;
    let mut plan = FolderPlan {
        id: id.to_owned(),
        sources,
        starters: Vec::new(),
        fixed: None,
        attributes: Vec::new(),
        uniforms: Vec::new(),
        scene: scene::Proposed::default(),
        rubric: Vec::new(),
        remarks: Vec::new(),
    };
    let wrapped: Vec<String> =
        plan.sources.iter().filter(|source| source.is_wrapped).map(SolutionFile::solution_name).collect();
    for name in wrapped {
        plan.read(
            format!("{name}: has `mainImage` and no `main`, so `main` and the uniforms that such pages give are added"),
            format!("{name}: `mainImage` だけがあるので、`main` と、共有サイトが与える uniform を加えました"),
        );
    }
    starter::cut(&mut plan)?;
    uniforms::feed(&mut plan, test)?;
    stages::fix(&mut plan, test)?;
    scene::propose(&mut plan, test);
    rubric::plain(&mut plan);
    let trouble = match Assignment::load(plan.folder()) {
        Ok(assignment) => {
            if test.is_none() {
                reveal::widen(&mut plan, &assignment);
            }
            rubric::refine(&mut plan);
            None
        }
        Err(trouble) => match plan.sources.iter().find(|source| trouble.file == source.solution_name()) {
            Some(source) if trouble.line.is_some() => return Err(source.placed(trouble)),
            _ => Some(trouble),
        },
    };
    rubric::tell(&mut plan);
    Ok(Proposal { folder: plan.folder(), remarks: plan.remarks, trouble })
}

/// What an entry of `assignment.toml` may say of an attribute or a uniform with such a name.
pub(crate) fn entry_for(path: &str, kind: &Type, is_attribute: bool) -> String {
    uniforms::entry_for(path, kind, is_attribute)
}

/// A name as an id: what cannot stand in an address becomes `-`.
pub fn id_of(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '-' };
    let id: String = name.chars().map(plain).collect();
    let id: String = id.trim_matches(['.', '-']).chars().take(64).collect();
    if id.is_empty() { "homework".to_owned() } else { id }
}
