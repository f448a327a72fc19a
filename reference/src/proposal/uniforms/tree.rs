//! The parts of a uniform, each with its source, and the entries that say so.

use super::{ProposedTexture, ProposedUniform};

/// Where the value of one scalar, vector, matrix or sampler comes from.
#[derive(Clone, Debug)]
pub(super) enum ProposedValue {
    Line(String),
    Value { value: String, probe: Option<String>, what: (&'static str, &'static str) },
    Texture(ProposedTexture),
}

/// The parts of a uniform.
#[derive(Clone, Debug)]
pub(super) enum Tree {
    Leaf(ProposedValue),
    Members(Vec<(String, Tree)>),
    Elements(Vec<Tree>),
}

/// The name of a whole uniform, and the path in it.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.split_at(path.find(['.', '[']).unwrap_or(path.len()))
}

/// The first step of a path and the rest of it: an index or a member.
fn step(path: &str) -> Option<(Result<usize, &str>, &str)> {
    if let Some(rest) = path.strip_prefix('[') {
        let (index, rest) = rest.split_once(']')?;
        return Some((Ok(index.parse().ok()?), rest));
    }
    let rest = path.strip_prefix('.')?;
    let end = rest.find(['.', '[']).unwrap_or(rest.len());
    Some((Err(&rest[..end]), &rest[end..]))
}

pub(super) fn empty(path: &str) -> Tree {
    match step(path) {
        Some((Ok(_), _)) => Tree::Elements(Vec::new()),
        _ => Tree::Members(Vec::new()),
    }
}

pub(super) fn insert(tree: &mut Tree, path: &str, said: ProposedValue) {
    let Some((first, rest)) = step(path) else {
        *tree = Tree::Leaf(said);
        return;
    };
    match (first, tree) {
        // Elements come in their order.
        (Ok(index), Tree::Elements(elements)) => {
            while elements.len() <= index {
                elements.push(empty(rest));
            }
            insert(&mut elements[index], rest, said);
        }
        (Err(name), Tree::Members(members)) => {
            let at = members.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
                members.push((name.to_owned(), empty(rest)));
                members.len() - 1
            });
            insert(&mut members[at].1, rest, said);
        }
        _ => {}
    }
}

pub(super) fn has(tree: &Tree, path: &str) -> bool {
    match (step(path), tree) {
        (None, Tree::Leaf(_)) => true,
        (Some((Ok(index), rest)), Tree::Elements(elements)) => elements.get(index).is_some_and(|one| has(one, rest)),
        (Some((Err(name), rest)), Tree::Members(members)) => {
            members.iter().any(|(known, one)| known == name && has(one, rest))
        }
        _ => false,
    }
}

/// The entries of a uniform: one where all its parts have values, or one for each part.
pub(super) fn write(name: &str, tree: &Tree, entries: &mut Vec<ProposedUniform>) {
    let entry = |lines: Vec<String>, note, texture| ProposedUniform { name: name.to_owned(), lines, note, texture };
    let note = |what: (&str, &str)| Some((what.0.to_owned(), what.1.to_owned()));
    match tree {
        Tree::Leaf(ProposedValue::Line(line)) => {
            entries.push(entry(line.lines().map(str::to_owned).collect(), None, None))
        }
        Tree::Leaf(ProposedValue::Texture(texture)) => {
            let (en, ja) = texture.what;
            entries.push(entry(vec![format!("texture = \"{}\"", texture.name)], note((en, ja)), Some(texture.clone())));
        }
        Tree::Leaf(ProposedValue::Value { value, probe, what }) => {
            let mut lines = vec![format!("value = {value}")];
            lines.extend(probe.iter().map(|probe| format!("probe = {probe}")));
            entries.push(entry(lines, note(*what), None));
        }
        parts => match (value_of(parts, 0), probe_of(parts)) {
            (Some(value), probe) => {
                let mut lines = vec![format!("value = {value}")];
                lines.extend(probe.iter().map(|probe| format!("probe = {probe}")));
                entries.push(entry(lines, note(("a whole of values by their names", "名前から決めた値の組")), None));
            }
            (None, _) => match parts {
                Tree::Members(members) => {
                    members.iter().for_each(|(member, tree)| write(&format!("{name}.{member}"), tree, entries));
                }
                Tree::Elements(elements) => {
                    (0..)
                        .zip(elements)
                        .for_each(|(at, tree): (usize, _)| write(&format!("{name}[{at}]"), tree, entries));
                }
                Tree::Leaf(_) => {}
            },
        },
    }
}

/// The values of all parts, where they have values.
fn value_of(tree: &Tree, depth: usize) -> Option<String> {
    match tree {
        Tree::Leaf(ProposedValue::Value { value, .. }) => Some(value.clone()),
        Tree::Leaf(_) => None,
        Tree::Members(members) => {
            let each = members.iter().map(|(name, tree)| Some(format!("{name} = {}", value_of(tree, depth + 1)?)));
            Some(format!("{{ {} }}", each.collect::<Option<Vec<_>>>()?.join(", ")))
        }
        Tree::Elements(elements) => {
            let each = elements.iter().map(|tree| value_of(tree, depth + 1)).collect::<Option<Vec<_>>>()?;
            Some(match depth {
                0 => format!("[\n{}]", each.iter().map(|one| format!("    {one},\n")).collect::<String>()),
                _ => format!("[{}]", each.join(", ")),
            })
        }
    }
}

/// What probes may draw for the parts; of an array it is said once.
fn probe_of(tree: &Tree) -> Option<String> {
    match tree {
        Tree::Leaf(ProposedValue::Value { probe, .. }) => probe.clone(),
        Tree::Leaf(_) => None,
        Tree::Elements(elements) => elements.first().and_then(probe_of),
        Tree::Members(members) => {
            let each: Vec<_> =
                members.iter().filter_map(|(name, tree)| Some(format!("{name} = {}", probe_of(tree)?))).collect();
            (!each.is_empty()).then(|| format!("{{ {} }}", each.join(", ")))
        }
    }
}
