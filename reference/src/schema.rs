//! The JSON schema of `assignment.toml`, for editors: made from the types that read it, so that no key can be missing.

use crate::manifest::Manifest;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, json_schema};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// The schema. Descriptions are those of the types.
pub fn schema() -> Schema {
    let mut generator = SchemaSettings::draft07().into_generator();
    generator.subschema_for::<Manifest>();
    let definitions = Value::Object(generator.take_definitions(true));
    // What extends another homework may leave out whatever that one says.
    let mut laid_over = definitions.clone();
    loosen(&mut laid_over);
    json_schema!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "assignment.toml of ggrade",
        "required": ["id"],
        "if": { "required": ["extends"] },
        "then": { "$ref": "#/laidOver/Manifest" },
        "else": { "$ref": "#/definitions/Manifest" },
        "definitions": definitions,
        "laidOver": laid_over,
    })
}

/// Takes out what asks for a key, and refers to the same without that.
fn loosen(schema: &mut Value) {
    match schema {
        Value::Object(members) => {
            if members.get("required").is_some_and(Value::is_array) {
                members.remove("required");
            }
            for (key, member) in members {
                match member {
                    Value::String(path) if key == "$ref" => *path = path.replace("#/definitions/", "#/laidOver/"),
                    member => loosen(member),
                }
            }
        }
        Value::Array(elements) => elements.iter_mut().for_each(loosen),
        _ => {}
    }
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
