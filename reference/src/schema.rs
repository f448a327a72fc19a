//! The JSON schema of `assignment.toml`, for editors: made from the types that read it, so that no key can be missing.

use crate::manifest::Manifest;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The schema. Descriptions are those of the types.
pub fn schema() -> Schema {
    let generator = SchemaSettings::draft07().into_generator();
    let mut schema = generator.into_root_schema_for::<Manifest>();
    schema.insert("title".to_owned(), "assignment.toml of ggrade".into());
    schema
}

/// The schema as a file has it.
pub fn text() -> String {
    format!("{:#}\n", schema().to_value())
}

/// A number, a truth value, a list, or a table of members.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used")]
pub(crate) enum AnyValue {
    Number(f64),
    Truth(bool),
    List(Vec<AnyValue>),
    Members(BTreeMap<String, AnyValue>),
}

/// The name of a texture, a list of names, or a table of members.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used")]
pub(crate) enum AnyTexture {
    Name(String),
    List(Vec<AnyTexture>),
    Members(BTreeMap<String, AnyTexture>),
}

/// `{ within = [least, greatest] }`, or a table of members with such bounds.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used")]
pub(crate) enum AnyBounds {
    Within {
        /// The least and the greatest value: a number for all components, or a list of as many.
        within: [AnyValue; 2],
    },
    Members(BTreeMap<String, AnyBounds>),
}

/// A table, or several of its kind.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used")]
pub(crate) enum OneOrMany<T> {
    One(T),
    Many(Vec<T>),
}
