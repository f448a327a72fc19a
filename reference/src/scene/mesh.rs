//! Triangles with shared vertices.

mod derived;
mod file;
mod shapes;

use super::Vertex;
use crate::text::both;
use crate::{Folder, Text};
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt;

/// More vertices than this are refused: a picture of 640 × 480 shows no more.
const MOST_VERTICES: usize = 100_000;
/// More triangles than this are refused.
const MOST_TRIANGLES: usize = 200_000;
/// Coordinates farther out than this are refused: their products would leave the range of a float.
const FARTHEST: f64 = 1e6;

/// The vertices of an object and the triangles between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// The vertices.
    pub vertices: Vec<Vertex>,
    /// Three vertices each, by number; the front is where they run against the clock.
    pub triangles: Vec<[u32; 3]>,
    /// Whether it is the window, in clip space.
    pub fills_window: bool,
    /// The corners of the box that holds all vertices.
    bounds: (DVec3, DVec3),
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshError {
    /// What is wrong, and what to try.
    pub message: Text,
    /// The file that it is read from.
    pub file: Option<String>,
    /// The line in it, from 1, where it is known.
    pub line: Option<u32>,
}

impl MeshError {
    fn new(en: impl Into<String>, ja: impl Into<String>) -> Self {
        Self { message: both(en, ja), file: None, line: None }
    }

    /// The same, of a file.
    fn in_file(self, name: &str) -> Self {
        Self { file: self.file.or_else(|| Some(name.to_owned())), ..self }
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message.en)
    }
}

impl std::error::Error for MeshError {}

fn refused<T>(en: impl Into<String>, ja: impl Into<String>) -> Result<T, MeshError> {
    Err(MeshError::new(en, ja))
}

/// Refuses what is too much.
fn bounded(vertices: usize, triangles: usize) -> Result<(), MeshError> {
    if vertices <= MOST_VERTICES && triangles <= MOST_TRIANGLES {
        return Ok(());
    }
    refused(
        format!(
            "it has {vertices} vertices and {triangles} triangles: use at most {MOST_VERTICES} and {MOST_TRIANGLES}"
        ),
        format!(
            "頂点が {vertices} 個、三角形が {triangles} 個あります。{MOST_VERTICES} 個以下、{MOST_TRIANGLES} 個以下にしてください"
        ),
    )
}

impl Mesh {
    /// A mesh whose vertices are numbered, and whose triangles have vertices.
    ///
    /// # Errors
    /// It has none, or too many, or a triangle names a vertex that is not there, or a coordinate is no number or too far out.
    pub fn new(mut vertices: Vec<Vertex>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if vertices.is_empty() || triangles.is_empty() {
            return refused("it has no triangle: add some", "三角形がありません。追加してください");
        }
        bounded(vertices.len(), triangles.len())?;
        let count = vertices.len() as u32;
        if let Some(place) = triangles.iter().position(|triangle| triangle.iter().any(|&vertex| vertex >= count)) {
            return refused(
                format!("triangle {place} names a vertex that is not there: there are {count}, from 0"),
                format!("三角形 {place} の頂点番号が範囲を超えています。頂点は 0 から数えて {count} 個です"),
            );
        }
        for (number, vertex) in vertices.iter_mut().enumerate() {
            let numbers =
                [vertex.position, vertex.normal, vertex.tangent, vertex.texture_coordinates.extend(0.0).extend(0.0)];
            if !numbers.iter().all(|vector| vector.is_finite() && vector.abs().max_element() <= FARTHEST) {
                return refused(
                    format!("vertex {number} has a coordinate that is no number, or beyond {FARTHEST:e}"),
                    format!("頂点 {number} に、数でない座標か {FARTHEST:e} を超える座標があります"),
                );
            }
            vertex.number = number as u32;
        }
        let points = vertices.iter().map(|vertex| vertex.position.truncate());
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let bounds = points.fold(start, |(low, high), point| (low.min(point), high.max(point)));
        Ok(Self { vertices, triangles, fills_window: false, bounds })
    }
}

impl Mesh {
    /// The corners of the box that holds all vertices.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }
}

/// A mesh as a folder writes it: a built-in one with its parameters, `{ torus = { radius = 1, tube = 0.4 } }`, or a file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// One triangle in the plane z = 0, upright.
    Triangle(Sized2),
    /// A rectangle in the plane z = 0.
    Quad(Sized2),
    /// A rectangle in the plane y = 0 of many squares.
    Grid(Grid),
    /// A box with flat faces.
    Cube(Sized3),
    /// A sphere; its poles are on the y axis.
    Sphere(Sphere),
    /// A ring about the y axis.
    Torus(Torus),
    /// The whole window, in clip space.
    Fullscreen(Nothing),
    /// Vertices that stand in the manifest.
    Vertices(Listed),
    /// A file of the folder: OBJ, or glTF as text or binary.
    File(String),
}

/// No parameters.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Nothing {}

/// Width and height.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sized2 {
    #[serde(default = "two")]
    size: [f64; 2],
}

/// The lengths of the edges.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sized3 {
    #[serde(default = "three")]
    size: [f64; 3],
}

/// Width, depth and the number of squares along them.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    #[serde(default = "two")]
    size: [f64; 2],
    #[serde(default = "squares")]
    segments: [u32; 2],
}

/// Radius, and the number of segments around the axis and from pole to pole.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    #[serde(default = "one")]
    radius: f64,
    #[serde(default = "around")]
    segments: [u32; 2],
}

/// The radius of the ring, that of its tube, and the number of segments along the ring and around the tube.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Torus {
    #[serde(default = "one")]
    radius: f64,
    #[serde(default = "tube")]
    tube: f64,
    #[serde(default = "around")]
    segments: [u32; 2],
}

/// A mesh number by number; what is not there is 0.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Listed {
    positions: Vec<[f64; 3]>,
    #[serde(default)]
    normals: Vec<[f64; 3]>,
    #[serde(default)]
    texture_coordinates: Vec<[f64; 2]>,
    /// Without them each three vertices are a triangle.
    #[serde(default)]
    triangles: Vec<[u32; 3]>,
}

fn one() -> f64 {
    1.0
}
fn tube() -> f64 {
    0.4
}
fn two() -> [f64; 2] {
    [2.0; 2]
}
fn three() -> [f64; 3] {
    [2.0; 3]
}
fn squares() -> [u32; 2] {
    [32; 2]
}
fn around() -> [u32; 2] {
    [36, 18]
}

impl Shape {
    /// The mesh.
    ///
    /// # Errors
    /// The parameters make none, or the file has none.
    pub fn mesh(&self, folder: &Folder) -> Result<Mesh, MeshError> {
        match self {
            Self::Triangle(Sized2 { size }) => shapes::triangle(*size),
            Self::Quad(Sized2 { size }) => shapes::quad(*size),
            Self::Grid(Grid { size, segments }) => shapes::grid(*size, *segments),
            Self::Cube(Sized3 { size }) => shapes::cube(*size),
            Self::Sphere(Sphere { radius, segments }) => shapes::sphere(*radius, *segments),
            Self::Torus(Torus { radius, tube, segments }) => shapes::torus([*radius, *tube], *segments),
            Self::Fullscreen(Nothing {}) => {
                shapes::quad([2.0, 2.0]).map(|window| Mesh { fills_window: true, ..window })
            }
            Self::Vertices(listed) => listed.mesh(),
            Self::File(name) => file::read(name, folder).map_err(|wrong| wrong.in_file(name)),
        }
    }
}

impl Listed {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        let count = self.positions.len();
        for (name, given) in [("normals", self.normals.len()), ("texture_coordinates", self.texture_coordinates.len())]
        {
            if given != 0 && given != count {
                return refused(
                    format!("there are {given} {name} for {count} positions: write as many"),
                    format!("`positions` が {count} 個、`{name}` が {given} 個あります。同じ数だけ書いてください"),
                );
            }
        }
        let vertex = |(at, position): (usize, &[f64; 3])| {
            let normal = self.normals.get(at).copied().unwrap_or_default();
            let coordinates = self.texture_coordinates.get(at).copied().unwrap_or_default();
            Vertex::new(DVec3::from_array(*position), DVec3::from_array(normal))
                .textured(DVec2::from_array(coordinates))
        };
        let mut vertices: Vec<Vertex> = self.positions.iter().enumerate().map(vertex).collect();
        if self.triangles.is_empty() && !count.is_multiple_of(3) {
            return refused(
                format!("{count} positions are no triangles: write three for each, or `triangles`"),
                format!(
                    "`positions` が {count} 個では三角形になりません。3 個ずつ書くか、`triangles` を書いてください"
                ),
            );
        }
        let in_order = || (0..count as u32 / 3).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        let triangles: Vec<[u32; 3]> = if self.triangles.is_empty() { in_order() } else { self.triangles.clone() };
        if !self.normals.is_empty() && !self.texture_coordinates.is_empty() {
            derived::tangents(&mut vertices, &triangles, |_| true);
        }
        Mesh::new(vertices, triangles)
    }
}
