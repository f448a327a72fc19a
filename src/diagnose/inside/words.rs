//! What is said of a place.

use super::{Finding, Flaw};
use crate::language::Text;
use reference::Assignment;

/// Numbers are written with so many places behind the point, so that a cosine can be told from another.
const PLACES: usize = 3;

/// What is said of a line that gives a variable another value than one that belongs to a sum.
pub fn overwrites(line: u32, name: &Option<String>) -> Text {
    Text::new(
        format!(
            "Line {line} writes over what{} held before: does that not belong to the sum as well?",
            named(name, "", "").0
        ),
        format!(
            "{line} 行目で、それまでの{}値が上書きされています。その値も和に含まれるはずです。",
            named(name, "", "の").1
        ),
    )
}

/// That a line writes over what is right.
pub fn left_behind(line: u32, name: &Option<String>) -> Text {
    let (en, ja) = (named(name, "", "").0, named(name, "", "の").1);
    Text::new(
        format!("Line {line} writes over what{en} held before. Is that line still needed?"),
        format!("{line} 行目で、それまでの{ja}値が上書きされています。この行は、まだ必要でしょうか。"),
    )
}

impl Finding {
    /// Where to look, and what is not right there. `name`: what a definition is called.
    pub fn sentence(&self, assignment: &Assignment) -> Text {
        let line = self.line;
        let means = self.quantity.as_deref().and_then(|quantity| meaning(assignment, quantity));
        match &self.flaw {
            Flaw::Lacks(missing) => lacks(assignment, line, self.name.as_deref(), missing),
            Flaw::Overwrites => overwrites(line, &self.name),
            Flaw::ThrownAway => Text::new(
                format!(
                    "The result of line {line} is thrown away: a function gives a new value, and leaves what it is given as it is."
                ),
                format!(
                    "{line} 行目の結果は、どこにも代入されていません。関数は新しい値を返すだけで、引数に渡した変数の値は変わりません。"
                ),
            ),
            Flaw::Condition => Text::new(
                format!(
                    "Look at the condition on line {line}: there are places where it decides the other way than it should."
                ),
                format!("{line} 行目の条件を見てみましょう。本来と逆に判定されるところがあります。"),
            ),
            Flaw::Interpolation => Text::new(
                format!("What is declared on line {line} is interpolated in another way than it should be."),
                format!("{line} 行目の宣言では、補間のしかたが違います。"),
            ),
            Flaw::Value => self.value(means),
        }
    }

    fn value(&self, means: Option<Text>) -> Text {
        let line = self.line;
        let Some(name) = &self.name else {
            let what = match &means {
                Some(means) => Text::new(
                    format!("Look at line {line}: what should be {} is not right there", means.en),
                    format!("{line} 行目を見てみましょう。{}になるはずの値が正しくありません", means.ja),
                ),
                None => Text::new(
                    format!("Look at line {line}: a value that is computed there is not what it should be"),
                    format!("{line} 行目を見てみましょう。そこで計算している値が正しくありません"),
                ),
            };
            return self.with_numbers(what);
        };
        let what = match (self.is_use, &means) {
            (false, Some(means)) => Text::new(
                format!("The value of `{name}` on line {line} should be {}, and is not", means.en),
                format!("{line} 行目の `{name}` は{}になるはずですが、正しくありません", means.ja),
            ),
            (false, None) => Text::new(
                format!("The value of `{name}` on line {line} is not what it should be"),
                format!("{line} 行目の `{name}` の値が正しくありません"),
            ),
            (true, Some(means)) => Text::new(
                format!("Where line {line} uses `{name}`, it needs {}", means.en),
                format!("{line} 行目で `{name}` を使っているところに必要なのは、{}です", means.ja),
            ),
            (true, None) => Text::new(
                format!("Where line {line} uses `{name}`, another value is needed"),
                format!("{line} 行目で `{name}` を使っているところには、別の値が必要です"),
            ),
        };
        self.with_numbers(what)
    }

    /// With what it should be and what it is at a place, where that can be read.
    fn with_numbers(&self, what: Text) -> Text {
        let Some([expected, found]) = self.numbers() else {
            return Text::new(format!("{}.", what.en), format!("{}。", what.ja));
        };
        Text::new(
            format!("{}: at one place it should be {expected}, and is {found}.", what.en),
            format!("{}。ある場所では {expected} になるはずですが、{found} になっています。", what.ja),
        )
    }

    /// What the value should be at a place that shows it, and what it is there; `None` where it is long, or no number.
    pub fn numbers(&self) -> Option<[String; 2]> {
        let is_short = (1..=4).contains(&self.expected.len());
        let is_finite = self.expected.iter().chain(&self.found).all(|number| number.is_finite());
        let [expected, found] = [&self.expected, &self.found].map(|numbers| written(numbers));
        (is_short && is_finite && expected != found).then_some([expected, found])
    }
}

/// A name with a space before it, and in Japanese what follows it.
fn named(name: &Option<String>, en: &str, ja: &str) -> (String, String) {
    name.as_ref().map_or_else(Default::default, |name| (format!(" `{name}`{en}"), format!(" `{name}` {ja}")))
}

fn lacks(assignment: &Assignment, line: u32, name: Option<&str>, missing: &[String]) -> Text {
    let known: Option<Vec<Text>> = missing.iter().map(|name| meaning(assignment, name)).collect();
    let of = name.map_or_else(Default::default, |name| (format!(" `{name}`"), format!(" `{name}` の")));
    let Some(known) = known.filter(|known| !known.is_empty()) else {
        return Text::new(
            format!("Something is missing in the sum{} on line {line}.", of.0),
            format!("{line} 行目の{}和に、足りない項があります。", of.1),
        );
    };
    let ja = known.iter().map(|text| text.ja.as_str()).collect::<Vec<_>>().join("と");
    let en: Vec<&str> = known.iter().map(|text| text.en.as_str()).collect();
    let en = match &en[..] {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => en.concat(),
    };
    Text::new(
        format!("The sum{} on line {line} lacks {en}.", of.0),
        format!("{line} 行目の{}和に、{ja}が入っていません。", of.1),
    )
}

/// What a definition or a variable of the solution means, or what the lecture calls it.
pub(super) fn meaning(assignment: &Assignment, name: &str) -> Option<Text> {
    assignment.names.get(name)?.said().map(Text::from)
}

fn written(numbers: &[f64]) -> String {
    let number = |number: &f64| {
        let scale = 10_f64.powi(PLACES as i32);
        let rounded = (number * scale).round() / scale;
        format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
    };
    let all: Vec<String> = numbers.iter().map(number).collect();
    if let [only] = all.as_slice() { only.clone() } else { format!("({})", all.join(", ")) }
}
