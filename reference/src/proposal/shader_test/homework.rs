//! A test as parts of a homework: attributes, values of uniforms, and the scene.

use super::drawing::{self, TestDraw};
use super::{ShaderTest, VERTEX};
use crate::interpreter::Type;
use crate::proposal::uniforms::{ProposedAttribute, numbers};

impl ShaderTest {
    /// Whether the vertex stage only hands on positions.
    pub fn is_passthrough(&self) -> bool {
        self.has_passthrough
    }

    /// The attribute of such a stage.
    pub fn passthrough(&self) -> Vec<ProposedAttribute> {
        let listed = self.attribute(VERTEX, &Type::VEC4).map(|values| format!("values = {values}"));
        let said = listed.unwrap_or_else(|| "carries = \"position\"".to_owned());
        vec![ProposedAttribute { name: VERTEX.to_owned(), said }]
    }

    /// The values of an attribute that the test lists, as TOML.
    pub fn attribute(&self, name: &str, kind: &Type) -> Option<String> {
        let is_used = self.draws.iter().any(|draw| matches!(draw, TestDraw::Arrays { .. }));
        self.data.attribute(name, kind.slots()?).filter(|_| is_used)
    }

    /// The value of a uniform as TOML, where the test sets one and the same for all that it draws.
    pub fn value_of(&self, path: &str, kind: &Type) -> Option<String> {
        let (_, values) =
            self.uniforms.get(path).or_else(|| self.uniforms.get(path.trim_end_matches("[0]")))?.first()?;
        (Some(values.len()) == kind.slots()).then(|| numbers(values, kind))
    }

    /// Its value as an expression of the number of what is drawn, where the test changes it.
    pub fn expression_of(&self, path: &str, kind: &Type) -> Option<String> {
        let [(_, first), rest @ ..] = &self.uniforms.get(path)?[..] else { return None };
        let is_known = |values: &[f64]| Some(values.len()) == kind.slots();
        if rest.is_empty() || !is_known(first) || !rest.iter().all(|(_, values)| is_known(values)) {
            return None;
        }
        let one = |values: &[f64]| {
            let list: Vec<_> = values.iter().map(|value| drawing::literal(*value, kind)).collect();
            if values.len() == 1 { list[0].clone() } else { format!("{kind}({})", list.join(", ")) }
        };
        let mut text = String::new();
        for (at, (_, values)) in self.uniforms[path].iter().enumerate() {
            match self.uniforms[path].get(at + 1) {
                Some((next, _)) => text += &format!("i < {next} ? {} : ", one(values)),
                None => text += &one(values),
            }
        }
        Some(text)
    }

    /// The lines of `[scene]`.
    pub fn scene(&self) -> Vec<String> {
        let byte = |share: &f64| (share.clamp(0.0, 1.0) * 255.0).round() as u8;
        let background: Vec<_> = self.background[..3].iter().map(|share| byte(share).to_string()).collect();
        let mut lines = vec![
            "eye = [0, 0, 1] # the test draws in clip space: the camera plays no part".to_owned(),
            "target = [0, 0, 0]\nup = [0, 1, 0]\nfovy = 1\nnear = 0.1\nfar = 10".to_owned(),
            format!("window = [{}, {}]", self.size[0], self.size[1]),
            format!("background = [{}, 255]", background.join(", ")),
            "poses = 1\ndepth_test = \"off\"".to_owned(),
        ];
        lines.extend(self.draws.iter().map(|draw| format!("\n[[scene.draw]]\nmesh = {}", draw.mesh(&self.data))));
        lines
    }
}
