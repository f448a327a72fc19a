//! What is said of a derived mistake: made from its operator, and from what the lecture or the student calls the quantity.

use super::{OperatorText, PREFIX, RESULT, operator_of};
use crate::assignment::RubricItem;
use crate::interpreter::{DefinitionSlip, Operator, ProgramSlip};
use crate::manifest::LectureName;
use crate::mistake::{Alternative, Condition, Mistake};
use crate::text::both;
use crate::{Assignment, Text};

/// A mistake without its forms, which are those of the slips.
pub(super) fn mistake(
    assignment: &Assignment,
    operator: Operator,
    definition: usize,
    slips: &[DefinitionSlip],
) -> Mistake {
    let name = &assignment.equation.definitions[definition].name;
    let quantity = DefinitionName::of(assignment, definition);
    let said = operator_of(operator);
    let instead = slips.iter().enumerate().map(|(form, slip)| {
        let part = quantity.part(assignment, slip);
        alternative(form, said, &quantity, &part, slip.is_bound_by_zero)
    });
    let equation = &assignment.equation;
    let moves = equation.position.is_some_and(|position| equation.depends(position, definition));
    let mut mistake = Mistake { instead: instead.collect(), ..blank(assignment, said, name, &quantity) };
    mistake.keeps.retain(|(id, _)| {
        let mut lines = assignment.rubric.iter();
        moves || !lines.any(|line| line.id == *id && assignment.judges_position(line))
    });
    mistake
}

/// A mistake without its variants, which are those of the slips.
pub(super) fn of_program(assignment: &Assignment, operator: Operator, name: &str, slips: &[ProgramSlip]) -> Mistake {
    let quantity = DefinitionName::of_program(assignment, name);
    let said = operator_of(operator);
    let part = Text {
        en: format!("a value in {}", quantity.named.en),
        ja: format!("{}を求める途中の値", quantity.named.ja),
    };
    let instead = slips.iter().enumerate();
    let instead = instead.map(|(form, slip)| alternative(form, said, &quantity, &part, slip.is_bound_by_zero));
    Mistake { instead: instead.collect(), ..blank(assignment, said, name, &quantity) }
}

/// What is said of a mistake that is known by what makes it right: the operator, and the definition that it is in, where it is one.
pub(super) fn of_repair(
    assignment: &Assignment,
    operator: Operator,
    name: Option<&str>,
    is_bound_by_zero: bool,
) -> Mistake {
    let name = name.unwrap_or(RESULT);
    let quantity = DefinitionName::called(assignment, name);
    let said = operator_of(operator);
    let only = alternative(0, said, &quantity, &quantity.named, is_bound_by_zero);
    let mistake = blank(assignment, said, name, &quantity);
    let [equation, look] = [only.equation.unwrap_or_default(), only.look.unwrap_or_default()];
    Mistake { equation, look, ..mistake }
}

/// What a mistake is called that an operator makes in what has this name.
pub(super) fn title(assignment: &Assignment, said: &OperatorText, name: &str) -> Text {
    DefinitionName::called(assignment, name).titled(said)
}

fn alternative(
    form: usize,
    said: &OperatorText,
    quantity: &DefinitionName,
    part: &Text,
    is_bound_by_zero: bool,
) -> Alternative {
    let bounded = said.bounded.as_ref().filter(|_| is_bound_by_zero);
    let special = bounded.or(said.whole.as_ref().filter(|_| quantity.is_everything));
    let equation = special.map_or(&said.equation, |special| &special.equation);
    let look = special.map_or(&said.look, |special| &special.look);
    Alternative {
        when: vec![Condition::Forms(vec![form])],
        seen: None,
        equation: Some(filled(equation, &quantity.plain, &quantity.plain)),
        look: Some(filled(look, &quantity.named, part)),
    }
}

fn blank(assignment: &Assignment, said: &OperatorText, name: &str, quantity: &DefinitionName) -> Mistake {
    let keeps = assignment.rubric.iter().map(|line| (line.id.clone(), said.keeps));
    Mistake {
        id: format!("{PREFIX}{}-{name}", said.id),
        title: quantity.titled(said),
        keeps: keeps.collect(),
        forms: Vec::new(),
        variants: Vec::new(),
        fit: None,
        handed_out: false,
        is_general: false,
        undefined_power: false,
        at_use: false,
        needs: Vec::new(),
        lacks: Vec::new(),
        seen: quantity.seen(),
        equation: said.equation.clone(),
        look: said.look.clone(),
        instead: Vec::new(),
    }
}

/// What a definition is called.
struct DefinitionName {
    /// Without the student's own name for it.
    plain: Text,
    /// With it.
    named: Text,
    /// By itself, in few words.
    called: Option<Text>,
    /// Whether it is called anything.
    is_known: bool,
    /// Whether it is all that is computed.
    is_everything: bool,
}

impl DefinitionName {
    /// That with this name, a definition or a variable of a program.
    fn called(assignment: &Assignment, name: &str) -> Self {
        match assignment.equation.index(name) {
            Some(definition) => Self::of(assignment, definition),
            None => Self::of_program(assignment, name),
        }
    }

    /// What a mistake in it is called. The solution's own names say nothing to a student.
    fn titled(&self, said: &OperatorText) -> Text {
        let Text { en, ja } = &said.title;
        match &self.called {
            Some(called) => Text { en: format!("{en} ({})", called.en), ja: format!("{ja} ({})", called.ja) },
            None => said.title.clone(),
        }
    }

    fn of(assignment: &Assignment, definition: usize) -> Self {
        let name = &assignment.equation.definitions[definition].name;
        let own = assignment.names.get(name);
        let said = own.and_then(LectureName::said);
        let plain = said.clone().unwrap_or_else(|| of_line(assignment, definition));
        let named = Text {
            en: format!("{}⟨ ({{{name}}})⟩", plain.en),
            ja: format!("{}⟨ ({{{name}}}) ⟩", plain.ja.trim_end()),
        };
        // A symbol by itself is a name.
        let is_symbol = own.is_some_and(|own| own.means.is_none()) && said.is_some();
        let line = || line_of(assignment, definition).map(|line| line.label.clone());
        Self {
            named: if is_symbol || plain.en.starts_with('⟨') { plain.clone() } else { named },
            plain,
            called: own.and_then(LectureName::in_few_words).or_else(line),
            is_known: said.is_some() || judging(assignment, definition).next().is_some(),
            is_everything: false,
        }
    }

    /// A variable of a program, which the lecture has a name for, or of which nothing is told apart but by the lines of the rubric
    /// that are about it.
    fn of_program(assignment: &Assignment, name: &str) -> Self {
        let own = assignment.names.get(name);
        let about: Vec<&RubricItem> = assignment.lines_about(name).collect();
        let only = match (&about[..], &assignment.rubric[..]) {
            ([line], _) => Some(*line),
            (_, [line]) => Some(line),
            _ => None,
        };
        let known = own.and_then(LectureName::said).or_else(|| only.map(part_called));
        let is_everything = known.is_none();
        // The student's own name for what is computed there says most where there is no other.
        let plain = known.unwrap_or_else(own_name);
        let named = Text {
            en: format!("{}⟨ (here `{{name}}`)⟩", plain.en),
            ja: format!("{}⟨（ここでは `{{name}}`）⟩", plain.ja),
        };
        Self {
            named: if is_everything { plain.clone() } else { named },
            plain,
            called: own.and_then(LectureName::in_few_words).or_else(|| only.map(|line| line.label.clone())),
            is_known: true,
            is_everything,
        }
    }

    fn seen(&self) -> Text {
        if self.is_everything {
            return both("The result is not the right one.", "結果が正しいものと違います。");
        }
        Text {
            en: format!("The result is not the right one where {} counts.", self.plain.en),
            ja: format!("{}が効くところで、結果が正しいものと違います。", self.plain.ja.trim_start()),
        }
    }

    /// What of the quantity is concerned: all of it, a value that goes into it, or some part.
    fn part(&self, assignment: &Assignment, slip: &DefinitionSlip) -> Text {
        if slip.is_whole || !self.is_known {
            return self.named.clone();
        }
        let Text { en, ja } = &self.named;
        match slip.about.as_deref().and_then(|about| value_called(assignment, about)) {
            Some(value) => Text { en: format!("{} in {en}", value.en), ja: format!("{ja}に使う{}", value.ja) },
            None => Text { en: format!("a value in {en}"), ja: format!("{ja}を求める途中の値") },
        }
    }
}

/// What a definition without a name of the lecture's is part of.
fn of_line(assignment: &Assignment, definition: usize) -> Text {
    let equation = &assignment.equation;
    if let Some(line) = line_of(assignment, definition) {
        return part_called(line);
    }
    let judged = |line: &&RubricItem| equation.index(&line.judges);
    let mut lines = assignment.rubric.iter();
    // One line of several does not stand for the whole colour.
    let is_only = assignment.rubric.iter().filter(|line| !assignment.judges_position(line)).count() == 1;
    let is_of_term = |line: &&RubricItem| {
        let is_part = |judged| is_only || judged != equation.colour;
        judged(line).is_some_and(|judged| is_part(judged) && equation.depends(judged, definition))
    };
    if let Some(line) = lines.find(is_of_term) {
        return Text {
            en: format!("a value of the part “{}”", line.label.en),
            ja: format!("{}に使う値", quoted(&line.label.ja)),
        };
    }
    match definition == equation.colour {
        true => Text { en: "the colour".into(), ja: "色".into() },
        false => own_name(),
    }
}

/// What the student calls it, or else the result.
fn own_name() -> Text {
    both("⟨`{name}`|the result⟩", "⟨`{name}` |結果⟩")
}

/// The only line that judges a definition, or that is about it.
fn line_of<'a>(assignment: &'a Assignment, definition: usize) -> Option<&'a RubricItem> {
    let only = |lines: Vec<&'a RubricItem>| if let [line] = lines[..] { Some(line) } else { None };
    let about = || assignment.lines_about(&assignment.equation.definitions[definition].name).collect();
    only(judging(assignment, definition).collect()).or_else(|| only(about()))
}

/// The lines that judge a definition, but for those that judge a feature of all that is seen, beside its terms.
fn judging(assignment: &Assignment, definition: usize) -> impl Iterator<Item = &RubricItem> {
    let judges_it = move |line: &&RubricItem| assignment.equation.index(&line.judges) == Some(definition);
    assignment.rubric.iter().filter(judges_it).filter(|line| !assignment.is_beside_terms(line))
}

fn part_called(line: &RubricItem) -> Text {
    Text { en: format!("the part “{}”", line.label.en), ja: format!("{}の部分", quoted(&line.label.ja)) }
}

/// In Japanese quotation marks. A label that is a name of the program's has them already.
fn quoted(label: &str) -> String {
    if label.starts_with('「') { label.to_owned() } else { format!("「{label}」") }
}

/// A value by its name in the solution, where it is called anything.
fn value_called(assignment: &Assignment, name: &str) -> Option<Text> {
    if let Some(definition) = assignment.equation.index(name) {
        return Some(DefinitionName::of(assignment, definition))
            .filter(|quantity| quantity.is_known)
            .map(|it| it.named);
    }
    let constant = assignment.constants.iter().find(|constant| constant.name == name)?;
    let Text { en, ja } = &constant.means;
    Some(Text { en: format!("the {en}⟨ ({{{name}}})⟩"), ja: format!("{ja}⟨ ({{{name}}}) ⟩") })
}

fn filled(text: &Text, quantity: &Text, part: &Text) -> Text {
    let en = text.en.replace("{quantity}", &quantity.en).replace("{part}", &part.en);
    let en = en.replace("{Quantity}", &capital(&quantity.en)).replace("{Part}", &capital(&part.en));
    let ja = |name: &str, with: &Text, text: String| text.replace(&format!("{{{name}}}"), &with.ja);
    let mut japanese = text.ja.clone();
    for (name, with) in [("quantity", quantity), ("Quantity", quantity), ("part", part), ("Part", part)] {
        japanese = ja(name, with, japanese);
    }
    Text { en, ja: japanese.trim_start().to_owned() }
}

/// With a capital letter at the beginning. A symbol, which is one word, stays as the lecture writes it: d is not D.
fn capital(text: &str) -> String {
    if let Some((name, instead)) = text.strip_prefix('⟨').and_then(|text| text.split_once('|')) {
        return format!("⟨{name}|{}", capital(instead));
    }
    let name = text.split_once('⟨').map_or(text, |(name, _)| name);
    if !name.contains(' ') {
        return text.to_owned();
    }
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
