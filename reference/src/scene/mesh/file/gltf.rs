//! glTF 2.0, as text or binary.

mod buffers;

use super::super::{Mesh, MeshError, bounded, derived, refused};
use crate::Folder;
use crate::scene::{Vertex, normal_matrix};
use buffers::Buffers;
use glam::{DMat4, DVec2, DVec3};
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Semantic};

/// Nodes stand in one another no deeper, and there are no more of them.
const DEEPEST: usize = 64;
const MOST_NODES: usize = 1_000;

/// All triangles of the default scene as one mesh, each where its node puts it.
pub(super) fn read(name: &str, bytes: &[u8], folder: &Folder) -> Result<Mesh, MeshError> {
    let (document, blob) = parsed(bytes)?;
    let buffers = Buffers::read(name, &document, blob, folder)?;
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let Some(scene) = scene else {
        return refused("has no scene: export it with one", "シーンがありません。シーンを含めて書き出してください");
    };
    let mut parts = PrimitiveParts { buffers: &buffers, vertices: Vec::new(), triangles: Vec::new() };
    let mut nodes: Vec<(Node<'_>, DMat4, usize)> = scene.nodes().map(|node| (node, DMat4::IDENTITY, 0)).collect();
    // What comes first in the file is drawn first.
    nodes.reverse();
    let mut count = 0;
    while let Some((node, outer, depth)) = nodes.pop() {
        count += 1;
        if depth > DEEPEST || count > MOST_NODES {
            return refused(
                format!("has more than {MOST_NODES} nodes, or nodes more than {DEEPEST} deep: join its objects"),
                format!(
                    "ノードが {MOST_NODES} 個を超えるか、{DEEPEST} 段より深くなっています。オブジェクトを結合してください"
                ),
            );
        }
        let own = node.transform().matrix().map(|column| column.map(f64::from));
        let world = outer * DMat4::from_cols_array_2d(&own);
        if let Some(mesh) = node.mesh() {
            mesh.primitives().try_for_each(|primitive| parts.add(&primitive, world))?;
        }
        let children: Vec<_> = node.children().collect();
        nodes.extend(children.into_iter().rev().map(|child| (child, world, depth + 1)));
    }
    Mesh::new(parts.vertices, parts.triangles)
}

/// The document, whose numbers name what is there, and its own buffer.
fn parsed(bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), MeshError> {
    let broken = |what: &str| {
        MeshError::new(
            format!("is no glTF 2.0, or damaged ({what}): export it again"),
            format!("glTF 2.0 ではないか、壊れています ({what})。書き出し直してください"),
        )
    };
    // The head of a binary file has its length, which is at least its own.
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok()).map_or(0, u32::from_le_bytes);
    if bytes.starts_with(b"glTF") && length < 12 {
        return Err(broken("it ends early"));
    }
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(bytes).map_err(|error| broken(&error.to_string()))?;
    let required: Vec<&str> = document.extensions_required().collect();
    if !required.is_empty() {
        let names = required.join(", ");
        return refused(
            format!("needs {names}: export it without compression and without extensions"),
            format!("{names} を必要とします。圧縮も拡張も使わずに書き出してください"),
        );
    }
    // The validation looks at the positions' accessors before it knows that they are there.
    let json = document.into_json();
    let primitives = json.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut named = primitives.flat_map(|primitive| primitive.attributes.values());
    if named.any(|accessor| accessor.value() >= json.accessors.len()) {
        return Err(broken("a primitive names an accessor that is not there"));
    }
    let document = Document::from_json(json).map_err(|error| match error {
        gltf::Error::Validation(errors) => {
            let first = errors.first().map(|(path, error)| format!("{path}: {error}"));
            broken(&first.unwrap_or_default())
        }
        error => broken(&error.to_string()),
    })?;
    Ok((document, blob))
}

/// What is collected from the primitives.
struct PrimitiveParts<'a> {
    buffers: &'a Buffers,
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
}

impl PrimitiveParts<'_> {
    /// Adds the triangles of a primitive.
    fn add(&mut self, primitive: &Primitive<'_>, world: DMat4) -> Result<(), MeshError> {
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let corners = primitive.indices().map_or(positions.count(), |indices| indices.count());
        // Before anything is read: a few bytes may promise any number.
        bounded(self.vertices.len() + positions.count(), self.triangles.len() + corners / 3)?;
        let indices = match primitive.indices() {
            Some(indices) => self.buffers.indices(&indices)?,
            None => (0..positions.count() as u32).collect(),
        };
        let mut triangles = triangles(primitive.mode(), &indices);
        if triangles.is_empty() {
            return Ok(());
        }
        let places = self.buffers.vectors::<3>(&positions)?;
        if triangles.iter().flatten().any(|vertex| *vertex as usize >= places.len()) {
            return refused(
                "has indices of vertices that are not there: export it again",
                "存在しない頂点を指すインデックスがあります。書き出し直してください",
            );
        }
        let column = |semantic| primitive.get(&semantic);
        let normals = column(Semantic::Normals).map(|normals| self.buffers.vectors::<3>(&normals)).transpose()?;
        let coordinates = column(Semantic::TexCoords(0));
        let coordinates = coordinates.map(|coordinates| self.buffers.vectors::<2>(&coordinates)).transpose()?;
        let tangents = column(Semantic::Tangents).map(|tangents| self.buffers.vectors::<4>(&tangents)).transpose()?;
        let is_mirrored = world.determinant() < 0.0;
        let of_normals = normal_matrix(world);
        let vertex = |at: usize| {
            let position = world.transform_point3(DVec3::from_array(places[at]));
            let normal = normals.as_ref().and_then(|normals| normals.get(at)).map_or(DVec3::ZERO, |normal| {
                let normal = of_normals.transform_vector3(DVec3::from_array(*normal)).normalize_or_zero();
                if is_mirrored { -normal } else { normal }
            });
            // glTF counts from above, and pictures stand upright here.
            let upright = |[u, v]: [f64; 2]| DVec2::new(u, 1.0 - v);
            let own = coordinates.as_ref().and_then(|coordinates| coordinates.get(at).copied());
            Vertex::new(position, normal).textured(own.map_or(DVec2::ZERO, upright))
        };
        let mut vertices: Vec<Vertex> = (0..places.len()).map(vertex).collect();
        if is_mirrored {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        if let Some(tangents) = tangents.filter(|_| normals.is_some()) {
            for (vertex, [x, y, z, sign]) in vertices.iter_mut().zip(tangents) {
                let along = world.transform_vector3(DVec3::new(x, y, z)).normalize_or(DVec3::X);
                *vertex = vertex.along(along, if is_mirrored { -sign } else { sign });
            }
        } else {
            if normals.is_none() {
                vertices = derived::flat(&vertices, &triangles);
                triangles = (0..triangles.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
            }
            derived::tangents(&mut vertices, &triangles, |_| true);
        }
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices);
        self.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        bounded(self.vertices.len(), self.triangles.len())
    }
}

/// The triangles of a primitive: points and lines have none.
fn triangles(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => indices.as_chunks().0.to_vec(),
        // Every second triangle runs the other way round.
        Mode::TriangleStrip => {
            let turned = |(at, corners): (usize, &[u32])| match at % 2 {
                0 => [corners[0], corners[1], corners[2]],
                _ => [corners[1], corners[0], corners[2]],
            };
            indices.windows(3).enumerate().map(turned).collect()
        }
        Mode::TriangleFan => indices.windows(2).skip(1).map(|corners| [indices[0], corners[0], corners[1]]).collect(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

#[cfg(test)]
mod tests;
