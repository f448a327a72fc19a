//! Normals and tangents that follow from positions and texture coordinates.

use crate::scene::Vertex;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// What a vertex has where nothing follows: no triangle with an area has it.
const NO_NORMAL: DVec3 = DVec3::Z;

fn corners<'v>(vertices: &'v [Vertex], triangle: &[u32; 3]) -> Option<[&'v Vertex; 3]> {
    let [a, b, c] = triangle.map(|vertex| vertices.get(vertex as usize));
    Some([a?, b?, c?])
}

/// Twice the area of a triangle, to its front.
fn area(corners: [&Vertex; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| corner.position.truncate());
    (b - a).cross(c - a)
}

fn set_normal(vertex: &mut Vertex, normal: DVec3) {
    vertex.normal = normal.normalize_or(NO_NORMAL).as_vec3().as_dvec3().extend(1.0);
}

/// Smooth normals for the vertices that lack one: the mean of the normals of all triangles at their place, weighted by
/// area.
pub(super) fn smooth_normals(vertices: &mut [Vertex], triangles: &[[u32; 3]], lacks: impl Fn(usize) -> bool) {
    let place = |vertex: &Vertex| vertex.position.truncate().to_array().map(f64::to_bits);
    let mut sums: HashMap<[u64; 3], DVec3> = HashMap::new();
    for triangle in triangles {
        let Some(corners) = corners(vertices, triangle) else { continue };
        let area = area(corners);
        corners.into_iter().for_each(|corner| *sums.entry(place(corner)).or_default() += area);
    }
    for (_, vertex) in vertices.iter_mut().enumerate().filter(|(number, _)| lacks(*number)) {
        let sum = sums.get(&place(vertex)).copied().unwrap_or_default();
        set_normal(vertex, sum);
    }
}

/// Flat normals: each triangle gets vertices of its own.
pub(super) fn flat(vertices: &[Vertex], triangles: &[[u32; 3]]) -> Vec<Vertex> {
    let each = |triangle: &[u32; 3]| {
        let corners = corners(vertices, triangle)?;
        let area = area(corners);
        Some(corners.map(|corner| {
            let mut own = *corner;
            set_normal(&mut own, area);
            own
        }))
    };
    triangles.iter().filter_map(each).flatten().collect()
}

/// Tangents along the first texture coordinate for the vertices that lack one, at right angles to their normals: the mean
/// over the triangles of a vertex (Lengyel 2001). Where texture coordinates say nothing, any direction in the surface.
pub(super) fn tangents(vertices: &mut [Vertex], triangles: &[[u32; 3]], lacks: impl Fn(usize) -> bool) {
    let mut sums = vec![[DVec3::ZERO; 2]; vertices.len()];
    for triangle in triangles {
        let Some(corners @ [a, b, c]) = corners(vertices, triangle) else { continue };
        let [e, f] = [b, c].map(|other| (other.position - a.position).truncate());
        let [p, q]: [DVec2; 2] = [b, c].map(|other| other.texture_coordinates - a.texture_coordinates);
        // The area in the texture takes its sign only: large triangles count more.
        let sign = p.perp_dot(q).signum() * f64::from(u8::from(p.perp_dot(q) != 0.0));
        let (along_u, along_v) = ((e * q.y - f * p.y) * sign, (f * p.x - e * q.x) * sign);
        let weight = area(corners).length();
        for vertex in triangle {
            let [u, v] = &mut sums[*vertex as usize];
            *u += along_u.normalize_or_zero() * weight;
            *v += along_v.normalize_or_zero() * weight;
        }
    }
    for (number, (vertex, [u, v])) in vertices.iter_mut().zip(sums).enumerate() {
        if !lacks(number) {
            continue;
        }
        let normal = vertex.normal.truncate().normalize_or(NO_NORMAL);
        let tangent = (u - normal * normal.dot(u)).try_normalize();
        let tangent = tangent.unwrap_or_else(|| normal.any_orthonormal_vector());
        let sign = if normal.cross(tangent).dot(v) < 0.0 { -1.0 } else { 1.0 };
        *vertex = vertex.along(tangent, sign);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Mesh;
    use crate::scene::mesh::shapes;

    fn shapes() -> Vec<Mesh> {
        let meshes = [
            shapes::quad([2.0, 1.0]),
            shapes::grid([3.0, 2.0], [4, 5]),
            shapes::cube([1.0, 2.0, 3.0]),
            shapes::torus([1.0, 0.4], [60, 40]),
        ];
        meshes.map(|mesh| mesh.expect("a mesh")).to_vec()
    }

    #[test]
    fn what_follows_is_what_built_in_meshes_have() {
        for mesh in shapes() {
            let mut vertices = mesh.vertices.clone();
            tangents(&mut vertices, &mesh.triangles, |_| true);
            for (own, known) in vertices.iter().zip(&mesh.vertices) {
                // A torus of 60 × 40 segments is no smooth one: 6 degrees.
                assert!(own.tangent.truncate().dot(known.tangent.truncate()) > 0.99, "{own:?} {known:?}");
                assert_eq!(own.tangent.w, known.tangent.w);
            }
        }
        // A cube's corners are shared by three faces: smooth normals point along the diagonals.
        let [torus, cube] = [shapes().remove(3), shapes().remove(2)];
        let mut vertices = torus.vertices.clone();
        smooth_normals(&mut vertices, &torus.triangles, |_| true);
        let pairs = vertices.iter().zip(&torus.vertices);
        assert!(pairs.clone().all(|(own, known)| own.normal.truncate().dot(known.normal.truncate()) > 0.99));
        let flat = flat(&cube.vertices, &cube.triangles);
        assert_eq!(flat.len(), 36);
        let of_faces = cube.triangles.iter().flatten().map(|vertex| cube.vertices[*vertex as usize].normal);
        assert!(flat.iter().zip(of_faces).all(|(own, known)| own.normal == known));
    }

    #[test]
    fn smooth_normals_join_at_seams_and_leave_what_is_there() {
        // A roof of two triangles whose ridge is split: the left side looks to (-1, 0, 1), the right one to (1, 0, 1).
        let vertex = |x: f64, y: f64, z: f64| Vertex::new(DVec3::new(x, y, z), DVec3::ZERO);
        let mut vertices = vec![
            vertex(-1.0, 0.0, 0.0),
            vertex(0.0, -1.0, 1.0),
            vertex(0.0, 1.0, 1.0),
            vertex(1.0, 0.0, 0.0),
            vertex(0.0, 1.0, 1.0),
            vertex(0.0, -1.0, 1.0),
        ];
        smooth_normals(&mut vertices, &[[0, 1, 2], [3, 4, 5]], |number| number != 3);
        let half = 0.5_f64.sqrt();
        let expected =
            [[-half, 0.0, half], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        for (vertex, expected) in vertices.iter().zip(expected) {
            assert!((vertex.normal.truncate() - DVec3::from_array(expected)).length() < 1e-6, "{vertex:?}");
        }
    }

    #[test]
    fn a_mirrored_picture_has_the_other_sign() {
        let quad = shapes::quad([2.0, 2.0]).expect("a mesh");
        let mut vertices = quad.vertices.clone();
        vertices.iter_mut().for_each(|vertex| vertex.texture_coordinates.x = 1.0 - vertex.texture_coordinates.x);
        tangents(&mut vertices, &quad.triangles, |_| true);
        assert!(vertices.iter().all(|vertex| vertex.tangent == DVec3::NEG_X.extend(-1.0)));
        // Without texture coordinates it is any direction in the surface.
        vertices.iter_mut().for_each(|vertex| vertex.texture_coordinates = DVec2::ZERO);
        tangents(&mut vertices, &quad.triangles, |_| true);
        assert!(vertices.iter().all(|vertex| vertex.tangent.z == 0.0 && vertex.tangent.truncate().length() == 1.0));
    }
}
