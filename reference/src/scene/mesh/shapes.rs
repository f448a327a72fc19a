//! Built-in meshes. Each has normals of length 1, texture coordinates and tangents.

use super::{Mesh, MeshError, refused};
use crate::scene::Vertex;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// More segments than this are refused.
const MOST_SEGMENTS: u32 = 512;

fn checked(sizes: &[f64], segments: &[u32], fewest: u32) -> Result<(), MeshError> {
    if !sizes.iter().all(|size| *size > 0.0 && size.is_finite()) {
        return refused("its sizes have to be greater than 0", "大きさは 0 より大きくしてください");
    }
    if !segments.iter().all(|count| (fewest..=MOST_SEGMENTS).contains(count)) {
        return refused(
            format!("its segments have to be {fewest} to {MOST_SEGMENTS}"),
            format!("`segments` は {fewest} 以上 {MOST_SEGMENTS} 以下にしてください"),
        );
    }
    Ok(())
}

pub(super) fn triangle([width, height]: [f64; 2]) -> Result<Mesh, MeshError> {
    checked(&[width, height], &[], 0)?;
    let vertex = |x: f64, y: f64, u: f64, v: f64| {
        Vertex::new(DVec3::new(x * width / 2.0, y * height / 2.0, 0.0), DVec3::Z).textured(DVec2::new(u, v))
    };
    Mesh::new(
        vec![vertex(-1.0, -1.0, 0.0, 0.0), vertex(1.0, -1.0, 1.0, 0.0), vertex(0.0, 1.0, 0.5, 1.0)],
        vec![[0, 1, 2]],
    )
}

pub(super) fn quad(size: [f64; 2]) -> Result<Mesh, MeshError> {
    checked(&size, &[], 0)?;
    sheet([1, 1], |u, v| {
        let position = DVec3::new((u - 0.5) * size[0], (v - 0.5) * size[1], 0.0);
        Vertex::new(position, DVec3::Z).along(DVec3::X, 1.0)
    })
}

pub(super) fn grid(size: [f64; 2], segments: [u32; 2]) -> Result<Mesh, MeshError> {
    checked(&size, &segments, 1)?;
    sheet(segments, |u, v| {
        let position = DVec3::new((u - 0.5) * size[0], 0.0, (0.5 - v) * size[1]);
        Vertex::new(position, DVec3::Y).along(DVec3::X, 1.0)
    })
}

pub(super) fn cube(size: [f64; 3]) -> Result<Mesh, MeshError> {
    checked(&size, &[], 0)?;
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    // Right, up and out of each face: right × up = out.
    let faces = [[-z, y, x], [z, y, -x], [x, -z, y], [x, z, -y], [x, y, z], [-x, y, -z]];
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for [right, up, out] in faces {
        let first = vertices.len() as u32;
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
            let corner = (right * (2.0 * u - 1.0) + up * (2.0 * v - 1.0) + out) * DVec3::from_array(size) / 2.0;
            vertices.push(Vertex::new(corner, out).textured(DVec2::new(u, v)).along(right, 1.0));
        }
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    Mesh::new(vertices, triangles)
}

pub(super) fn sphere(radius: f64, segments: [u32; 2]) -> Result<Mesh, MeshError> {
    checked(&[radius], &segments, 3)?;
    let [around, along] = segments.map(f64::from);
    sheet(segments, |u, v| {
        // The last meridian is the first one, number by number, and a pole is one point.
        let (sin, cos) = (TAU * (u * around).rem_euclid(around) / around).sin_cos();
        let step = (v * along).round();
        let (y, ring) = match step {
            0.0 => (-1.0, 0.0),
            step if step == along => (1.0, 0.0),
            step => (-(PI * step / along).cos(), (PI * step / along).sin()),
        };
        let out = DVec3::new(ring * sin, y, ring * cos);
        Vertex::new(out * radius, out).along(DVec3::new(cos, 0.0, -sin), 1.0)
    })
}

pub(super) fn torus([radius, tube]: [f64; 2], segments: [u32; 2]) -> Result<Mesh, MeshError> {
    checked(&[radius, tube], &segments, 3)?;
    let [along, around] = segments;
    let angle = |step: u32, count: u32| TAU * f64::from(step % count) / f64::from(count);
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..=along {
        let (sin_a, cos_a) = angle(i, along).sin_cos();
        for j in 0..=around {
            let (sin_b, cos_b) = angle(j, around).sin_cos();
            let out = DVec3::new(cos_a * cos_b, sin_b, sin_a * cos_b);
            let position = DVec3::new(cos_a * radius, 0.0, sin_a * radius) + out * tube;
            let coordinates = DVec2::new(f64::from(i) / f64::from(along), f64::from(j) / f64::from(around));
            let tangent = DVec3::new(-sin_a, 0.0, cos_a);
            vertices.push(Vertex::new(position, out).textured(coordinates).along(tangent, -1.0));
        }
    }
    for i in 0..along {
        for j in 0..around {
            let [low, high] = [i, i + 1].map(|i| i * (around + 1) + j);
            triangles.extend([[low, low + 1, high + 1], [low, high + 1, high]]);
        }
    }
    Mesh::new(vertices, triangles)
}

/// A rectangle of squares; `vertex` bends it. Texture coordinates are those of the sheet.
fn sheet([columns, rows]: [u32; 2], vertex: impl Fn(f64, f64) -> Vertex) -> Result<Mesh, MeshError> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for row in 0..=rows {
        for column in 0..=columns {
            let (u, v) = (f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
            vertices.push(vertex(u, v).textured(DVec2::new(u, v)));
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let low = row * (columns + 1) + column;
            let high = low + columns + 1;
            triangles.extend([[low, low + 1, high + 1], [low, high + 1, high]]);
        }
    }
    Mesh::new(vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every triangle faces where the normals of its vertices point, and normals and tangents have length 1.
    fn faces_outwards(mesh: &Mesh) {
        for triangle in &mesh.triangles {
            let corners = triangle.map(|at| mesh.vertices[at as usize]);
            let [a, b, c] = corners.map(|corner| corner.position.truncate());
            let face = (b - a).cross(c - a);
            for corner in corners {
                let (normal, tangent) = (corner.normal.truncate(), corner.tangent.truncate());
                // At a pole a triangle has no area.
                assert!(face.dot(normal) >= 0.0, "{triangle:?}");
                assert!((normal.length() - 1.0).abs() < 1e-6 && (tangent.length() - 1.0).abs() < 1e-6);
                assert!(normal.dot(tangent).abs() < 1e-6);
            }
        }
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|at| mesh.vertices[at as usize].position.truncate());
            (b - a).cross(c - a).length() / 2.0
        };
        assert!(mesh.triangles.iter().map(area).sum::<f64>() > 0.1);
    }

    #[test]
    fn shapes_face_outwards() {
        let shapes = [quad([2.0, 1.0]), grid([3.0, 2.0], [4, 5]), cube([1.0, 2.0, 3.0]), sphere(2.0, [8, 6])];
        for mesh in shapes.into_iter().chain([torus([1.0, 0.4], [36, 18]), triangle([2.0, 2.0])]) {
            faces_outwards(&mesh.expect("a mesh"));
        }
    }

    #[test]
    fn seams_close_number_by_number() {
        let sphere = sphere(1.0, [7, 5]).expect("a mesh");
        for row in 0..=5 {
            assert_eq!(sphere.vertices[row * 8].position, sphere.vertices[row * 8 + 7].position);
        }
    }

    #[test]
    fn tangents_follow_the_texture() {
        // The bitangent n × t · w points to where the second coordinate grows.
        for mesh in [quad([2.0, 2.0]), grid([2.0, 2.0], [2, 2]), cube([2.0; 3]), torus([1.0, 0.4], [12, 9])] {
            let mesh = mesh.expect("a mesh");
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|at| mesh.vertices[at as usize]);
                let edges = [b, c].map(|other| (other.position - a.position).truncate());
                let [p, q] = [b, c].map(|other| other.texture_coordinates - a.texture_coordinates);
                let area = p.perp_dot(q);
                let (along_u, along_v) =
                    ((edges[0] * q.y - edges[1] * p.y) / area, (edges[1] * p.x - edges[0] * q.x) / area);
                let (normal, tangent) = (a.normal.truncate(), a.tangent.truncate());
                assert!(along_u.normalize().dot(tangent) > 0.8);
                assert!(along_v.normalize().dot(normal.cross(tangent) * a.tangent.w) > 0.8);
            }
        }
    }

    #[test]
    fn what_is_too_large_is_refused() {
        assert!(grid([1.0, 1.0], [600, 1]).is_err() && grid([1.0, 1.0], [400, 400]).is_err());
        assert!(sphere(0.0, [8, 8]).is_err() && torus([1.0, f64::NAN], [8, 8]).is_err());
    }
}
