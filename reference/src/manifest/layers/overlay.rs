//! A manifest laid over another: what takes the place of what.

use std::collections::BTreeSet;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// What tells the elements of a list of tables apart: elements that have the same are one.
const IDENTITIES: [(&str, &str); 14] = [
    ("file", "stage"),
    ("fixed", "stage"),
    ("input", "name"),
    ("uniform", "name"),
    ("texture", "name"),
    ("pass", "target"),
    ("free", "id"),
    ("constant", "name"),
    ("rubric", "id"),
    ("mistake", "id"),
    ("region", "id"),
    ("advice", "id"),
    ("equation.term", "line"),
    ("equation.where", "symbol"),
];

/// Keys of a table that stand for one another: who writes one of the first takes all of the second away.
const INSTEAD_OF: [(&str, &[&str], &[&str]); 8] = [
    ("input", &["carries", "values"], &["carries", "values"]),
    ("uniform", &["carries", "value", "is", "texture"], &["carries", "value", "is", "texture"]),
    ("texture", &["file", "cube", "generate"], &["file", "cube", "generate"]),
    ("scene", &["mesh", "draw"], &["triangle", "normals", "mesh", "draw"]),
    ("scene", &["triangle"], &["mesh", "draw"]),
    ("scene", &["turn", "model"], &["turn", "model"]),
    ("rubric.without", &["replace", "define", "file"], &["replace", "define", "file"]),
    ("rubric", &["judges"], &["without"]),
];

/// Takes a key, or the element of a list that has this name, out of a manifest, and what the others say of it. Whether it
/// was there.
pub fn leave_out(base: &mut DeTable, name: &str) -> bool {
    let mut is_there = base.remove(name).is_some();
    for (path, identity) in IDENTITIES {
        is_there |= retain(base, path, |one| !is_called(one, identity, name));
    }
    let definitions = at_path(base, "definition").and_then(table_of);
    is_there |= definitions.is_some_and(|definitions| definitions.remove(name).is_some());
    // A mistake that costs nothing any more, or replaces nothing, is left out as well; so is advice about nothing.
    retain(base, "mistake", |one| {
        let keeps = forget_key(one, "keeps", name);
        let forms = forget_forms(one, name);
        !keeps && !forms
    });
    let constants = at_path(base, "constant").and_then(list_of);
    let of_line = constants.into_iter().flat_map(|list| list.iter()).filter(|one| is_called(one, "line", name));
    let of_line = of_line.filter_map(|one| one.get_ref().get("name")?.get_ref().as_str().map(str::to_owned));
    for constant in of_line.collect::<Vec<_>>() {
        leave_out(base, &constant);
    }
    retain(base, "rubric", |one| {
        forget_word(one, "alone_in", name);
        true
    });
    retain(base, "advice", |one| {
        if let Some(when) = table_in(one, "when").and_then(|when| when.get_mut("constants")) {
            table_of(when.get_mut()).map(|constants| constants.remove(name));
        }
        !forget_word(one, "about", name)
    });
    is_there
}

/// Keeps some elements of a list. Whether any went.
fn retain<'i>(base: &mut DeTable<'i>, path: &str, mut keeps: impl FnMut(&mut Spanned<DeValue<'i>>) -> bool) -> bool {
    let Some(list) = at_path(base, path).and_then(list_of) else { return false };
    let before = list.len();
    let kept = std::mem::replace(list, DeArray::new()).into_iter().filter_map(|mut one| keeps(&mut one).then_some(one));
    *list = kept.collect();
    list.len() < before
}

fn table_in<'t, 'i>(element: &'t mut Spanned<DeValue<'i>>, key: &str) -> Option<&'t mut DeTable<'i>> {
    table_of(element.get_mut()).and_then(|table| table.get_mut(key)).map(|value| value.get_mut()).and_then(table_of)
}

/// Takes a key out of a table in an element. Whether the table is empty by that.
fn forget_key(element: &mut Spanned<DeValue>, table: &str, key: &str) -> bool {
    table_in(element, table).is_some_and(|table| table.remove(key).is_some() && table.is_empty())
}

/// Takes a word out of a list of words in an element. Whether the list is empty by that.
fn forget_word(element: &mut Spanned<DeValue>, list: &str, word: &str) -> bool {
    let table = table_of(element.get_mut());
    let list = table.and_then(|table| table.get_mut(list)).map(|value| value.get_mut()).and_then(list_of);
    let Some(list) = list else { return false };
    let before = list.len();
    *list = std::mem::replace(list, DeArray::new())
        .into_iter()
        .filter(|one| one.get_ref().as_str() != Some(word))
        .collect();
    list.is_empty() && before > 0
}

/// Takes the forms out of a mistake that replace a definition. Whether none is left by that.
fn forget_forms(mistake: &mut Spanned<DeValue>, definition: &str) -> bool {
    let forms = table_of(mistake.get_mut()).and_then(|table| table.get_mut("forms")).map(|value| value.get_mut());
    let Some(forms) = forms.and_then(list_of) else { return false };
    let before = forms.len();
    *forms = std::mem::replace(forms, DeArray::new())
        .into_iter()
        .filter(|form| form.get_ref().get(definition).is_none())
        .collect();
    forms.is_empty() && before > 0
}

/// What can be left out of a manifest.
pub fn names(base: &DeTable) -> Vec<String> {
    let mut names: BTreeSet<String> = base.keys().map(|key| key.get_ref().to_string()).collect();
    for (path, identity) in IDENTITIES.iter().filter(|(path, _)| !path.contains('.')) {
        let list = base.get(*path).and_then(|list| list.get_ref().as_array());
        let elements = list.into_iter().flat_map(|list| list.iter());
        names.extend(elements.filter_map(|one| one.get_ref().get(*identity)?.get_ref().as_str().map(str::to_owned)));
    }
    names.into_iter().collect()
}

fn at_path<'t, 'i>(table: &'t mut DeTable<'i>, path: &str) -> Option<&'t mut DeValue<'i>> {
    match path.split_once('.') {
        None => table.get_mut(path).map(|value| value.get_mut()),
        Some((first, rest)) => at_path(table.get_mut(first).map(|value| value.get_mut()).and_then(table_of)?, rest),
    }
}

fn table_of<'t, 'i>(value: &'t mut DeValue<'i>) -> Option<&'t mut DeTable<'i>> {
    match value {
        DeValue::Table(table) => Some(table),
        _ => None,
    }
}

fn list_of<'t, 'i>(value: &'t mut DeValue<'i>) -> Option<&'t mut DeArray<'i>> {
    match value {
        DeValue::Array(list) => Some(list),
        _ => None,
    }
}

fn is_called(element: &Spanned<DeValue>, identity: &str, name: &str) -> bool {
    element.get_ref().get(identity).and_then(|found| found.get_ref().as_str()) == Some(name)
}

/// Lays a manifest over another.
pub fn lay<'i>(base: &mut DeTable<'i>, own: DeTable<'i>) {
    lay_table(base, own, "");
}

/// Key by key; `path` is where the table stands.
fn lay_table<'i>(base: &mut DeTable<'i>, own: DeTable<'i>, path: &str) {
    for (_, keys, others) in INSTEAD_OF.iter().filter(|(known, ..)| *known == path) {
        if keys.iter().any(|key| own.contains_key(*key)) {
            others.iter().for_each(|other| drop(base.remove(*other)));
        }
    }
    for (key, value) in own {
        let path = if path.is_empty() { key.get_ref().to_string() } else { format!("{path}.{}", key.get_ref()) };
        match base.get_mut(&key) {
            None => {
                base.insert(key, value);
            }
            Some(below) => lay_value(below, value, &path),
        }
    }
}

fn lay_value<'i>(base: &mut Spanned<DeValue<'i>>, own: Spanned<DeValue<'i>>, path: &str) {
    let span = own.span();
    if path == "scene" && base.get_ref().is_table() && own.get_ref().is_array() {
        // A table is the first of several scenes.
        let only = std::mem::replace(base, Spanned::new(span.clone(), DeValue::Boolean(false)));
        *base = Spanned::new(span.clone(), DeValue::Array([only].into_iter().collect()));
    }
    let identity = IDENTITIES.iter().find(|(known, _)| *known == path).map(|(_, identity)| *identity);
    match (base.get_mut(), own.into_inner()) {
        (DeValue::Table(base), DeValue::Table(own)) => lay_table(base, own, path),
        (DeValue::Array(base), DeValue::Array(own)) if identity.is_some() || path == "scene" => {
            for (place, element) in own.into_iter().enumerate() {
                let name = identity
                    .and_then(|identity| element.get_ref().get(identity)?.get_ref().as_str().map(str::to_owned));
                let same = match (identity, name) {
                    (Some(identity), Some(name)) => base.iter().position(|one| is_called(one, identity, &name)),
                    // Scenes are told apart by their order.
                    (None, _) => Some(place).filter(|place| *place < base.len()),
                    (Some(_), None) => None,
                };
                match same {
                    Some(same) => lay_value(&mut base.as_mut()[same], element, path),
                    None => base.push(element),
                }
            }
        }
        (_, own) => *base = Spanned::new(span, own),
    }
}
