//! What a line of the rubric says: what is seen, which equation it breaks, where to look.

use super::constants::ChangedConstant;
use super::locate::{self, Located};
use super::{Cause, Evidence, Hints};
use crate::language::Text;
use crate::report::FrameResult;
use crate::translate::NO_LINE;
use reference::assignment::RubricLine;
use reference::fit::Worst;
use reference::mistake::Mistake;
use reference::probes::Region;

/// A message and the line of the student's file that it speaks of.
pub(super) struct Told {
    pub text: Text,
    pub line: Option<u32>,
}

/// The message for a line of the rubric that these mistakes cost points.
pub(super) fn tell(evidence: &Evidence<'_>, line: &RubricLine, cause: &Cause, culprits: &[&str]) -> Told {
    let told: Vec<Told> = culprits
        .iter()
        .filter_map(|id| evidence.assignment.mistake(id))
        .map(|mistake| of_mistake(evidence, line, cause, mistake))
        .collect();
    if told.is_empty() {
        return Told { text: agreement(evidence, line), line: None };
    }
    let join = |language: fn(&Text) -> &String, space| {
        told.iter().map(|told| language(&told.text).as_str()).collect::<Vec<_>>().join(space)
    };
    Told {
        text: Text::new(join(|text| &text.en, " "), join(|text| &text.ja, "")),
        line: told.iter().find_map(|told| told.line),
    }
}

fn of_mistake(evidence: &Evidence<'_>, line: &RubricLine, cause: &Cause, mistake: &Mistake) -> Told {
    let blanks = Blanks::of(evidence, line, cause, mistake);
    let values: Vec<(&str, &str)> = blanks.values.iter().map(|(name, value)| (*name, value.as_str())).collect();
    let mut parts = vec![&mistake.seen];
    if evidence.hints >= Hints::Gentle {
        parts.push(&mistake.equation);
    }
    if evidence.hints >= Hints::Full {
        parts.push(&mistake.look);
    }
    let filled: Vec<reference::Text> = parts.iter().map(|part| part.fill(&values)).collect();
    let join = |language: fn(&reference::Text) -> &String, space| {
        filled.iter().map(|part| language(part).as_str()).collect::<Vec<_>>().join(space)
    };
    let mut text = Text::new(join(|text| &text.en, " "), join(|text| &text.ja, ""));
    if let Some(worst) = &blanks.worst {
        let place = region(worst.region);
        text.en = format!("{} ({}.)", text.en, place.en);
        text.ja = format!("{}({})", text.ja, place.ja);
    }
    Told { text, line: (evidence.hints >= Hints::Full).then_some(blanks.line).flatten() }
}

/// What the placeholders of a mistake's texts stand for in this file.
#[derive(Default)]
struct Blanks {
    values: Vec<(&'static str, String)>,
    line: Option<u32>,
    worst: Option<Worst>,
}

impl Blanks {
    fn of(evidence: &Evidence<'_>, line: &RubricLine, cause: &Cause, mistake: &Mistake) -> Self {
        let mut blanks = Self::default();
        match (cause, mistake.id.as_str()) {
            (Cause::Known { constants, .. }, super::CONSTANTS_CHANGED) => {
                let of_line = |changed: &&ChangedConstant| super::belongs(evidence.assignment, &changed.name, line);
                blanks.constant(constants.iter().find(of_line));
            }
            (Cause::Unexplained(terms), _) => {
                let worst = terms.iter().find(|term| term.line == line.id).and_then(|term| term.worst);
                blanks.worst(worst);
            }
            (Cause::Known { found, .. }, id) => {
                let met = evidence.undefined.filter(|line| id == super::UNDEFINED_POWER && *line != NO_LINE);
                let met = met.map(|line| Located { line, name: None });
                blanks.place(met.or_else(|| locate::find(evidence.source, &mistake.near)));
                let parameter = found.iter().find(|found| found.id == id).and_then(|found| found.parameter);
                blanks.parameter(parameter, evidence);
            }
            _ => {
                if evidence.frames.iter().all(FrameResult::agrees) {
                    blanks.values.push(("frames", evidence.frames.len().to_string()));
                }
                blanks.place(locate::find(evidence.source, &mistake.near));
            }
        }
        blanks
    }

    fn place(&mut self, located: Option<Located>) {
        let Some(Located { line, name }) = located else { return };
        self.line = Some(line);
        self.values.push(("line", line.to_string()));
        self.values.extend(name.map(|name| ("name", name)));
    }

    fn constant(&mut self, changed: Option<&ChangedConstant>) {
        let Some(changed) = changed else { return };
        self.line = Some(changed.line);
        self.values.push(("line", changed.line.to_string()));
        self.values.push(("name", changed.name.clone()));
        self.values.push(("expected", numbers(&changed.expected.numbers())));
        self.values.push(("found", numbers(&changed.found.numbers())));
    }

    fn parameter(&mut self, parameter: Option<f64>, evidence: &Evidence<'_>) {
        let Some(parameter) = parameter else { return };
        self.values.push(("found", number(parameter)));
        // The only scalar among the constants is what the exponent should be.
        let scalar = evidence.assignment.constants.iter().find(|constant| constant.kind == reference::Type::Float);
        self.values.extend(scalar.map(|constant| ("expected", number(constant.value.float()))));
    }

    fn worst(&mut self, worst: Option<Worst>) {
        let Some(worst) = worst else { return };
        self.values.push(("expected", numbers(&worst.expected.to_array())));
        self.values.push(("found", numbers(&worst.found.to_array())));
        self.worst = Some(worst);
    }
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(", ")
}

/// Three significant places behind the point at most; what is no number is called by its name.
fn number(value: f64) -> String {
    if value.is_nan() {
        return "NaN".into();
    }
    if value.is_infinite() {
        return if value > 0.0 { "+∞".into() } else { "−∞".into() };
    }
    let rounded = (value * 1000.0).round() / 1000.0;
    // No minus before a zero.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

/// Where a probe lies with respect to light and eye.
fn region(region: Region) -> Text {
    match region {
        Region::AmbientOnly => Text::new(
            "Seen where the light is behind the surface and nothing shines",
            "光が面の裏側から当たり、ハイライトもないところ",
        ),
        Region::FacingAway => Text::new(
            "Seen where light and half vector are behind the surface",
            "光も中間ベクトルも面の裏側にあるところ",
        ),
        Region::DiffuseOnly => Text::new(
            "Seen where the light falls on the surface, away from the highlight",
            "光が当たり、ハイライトから離れたところ",
        ),
        Region::Highlight => Text::new("Seen in the highlight", "ハイライトのところ"),
        Region::HighlightBehind => Text::new(
            "Seen where N·L is not above 0 and N·H is large, for points behind the eye",
            "N·L が 0 以下で N·H が大きいところ(視点より後ろの点)",
        ),
        Region::Between => Text::new("Seen at the highlight's rim", "ハイライトの縁のところ"),
    }
}

/// Right answers get more than silence.
fn agreement(evidence: &Evidence<'_>, line: &RubricLine) -> Text {
    let frames = evidence.frames.len();
    let probes = evidence.probes.probes.len();
    if line.id == super::SHAPE {
        return Text::new(
            format!("The triangle stands where it should in all {frames} frames."),
            format!("{frames} 枚の画像すべてで、三角形の位置と形が一致しています。"),
        );
    }
    Text::new(
        format!("It agrees wherever it shows among {probes} probes."),
        format!("{probes} 点の検査点のうち、この項が現れるすべての点で一致しています。"),
    )
}
