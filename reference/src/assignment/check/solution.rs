//! The solution: what is right, as a shader computes it, and what `assignment.toml` says of its names.

use super::{CheckResult, listed};
use crate::Text;
use crate::assignment::{AssignmentError, Constant, HandedIn, Interface, Output, error};
use crate::equation::{Definition, Equation, MAX_INPUTS, Reads};
use crate::interpreter::{Cell, Draft, Formula, Refusal, Stage, StoredOutput, Texture, Type};
use crate::manifest::{self, Manifest};
use crate::pipeline::Pipeline;
use crate::text::both;
use std::sync::Arc;

/// Definitions are held as the bits of a u64.
const MAX_DEFINITIONS: usize = 64;

/// What `gl_Position` is given is the position.
const POSITION: &str = "gl_Position";

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
        constants: &[manifest::Constant],
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
        let draft = Draft::read(&file.solution.text, file.stage.into(), constants);
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
            manifest::Stage::Vertex => Reads::Attributes,
            manifest::Stage::Fragment => Reads::Varyings,
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
        let position = has(manifest::Stage::Vertex);
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
        let written = match has(manifest::Stage::Fragment) {
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

    /// A condition on the definitions.
    pub(super) fn condition(&mut self, text: &str, place: &dyn Fn() -> String) -> CheckResult<Formula> {
        self.draft.condition(text).map_err(|refusal| {
            let known =
                listed(self.draft.cells().iter().map(|cell| cell.name.as_str()).filter(|name| !name.is_empty()));
            let Text { en, ja } = refusal.what();
            let message = both(
                format!("{en}: write an expression of type bool with {known}"),
                format!("{ja}。{known} を使った bool 型の式を書いてください"),
            );
            error(place(), message)
        })
    }

    /// A name for what is free in a mistake's forms.
    pub(super) fn parameter(&self, name: &str, place: &str) -> CheckResult<()> {
        let taken = || {
            error(
                place,
                both(
                    format!("`{name}` is taken, means something in GLSL, or is not a name"),
                    format!("`{name}` は、すでに使われているか、GLSL で意味を持つか、名前として使えません"),
                ),
            )
        };
        self.draft.is_free(name).then_some(()).ok_or_else(taken)
    }

    /// An expression in place of a definition, and whether what is free occurs in it.
    pub(super) fn replacement(
        &mut self,
        definition: usize,
        text: &str,
        free: Option<&str>,
        place: &dyn Fn() -> String,
    ) -> CheckResult<(Formula, bool)> {
        let cell = self.first + definition;
        let allowed = |solution: &Self| {
            let names = solution.draft.cells()[..cell].iter().map(|cell| cell.name.as_str());
            listed(names.chain(free))
        };
        let formula = self.draft.replacement(cell, text, free).map_err(|refusal| {
            let kind = &self.draft.cells()[cell].kind;
            let (Text { en, ja }, allowed) = (refusal.what(), allowed(self));
            let message = both(
                format!("{en}: write an expression of type {kind} with {allowed}"),
                format!("{ja}。{allowed} を使った {kind} 型の式を書いてください"),
            );
            error(place(), message)
        })?;
        let parameter = self.draft.cells().len() - 1;
        if let Some(used) = formula.uses().iter().find(|used| **used >= cell && **used != parameter) {
            let used = &self.draft.cells()[*used].name;
            return Err(error(
                place(),
                both(
                    format!("uses `{used}`, which is defined later: use only {}", allowed(self)),
                    format!("後で定義される `{used}` を使っています。使えるのは {} です", allowed(self)),
                ),
            ));
        }
        self.few_enough(&formula, place)?;
        let is_free = formula.uses().contains(&parameter);
        Ok((formula, is_free))
    }

    /// A search keeps what a definition uses in a few places.
    fn few_enough(&self, formula: &Formula, place: &dyn Fn() -> String) -> CheckResult<()> {
        let used = formula.uses().iter().filter(|cell| **cell >= self.first);
        if used.count() > MAX_INPUTS {
            let message = both(
                format!("uses more than {MAX_INPUTS} definitions: name a part of it first"),
                format!("使っている定義が {MAX_INPUTS} 個を超えています。先に一部に名前を付けてください"),
            );
            return Err(error(place(), message));
        }
        Ok(())
    }

    /// What the handed-in stages write beside `gl_Position`.
    pub(super) fn outputs(&self) -> Vec<Output> {
        self.outputs.clone()
    }

    /// The equation that the solution is, with what the lecture calls its definitions.
    pub(super) fn finish(
        self,
        m: &Manifest,
        interface: &Interface,
        pipeline: &Pipeline,
        constants: &[Constant],
        textures: Arc<[Texture]>,
    ) -> CheckResult<Equation> {
        for name in m.definition.keys() {
            self.definition(name, &|| format!("definition `{name}`"))?;
        }
        let colour = self.output(None)?;
        let has_position = self.draft.stored().iter().any(|stored| stored.output == POSITION);
        let position = has_position.then(|| self.output(Some(POSITION))).transpose()?;
        let stored = self.draft.stored().iter();
        let outputs = stored.map(|stored| (stored.output.clone(), stored.cell - self.first)).collect();
        let cells = self.draft.cells();
        let definition = |formula: &Formula| {
            let Cell { name, kind, .. } = cells[formula.cell()].clone();
            let said = m.definition.get(&name);
            let (slide, symbol) = said.map_or((None, None), |said| (said.slide, said.symbol.clone()));
            let means = said.and_then(|said| said.means.clone());
            Definition { name, kind, formula: formula.clone(), slide, symbol, means }
        };
        let definitions: Vec<Definition> = self.draft.formulas().iter().map(definition).collect();
        let given = |name: &str| cells[..self.first].iter().position(|cell| cell.name == *name);
        let constants = constants.iter().map(|constant| (given(&constant.name), constant.value.clone())).collect();
        let uniforms = interface.uniforms.iter().map(|uniform| given(&uniform.path)).collect();
        let attributes = match self.reads {
            Reads::Attributes => interface.inputs.iter().map(|input| given(&input.name)).collect(),
            Reads::Varyings => pipeline.fragment.inputs().iter().map(|input| given(&input.name)).collect(),
            Reads::Outputs => [SHOWN_COLOUR, SHOWN_POSITION].into_iter().map(given).collect(),
        };
        let (name, reads) = (&self.file.solution.name, self.reads);
        let sheet = self.draft.finish(textures).map_err(|refusal| refused(name, &refusal))?;
        let sheet = Arc::new(sheet);
        let numbers = definitions.iter().filter_map(|definition| definition.kind.slots()).sum();
        Ok(Equation {
            reads,
            sheet,
            constants,
            uniforms,
            attributes,
            first: self.first,
            definitions,
            numbers,
            colour,
            position,
            outputs,
        })
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
