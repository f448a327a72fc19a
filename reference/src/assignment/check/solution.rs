//! The solution: what is right, as a shader computes it, and what `assignment.toml` says of its names.

mod equation;
mod expressions;

use super::{CheckResult, listed};
use crate::Text;
use crate::assignment::{AssignmentError, HandedIn, Output, error};
use crate::equation::Reads;
use crate::interpreter::{Cell, Draft, Formula, Refusal, Stage, StoredOutput, Type};
use crate::manifest;
use crate::pipeline::{POSITION, Pipeline};
use crate::text::both;

/// Definitions are held as the bits of a u64.
const MAX_DEFINITIONS: usize = 64;

/// What a whole program shows, as a program: the definitions of a solution whose own cannot be told apart.
const SHOWN_COLOUR: &str = "shown_colour";
const SHOWN_POSITION: &str = "shown_position";

/// The solution, as long as forms of mistakes are read beside it.
pub(super) struct CheckedSolution<'a> {
    /// The file that the definitions stand in; the last one where they are what the whole program shows.
    file: &'a HandedIn,
    reads: Reads,
    draft: Draft,
    /// The cell of the first definition.
    first: usize,
    /// Why the definitions of the file are not told apart.
    why_whole: Option<AssignmentError>,
    /// What the handed-in stages write.
    outputs: Vec<Output>,
}

impl<'a> CheckedSolution<'a> {
    /// Reads the solution: as a list of definitions where it is one file that is one, else as what the program shows.
    pub(super) fn read(
        files: &'a [HandedIn],
        pipeline: &Pipeline,
        constants: &[manifest::ConstantEntry],
    ) -> CheckResult<Self> {
        let names: Vec<&str> = constants.iter().map(|constant| constant.name.as_str()).collect();
        let why = match files {
            [file] => match Self::of_definitions(file, &names) {
                Ok(solution) => return Ok(solution),
                Err(why) => why,
            },
            _ => error("file", both("the homework has several files", "課題のファイルが複数あります")),
        };
        Self::of_outputs(files, pipeline, why)
    }

    fn of_definitions(file: &'a HandedIn, constants: &[&str]) -> CheckResult<Self> {
        let draft = Draft::read(&file.solution.text, file.stage, constants);
        let draft = draft.map_err(|refusal| refused(&file.solution.name, &refusal))?;
        let first = draft.formulas().first().map(Formula::cell);
        let first = first.ok_or_else(|| {
            error(
                &file.solution.name,
                both(
                    "`main` defines nothing: write `type name = …;`",
                    "`main` に定義がありません。`型 名前 = …;` と書いてください",
                ),
            )
        })?;
        let reads = match file.stage {
            Stage::Vertex => Reads::Attributes,
            Stage::Fragment => Reads::Varyings,
        };
        let mut solution = Self { file, reads, draft, first, why_whole: None, outputs: Vec::new() };
        if solution.draft.formulas().len() > MAX_DEFINITIONS {
            let message = both(
                format!("there are more than {MAX_DEFINITIONS} definitions"),
                format!("定義が {MAX_DEFINITIONS} 個を超えています"),
            );
            return Err(solution.wrong(0, message));
        }
        for formula in solution.draft.formulas() {
            let line = solution.draft.cells()[formula.cell()].line;
            solution.few_enough(formula, &|| place(&file.solution.name, line))?;
        }
        solution.output(None)?;
        if reads == Reads::Attributes {
            solution.output(Some(POSITION))?;
        }
        let stored = solution.draft.stored().iter().filter(|stored| stored.output != POSITION);
        let kind = |stored: &StoredOutput| solution.draft.cells()[stored.cell].kind.clone();
        solution.outputs = stored.map(|stored| Output { name: stored.output.clone(), kind: kind(stored) }).collect();
        Ok(solution)
    }

    /// The colour and, where a vertex stage is handed in, the position are the definitions.
    fn of_outputs(files: &'a [HandedIn], pipeline: &Pipeline, why: AssignmentError) -> CheckResult<Self> {
        let nothing = || error("file", both("nothing is handed in", "提出するファイルがありません"));
        let file = files.last().ok_or_else(nothing)?;
        let has = |stage| files.iter().any(|file| file.stage == stage);
        let seen = &pipeline.fragment.outputs()[pipeline.colour].name;
        let colour = if seen.starts_with("gl_") { "colour" } else { seen };
        let clip = if colour == "position" { "clip_position" } else { "position" };
        let position = has(Stage::Vertex);
        let [declared, written] = match position {
            true => {
                [format!("in vec4 {SHOWN_POSITION};"), format!("vec4 {clip} = {SHOWN_POSITION}; {POSITION} = {clip};")]
            }
            false => Default::default(),
        };
        let text = format!(
            "#version 410 core\nin vec4 {SHOWN_COLOUR}; {declared} out vec4 {SHOWN_COLOUR}_out;\n\
             void main() {{ vec4 {colour} = {SHOWN_COLOUR}; {written} {SHOWN_COLOUR}_out = {colour}; }}"
        );
        let draft = Draft::read(&text, Stage::Vertex, &[]).map_err(|refusal| refused(&file.solution.name, &refusal))?;
        let first = draft.formulas().first().map_or(0, Formula::cell);
        let written = match has(Stage::Fragment) {
            true => &pipeline.fragment,
            false => &pipeline.vertex,
        };
        // `gl_FragColor` is an output like those that are declared; `gl_Position` and the like are not colours.
        let is_own = |name: &str| !name.starts_with("gl_") || name == "gl_FragColor";
        let own = written.outputs().iter().filter(|output| is_own(&output.name));
        let outputs = own.map(|output| Output { name: output.name.clone(), kind: output.kind.clone() }).collect();
        Ok(Self { file, reads: Reads::Outputs, draft, first, why_whole: Some(why), outputs })
    }

    /// Why the definitions of the solution are not told apart, where they are not.
    pub(super) fn why_whole(&self) -> Option<&AssignmentError> {
        self.why_whole.as_ref()
    }

    /// What the equation is computed from.
    pub(super) fn reads(&self) -> Reads {
        self.reads
    }

    pub(super) fn wrong(&self, line: u32, message: Text) -> AssignmentError {
        error(place(&self.file.solution.name, line), message)
    }

    fn definitions(&self) -> &[Cell] {
        &self.draft.cells()[self.first..][..self.draft.formulas().len()]
    }

    /// The place of a definition.
    pub(super) fn definition(&self, name: &str, place: &dyn Fn() -> String) -> CheckResult<usize> {
        let stored = self.draft.stored().iter().find(|stored| stored.output == name);
        let named = self.definitions().iter().position(|cell| cell.name == name);
        named.or_else(|| stored.map(|stored| stored.cell - self.first)).ok_or_else(|| {
            let known = listed(self.definitions().iter().map(|cell| cell.name.as_str()));
            let place = place();
            let names = self.definitions().iter().map(|cell| &cell.name);
            let mut names = names.chain(self.draft.stored().iter().map(|stored| &stored.output));
            if let Some(meant) = names.find(|known| known.eq_ignore_ascii_case(name)) {
                let message = both(
                    format!("there is no definition `{name}`: write `{meant}`"),
                    format!("定義 `{name}` はありません。`{meant}` と書いてください"),
                );
                return error(place, message);
            }
            if let Some(why) = &self.why_whole {
                let AssignmentError { message, .. } = why;
                let message = both(
                    format!("{}; {place}, names the definition `{name}`", message.en),
                    format!("{} ({place} が定義 `{name}` を使っています)", message.ja),
                );
                return AssignmentError { message, ..why.clone() };
            }
            error(
                place,
                both(
                    format!("there is no definition `{name}` in {}, which has {known}", self.file.solution.name),
                    format!("{} に定義 `{name}` はありません (あるもの: {known})", self.file.solution.name),
                ),
            )
        })
    }

    /// The place of the definition that is the colour.
    pub(super) fn colour(&self) -> CheckResult<usize> {
        self.output(None)
    }

    /// The type of a definition by its place.
    pub(super) fn kind(&self, definition: usize) -> &Type {
        &self.definitions()[definition].kind
    }

    /// The name of a definition by its place.
    pub(super) fn name(&self, definition: usize) -> &str {
        &self.definitions()[definition].name
    }

    /// The place of a definition of this type.
    pub(super) fn definition_of(&self, name: &str, kind: &Type, place: &dyn Fn() -> String) -> CheckResult<usize> {
        let definition = self.definition(name, place)?;
        let found = &self.definitions()[definition].kind;
        let other = || error(place(), other_type(name, found, kind));
        (found == kind).then_some(definition).ok_or_else(other)
    }

    /// What the handed-in stages write beside `gl_Position`.
    pub(super) fn outputs(&self) -> Vec<Output> {
        self.outputs.clone()
    }

    /// Whether a definition is the position in clip space.
    pub(super) fn is_position(&self, definition: &str) -> bool {
        let mut stored = self.draft.stored().iter().filter(|stored| stored.output == POSITION);
        stored.any(|stored| self.draft.cells()[stored.cell].name == definition)
    }

    /// The place of the definition that an output is given; without a name, of the only output beside the position.
    fn output(&self, name: Option<&str>) -> CheckResult<usize> {
        let is_it = |output: &str| name.map_or(output != POSITION, |name| output == name);
        let mut stored = self.draft.stored().iter().filter(|stored| is_it(&stored.output));
        let missing = || {
            match name {
            Some(name) => self.wrong(
                0,
                both(
                    format!("`{name}` has no value: write `{name} = …;` at the end of `main`"),
                    format!("`{name}` に値がありません。`main` の最後に `{name} = …;` と書いてください"),
                ),
            ),
            None => self.wrong(
                0,
                both(
                    "no output has a value: declare `out vec4 a_name;`, and write `a_name = …;` at the end of `main`",
                    "値のある出力がありません。`out vec4 a_name;` と宣言し、`main` の最後に `a_name = …;` と書いてください",
                ),
            ),
        }
        };
        let one = stored.next().ok_or_else(missing)?;
        if let Some(other) = stored.next() {
            return Err(self.wrong(
                other.line,
                both(
                    "this is one output too many: only one beside gl_Position is compared",
                    "出力が多すぎます。`gl_Position` のほかに比較する出力は 1 つだけです",
                ),
            ));
        }
        let kind = &self.draft.cells()[one.cell].kind;
        let is_colour_of_fragment = self.reads == Reads::Varyings && *kind == Type::VEC3;
        if *kind != Type::VEC4 && !is_colour_of_fragment {
            return Err(self.wrong(one.line, other_type(&one.output, kind, &Type::VEC4)));
        }
        Ok(one.cell - self.first)
    }
}

/// The message about something of another type than the one it has to have.
fn other_type(name: &str, found: &Type, wanted: &Type) -> Text {
    both(
        format!("`{name}` is a {found}, and has to be a {wanted}"),
        format!("`{name}` の型は {found} ですが、{wanted} でなければなりません"),
    )
}

/// A place in a file.
pub(super) fn place(file: &str, line: u32) -> String {
    if line == 0 { file.to_owned() } else { format!("{file}, line {line}") }
}

/// What the interpreter has to say of a file.
pub(super) fn refused(file: &str, refusal: &Refusal) -> AssignmentError {
    error(place(file, refusal.line), refusal.what().clone())
}
