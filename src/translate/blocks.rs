//! Blocks of uniforms that the homework lays out by `std140`: a program fills them byte by byte, as the homework declares them, whatever
//! a student's shader calls their members.

use super::interface::{LinkedInterface, place, unset_uniform};
use super::spirv::DeclaredUniform;
use super::uniforms::{UniformBlock, UniformMember};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Source;
use naga::{ScalarKind, TypeInner, VectorSize};
use reference::Assignment;
use reference::interpreter::{BlockPlace, Scalar, Type, std140};
use std::collections::{BTreeMap, HashMap};

/// A scalar, vector or matrix in such a block, as the program fills it.
#[derive(Clone, Debug)]
pub struct PlacedUniform {
    /// Its path in the homework.
    pub path: String,
    /// Its type there.
    pub kind: Type,
    /// Where it lies.
    pub place: BlockPlace,
}

impl PlacedUniform {
    /// All of a homework's.
    pub(super) fn of(assignment: &Assignment) -> Vec<Self> {
        let all = assignment.interface.uniforms.iter();
        all.filter_map(|own| Some(Self { path: own.path.clone(), kind: own.kind.clone(), place: own.place.clone()? }))
            .collect()
    }

    /// Its numbers as the bytes of the block hold them, a matrix column by column.
    fn members(&self) -> Vec<UniformMember> {
        let member = |path: String, offset: u32, scalar: Scalar, count: u8| UniformMember {
            path,
            alias: None,
            offset,
            ty: inner(scalar, count),
        };
        let begin = self.place.offset;
        match self.kind {
            Type::Vector(scalar, count) => vec![member(self.path.clone(), begin, scalar, count)],
            Type::Matrix(scalar, _, rows) => {
                let starts = std140::numbers(&self.kind).into_iter().step_by(usize::from(rows)).enumerate();
                starts
                    .map(|(column, at)| member(format!("{}[{column}]", self.path), begin + at, scalar, rows))
                    .collect()
            }
            _ => Vec::new(),
        }
    }
}

/// A vector as a block holds it, where a truth value is a whole number.
fn inner(scalar: Scalar, count: u8) -> TypeInner {
    let scalar = match scalar {
        Scalar::Float => naga::Scalar::F32,
        Scalar::Double => naga::Scalar::F64,
        Scalar::Int => naga::Scalar::I32,
        _ => naga::Scalar::U32,
    };
    match count {
        2 => TypeInner::Vector { size: VectorSize::Bi, scalar },
        3 => TypeInner::Vector { size: VectorSize::Tri, scalar },
        4 => TypeInner::Vector { size: VectorSize::Quad, scalar },
        _ => TypeInner::Scalar(scalar),
    }
}

/// A member of a student's block that does not lie where the homework has one of its name and kind.
#[derive(Clone, Debug)]
pub struct Misplaced {
    block: String,
    /// The student's member.
    own: String,
    /// What the program writes there, by its path in the homework.
    there: Option<String>,
    /// Whether what lies there is no value of such a type, or the program's value of that name lies elsewhere and nothing does here.
    is_wrong: bool,
}

/// What numbers of a kind are as bits.
fn kind_of(kind: ScalarKind, width: u8) -> (bool, u8) {
    (kind == ScalarKind::Float, width)
}

/// Lets the program fill the blocks as the homework lays them out; what lies elsewhere in a student's, the worst of each block.
pub(super) fn lay_out(blocks: &mut [UniformBlock], placed: &[PlacedUniform]) -> Vec<Misplaced> {
    let mut all = Vec::new();
    for block in blocks.iter_mut().filter(|block| !block.is_default) {
        let known: Vec<&PlacedUniform> = placed.iter().filter(|own| own.place.block == block.name).collect();
        if known.is_empty() {
            continue;
        }
        let found = misplaced(block, &known);
        let worst = found.iter().find(|own| own.is_wrong).or_else(|| found.iter().find(|own| own.there.is_some()));
        match worst {
            Some(worst) => all.push(worst.clone()),
            None => all.extend(found),
        }
        block.members = known.iter().flat_map(|own| own.members()).collect();
    }
    all
}

fn misplaced(block: &UniformBlock, known: &[&PlacedUniform]) -> Vec<Misplaced> {
    let mut numbers: HashMap<u32, (&str, (bool, u8))> = HashMap::new();
    for own in known {
        let TypeInner::Scalar(scalar) = inner(own.kind.scalar().unwrap_or(Scalar::Float), 1) else { continue };
        let bits = kind_of(scalar.kind, scalar.width);
        numbers.extend(
            std140::numbers(&own.kind).into_iter().map(|at| (own.place.offset + at, (own.path.as_str(), bits))),
        );
    }
    let mut found = Vec::new();
    for member in &block.members {
        let Some((bits, places)) = numbers_of(member) else { continue };
        let hits: Vec<(&str, (bool, u8))> = places.iter().filter_map(|at| numbers.get(at).copied()).collect();
        let is_name = |path: &str| member.paths().any(|own| own == path || own.starts_with(&format!("{path}[")));
        let other = hits.iter().find(|(_, there)| *there != bits);
        let is_known = known.iter().any(|own| is_name(&own.path));
        let (there, is_wrong) = match (other, hits.first()) {
            (Some((path, _)), _) => (Some(*path), true),
            (None, None) => (None, is_known),
            (None, Some((path, _))) if is_known && !is_name(path) => (Some(*path), false),
            _ => continue,
        };
        let own = member.alias.as_ref().unwrap_or(&member.path).clone();
        found.push(Misplaced { block: block.name.clone(), own, there: there.map(str::to_owned), is_wrong });
    }
    found
}

/// What the numbers of a member are, and where each lies in its block.
fn numbers_of(member: &UniformMember) -> Option<((bool, u8), Vec<u32>)> {
    let (scalar, columns, rows) = match member.ty {
        TypeInner::Scalar(scalar) => (scalar, 1, 1),
        TypeInner::Vector { size, scalar } => (scalar, 1, size as u32),
        TypeInner::Matrix { columns, rows, scalar } => (scalar, columns as u32, rows as u32),
        _ => return None,
    };
    let width = u32::from(scalar.width);
    let stride = rows.next_power_of_two() * width;
    let places = (0..columns).flat_map(|column| (0..rows).map(move |row| column * stride + row * width));
    Some((kind_of(scalar.kind, scalar.width), places.map(|at| member.offset + at).collect()))
}

/// Says it, with the place in the student's file; the errors aside.
pub(super) fn told(misplaced: &[Misplaced], source: &Source, interface: &LinkedInterface) -> [Vec<Diagnostic>; 2] {
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
pub(super) fn renamed(declared: &[DeclaredUniform], placed: &[PlacedUniform], source: &Source) -> Vec<Diagnostic> {
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
    let Misplaced { block, own, there, is_wrong } = misplaced;
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
