//! Vertices as a vertex buffer holds them.

use glam::{DVec2, DVec3, DVec4};

/// A vertex as the vertex shader receives it: all numbers are exact in f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Position in object space; the buffer holds three floats, so w is 1.
    pub position: DVec4,
    /// Normal in object space; the buffer holds three floats, so w is 1.
    pub normal: DVec4,
    /// Texture coordinates: (0, 0) is the lower left corner of a picture.
    pub texture_coordinates: DVec2,
    /// Direction in which the first texture coordinate grows; w is 1 or, where the picture is mirrored, -1.
    pub tangent: DVec4,
    /// Its number in the mesh.
    pub number: u32,
    /// The number of the instance that it is drawn in.
    pub instance: u32,
}

impl Vertex {
    /// A vertex from the three floats of position and normal, rounded to f32.
    pub fn new(position: DVec3, normal: DVec3) -> Self {
        let attribute = |v: DVec3| v.as_vec3().as_dvec3().extend(1.0);
        Self {
            position: attribute(position),
            normal: attribute(normal),
            texture_coordinates: DVec2::ZERO,
            tangent: DVec4::new(1.0, 0.0, 0.0, 1.0),
            number: 0,
            instance: 0,
        }
    }

    /// What a vertex stage knows of a vertex by this name beside its inputs.
    pub(crate) fn number_by(name: &str) -> Option<fn(&Self) -> u32> {
        match name {
            "gl_VertexID" => Some(|vertex| vertex.number),
            "gl_InstanceID" => Some(|vertex| vertex.instance),
            _ => None,
        }
    }

    /// The same vertex with the numbers of another.
    pub fn numbered_as(self, other: &Self) -> Self {
        Self { number: other.number, instance: other.instance, ..self }
    }

    /// The same vertex with texture coordinates.
    pub fn textured(self, coordinates: DVec2) -> Self {
        Self { texture_coordinates: coordinates.as_vec2().as_dvec2(), ..self }
    }

    /// The same vertex with a tangent of length 1.
    pub fn along(self, tangent: DVec3, sign: f64) -> Self {
        Self { tangent: tangent.as_vec3().as_dvec3().extend(sign), ..self }
    }
}
