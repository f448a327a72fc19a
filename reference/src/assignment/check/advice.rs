//! What is said of right answers that would break elsewhere.

use super::CheckResult;
use super::solution::CheckedSolution;
use crate::advice::{Advice, Circumstance};
use crate::assignment::{Constant, Interface, error};
use crate::equation::Reads;
use crate::text::both;
use crate::{Value, manifest};

/// An entry whose names are known.
pub(super) fn advice(
    entry: manifest::AdviceEntry,
    interface: &Interface,
    constants: &[Constant],
    solution: &CheckedSolution<'_>,
) -> CheckResult<Advice> {
    let place = format!("advice `{}`", entry.id);
    for definition in &entry.about {
        solution.definition(definition, &|| place.clone())?;
    }
    if solution.reads() != Reads::Attributes {
        let message = both(
            "advice varies what a vertex stage of definitions is given, and this solution is none: remove it",
            "advice は、定義からなる頂点シェーダに与える値を変えて調べます。この解答には使えません。取り除いてください",
        );
        return Err(error(place, message));
    }
    let manifest::CircumstanceEntry { scaled, stretched, constants: changed } = entry.when;
    if let Some(name) = scaled.keys().find(|name| !interface.inputs.iter().any(|input| input.name == **name)) {
        return Err(error(
            place,
            both(
                format!("there is no input `{name}`: add it, or correct the name"),
                format!("入力 `{name}` はありません。追加するか、名前を直してください"),
            ),
        ));
    }
    let value = |(name, numbers): (String, Vec<f64>)| {
        let constant = constants.iter().find(|constant| constant.name == name);
        let value = constant.and_then(|constant| Value::new(constant.value.kind().clone(), numbers.clone()));
        let wrong = || {
            let count = numbers.len();
            error(
                &place,
                both(
                    format!("there is no constant `{name}` with {count} numbers"),
                    format!("数が {count} 個の定数 `{name}` はありません"),
                ),
            )
        };
        value.map(|value| (name.clone(), value)).ok_or_else(wrong)
    };
    let constants = changed.into_iter().map(value).collect::<CheckResult<Vec<_>>>()?;
    if scaled.is_empty() && stretched.is_none() && constants.is_empty() {
        return Err(error(
            place,
            both(
                "`when` changes nothing: write what is different",
                "`when` で変わるものがありません。何が異なるかを書いてください",
            ),
        ));
    }
    Ok(Advice {
        id: entry.id,
        when: Circumstance { scaled: scaled.into_iter().collect(), stretched, constants },
        about: entry.about,
        only_about: entry.only_about,
        message: entry.message,
    })
}
