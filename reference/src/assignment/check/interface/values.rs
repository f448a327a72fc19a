//! Values of `assignment.toml`: numbers, lists and tables as values of GLSL.

use crate::Value;
use crate::feed::Bounds;
use crate::interpreter::{Scalar, Type};
use crate::value::rounded;
use toml::Value as Toml;

type Read<T> = Result<T, String>;

/// The part of a value that a path leads to: `.colour`, `[1].power`.
pub(super) fn part<'v>(value: &'v Toml, path: &str) -> Read<&'v Toml> {
    if path.is_empty() {
        return Ok(value);
    }
    let (step, rest) = step(path);
    let found = match step {
        Step::Index(index) => value.as_array().and_then(|list| list.get(index)),
        Step::Member(name) => value.as_table().and_then(|table| table.get(name)),
    };
    match found {
        Some(found) => part(found, rest),
        None => Err(match step {
            Step::Index(index) => format!("there is no element {index}: write a list of all"),
            Step::Member(name) => format!("there is no `{name} = …`: write a table of all members"),
        }),
    }
}

#[derive(Clone, Copy)]
enum Step<'p> {
    Index(usize),
    Member(&'p str),
}

/// The first step of a path, and the others.
fn step(path: &str) -> (Step<'_>, &str) {
    if let Some((index, rest)) = path.strip_prefix('[').and_then(|path| path.split_once(']')) {
        return (Step::Index(index.parse().unwrap_or(usize::MAX)), rest);
    }
    let path = path.strip_prefix('.').unwrap_or(path);
    let end = path.find(['.', '[']).unwrap_or(path.len());
    (Step::Member(&path[..end]), &path[end..])
}

/// A number, a truth value, or a list of them, as a value of a type; a matrix by columns.
pub(super) fn value(value: &Toml, kind: &Type) -> Read<Value> {
    let scalar = kind.scalar().ok_or("this has no value of its own")?;
    let numbers = numbers(value)?;
    let count = kind.slots().unwrap_or(0);
    if numbers.len() != count {
        return Err(format!("{} numbers are written, and it has {count}", numbers.len()));
    }
    check(&numbers, scalar)?;
    Ok(rounded(Value::of(kind.clone(), numbers)))
}

fn check(numbers: &[f64], scalar: Scalar) -> Read<()> {
    let fits = |number: &f64| match scalar {
        Scalar::Bool => [0.0, 1.0].contains(number),
        Scalar::Int => number.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(number),
        Scalar::Uint => number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(number),
        Scalar::Float => (*number as f32).is_finite(),
        Scalar::Double => number.is_finite(),
    };
    match numbers.iter().find(|number| !fits(number)) {
        Some(number) => Err(format!("{number} is not a {}", Type::Vector(scalar, 1))),
        None => Ok(()),
    }
}

fn numbers(value: &Toml) -> Read<Vec<f64>> {
    Ok(match value {
        Toml::Integer(number) => vec![*number as f64],
        Toml::Float(number) => vec![*number],
        Toml::Boolean(holds) => vec![f64::from(u8::from(*holds))],
        Toml::Array(list) => list.iter().map(numbers).collect::<Read<Vec<_>>>()?.concat(),
        _ => return Err("write a number or a list of numbers".into()),
    })
}

/// What probes may draw for the part that a path leads to; nothing where it is not said.
pub(super) fn bounds(said: &Toml, path: &str, kind: &Type) -> Read<Option<Bounds>> {
    let Some(table) = said.as_table() else { return Err("write `{ within = [least, greatest] }`".into()) };
    if let Some(within) = table.get("within") {
        if table.len() > 1 {
            return Err("`within` stands alone".into());
        }
        let ends = within.as_array().filter(|ends| ends.len() == 2).ok_or("`within` is `[least, greatest]`")?;
        let [least, greatest] = [numbers(&ends[0])?, numbers(&ends[1])?];
        let bounds = Bounds::new(kind, &least, &greatest);
        let message = "write the least and the greatest value, each as one number for all or as many as it has";
        return bounds.map(Some).ok_or_else(|| message.into());
    }
    let (step, rest) = match path {
        "" => return Err("write `{ within = [least, greatest] }`".into()),
        path => step(path),
    };
    match step {
        Step::Member(name) => table.get(name).map_or(Ok(None), |said| bounds(said, rest, kind)),
        Step::Index(_) => bounds(said, rest, kind),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn toml(text: &str) -> Toml {
        toml::from_str::<toml::Table>(&format!("x = {text}")).expect(text)["x"].clone()
    }

    #[test]
    fn parts_are_found_by_their_paths() {
        let lights = toml("[{ colour = [1, 2, 3] }, { colour = [4, 5, 6] }]");
        let found = part(&lights, "[1].colour").and_then(|part| value(part, &Type::vector(3)));
        assert_eq!(found.map(|value| value.numbers().to_vec()), Ok(vec![4.0, 5.0, 6.0]));
        assert!(part(&lights, "[2].colour").is_err_and(|what| what.contains("element 2")));
        assert!(part(&lights, "[0].power").is_err_and(|what| what.contains("`power")));
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
        assert!(value(&toml("[1, 2]"), &Type::vector(3)).is_err_and(|what| what.contains("2 numbers")));
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
