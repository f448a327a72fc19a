//! Values of `assignment.toml`: numbers, lists and tables as values of GLSL.

use crate::feed::Bounds;
use crate::interpreter::{Scalar, Type};
use crate::text::both;
use crate::value::rounded;
use crate::{Text, Value};
use toml::Value as Toml;

type ValueResult<T> = Result<T, Text>;

/// The part of a value that a path leads to: `.colour`, `[1].power`.
pub(super) fn part<'v>(value: &'v Toml, path: &str) -> ValueResult<&'v Toml> {
    if path.is_empty() {
        return Ok(value);
    }
    let (step, rest) = step(path);
    let found = match step {
        PathStep::Index(index) => value.as_array().and_then(|list| list.get(index)),
        PathStep::Member(name) => value.as_table().and_then(|table| table.get(name)),
    };
    match found {
        Some(found) => part(found, rest),
        None => Err(match step {
            PathStep::Index(index) => both(
                format!("there is no element {index}: write a list of all"),
                format!("要素 {index} がありません。すべての要素のリストを書いてください"),
            ),
            PathStep::Member(name) => both(
                format!("there is no `{name} = …`: write a table of all members"),
                format!("`{name} = …` がありません。すべてのメンバのテーブルを書いてください"),
            ),
        }),
    }
}

#[derive(Clone, Copy)]
enum PathStep<'p> {
    Index(usize),
    Member(&'p str),
}

/// The first step of a path, and the others.
fn step(path: &str) -> (PathStep<'_>, &str) {
    if let Some((index, rest)) = path.strip_prefix('[').and_then(|path| path.split_once(']')) {
        return (PathStep::Index(index.parse().unwrap_or(usize::MAX)), rest);
    }
    let path = path.strip_prefix('.').unwrap_or(path);
    let end = path.find(['.', '[']).unwrap_or(path.len());
    (PathStep::Member(&path[..end]), &path[end..])
}

/// A number, a truth value, or a list of them, as a value of a type; a matrix by columns.
pub(super) fn value(value: &Toml, kind: &Type) -> ValueResult<Value> {
    let scalar = kind.scalar().ok_or_else(|| {
        both("this has no value of its own: write its parts", "これ自体は値を持ちません。部分ごとに書いてください")
    })?;
    let numbers = numbers(value)?;
    let count = kind.slots().unwrap_or(0);
    if numbers.len() != count {
        return Err(both(
            format!("{} numbers are written, and it has {count}", numbers.len()),
            format!("{} 個の数が書かれていますが、{count} 個必要です", numbers.len()),
        ));
    }
    check(&numbers, scalar)?;
    Ok(rounded(Value::of(kind.clone(), numbers)))
}

fn check(numbers: &[f64], scalar: Scalar) -> ValueResult<()> {
    let fits = |number: &f64| match scalar {
        Scalar::Bool => [0.0, 1.0].contains(number),
        Scalar::Int => number.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(number),
        Scalar::Uint => number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(number),
        Scalar::Float => (*number as f32).is_finite(),
        Scalar::Double => number.is_finite(),
    };
    match numbers.iter().find(|number| !fits(number)) {
        Some(number) => {
            let kind = Type::Vector(scalar, 1);
            Err(both(
                format!(
                    "{number} is no value of type {kind}: write another number, or give the declaration another type"
                ),
                format!("{number} は {kind} 型の値ではありません。数か、宣言の型を直してください"),
            ))
        }
        None => Ok(()),
    }
}

fn numbers(value: &Toml) -> ValueResult<Vec<f64>> {
    Ok(match value {
        Toml::Integer(number) => vec![*number as f64],
        Toml::Float(number) => vec![*number],
        Toml::Boolean(holds) => vec![f64::from(u8::from(*holds))],
        Toml::Array(list) => list.iter().map(numbers).collect::<ValueResult<Vec<_>>>()?.concat(),
        _ => return Err(both("write a number or a list of numbers", "数または数のリストを書いてください")),
    })
}

/// What probes may draw for the part that a path leads to; nothing where it is not said.
pub(super) fn bounds(said: &Toml, path: &str, kind: &Type) -> ValueResult<Option<Bounds>> {
    let within = || both("write `{ within = [least, greatest] }`", "`{ within = [最小, 最大] }` の形で書いてください");
    let Some(table) = said.as_table() else { return Err(within()) };
    if let Some(said) = table.get("within") {
        if table.len() > 1 {
            return Err(both("`within` stands alone: remove the others", "`within` は単独で書いてください"));
        }
        let ends = said.as_array().filter(|ends| ends.len() == 2).ok_or_else(within)?;
        let [least, greatest] = [numbers(&ends[0])?, numbers(&ends[1])?];
        let bounds = Bounds::new(kind, &least, &greatest);
        return bounds.map(Some).ok_or_else(|| {
            both(
                "write the least and the greatest value, each as one number for all or as many as it has",
                "最小値と最大値を、全成分に共通の 1 つの数、または成分と同じ個数の数で書いてください",
            )
        });
    }
    let (step, rest) = match path {
        "" => return Err(within()),
        path => step(path),
    };
    match step {
        PathStep::Member(name) => table.get(name).map_or(Ok(None), |said| bounds(said, rest, kind)),
        PathStep::Index(_) => bounds(said, rest, kind),
    }
}

/// The first member that is written in a table and that no path has. A table stands for each element of an array.
pub(super) fn unknown_member<'v>(said: &'v Toml, paths: &[&str]) -> Option<&'v str> {
    let behind = |is_next: &dyn Fn(PathStep<'_>) -> bool| -> Vec<&str> {
        paths.iter().map(|path| step(path)).filter(|(next, _)| is_next(*next)).map(|(_, rest)| rest).collect()
    };
    match said {
        Toml::Table(table) if table.contains_key("within") => None,
        Toml::Table(_) if paths.iter().any(|path| path.starts_with('[')) => {
            unknown_member(said, &behind(&|next| matches!(next, PathStep::Index(_))))
        }
        Toml::Table(table) => table.iter().find_map(|(name, inner)| {
            let behind = behind(&|next| matches!(next, PathStep::Member(own) if own == name));
            if behind.is_empty() { Some(name.as_str()) } else { unknown_member(inner, &behind) }
        }),
        Toml::Array(list) => list.iter().enumerate().find_map(|(at, inner)| {
            unknown_member(inner, &behind(&|next| matches!(next, PathStep::Index(own) if own == at)))
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn toml(text: &str) -> Toml {
        toml::from_str::<toml::Table>(&format!("x = {text}")).expect(text)["x"].clone()
    }

    #[test]
    fn a_member_that_there_is_not_is_named() {
        let paths = ["[0].position", "[0].colour", "[1].position", "[1].colour"];
        let unknown = |text: &str| unknown_member(&toml(text), &paths).map(str::to_owned);
        assert_eq!(unknown("{ positoin = { within = [0, 1] } }").as_deref(), Some("positoin"));
        assert_eq!(unknown("{ position = { within = [0, 1] }, colour = { within = [0, 1] } }"), None);
        assert_eq!(unknown("[{ position = 1, colour = 2 }, { position = 1, color = 2 }]").as_deref(), Some("color"));
        assert_eq!(unknown("{ within = [0, 1] }"), None);
    }

    #[test]
    fn parts_are_found_by_their_paths() {
        let lights = toml("[{ colour = [1, 2, 3] }, { colour = [4, 5, 6] }]");
        let found = part(&lights, "[1].colour").and_then(|part| value(part, &Type::vector(3)));
        assert_eq!(found.map(|value| value.numbers().to_vec()), Ok(vec![4.0, 5.0, 6.0]));
        assert!(
            part(&lights, "[2].colour").is_err_and(|what| what.en.contains("element 2") && what.ja.contains("要素 2"))
        );
        assert!(part(&lights, "[0].power").is_err_and(|what| what.en.contains("`power")));
    }

    #[test]
    fn values_fit_their_types() {
        assert_eq!(
            value(&toml("[[1, 2], [3, 4]]"), &Type::Matrix(Scalar::Float, 2, 2)).expect("a matrix").numbers(),
            [1.0, 2.0, 3.0, 4.0]
        );
        assert_eq!(value(&toml("true"), &Type::BOOL).expect("a truth value").numbers(), [1.0]);
        for (text, kind) in
            [("1.5", Type::INT), ("-1", Type::UINT), ("2", Type::BOOL), ("1e40", Type::FLOAT), ("nan", Type::FLOAT)]
        {
            assert!(value(&toml(text), &kind).is_err(), "{text}");
        }
        assert!(value(&toml("[1, 2]"), &Type::vector(3)).is_err_and(|what| what.en.contains("2 numbers")));
    }

    #[test]
    fn bounds_of_a_structure_are_those_of_its_members() {
        let said = toml("{ shininess = { within = [4, 100] } }");
        assert!(bounds(&said, ".shininess", &Type::FLOAT).expect("valid").is_some());
        assert!(bounds(&said, ".diffuse", &Type::VEC4).expect("valid").is_none());
        assert!(bounds(&toml("{ within = [0.1, 1] }"), ".diffuse", &Type::VEC4).expect("valid").is_some());
        assert!(bounds(&toml("{ within = [1] }"), "", &Type::FLOAT).is_err());
    }
}
