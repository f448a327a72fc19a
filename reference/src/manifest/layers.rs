//! `assignment.toml` and those that it extends, read as one.

use super::Manifest;
use crate::assignment::{AssignmentError, MANIFEST, both, error};
use crate::folder::Folder;
use serde::Deserialize;
use std::collections::BTreeSet;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Most folders that extend one another.
const MAX_LAYERS: usize = 8;

/// The key that names what is extended, and the key that names what of it is not taken over.
const EXTENDS: &str = "extends";
const LEAVE_OUT: &str = "leave_out";

/// What tells the elements of a list of tables apart: elements that have the same are one.
const IDENTITIES: [(&str, &str); 12] = [
    ("file", "stage"),
    ("fixed", "stage"),
    ("input", "name"),
    ("uniform", "name"),
    ("texture", "name"),
    ("constant", "name"),
    ("rubric", "id"),
    ("mistake", "id"),
    ("region", "id"),
    ("advice", "id"),
    ("equation.term", "line"),
    ("equation.where", "symbol"),
];

/// The manifests of a folder, the one that extends none first.
pub struct Layers {
    layers: Vec<Layer>,
}

/// A manifest in the text of all of them.
struct Layer {
    file: String,
    /// Its text behind as many spaces as the layers before it have bytes: a place in it is a place among all.
    text: String,
    start: usize,
}

/// The name of the file, among those of a folder, in which the manifest of a folder that it extends is kept.
pub fn name_of_base(base: &str) -> String {
    format!("../{base}/{MANIFEST}")
}

/// What a manifest extends. One that is broken extends nothing: what is wrong in it is said when it is read.
pub fn extended(manifest: &str) -> Option<String> {
    let table: toml::Table = toml::from_str(manifest).ok()?;
    table.get(EXTENDS)?.as_str().map(str::to_owned)
}

/// The line of a manifest in which it says what it extends.
pub fn line_of_extends(manifest: &str) -> usize {
    let says = |line: &str| line.split('=').next().is_some_and(|key| key.trim() == EXTENDS);
    manifest.lines().position(says).unwrap_or_default() + 1
}

impl Layers {
    /// The manifests of a folder.
    ///
    /// # Errors
    /// One of them is not there, or is not text, or too many extend one another.
    pub fn of(folder: &Folder) -> Result<Self, AssignmentError> {
        let mut texts = vec![(MANIFEST.to_owned(), folder.text(MANIFEST)?)];
        while let Some(base) = texts.last().and_then(|(_, text)| extended(text)) {
            let file = name_of_base(&base);
            if texts.len() == MAX_LAYERS || texts.iter().any(|(known, _)| *known == file) {
                let (from, text) = &texts[texts.len() - 1];
                return Err(error(
                    format!("{from}, line {}", line_of_extends(text)),
                    both(
                        format!(
                            "`{base}` extends this folder in turn, or more than {MAX_LAYERS} folders extend one another"
                        ),
                        format!("`{base}` がこのフォルダを継承しているか、継承が {MAX_LAYERS} 段を超えています"),
                    ),
                ));
            }
            let text = folder.text(&file)?;
            texts.push((file, text));
        }
        let mut start = 0;
        let layers = texts.into_iter().rev().map(|(file, text)| {
            let layer = Layer { file, text: " ".repeat(start) + text, start };
            // One more: the end of a text is no place of the next one.
            start += text.len() + 1;
            layer
        });
        Ok(Self { layers: layers.collect() })
    }

    /// All of them as one.
    ///
    /// # Errors
    /// What does not read as a manifest, with its place.
    pub fn manifest(&self) -> Result<Manifest, AssignmentError> {
        let refused = |e: &toml::de::Error| {
            let message = super::toml_error::explained(e.message());
            let place = e.span().map(|span| self.file_line_column(span.start));
            let Some((file, line, column)) = place else { return AssignmentError::of_file(MANIFEST, message) };
            AssignmentError { line: Some(line), column: Some(column), ..AssignmentError::of_file(file, message) }
        };
        let mut all: Option<Spanned<DeTable>> = None;
        for layer in &self.layers {
            let mut own = DeTable::parse(&layer.text).map_err(|e| refused(&e))?;
            if let Some(base) = all.take() {
                own = Spanned::new(own.span(), self.laid_over(base.into_inner(), own.into_inner())?);
            }
            all = Some(own);
        }
        let all = all.unwrap_or_else(|| Spanned::new(0..0, DeTable::new()));
        Manifest::deserialize(toml::de::Deserializer::from(all)).map_err(|e| refused(&e))
    }

    /// A place, `FILE, line N`, from the number of a byte among all manifests.
    pub fn place_at(&self, at: usize) -> String {
        let (file, line, _) = self.file_line_column(at);
        format!("{file}, line {line}")
    }

    fn file_line_column(&self, at: usize) -> (&str, u32, u32) {
        let found = self.layers.iter().rev().find(|layer| layer.start <= at);
        let Some(Layer { file, text, start }) = found else { return (MANIFEST, 1, 1) };
        let before = text.get(*start..at).unwrap_or_default();
        let line = before.bytes().filter(|byte| *byte == b'\n').count() as u32 + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() as u32 + 1;
        (file, line, column)
    }

    /// A manifest over what it extends.
    fn laid_over<'i>(&self, mut base: DeTable<'i>, mut own: DeTable<'i>) -> Result<DeTable<'i>, AssignmentError> {
        // A homework has its own name, and says itself what it extends.
        for key in ["id", EXTENDS, LEAVE_OUT] {
            base.remove(key);
        }
        for name in strings(own.get(LEAVE_OUT)) {
            if !leave_out(&mut base, name.get_ref()) {
                let (known, name) = (names(&base), name.as_ref());
                let place = self.place_at(own[LEAVE_OUT].span().start);
                let near = super::toml_error::nearest(name, &known.iter().map(String::as_str).collect::<Vec<_>>());
                let (en, ja) = match near {
                    Some(near) => (format!(": write `{near}`"), format!("。`{near}` ではありませんか")),
                    None => (": remove it".to_owned(), "。取り除いてください".to_owned()),
                };
                return Err(error(
                    place,
                    both(
                        format!("what is extended has no `{name}` to leave out{en}"),
                        format!("`{name}` は継承元にありません{ja}"),
                    ),
                ));
            }
        }
        own.remove(LEAVE_OUT);
        lay_table(&mut base, own, "");
        Ok(base)
    }
}

/// The strings of a list.
fn strings<'a, 'i>(list: Option<&'a Spanned<DeValue<'i>>>) -> Vec<Spanned<String>> {
    let list = list.and_then(|list| list.get_ref().as_array());
    let string = |one: &Spanned<DeValue>| one.get_ref().as_str().map(|text| Spanned::new(one.span(), text.to_owned()));
    list.into_iter().flat_map(|list| list.iter()).filter_map(string).collect()
}

/// Takes a key, or the element of a list that has this name, out of a manifest. Whether it was there.
fn leave_out(base: &mut DeTable, name: &str) -> bool {
    let mut is_there = base.remove(name).is_some();
    for (path, identity) in IDENTITIES {
        let Some(list) = at_path(base, path).and_then(list_of) else { continue };
        let kept: Vec<_> = list.iter().filter(|one| !is_called(one, identity, name)).cloned().collect();
        is_there |= kept.len() < list.len();
        *list = kept.into_iter().collect();
    }
    let definitions = at_path(base, "definition").and_then(table_of);
    is_there | definitions.is_some_and(|definitions| definitions.remove(name).is_some())
}

/// What can be left out of a manifest.
fn names(base: &DeTable) -> Vec<String> {
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
        None => table.get_mut(path).map(Spanned::get_mut),
        Some((first, rest)) => at_path(table.get_mut(first).map(Spanned::get_mut).and_then(table_of)?, rest),
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

/// Key by key; `path` is where the table stands.
fn lay_table<'i>(base: &mut DeTable<'i>, own: DeTable<'i>, path: &str) {
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

#[cfg(test)]
mod tests;
