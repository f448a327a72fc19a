//! Wavefront OBJ.

use super::super::{Mesh, MeshError, bounded, derived, refused};
use crate::scene::Vertex;
use glam::{DVec2, DVec3};
use std::path::Path;
use tobj::{LoadError, LoadOptions};

/// A corner names a vertex by no larger a number.
const LARGEST_NUMBER: i64 = 10_000_000;

/// All objects and groups as one mesh. Faces of more corners are fans of triangles; lines, points and materials are left
/// out. Normals that are missing are smooth.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    // Names of objects may be in any encoding.
    let text = String::from_utf8_lossy(bytes);
    let lines = Faces::default().cleaned(&text)?;
    let model = match load(&lines) {
        Ok(models) => models.into_iter().next().map(|model| model.mesh).unwrap_or_default(),
        Err(error) => {
            // What is said of all lines is said of those up to the first that is wrong, and of no fewer.
            let counts: Vec<usize> = (1..=lines.len()).collect();
            let line = counts.partition_point(|count| load(&lines[..*count]).is_ok()) + 1;
            return wrong(
                line,
                format!("is not what OBJ has ({error}): export the mesh again"),
                format!("OBJ として正しくありません ({error})。メッシュを書き出し直してください"),
            );
        }
    };
    let count = model.positions.len() / 3;
    for (per, numbers, en, ja) in
        [(2, &model.texcoords, "texture coordinates", "テクスチャ座標"), (3, &model.normals, "a normal", "法線")]
    {
        if !numbers.is_empty() && numbers.len() != per * count {
            return refused(
                format!("some corners of faces have {en}, and others have none: export it with all or without"),
                format!("{ja}のある頂点とない頂点が混じっています。すべてに付けるか、付けずに書き出してください"),
            );
        }
    }
    let vector = |numbers: &[f32], vertex: usize| {
        let own = numbers.get(3 * vertex..3 * vertex + 3);
        own.map_or(DVec3::ZERO, |own| DVec3::new(own[0].into(), own[1].into(), own[2].into()))
    };
    let vertex = |at: usize| {
        let pair = model.texcoords.get(2 * at..2 * at + 2);
        let coordinates = pair.map_or(DVec2::ZERO, |pair| DVec2::new(pair[0].into(), pair[1].into()));
        Vertex::new(vector(&model.positions, at), vector(&model.normals, at)).textured(coordinates)
    };
    let mut vertices: Vec<Vertex> = (0..count).map(vertex).collect();
    let triangles = model.indices.as_chunks().0.to_vec();
    let lacking: Vec<bool> = vertices.iter().map(|vertex| vertex.normal.truncate() == DVec3::ZERO).collect();
    derived::smooth_normals(&mut vertices, &triangles, |vertex| lacking[vertex]);
    derived::tangents(&mut vertices, &triangles, |_| true);
    Mesh::new(vertices, triangles)
}

/// One model, as only lines of vertices and faces are handed over.
fn load(lines: &[String]) -> Result<Vec<tobj::Model>, LoadError> {
    let options = LoadOptions { triangulate: true, single_index: true, ..LoadOptions::default() };
    let no_materials = |_: &Path| Ok(Default::default());
    Ok(tobj::load_obj_buf(&mut lines.join("\n").as_bytes(), &options, no_materials)?.0)
}

fn wrong<T>(line: usize, en: impl Into<String>, ja: impl Into<String>) -> Result<T, MeshError> {
    Err(MeshError { line: u32::try_from(line).ok(), ..MeshError::new(en, ja) })
}

/// How many positions, texture coordinates and normals there are so far, and how many faces.
#[derive(Default)]
struct Faces {
    counts: [i64; 3],
    faces: usize,
}

impl Faces {
    /// The lines of vertices and faces, each at its place, without what else may stand there: comments, colours.
    fn cleaned(mut self, text: &str) -> Result<Vec<String>, MeshError> {
        let clean = |(line, text): (usize, &str)| {
            let words: Vec<&str> = text.split('#').next().unwrap_or_default().split_whitespace().collect();
            let kind = match words.first() {
                Some(&"v") => 0,
                Some(&"vt") => 1,
                Some(&"vn") => 2,
                Some(&"f") => {
                    self.faces += 1;
                    bounded(self.counts[0] as usize, self.faces)?;
                    self.check(&words[1..], line + 1)?;
                    return Ok(words.join(" "));
                }
                _ => return Ok(String::new()),
            };
            self.counts[kind] += 1;
            // A corner may have its own texture coordinates and normal.
            bounded(self.counts[0] as usize, self.counts[1].max(self.counts[2]) as usize / 3)?;
            // A position may have a divisor; six numbers are a position and a colour.
            let kept = if kind == 0 && words.len() >= 7 { &words[..4] } else { &words[..] };
            Ok(kept.join(" "))
        };
        text.lines().enumerate().map(clean).collect()
    }

    /// The corners of a face are numbered from 1, or from the last one backwards.
    fn check(&self, corners: &[&str], line: usize) -> Result<(), MeshError> {
        if corners.len() < 3 {
            return wrong(
                line,
                format!("a face has {} corners: it needs three", corners.len()),
                format!("面の頂点が {} 個です。3 個以上必要です", corners.len()),
            );
        }
        for corner in corners {
            for (part, count) in corner.split('/').zip(self.counts).filter(|(part, _)| !part.is_empty()) {
                // What is no number at all is the reader's affair.
                let Ok(number) = part.parse::<i64>() else { continue };
                if number == 0 || number < -count || number > LARGEST_NUMBER {
                    return wrong(
                        line,
                        format!("`{corner}` names what is not there: numbers begin with 1"),
                        format!("`{corner}` の番号のものはありません。番号は 1 から数えます"),
                    );
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of one face and a triangle above it, by two ways to number corners.
    const HOUSE: &str = "# a house\nmtllib none.mtl\no \u{5bb6}\nv 0 0 0\nv 2 0 0 1 # a comment\nv 2 2 0 0.5 0.5 0.5\nv 0 2 0\n\
        vt 0 0\nvt 1 0\nvt 1 0.5\nvt 0 0.5\nvn 0 0 1\nusemtl wall\ns 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\ng roof\nv 1 3 0\nvt 0.5 1\n\
        f -3/-3/-1 -1/-1/-1 -2/-2/-1\nl 1 2 3\n";

    fn said(text: &str) -> (String, Option<u32>) {
        let wrong = read(text.as_bytes()).expect_err(text);
        (wrong.message.en, wrong.line)
    }

    #[test]
    fn faces_become_triangles_with_one_number_a_corner() {
        let mesh = read(HOUSE.as_bytes()).expect("a mesh");
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [2, 4, 3]]);
        let places: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.position.truncate().to_array()).collect();
        assert_eq!(places, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 3.0, 0.0]]);
        let coordinates: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.texture_coordinates.to_array()).collect();
        assert_eq!(coordinates, [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5], [0.5, 1.0]]);
        for vertex in &mesh.vertices {
            assert_eq!(vertex.normal, DVec3::Z.extend(1.0));
            // Both coordinates grow with x and y: in the roof by as much.
            assert_eq!(vertex.tangent, DVec3::X.extend(1.0));
        }
    }

    #[test]
    fn missing_normals_are_smooth_and_missing_coordinates_are_zero() {
        // A tetrahedron around the origin: its normals point away from it.
        let text = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 2 4\nf 1 3 2\nf 1 4 3\nf 2 3 4\n";
        let mesh = read(text.as_bytes()).expect("a mesh");
        assert_eq!(mesh.vertices.len(), 4);
        for vertex in &mesh.vertices {
            let out = vertex.position.truncate().normalize();
            assert!((vertex.normal.truncate() - out).length() < 1e-6, "{vertex:?}");
            assert_eq!(vertex.texture_coordinates, DVec2::ZERO);
            assert!(vertex.tangent.truncate().dot(out).abs() < 1e-6);
        }
    }

    #[test]
    fn what_is_wrong_is_named_by_its_line() {
        let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\n";
        let after = |line: &str| said(&format!("{square}f 1 2 3\n{line}\nf 1 2 3\n"));
        for (line, en) in [
            ("v 1 2", "position parse error"),
            ("v 1 two 3", "position parse error"),
            ("v 1 2 3 4 5", "color parse error"),
            ("v 1 2 3 0", "scaling"),
            ("vn 1 2", "normal parse error"),
            ("f 1 2 x", "face parse error"),
            ("f 1 2 9", "face vertex index out of bounds"),
            ("f 1//1 2//1 3//2", "face normal index out of bounds"),
            ("f 0 1 2", "`0` names what is not there: numbers begin with 1"),
            ("f 1 2 -9", "`-9` names what is not there"),
            ("f 1 2 99999999999", "`99999999999` names what is not there"),
            ("f 1 2", "a face has 2 corners"),
        ] {
            let (message, place) = after(line);
            assert!(message.contains(en), "{line}: {message}");
            assert_eq!(place, Some(6), "{line}");
        }
        assert!(after("f 1//1 2 3").0.contains("some corners of faces have a normal, and others have none"));
        assert!(
            said("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").0.contains("vertex 0 has a coordinate that is no number")
        );
        assert!(said("").0.contains("it has no triangle") && said(square).0.contains("it has no triangle"));
    }

    #[test]
    fn a_damaged_file_is_a_mesh_or_an_error() {
        // Every byte replaced by each of those that mean something.
        for at in 0..HOUSE.len() {
            for byte in *b"0-/ .\nvfe\xff" {
                let mut bytes = HOUSE.as_bytes().to_vec();
                bytes[at] = byte;
                if let Ok(mesh) = read(&bytes) {
                    let count = mesh.vertices.len() as u32;
                    assert!(mesh.triangles.iter().flatten().all(|vertex| *vertex < count));
                }
            }
        }
    }
}
