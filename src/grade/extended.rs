//! The homework with what a student's files add to it: uniforms under names of their own.

use crate::fault::Fault;
use crate::language::Text;
use crate::report::AdviceLine;
use crate::source::Source;
use crate::translate::{HomeworkProgram, LinkedInterface, Stage};
use reference::Assignment;
use reference::free::RecognisedUniform;
use reference::probes::ProbeSet;

/// A homework whose program sets a student's own uniforms as well.
pub(super) struct Extended {
    /// The homework.
    pub assignment: Assignment,
    /// Its program.
    pub program: HomeworkProgram,
    /// The probes that judge.
    pub probes: ProbeSet,
    /// How many uniforms are added.
    count: usize,
    /// By name of a uniform: the id of what it is taken for, and what is said of that.
    notes: Vec<(String, String, Text)>,
}

impl Extended {
    /// `None` where the files add nothing, or where it is not known what they do.
    pub fn of(assignment: &Assignment, probes: &ProbeSet, sources: &[(Stage, &Source)]) -> Result<Option<Self>, Fault> {
        if assignment.free.is_empty() {
            return Ok(None);
        }
        let texts: Vec<(Stage, &str)> = sources.iter().map(|(stage, source)| (*stage, source.text.as_str())).collect();
        let taken = assignment.taken(&texts, probes);
        if taken.is_empty() {
            return Ok(None);
        }
        let extended = assignment.with(&taken);
        let own = extended.fixed.first().map(|fixed| (fixed.stage, fixed.text.as_str()));
        let note = |taken: &RecognisedUniform<'_>| {
            let note = taken.as_what.note.as_ref()?;
            let name = &taken.name;
            let said = Text::new(format!("`{name}`: {}", note.en), format!("`{name}`: {}", note.ja));
            Some((name.clone(), taken.as_what.id.clone(), said))
        };
        Ok(Some(Self {
            program: HomeworkProgram::new(LinkedInterface::of(&extended)?, own)?,
            probes: extended.probes_with(probes, taken.len()),
            count: taken.len(),
            notes: taken.iter().filter_map(note).collect(),
            assignment: extended,
        }))
    }

    /// Probes of the homework, with what the added uniforms are there.
    pub fn probes_of(&self, probes: &ProbeSet) -> ProbeSet {
        self.assignment.probes_with(probes, self.count)
    }

    /// What is said of what the uniforms are taken for, each where it is declared.
    pub fn notes(&self, sources: &[(Stage, &Source)]) -> impl Iterator<Item = AdviceLine> {
        let advice = |(name, id, message): &(String, String, Text)| {
            let line = |source: &Source| {
                let is_it = |line: &u32| {
                    let code = source.code_line(*line);
                    code.contains("uniform") && code.contains(name.as_str())
                };
                (1..=source.line_count()).find(is_it)
            };
            let found = sources.iter().find_map(|(_, source)| Some((source.facts.name.clone(), line(source)?)));
            let (file, line) = found.map_or((String::new(), None), |(file, line)| (file, Some(line)));
            AdviceLine { id: id.clone(), message: message.clone(), file, line }
        };
        self.notes.iter().map(advice).collect::<Vec<_>>().into_iter()
    }
}
