//! `assignment.toml` and those that it extends, read as one.

mod overlay;

use super::Manifest;
use crate::assignment::{AssignmentError, MANIFEST, error};
use crate::folder::Folder;
use crate::text::both;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Most folders that extend one another.
const MAX_LAYERS: usize = 8;

/// The key that names what is extended, and the key that names what of it is not taken over.
const EXTENDS: &str = "extends";
const LEAVE_OUT: &str = "leave_out";

/// The manifests of a folder, the one that extends none first.
pub struct Layers {
    layers: Vec<ManifestLayer>,
}

/// A manifest in the text of all of them.
struct ManifestLayer {
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
            let layer = ManifestLayer { file, text: " ".repeat(start) + text, start };
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
        let Some(ManifestLayer { file, text, start }) = found else { return (MANIFEST, 1, 1) };
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
        // What goes with another may be named as well.
        let known = overlay::names(&base);
        for name in strings(own.get(LEAVE_OUT)) {
            let is_left_out = overlay::leave_out(&mut base, name.get_ref());
            if !is_left_out && !known.contains(name.get_ref()) {
                let name = name.as_ref();
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
        overlay::lay(&mut base, own);
        Ok(base)
    }
}

/// The strings of a list.
fn strings<'a, 'i>(list: Option<&'a Spanned<DeValue<'i>>>) -> Vec<Spanned<String>> {
    let list = list.and_then(|list| list.get_ref().as_array());
    let string = |one: &Spanned<DeValue>| one.get_ref().as_str().map(|text| Spanned::new(one.span(), text.to_owned()));
    list.into_iter().flat_map(|list| list.iter()).filter_map(string).collect()
}

#[cfg(test)]
mod tests;
