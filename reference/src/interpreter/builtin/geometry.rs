//! Vectors and matrices (GLSL 4.60, sections 8.5 and 8.6).

use super::BuiltinCall;
use crate::interpreter::code::{ArithmeticClass, Operation, Slot};
use crate::interpreter::compile::CodeBuilder;
use crate::interpreter::types::Type;

/// Writes the function; `None` where it is not one of these.
pub fn write(builder: &mut CodeBuilder, name: &str, class: ArithmeticClass, of: &[&[Slot]]) -> Option<Vec<Vec<Slot>>> {
    let result = match (name, of) {
        ("dot", [a, b]) => vec![builder.dot(class, a, b)],
        ("length", [a]) => vec![length(builder, class, a)],
        ("distance", [a, b]) => {
            let difference = builder.each2(Operation::Subtract, class, a, b);
            vec![length(builder, class, &difference)]
        }
        ("cross", [a, b]) => cross(builder, class, a, b),
        ("normalize", [a]) => {
            let square = builder.dot(class, a, a);
            let factor = builder.emit(Operation::InverseSquareRoot, class, &[square]);
            builder.each2(Operation::Multiply, class, a, &[factor])
        }
        ("faceforward", [normal, incident, reference]) => {
            let dot = builder.dot(class, reference, incident);
            let zero = builder.number(class, 0.0);
            let faces = builder.emit(Operation::Less, class, &[dot, zero]);
            let turned = builder.each1(Operation::Negate, class, normal);
            builder.each3(Operation::Select, class, [&[faces], normal, &turned])
        }
        ("reflect", [incident, normal]) => {
            let dot = builder.dot(class, normal, incident);
            let two = builder.number(class, 2.0);
            let twice = builder.emit(Operation::Multiply, class, &[two, dot]);
            let part = builder.each2(Operation::Multiply, class, &[twice], normal);
            builder.each2(Operation::Subtract, class, incident, &part)
        }
        ("refract", [incident, normal, ratio]) => refract(builder, class, incident, normal, ratio[0]),
        _ => return None,
    };
    Some(vec![result])
}

impl CodeBuilder {
    /// The sum of products.
    pub fn dot(&mut self, class: ArithmeticClass, a: &[Slot], b: &[Slot]) -> Slot {
        let mut sum = self.emit(Operation::Multiply, class, &[a[0], b[0]]);
        for (&a, &b) in a.iter().zip(b).skip(1) {
            sum = self.emit(Operation::MultiplyAdd, class, &[a, b, sum]);
        }
        sum
    }
}

fn length(builder: &mut CodeBuilder, class: ArithmeticClass, a: &[Slot]) -> Slot {
    if let [only] = *a {
        return builder.emit(Operation::Abs, class, &[only]);
    }
    let square = builder.dot(class, a, a);
    builder.emit(Operation::SquareRoot, class, &[square])
}

fn cross(builder: &mut CodeBuilder, class: ArithmeticClass, a: &[Slot], b: &[Slot]) -> Vec<Slot> {
    let component = |(i, j): (usize, usize)| {
        let first = builder.emit(Operation::Multiply, class, &[a[i], b[j]]);
        let second = builder.emit(Operation::Multiply, class, &[a[j], b[i]]);
        builder.emit(Operation::Subtract, class, &[first, second])
    };
    [(1, 2), (2, 0), (0, 1)].map(component).to_vec()
}

/// `k = 1 − ratio² (1 − (N·I)²)`; 0 where that is negative, else `ratio I − (ratio N·I + √k) N`.
fn refract(
    builder: &mut CodeBuilder,
    class: ArithmeticClass,
    incident: &[Slot],
    normal: &[Slot],
    ratio: Slot,
) -> Vec<Slot> {
    let (zero, one) = (builder.number(class, 0.0), builder.number(class, 1.0));
    let dot = builder.dot(class, normal, incident);
    let square = builder.emit(Operation::Multiply, class, &[dot, dot]);
    let rest = builder.emit(Operation::Subtract, class, &[one, square]);
    let of_ratio = builder.emit(Operation::Multiply, class, &[ratio, ratio]);
    let part = builder.emit(Operation::Multiply, class, &[of_ratio, rest]);
    let k = builder.emit(Operation::Subtract, class, &[one, part]);
    let is_reflected = builder.emit(Operation::Less, class, &[k, zero]);
    let positive = builder.emit(Operation::Maximum, class, &[k, zero]);
    let root = builder.emit(Operation::SquareRoot, class, &[positive]);
    let along = builder.emit(Operation::MultiplyAdd, class, &[ratio, dot, root]);
    let of_normal = builder.each2(Operation::Multiply, class, &[along], normal);
    let of_incident = builder.each2(Operation::Multiply, class, &[ratio], incident);
    let refracted = builder.each2(Operation::Subtract, class, &of_incident, &of_normal);
    builder.each3(Operation::Select, class, [&[is_reflected], &[zero], &refracted])
}

impl BuiltinCall<'_> {
    /// Functions of matrices; `None` where it is not one of these.
    pub(super) fn matrix(&self, builder: &mut CodeBuilder, class: ArithmeticClass) -> Option<Vec<Vec<Slot>>> {
        let first = self.arguments.first()?;
        let shape = match &first.kind {
            Type::Matrix(_, columns, rows) => Some((usize::from(*columns), usize::from(*rows))),
            _ => None,
        };
        let result = match (self.name, shape) {
            ("transpose", Some((columns, rows))) => {
                (0..columns * rows).map(|index| first.slots[index % columns * rows + index / columns]).collect()
            }
            ("determinant", Some((side, _))) => {
                let all: Vec<usize> = (0..side).collect();
                vec![minor(builder, class, &first.slots, side, &all, &all)]
            }
            ("inverse", Some((side, _))) => inverse(builder, class, &first.slots, side),
            ("outerProduct", None) => {
                let row = &self.arguments.get(1)?.slots;
                let product = |&of_row: &Slot| builder.each2(Operation::Multiply, class, &first.slots, &[of_row]);
                row.iter().flat_map(product).collect()
            }
            _ => return None,
        };
        Some(vec![result])
    }
}

/// The determinant of these columns and rows, along the first of them.
fn minor(
    builder: &mut CodeBuilder,
    class: ArithmeticClass,
    of: &[Slot],
    side: usize,
    columns: &[usize],
    rows: &[usize],
) -> Slot {
    let (Some((&column, columns)), false) = (columns.split_first(), rows.is_empty()) else {
        return builder.number(class, 1.0);
    };
    if columns.is_empty() {
        return of[column * side + rows[0]];
    }
    let mut sum = None;
    for (index, &row) in rows.iter().enumerate() {
        let others: Vec<usize> = rows.iter().copied().filter(|&other| other != row).collect();
        let inner = minor(builder, class, of, side, columns, &others);
        let product = builder.emit(Operation::Multiply, class, &[of[column * side + row], inner]);
        sum = Some(match sum {
            None => product,
            Some(sum) => {
                let operation = if index % 2 == 0 { Operation::Add } else { Operation::Subtract };
                builder.emit(operation, class, &[sum, product])
            }
        });
    }
    sum.unwrap_or(of[0])
}

/// The adjugate over the determinant.
fn inverse(builder: &mut CodeBuilder, class: ArithmeticClass, of: &[Slot], side: usize) -> Vec<Slot> {
    let all: Vec<usize> = (0..side).collect();
    let without = |one: usize| all.iter().copied().filter(|&other| other != one).collect::<Vec<_>>();
    let mut cofactors = Vec::with_capacity(side * side);
    for column in 0..side {
        for row in 0..side {
            let minor = minor(builder, class, of, side, &without(column), &without(row));
            let is_negative = (column + row) % 2 == 1;
            cofactors.push(if is_negative { builder.emit(Operation::Negate, class, &[minor]) } else { minor });
        }
    }
    let determinant = builder.dot(class, &of[..side], &cofactors[..side]);
    let factor = builder.emit(Operation::Reciprocal, class, &[determinant]);
    let adjugate: Vec<Slot> = (0..side * side).map(|index| cofactors[index % side * side + index / side]).collect();
    builder.each2(Operation::Multiply, class, &adjugate, &[factor])
}
