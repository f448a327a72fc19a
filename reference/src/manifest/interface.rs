//! What a program is given, as `assignment.toml` has it.

use crate::Text;
use crate::feed::{Attribute, Role};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::{Spanned, Value};

/// A vertex attribute: it is what `carries` or `values` says.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Input")]
pub struct InputEntry {
    /// Its name in the shader.
    #[schemars(with = "String")]
    pub name: Spanned<String>,
    /// Its type, where the shader does not say it.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// What of the mesh it holds.
    pub carries: Option<Attribute>,
    /// Its values, one for each vertex.
    #[schemars(with = "Option<Vec<crate::schema::AnyValue>>")]
    pub values: Option<Vec<Value>>,
}

/// A uniform, or all that lie in a structure, array or block: it is what `carries`, `value`, `is` or `texture` says.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Uniform")]
pub struct UniformEntry {
    /// Its name in the shader, or a path: `lights[1].colour`, `Block.member`.
    #[schemars(with = "String")]
    pub name: Spanned<String>,
    /// Its type, where no shader says it.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// What of camera and model it holds.
    pub carries: Option<Role>,
    /// Its value: a number, a list, or a table of members.
    #[schemars(with = "Option<crate::schema::AnyValue>")]
    pub value: Option<Value>,
    /// Its value as an expression of `t`, `i`, `resolution`, `model`, `view`, `projection` and `eye`.
    #[schemars(with = "Option<String>")]
    pub is: Option<Spanned<String>>,
    /// The name of the texture that a sampler reads; of an array of samplers a list, of a structure a table.
    #[schemars(with = "Option<crate::schema::AnyTexture>")]
    pub texture: Option<Value>,
    /// What probes may draw at random: `{ within = [least, greatest] }`, or a table of members.
    #[schemars(with = "Option<crate::schema::AnyBounds>")]
    pub probe: Option<Value>,
}

/// What a uniform may be that a student adds under a name of their own: it is what `carries`, `is` or `texture` says.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Free")]
pub struct FreeEntry {
    /// Its id in reports, among the advice.
    #[schemars(with = "String")]
    pub id: Spanned<String>,
    /// Its type.
    #[serde(rename = "type")]
    pub kind: String,
    /// What of camera and model it holds.
    pub carries: Option<Role>,
    /// Its value as an expression.
    #[schemars(with = "Option<String>")]
    pub is: Option<Spanned<String>>,
    /// The name of the texture that a sampler reads.
    #[schemars(with = "Option<String>")]
    pub texture: Option<Value>,
    /// What is said of an answer in which a uniform is this.
    pub note: Option<Text>,
}
