//! Which texture each sampler reads.

use super::super::CheckResult;
use super::super::solution;
use super::super::stages::Compiled;
use super::super::textures::place;
use super::values::part;
use crate::Text;
use crate::assignment::{MANIFEST, Uniform, error};
use crate::feed::Feed;
use crate::interpreter::{Sampler, Texels, Texture, Type};
use crate::manifest;
use crate::text::both;

/// The textures of a folder, for samplers.
#[derive(Clone, Copy)]
pub(super) struct FolderSamplers<'a> {
    /// What the manifest says of them.
    pub entries: &'a [manifest::TextureEntry],
    /// Themselves, in the same order.
    pub textures: &'a [Texture],
    pub place_at: &'a dyn Fn(usize) -> String,
}

impl FolderSamplers<'_> {
    /// The texture that a uniform's sampler reads. `rest`: the path from the entry's name to the sampler.
    pub fn feed(&self, entry: &manifest::UniformEntry, rest: &str, sampler: Sampler) -> Result<Feed, Text> {
        let kind = Type::Sampler(sampler);
        let alone = entry.texture.as_ref().filter(|_| {
            entry.carries.is_none() && entry.value.is_none() && entry.is.is_none() && entry.probe.is_none()
        });
        let Some(said) = alone else {
            return Err(both(
                format!("it is a {kind}: write `texture = \"…\"` with the name of a [[texture]], and nothing else"),
                format!("{kind} です。`texture = \"…\"` に [[texture]] の名前だけを書いてください"),
            ));
        };
        let found = part(said, rest)?;
        let Some(name) = found.as_str() else {
            return Err(both(
                format!("`texture` of a {kind} is the name of a [[texture]]: write it between quotation marks"),
                format!("{kind} の `texture` には [[texture]] の名前を引用符で囲んで書いてください"),
            ));
        };
        let number = self.entries.iter().position(|entry| entry.name.get_ref() == name).ok_or_else(|| {
            let known: Vec<_> = self.entries.iter().map(|entry| format!("`{}`", entry.name.get_ref())).collect();
            let (en, ja) = if known.is_empty() { ("none", "なし") } else { ("", "") };
            let known = known.join(", ");
            both(
                format!("there is no texture `{name}` (there is {en}{known}): add [[texture]], or correct the name"),
                format!("テクスチャ `{name}` はありません (あるもの: {ja}{known})。[[texture]] を追加するか、名前を直してください"),
            )
        })?;
        let texture = &self.textures[number];
        if texture.fits(sampler) {
            return Ok(match texture.levels[0].texels {
                Texels::Depths(_) => Feed::Drawn { first: self.entries.len(), at_probes: number },
                _ => Feed::Texture(number),
            });
        }
        let fitting = Type::Sampler(texture.sampler());
        Err(both(
            format!(
                "it is a {kind} in the shader, and `{name}` is read by a {fitting}: declare that, or take another texture"
            ),
            format!(
                "シェーダでは {kind} ですが、`{name}` を読むのは {fitting} です。宣言を直すか、別のテクスチャを書いてください"
            ),
        ))
    }

    /// Every sampler of a stage has a texture, and every texture a sampler.
    pub fn are_all_fed(&self, programs: &[Compiled], uniforms: &[Uniform]) -> CheckResult<()> {
        for Compiled { name, program, .. } in programs {
            let mut samplers = program.uniforms().iter().filter(|uniform| matches!(uniform.kind, Type::Sampler(_)));
            let lacking = samplers.find(|sampler| uniforms.iter().all(|uniform| uniform.path != sampler.name));
            if let Some(sampler) = lacking {
                let (path, kind) = (&sampler.name, &sampler.kind);
                let message = both(
                    format!(
                        "the {kind} `{path}` has no texture: write [[uniform]] with `name = \"{path}\"` and `texture = \"…\"` in {MANIFEST}"
                    ),
                    format!(
                        "{kind} `{path}` にテクスチャがありません。{MANIFEST} の [[uniform]] に `name = \"{path}\"` と `texture = \"…\"` を書いてください"
                    ),
                );
                return Err(error(solution::place(name, sampler.line), message));
            }
        }
        let reads = |feed: &Feed, number: usize| match feed {
            Feed::Texture(own) | Feed::Drawn { at_probes: own, .. } => *own == number,
            _ => false,
        };
        let is_read = |number: usize| uniforms.iter().any(|uniform| reads(&uniform.feed, number));
        match (0..self.entries.len()).find(|number| !is_read(*number)) {
            None => Ok(()),
            Some(number) => {
                let entry = &self.entries[number];
                let name = entry.name.get_ref();
                Err(error(
                    place(entry, self.place_at),
                    both(
                        format!("no uniform reads it: write [[uniform]] with `texture = \"{name}\"`, or remove it"),
                        format!(
                            "どの uniform からも読まれません。[[uniform]] に `texture = \"{name}\"` を書くか、取り除いてください"
                        ),
                    ),
                ))
            }
        }
    }
}
