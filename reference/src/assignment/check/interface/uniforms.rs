//! Uniforms: which of the shaders' an entry speaks of, and where the value of each comes from.

use super::{InterfaceReader, declared_as, values};
use crate::Text;
use crate::assignment::check::expression::expression;
use crate::assignment::check::stages::Compiled;
use crate::assignment::check::{CheckResult, solution};
use crate::assignment::{Uniform, error};
use crate::feed::{Feed, Role};
use crate::interpreter::{BlockPlace, ProgramVariable, Type};
use crate::manifest;
use crate::text::both;

/// Whether a path names this variable or something that it lies in.
fn lies_in(name: &str, path: &str) -> bool {
    name.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// What is wrong with a key of a uniform's entry.
fn of_key(key: &str, leaf: &str, kind: &Type, what: &Text) -> Text {
    let Text { en, ja } = what;
    both(format!("`{key}` of `{leaf}`, a {kind}: {en}"), format!("`{leaf}` ({kind}) の `{key}`: {ja}"))
}

impl InterfaceReader<'_> {
    /// The uniforms of an entry.
    pub(super) fn uniforms(&self, entry: &manifest::UniformEntry, all: &mut Vec<Uniform>) -> CheckResult<()> {
        let (path, at) = (entry.name.get_ref(), entry.name.span().start);
        let place = format!("uniform `{path}`");
        let leaves = self.leaves(entry, &place)?;
        if let Some((twice, _)) = leaves.iter().find(|(leaf, _)| all.iter().any(|known| known.path == *leaf)) {
            let message = both(
                format!("`{twice}` stands twice: keep one"),
                format!("`{twice}` が 2 回書かれています。一方を取り除いてください"),
            );
            return Err(self.wrong(at, &place, message));
        }
        let rests: Vec<&str> = leaves.iter().map(|(leaf, _)| &leaf[path.len()..]).collect();
        for (key, said) in [("value", &entry.value), ("probe", &entry.probe)] {
            if let Some(name) = said.as_ref().and_then(|said| values::unknown_member(said, &rests)) {
                let message = both(
                    format!(
                        "`{key}` says something of `{name}`, which `{path}` does not have: correct the name, or remove it"
                    ),
                    format!(
                        "`{key}` に `{name}` が書かれていますが、`{path}` にそのメンバはありません。名前を直すか、取り除いてください"
                    ),
                );
                return Err(self.wrong(at, &place, message));
            }
        }
        for (leaf, kind) in leaves {
            let rest = &leaf[path.len()..];
            let feed = self.feed(entry, rest, &leaf, &kind, &place)?;
            let probe = match &entry.probe {
                None => None,
                Some(said) => values::bounds(said, rest, &kind)
                    .map_err(|what| self.wrong(at, &place, of_key("probe", &leaf, &kind, &what)))?,
            };
            let place = self.place_in_block(&leaf);
            all.push(Uniform { path: leaf, kind, feed, probe, place });
        }
        Ok(())
    }

    /// Where a uniform lies in a block that a shader of the folder lays out by `std140`.
    fn place_in_block(&self, leaf: &str) -> Option<BlockPlace> {
        let variables = self.programs.iter().flat_map(|own| own.program.uniforms());
        let mut places = variables.filter(|own| own.name == leaf).filter_map(|own| own.place.as_ref());
        places.find(|place| place.is_std140).cloned()
    }

    /// Where the value of `leaf` comes from, which lies at `rest` in what the entry names.
    pub(super) fn feed(
        &self,
        entry: &manifest::UniformEntry,
        rest: &str,
        leaf: &str,
        kind: &Type,
        place: &str,
    ) -> CheckResult<Feed> {
        let at = entry.name.span().start;
        if let Type::Sampler(sampler) = kind {
            let feed = self.samplers.feed(entry, rest, *sampler);
            return feed.map_err(|message| self.wrong(at, place, message));
        }
        if entry.texture.is_some() {
            let message = both(
                format!("`{leaf}` is a {kind} in the shader, and a texture is read by a sampler2D or a samplerCube"),
                format!("シェーダで `{leaf}` は {kind} です。テクスチャを読むのは sampler2D か samplerCube です"),
            );
            return Err(self.wrong(at, place, message));
        }
        match (entry.carries, &entry.value, &entry.is) {
            (Some(role), None, None) => self.role(role, kind).map_err(|what| self.wrong(at, place, what)),
            (None, Some(value), None) => {
                let value = values::part(value, rest).and_then(|part| values::value(part, kind));
                value.map(Feed::Constant).map_err(|what| self.wrong(at, place, of_key("value", leaf, kind, &what)))
            }
            (None, None, Some(text)) if rest.is_empty() => {
                let expression = expression(text, kind, place, self.place_at)?;
                Ok(Feed::Expression(expression))
            }
            (None, None, Some(text)) => {
                let message = both(
                    format!("`is` gives a scalar, vector or matrix: write an entry for `{leaf}` and each other part"),
                    format!("`is` で書けるのはスカラー、ベクトル、行列です。`{leaf}` などの部分ごとに書いてください"),
                );
                Err(self.wrong(text.span().start, place, message))
            }
            (None, None, None) => {
                let message = both(
                    "write where its value comes from: `carries`, `value` or `is`",
                    "値の与え方を `carries`、`value`、`is` のいずれかで書いてください",
                );
                Err(self.wrong(at, place, message))
            }
            _ => {
                let message = both(
                    "write one of `carries`, `value` and `is`",
                    "`carries`、`value`、`is` のうち 1 つだけを書いてください",
                );
                Err(self.wrong(at, place, message))
            }
        }
    }

    fn role(&self, role: Role, kind: &Type) -> Result<Feed, Text> {
        let identity = crate::scene::Matrices::new(glam::DMat4::IDENTITY, glam::DMat4::IDENTITY);
        match role.value(&identity, kind) {
            Some(_) => Ok(Feed::Role(role)),
            None => Err(both(
                format!("it is a {kind} in the shader, and what it carries is {}: declare it so", role.types()),
                format!(
                    "シェーダでは {kind} ですが、`carries` の値は {} です。その型で宣言してください",
                    role.types().replace(" or ", " または ")
                ),
            )),
        }
    }

    /// The uniforms that an entry speaks of, each with its type.
    fn leaves(&self, entry: &manifest::UniformEntry, place: &str) -> CheckResult<Vec<(String, Type)>> {
        let path = entry.name.get_ref();
        let mut leaves: Vec<(&ProgramVariable, &str)> = Vec::new();
        for Compiled { name, program, .. } in self.programs {
            for variable in program.uniforms().iter().filter(|variable| lies_in(&variable.name, path)) {
                match leaves.iter().find(|(known, _)| known.name == variable.name) {
                    Some((known, first)) if known.kind != variable.kind => {
                        let (one, other) = (&known.kind, &variable.kind);
                        let path = &variable.name;
                        let message = both(
                            format!("`{path}` is a {other} here and a {one} in {first}: declare it alike in both"),
                            format!("`{path}` はここでは {other}、{first} では {one} です。同じ型で宣言してください"),
                        );
                        return Err(error(solution::place(name, variable.line), message));
                    }
                    Some(_) => {}
                    None => leaves.push((variable, name)),
                }
            }
        }
        let found: Vec<_> = leaves.iter().map(|(leaf, _)| (leaf.name.clone(), leaf.kind.clone())).collect();
        if let Some(said) = &entry.kind {
            let kind = self.named(said, entry.name.span().start, place)?;
            return match &found[..] {
                [] => Ok(vec![(path.clone(), kind)]),
                [(name, known)] if name == path && *known != kind => {
                    let message = declared_as(known);
                    Err(self.wrong(entry.name.span().start, place, message))
                }
                _ => Ok(found),
            };
        }
        if found.is_empty() {
            let names: Vec<&str> = self.programs.iter().map(|program| program.name.as_str()).collect();
            let message = both(
                format!(
                    "there is no such uniform in {}: declare `uniform type {path};` there, or write `type = …` here",
                    names.join(" or ")
                ),
                format!(
                    "{} にこの uniform はありません。そこで `uniform 型 {path};` と宣言するか、ここに `type = …` を書いてください",
                    names.join(" にも ")
                ),
            );
            return Err(self.wrong(entry.name.span().start, place, message));
        }
        Ok(found)
    }
}
