//! What is said of a student's block that is not laid out as the homework's is.

use super::{Misplaced, PlacedUniform};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Source;
use crate::translate::interface::{LinkedInterface, place, unset_uniform};
use crate::translate::spirv::DeclaredUniform;
use std::collections::BTreeMap;

/// Says it, with the place in the student's file; the errors aside.
pub(in crate::translate) fn told(
    misplaced: &[Misplaced],
    source: &Source,
    interface: &LinkedInterface,
) -> [Vec<Diagnostic>; 2] {
    let [mut errors, mut notes] = [Vec::new(), Vec::new()];
    for own in misplaced {
        match (&own.there, own.is_wrong) {
            (None, false) => notes.push(unset_uniform(source, &own.own, interface)),
            (_, true) => errors.push(elsewhere(own, source)),
            (Some(_), false) => notes.push(elsewhere(own, source)),
        }
    }
    [errors, notes]
}

/// Says which blocks have another name than that by which a program finds them to fill them.
pub(in crate::translate) fn renamed(
    declared: &[DeclaredUniform],
    placed: &[PlacedUniform],
    source: &Source,
) -> Vec<Diagnostic> {
    let block = |own: &DeclaredUniform| own.path.split('.').next().unwrap_or_default().to_owned();
    let in_blocks = || declared.iter().filter(|own| own.is_in_block);
    let mut found: BTreeMap<String, &str> = BTreeMap::new();
    for own in in_blocks() {
        let meant = placed.iter().find(|known| Some(known.path.as_str()) == own.own_name());
        let is_there = |name: &str| in_blocks().any(|other| block(other) == name);
        if let Some(name) = meant.map(|known| known.place.block.as_str()).filter(|name| !is_there(name)) {
            found.insert(block(own), name);
        }
    }
    let told = |(own, name): (String, &str)| {
        let text = Text::new(
            format!(
                "the program finds the block `{name}` by its name, and `{own}` is another one: OpenGL leaves it empty"
            ),
            format!(
                "プログラムはブロック `{name}` を名前で探します。`{own}` は別の名前なので、OpenGL では値が入りません"
            ),
        );
        let diagnostic = place(Diagnostic::warning(DiagnosticStage::Interface, text), source, &own);
        diagnostic.hint(Text::new(
            format!("Call the block `{name}`, as in the handed-out file. The name of its instance is free."),
            format!(
                "ブロックの名前を、配布されたファイルと同じ `{name}` にしてください。インスタンスの名前は自由です。"
            ),
        ))
    };
    found.into_iter().map(told).collect()
}

fn elsewhere(misplaced: &Misplaced, source: &Source) -> Diagnostic {
    let Misplaced { block, own, there, is_wrong, is_transposed } = misplaced;
    if *is_transposed {
        return transposed(own, source);
    }
    let text = match there {
        Some(there) if *is_wrong => Text::new(
            format!("`{own}` lies in the block `{block}` where the program writes `{there}`, a value of another type"),
            format!("`{own}` は、ブロック `{block}` の中で、プログラムが型の違う `{there}` を書き込む位置にあります"),
        ),
        Some(there) => Text::new(
            format!("`{own}` lies in the block `{block}` where the program writes `{there}`, and has that value"),
            format!(
                "`{own}` は、ブロック `{block}` の中で、プログラムが `{there}` を書き込む位置にあり、その値になります"
            ),
        ),
        None => Text::new(
            format!("`{own}` lies in the block `{block}` where the program writes nothing"),
            format!("`{own}` は、ブロック `{block}` の中で、プログラムが何も書き込まない位置にあります"),
        ),
    };
    let diagnostic = match is_wrong {
        true => Diagnostic::error(DiagnosticStage::Interface, text),
        false => Diagnostic::warning(DiagnosticStage::Interface, text),
    };
    place(diagnostic, source, own).hint(Text::new(
        "A `std140` block is filled byte by byte, as the handed-out file declares it: its members need that order and those types. Their names \
         may be others.",
        "`std140` のブロックには、配布されたファイルの宣言どおりにバイト単位で値が書き込まれます。メンバの順序と型は同じにしてください。名前は変えてもかまいません。",
    ))
}

fn transposed(own: &str, source: &Source) -> Diagnostic {
    let text = Text::new(
        format!(
            "`{own}` is read from its block row by row (`row_major`), and the program writes it column by column: here it is transposed"
        ),
        format!(
            "`{own}` は、ブロックから行ごとに読まれます (`row_major`)。プログラムは列ごとに書き込むので、ここでは転置行列になります"
        ),
    );
    place(Diagnostic::warning(DiagnosticStage::Interface, text), source, own)
}
