//! What is drawn, as `assignment.toml` has it; lengths in world units, angles in radians.

use crate::scene::{Cull, DepthTest, Shape};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// One scene or several.
#[derive(Debug, JsonSchema)]
#[schemars(with = "crate::schema::OneOrMany<SceneEntry>")]
pub struct Scenes(pub Vec<SceneEntry>);

impl<'de> Deserialize<'de> for Scenes {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ScenesVisitor;
        impl<'de> serde::de::Visitor<'de> for ScenesVisitor {
            type Value = Scenes;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a table [scene], or several [[scene]]")
            }
            fn visit_map<A: serde::de::MapAccess<'de>>(self, map: A) -> Result<Scenes, A::Error> {
                SceneEntry::deserialize(serde::de::value::MapAccessDeserializer::new(map)).map(|one| Scenes(vec![one]))
            }
            fn visit_seq<A: serde::de::SeqAccess<'de>>(self, sequence: A) -> Result<Scenes, A::Error> {
                Vec::deserialize(serde::de::value::SeqAccessDeserializer::new(sequence)).map(Scenes)
            }
        }
        deserializer.deserialize_any(ScenesVisitor)
    }
}

/// Geometry, camera, animation. What a further scene does not say is as in the first one.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Scene")]
pub struct SceneEntry {
    /// Vertices of a triangle.
    pub triangle: Option<[[f64; 3]; 3]>,
    /// Their normals.
    pub normals: Option<[[f64; 3]; 3]>,
    /// What is drawn, where it is one thing.
    #[schemars(with = "Option<Shape>")]
    pub mesh: Option<Spanned<Shape>>,
    /// Turn about y in one cycle.
    pub turn: Option<f64>,
    /// Where it stands in the world, as an expression of `t`, `i` and `resolution`.
    #[schemars(with = "Option<String>")]
    pub model: Option<Spanned<String>>,
    /// How many times it is drawn.
    pub instances: Option<u32>,
    /// Which pixels are drawn over others.
    pub depth_test: Option<Depth>,
    /// Which triangles are left out.
    pub cull: Option<Cull>,
    /// What is drawn, one thing after the other.
    pub draw: Option<Vec<DrawEntry>>,
    /// Where the eye is: three numbers, or an expression.
    pub eye: Option<PointEntry>,
    /// What it looks at.
    pub target: Option<PointEntry>,
    /// Which way is up.
    pub up: Option<[f64; 3]>,
    /// Vertical field of view.
    pub fovy: Option<f64>,
    /// Near clipping plane.
    pub near: Option<f64>,
    /// Far clipping plane.
    pub far: Option<f64>,
    /// Seconds in a cycle.
    pub cycle: Option<f64>,
    /// Width and height in pixels.
    pub window: Option<[u32; 2]>,
    /// Clear colour, RGBA.
    pub background: Option<[u8; 4]>,
    /// The poses that are looked at.
    pub poses: Option<Poses>,
}

/// One of several things that are drawn. What it does not say is as in its scene.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Draw")]
pub struct DrawEntry {
    /// Its name, for passes that draw it.
    pub name: Option<String>,
    /// Its vertices and triangles.
    #[schemars(with = "Shape")]
    pub mesh: Spanned<Shape>,
    /// Turn about y in one cycle.
    pub turn: Option<f64>,
    /// Where it stands in the world, as an expression of `t`, `i` and `resolution`.
    #[schemars(with = "Option<String>")]
    pub model: Option<Spanned<String>>,
    /// How many times it is drawn.
    pub instances: Option<u32>,
    /// Which pixels are drawn over others.
    pub depth_test: Option<Depth>,
    /// Which triangles are left out.
    pub cull: Option<Cull>,
}

/// Which pixels are drawn over others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Depth {
    /// Each.
    Off,
    /// Those that are nearer.
    Less,
    /// Those that are nearer or as near.
    LessEqual,
}

impl Depth {
    /// The test, if there is one.
    pub fn test(self) -> Option<DepthTest> {
        match self {
            Self::Off => None,
            Self::Less => Some(DepthTest::Less),
            Self::LessEqual => Some(DepthTest::LessEqual),
        }
    }
}

/// A place: three numbers, or an expression.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "write a point, [x, y, z], or an expression of t between quotation marks")]
#[schemars(rename = "Point")]
pub enum PointEntry {
    /// It stays.
    Numbers([f64; 3]),
    /// It is computed.
    Expression(String),
}

/// So many poses, evenly spaced from t = 0, or the values of t.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Poses {
    /// How many.
    Count(u32),
    /// When.
    Times(Vec<f64>),
}
