//! What a program is given: for each uniform and each vertex attribute where its values come from.

mod bounds;
mod expression;

pub use bounds::Bounds;
pub use expression::FeedExpression;

use crate::Value;
use crate::interpreter::{ProgramVariable, Scalar, Type};
use crate::pipeline::{LACKING, columns};
use crate::scene::{Matrices, Moment, Vertex};
use glam::{DMat4, DVec4};
use schemars::JsonSchema;
use serde::Deserialize;

/// Where the value of a uniform comes from.
#[derive(Clone, Debug)]
pub enum Feed {
    /// It is what the camera or the model makes it.
    Role(Role),
    /// It is always the same.
    Constant(Value),
    /// It is computed for each moment.
    Expression(FeedExpression),
    /// It is a sampler of the texture with this number.
    Texture(usize),
    /// It is a sampler of the texture that is drawn before each picture.
    Drawn {
        /// The texture of the first picture; those of the others follow.
        first: usize,
        /// The texture of probes.
        at_probes: usize,
    },
}

/// What the camera and the model give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// From object space to world space.
    Model,
    /// From world space to eye space.
    View,
    /// From eye space to clip space.
    Projection,
    /// From object space to eye space.
    ModelView,
    /// From world space to clip space.
    ViewProjection,
    /// From object space to clip space.
    ModelViewProjection,
    /// From normals in object space to normals in eye space.
    NormalMatrix,
    /// From normals in object space to normals in world space.
    WorldNormalMatrix,
    /// Where the eye is, in world space.
    Eye,
}

impl Role {
    /// Its value as a uniform of this type; `None` where it has no such value.
    pub fn value(self, matrices: &Matrices, kind: &Type) -> Option<Value> {
        let matrix = match self {
            Self::Model => matrices.model,
            Self::View => matrices.view,
            Self::Projection => matrices.projection,
            Self::ModelView => matrices.model_view,
            Self::ViewProjection => matrices.view_projection(),
            Self::ModelViewProjection => matrices.model_view_projection,
            Self::NormalMatrix => matrices.normal,
            Self::WorldNormalMatrix => matrices.world_normal(),
            Self::Eye => {
                let count = match kind {
                    Type::Vector(Scalar::Float, count @ (3 | 4)) => usize::from(*count),
                    _ => return None,
                };
                return Value::new(kind.clone(), matrices.eye().extend(1.0).to_array()[..count].to_vec());
            }
        };
        let numbers = match kind {
            Type::Matrix(Scalar::Float, 4, 4) => matrix.to_cols_array().to_vec(),
            Type::Matrix(Scalar::Float, 3, 3) => upper_left(matrix).to_vec(),
            _ => return None,
        };
        Value::new(kind.clone(), numbers)
    }

    /// The types that it may have.
    pub fn types(self) -> &'static str {
        if self == Self::Eye { "vec3 or vec4" } else { "mat4 or mat3" }
    }

    /// Whether model and view are told apart by it.
    pub(crate) fn is_of_the_world(self) -> bool {
        matches!(self, Self::Model | Self::View | Self::ViewProjection | Self::WorldNormalMatrix | Self::Eye)
    }
}

fn upper_left(matrix: DMat4) -> [f64; 9] {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| column.truncate().to_array());
    let mut numbers = [0.0; 9];
    [x, y, z].concat().iter().zip(&mut numbers).for_each(|(from, to)| *to = *from);
    numbers
}

impl Feed {
    /// The value of a uniform of this type at a moment; `None` where an expression has none.
    pub fn value(&self, kind: &Type, moment: &Moment) -> Option<Value> {
        match self {
            Self::Role(role) => role.value(&moment.matrices, kind),
            Self::Constant(value) => Some(value.clone()),
            Self::Expression(expression) => expression.value(moment),
            Self::Texture(number) => Value::new(kind.clone(), vec![*number as f64]),
            Self::Drawn { first, at_probes } => {
                let number = moment.picture.map_or(*at_probes, |picture| first + picture);
                Value::new(kind.clone(), vec![number as f64])
            }
        }
    }
}

/// Where the values of a vertex attribute come from.
#[derive(Clone, Debug)]
pub enum Stream {
    /// The mesh has them.
    Mesh(Attribute),
    /// They stand in the folder, one for each vertex; after the last comes the first again.
    Listed(Vec<Value>),
}

/// What a vertex of a mesh has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Attribute {
    /// Position in object space, w = 1.
    Position,
    /// Normal in object space, w = 1.
    Normal,
    /// Normal in object space, as the vector that it is: w = 0.
    NormalVector,
    /// Texture coordinates; z = 0, w = 1.
    TextureCoordinates,
    /// Tangent in object space; w is the sign of the bitangent.
    Tangent,
    /// The number of the vertex in its mesh.
    Number,
}

impl Attribute {
    /// It at a vertex, as four components.
    pub fn at(self, vertex: &Vertex) -> DVec4 {
        match self {
            Self::Position => vertex.position,
            Self::Normal => vertex.normal,
            Self::NormalVector => vertex.normal.truncate().extend(0.0),
            Self::TextureCoordinates => vertex.texture_coordinates.extend(0.0).extend(1.0),
            Self::Tangent => vertex.tangent,
            Self::Number => DVec4::new(f64::from(vertex.number), 0.0, 0.0, 1.0),
        }
    }
}

impl Stream {
    /// The attribute's value at a vertex.
    pub fn value(&self, kind: &Type, vertex: &Vertex) -> Value {
        let attribute = match self {
            Self::Mesh(attribute) => *attribute,
            Self::Listed(values) => return values[vertex.number as usize % values.len()].clone(),
        };
        let vector = attribute.at(vertex);
        let count = kind.slots().unwrap_or(0).min(4);
        Value::new(kind.clone(), vector.to_array()[..count].to_vec()).unwrap_or_else(|| Value::from(vector))
    }

    /// A column of the values at all vertices for each scalar of a program's input, which may have more or fewer than the attribute.
    pub(crate) fn columns(&self, kind: &Type, input: &ProgramVariable, vertices: &[Vertex]) -> Vec<Vec<f64>> {
        match self {
            Self::Mesh(attribute) => {
                let known = kind.slots().unwrap_or(0).min(4);
                let scalar = |scalar: usize, vertex: &Vertex| match scalar {
                    _ if scalar < known => attribute.at(vertex)[scalar],
                    _ => LACKING.get(scalar).copied().unwrap_or(0.0),
                };
                let column = |number: usize| vertices.iter().map(|vertex| scalar(number, vertex)).collect();
                (0..input.kind.slots().unwrap_or(0)).map(column).collect()
            }
            Self::Listed(values) => {
                columns(input, vertices.iter().map(|vertex| &values[vertex.number as usize % values.len()]))
            }
        }
    }

    /// Whether an attribute of this type can hold it.
    pub fn fits(&self, kind: &Type) -> bool {
        match (self, kind) {
            (Self::Mesh(Attribute::Number), Type::Vector(scalar, 1)) => *scalar != Scalar::Bool,
            (Self::Mesh(Attribute::Number), _) => false,
            (Self::Mesh(_), kind) => matches!(kind, Type::Vector(Scalar::Float, _)),
            (Self::Listed(values), kind) => !values.is_empty() && values.iter().all(|value| value.kind() == kind),
        }
    }
}
