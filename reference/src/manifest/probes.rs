//! `[probes]` and `[[region]]`: how samples are chosen.

use super::Variant;
use crate::Text;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// How probes are chosen. Without designs they lie near the vertices of what the scene draws.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Probes {
    /// Number of cameras.
    pub groups: usize,
    /// Vertices for each of them.
    pub per_group: usize,
    /// Definition that is a direction in eye space; positions are placed at an angle from it, as it is at the eye.
    pub axis: String,
    /// Definition that is a direction in eye space; normals are placed at an angle from it.
    pub lobe: String,
    /// Constant to whose power the cosine of that angle is raised.
    pub power: String,
    /// What the vertices of a group show, one after the other.
    pub design: Vec<DesignEntry>,
    /// The solution, changed: some fragments lie where one of these shows something else.
    #[schemars(with = "Vec<Variant>")]
    pub reveal: Vec<Spanned<Variant>>,
}

impl Default for Probes {
    fn default() -> Self {
        let [axis, lobe, power] = Default::default();
        Self { groups: 28, per_group: 20, axis, lobe, power, design: Vec::new(), reveal: Vec::new() }
    }
}

/// A range of numbers.
pub type Range = [f64; 2];

/// Where a vertex lies and how its normal stands.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Design")]
pub struct DesignEntry {
    /// Angle at the eye between the axis and the direction from the vertex, in degrees.
    pub angle: Range,
    /// Distance from the eye.
    pub distance: Range,
    /// Cosine of the angle between the normal and the lobe; or else that, raised to the power:
    pub cosine: Option<Range>,
    /// Where the normal stands so that the cosine, raised to the power, is in this range.
    pub raised: Option<Range>,
    /// Definition → values that it may have.
    #[serde(default)]
    pub within: BTreeMap<String, Range>,
}

/// What a right answer shows at a probe.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Region")]
pub struct RegionEntry {
    /// Its name in this file.
    pub id: String,
    /// Where that is: a GLSL expression of type `bool` with the solution's definitions.
    #[schemars(with = "String")]
    pub when: Spanned<String>,
    /// What is said of a place there.
    pub seen: Text,
    /// Whether a term that is nothing here shows if a clamp is missing.
    #[serde(default)]
    pub shows_clamps: bool,
}
