//! Expressions of `assignment.toml`, in which the names of the solution stand.

use super::CheckedSolution;
use crate::Text;
use crate::assignment::check::{CheckResult, listed};
use crate::assignment::error;
use crate::equation::MAX_INPUTS;
use crate::interpreter::Formula;
use crate::text::both;

impl CheckedSolution<'_> {
    /// A condition on the definitions.
    pub(in crate::assignment::check) fn condition(
        &mut self,
        text: &str,
        place: &dyn Fn() -> String,
    ) -> CheckResult<Formula> {
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
    pub(in crate::assignment::check) fn parameter(&self, name: &str, place: &str) -> CheckResult<()> {
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
    pub(in crate::assignment::check) fn replacement(
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
    pub(super) fn few_enough(&self, formula: &Formula, place: &dyn Fn() -> String) -> CheckResult<()> {
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
}
