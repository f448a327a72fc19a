//! The mistakes of an assignment: what they cost, and what an answer that has them computes.

use super::{Assignment, RubricItem};
use crate::Text;
use crate::derived::{self, Derived, is_derived};
use crate::equation::EquationVariant;
use crate::interpreter::Stage;
use crate::interpreter::trace::{Site, What};
use crate::mistake::{FoundMistake, Mistake, MistakeForm};

impl Assignment {
    /// The mistake with this id.
    pub fn mistake(&self, id: &str) -> Option<&Mistake> {
        let own = self.mistakes.iter().find(|m| m.id == id);
        own.or_else(|| self.deriving(id)?.assignment.mistake(id))
    }

    /// What a mistake is called. Of a derived one this is made from its id, for which no mistake has to be derived.
    pub fn title_of(&self, id: &str) -> Option<Text> {
        let own = self.mistakes.iter().find(|mistake| mistake.id == id);
        own.map(|mistake| mistake.title.clone()).or_else(|| derived::title(self, id))
    }

    /// The homework with derived mistakes, where this is without them and `id` is that of one.
    fn deriving(&self, id: &str) -> Option<&Derived> {
        let has_some = || self.mistakes.iter().any(|mistake| is_derived(&mistake.id));
        (is_derived(id) && !has_some()).then(|| self.derived()).filter(|derived| !derived.mistakes().is_empty())
    }

    /// Fraction of a rubric line's points that is kept by a mistake in the form in which it was found: 1 for a line that
    /// the form does not reach, although others of the same mistake do.
    pub fn keeps(&self, found: &FoundMistake, line: &RubricItem) -> f64 {
        let Some(mistake) = self.mistake(&found.id) else { return 1.0 };
        if let Some(derived) = self.deriving(&found.id) {
            return if derived.touches(found, line) { mistake.keeps(&line.id) } else { 1.0 };
        }
        let reaches = mistake.forms.get(found.form).is_none_or(|form| self.reaches(form, line));
        if reaches { mistake.keeps(&line.id) } else { 1.0 }
    }

    /// Whether two mistakes cost points of the same line.
    pub fn share_a_line(&self, a: &FoundMistake, b: &FoundMistake) -> bool {
        self.rubric.iter().any(|line| self.keeps(a, line) < 1.0 && self.keeps(b, line) < 1.0)
    }

    /// The lines of the rubric that are about a variable of the solution; none where no line says so.
    pub fn lines_about<'a>(&'a self, variable: &str) -> impl Iterator<Item = &'a RubricItem> {
        self.rubric.iter().filter(move |line| line.variables.iter().any(|own| own == variable))
    }

    /// Whether a line of the rubric is about a variable of the solution.
    pub fn is_judged(&self, variable: &str) -> bool {
        self.lines_about(variable).next().is_some()
    }

    /// Whether one line of the rubric alone is about a variable of the solution, which is given one value, so that the line is about all
    /// that it is. What is given several values one after the other may have those of other lines, but for a line that no feature tells.
    pub fn is_of_one_line(&self, variable: &str) -> bool {
        let is_untold = |line: usize| self.features[line].is_none() && !self.is_colour(variable);
        self.only_line_about(variable).is_some_and(|line| !self.is_of_several(variable) || is_untold(line))
    }

    /// The place of the line of the rubric that alone is about a variable of the solution.
    pub(crate) fn only_line_about(&self, variable: &str) -> Option<usize> {
        let is_about = |line: &usize| self.rubric[*line].variables.iter().any(|own| own == variable);
        let mut about = (0..self.rubric.len()).filter(is_about);
        about.next().filter(|_| about.next().is_none())
    }

    /// The lines that a mistake in a variable costs, where nothing else tells. Of one that is given several values, the only line that is
    /// about it may be about one of them.
    pub fn lines_owning(&self, variable: &str) -> Vec<&RubricItem> {
        let about: Vec<&RubricItem> = self.lines_about(variable).collect();
        if about.len() == 1 && !self.is_of_one_line(variable) { Vec::new() } else { about }
    }

    /// Whether a variable may have something of several lines: it is given several values, or is all that is seen.
    fn is_of_several(&self, variable: &str) -> bool {
        self.times_given(variable) > 1 || self.is_colour(variable)
    }

    fn is_colour(&self, variable: &str) -> bool {
        self.equation.index(variable) == Some(self.equation.colour)
    }

    /// How often the solution gives a variable a value.
    fn times_given(&self, variable: &str) -> usize {
        let gives = |site: &&Site| matches!(&site.what, What::Assign { name, .. } if name == variable);
        let Some(solution) = self.traced_solution() else { return 0 };
        let stages = [Stage::Vertex, Stage::Fragment].into_iter();
        stages.map(|stage| solution.stage(stage).sites().iter().filter(gives).count()).sum()
    }

    /// Whether a variable of a solution that is no list of definitions is called anything, by itself or by a line that is about it.
    pub(crate) fn is_told_apart(&self, variable: &str) -> bool {
        self.names.contains_key(variable) || self.is_judged(variable)
    }

    /// Whether what a form replaces shows in the term that the line judges: before it, or in what becomes of it. What is no
    /// term of the colour is the mistake's own affair.
    pub(crate) fn reaches(&self, form: &MistakeForm, line: &RubricItem) -> bool {
        let equation = &self.equation;
        let Some(judged) = equation.index(&line.judges) else { return true };
        if !equation.depends(equation.colour, judged) {
            return true;
        }
        let mut replaced = form.overrides.iter().map(|o| o.definition);
        replaced.any(|definition| equation.depends(judged, definition) || equation.depends(definition, judged))
    }

    /// What it means that the colour depends on a negative number raised to a power, which GLSL leaves undefined.
    pub fn undefined_power(&self) -> Option<&Mistake> {
        self.mistakes.iter().find(|mistake| mistake.undefined_power)
    }

    /// The equation with these mistakes in it; `None` if one is not known or has no such form.
    pub fn variant(&self, mistakes: &[FoundMistake]) -> Option<EquationVariant<'_>> {
        if let Some(derived) = mistakes.iter().find_map(|found| self.deriving(&found.id)) {
            return derived.assignment.variant(mistakes);
        }
        let mut variant = self.equation.right();
        for found in mistakes {
            let form = self.mistake(&found.id)?.forms.get(found.form)?;
            variant = variant.with(form, found.parameter.unwrap_or(f64::NAN));
        }
        Some(variant)
    }
}
