//! Blocks of uniforms that the homework lays out by `std140`: a program fills them byte by byte, as the homework declares them, whatever
//! a student's shader calls their members.

mod wording;

use super::spirv::DeclaredUniform;
use super::uniforms::{UniformBlock, UniformMember};
use naga::{ScalarKind, TypeInner, VectorSize};
use reference::Assignment;
use reference::interpreter::{BlockPlace, Scalar, Type};
use std::collections::HashMap;
pub(super) use wording::{renamed, told};

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

    /// Its numbers where the bytes of the block hold them, a matrix column by column.
    fn members(&self) -> Vec<UniformMember> {
        let places = self.place.numbers(&self.kind);
        let whole = |path: String, offset: u32, scalar: Scalar, count: u8| UniformMember {
            path,
            alias: None,
            offset,
            ty: inner(scalar, count),
        };
        match self.kind {
            Type::Vector(scalar, count) => vec![whole(self.path.clone(), self.place.offset, scalar, count)],
            Type::Matrix(scalar, _, rows) if !self.place.is_row_major => {
                let starts = places.into_iter().step_by(usize::from(rows)).enumerate();
                starts.map(|(column, at)| whole(format!("{}[{column}]", self.path), at, scalar, rows)).collect()
            }
            _ => (0..places.len()).filter_map(|number| self.number(number, places[number])).collect(),
        }
    }

    /// One of its numbers, at this byte.
    fn number(&self, number: usize, offset: u32) -> Option<UniformMember> {
        let path = match self.kind {
            Type::Vector(_, 1) => self.path.clone(),
            Type::Vector(..) => format!("{}[{number}]", self.path),
            Type::Matrix(_, _, rows) => {
                format!("{}[{}][{}]", self.path, number / usize::from(rows), number % usize::from(rows))
            }
            _ => return None,
        };
        Some(UniformMember { path, alias: None, offset, ty: inner(self.kind.scalar()?, 1) })
    }
}

/// A scalar, vector or matrix in a student's block.
struct BlockPart<'b> {
    declared: &'b DeclaredUniform,
    /// What its numbers are as bits.
    bits: (bool, u8),
    /// Where each of them lies in the module, in the order of [`DeclaredUniform::places`]: columns after columns.
    in_module: Vec<u32>,
}

impl<'b> BlockPart<'b> {
    /// Those of a block.
    fn all(block: &UniformBlock, declared: &'b [DeclaredUniform]) -> Vec<Self> {
        let is_inside = |own: &&DeclaredUniform| {
            own.is_in_block && own.path.strip_prefix(&block.name).is_some_and(|rest| rest.starts_with('.'))
        };
        let part = |declared: &'b DeclaredUniform| {
            // The columns of a matrix of two rows lie in an array.
            let is_its = |member: &&UniformMember| {
                member.path.strip_prefix(&declared.path).is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
            };
            let members: Vec<_> = block.members.iter().filter(is_its).filter_map(numbers_of).collect();
            let bits = members.first()?.0;
            let in_module: Vec<u32> = members.into_iter().flat_map(|(_, places)| places).collect();
            (in_module.len() == declared.places.len()).then_some(Self { declared, bits, in_module })
        };
        declared.iter().filter(is_inside).filter_map(part).collect()
    }

    /// Whether the module has it where OpenGL reads it.
    fn is_in_place(&self) -> bool {
        self.in_module == self.declared.places
    }

    /// The program's values of its numbers, each where the module reads it.
    fn filled(&self, known: &[&PlacedUniform]) -> Vec<UniformMember> {
        let of_number = |(at, offset): (&u32, &u32)| {
            known.iter().find_map(|own| {
                let number = own.place.numbers(&own.kind).iter().position(|place| place == at)?;
                own.number(number, *offset)
            })
        };
        self.declared.places.iter().zip(&self.in_module).filter_map(of_number).collect()
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
    /// Whether it lies there with rows and columns exchanged.
    is_transposed: bool,
}

/// What numbers of a kind are as bits.
fn kind_of(kind: ScalarKind, width: u8) -> (bool, u8) {
    (kind == ScalarKind::Float, width)
}

/// Lets the program fill the blocks as the homework lays them out; what lies elsewhere in a student's, the worst of each block.
pub(super) fn lay_out(
    blocks: &mut [UniformBlock],
    declared: &[DeclaredUniform],
    placed: &[PlacedUniform],
) -> Vec<Misplaced> {
    let mut all = Vec::new();
    for block in blocks.iter_mut().filter(|block| !block.is_default) {
        let known: Vec<&PlacedUniform> = placed.iter().filter(|own| own.place.block == block.name).collect();
        if known.is_empty() {
            continue;
        }
        let parts = BlockPart::all(block, declared);
        let found = misplaced(&block.name, &parts, &known);
        let worst = found.iter().find(|own| own.is_wrong).or_else(|| found.iter().find(|own| own.there.is_some()));
        match worst {
            Some(worst) => all.push(worst.clone()),
            None => all.extend(found),
        }
        // A layout may say where a member lies, or that rows lie before columns. The module knows neither.
        block.members = match parts.iter().all(BlockPart::is_in_place) {
            true => known.iter().flat_map(|own| own.members()).collect(),
            false => parts.iter().flat_map(|part| part.filled(&known)).collect(),
        };
    }
    all
}

fn misplaced(block: &str, parts: &[BlockPart<'_>], known: &[&PlacedUniform]) -> Vec<Misplaced> {
    let mut numbers: HashMap<u32, (&str, (bool, u8))> = HashMap::new();
    for own in known {
        let TypeInner::Scalar(scalar) = inner(own.kind.scalar().unwrap_or(Scalar::Float), 1) else { continue };
        let bits = kind_of(scalar.kind, scalar.width);
        numbers.extend(own.place.numbers(&own.kind).into_iter().map(|at| (at, (own.path.as_str(), bits))));
    }
    let mut found = Vec::new();
    for BlockPart { declared, bits, .. } in parts {
        let hits: Vec<(&str, (bool, u8))> = declared.places.iter().filter_map(|at| numbers.get(at).copied()).collect();
        let is_name = |path: &str| path == declared.path || declared.own_name() == Some(path);
        let other = hits.iter().find(|(_, there)| there != bits);
        let is_known = known.iter().any(|own| is_name(&own.path));
        let same = known.iter().find(|own| own.path == hits.first().map_or("", |(path, _)| path));
        let is_transposed = same.is_some_and(|own| {
            let [mut own, mut theirs] = [own.place.numbers(&own.kind), declared.places.clone()];
            let differs = own != theirs;
            own.sort_unstable();
            theirs.sort_unstable();
            differs && own == theirs
        });
        let (there, is_wrong) = match (other, hits.first()) {
            (Some((path, _)), _) => (Some(*path), true),
            (None, None) => (None, is_known),
            (None, Some((path, _))) if is_transposed || is_known && !is_name(path) => (Some(*path), false),
            _ => continue,
        };
        let own = declared.own_name().unwrap_or(&declared.path).to_owned();
        found.push(Misplaced {
            block: block.to_owned(),
            own,
            there: there.map(str::to_owned),
            is_wrong,
            is_transposed,
        });
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
