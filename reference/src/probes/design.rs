//! Where a probe lies and how its normal stands, by the angles that matter to the equation.

use super::{Random, Region};
use crate::scene::{Matrices, Vertex};
use crate::{Assignment, Value};
use glam::{DVec3, DVec4};

/// A cosine this far from 0 is on one side of a clamp, beyond the noise of f32.
const CLEAR_OF_CLAMP: f64 = 0.02;

/// A highlight below this fraction of its greatest does not show: far under half a step of 8 bits (1/510).
const NO_HIGHLIGHT: f64 = 1e-6;

/// A highlight of at least this fraction of its greatest shows.
const HIGHLIGHT: f64 = 0.02;

/// A highlight that is negative by this much would show in any power.
const FAR_BEHIND: f64 = -0.85;

/// How often a design is tried before it is taken as it comes; each try succeeds in one of about ten cases.
const TRIES: usize = 2000;

/// Range of a number.
type Range = (f64, f64);

/// What a probe shows.
struct Design {
    /// Angle between light and view vector, in degrees.
    opening: Range,
    /// Distance from the eye.
    distance: Range,
    /// How the normal is chosen.
    normal: Normal,
    /// N·L.
    light: Range,
}

enum Normal {
    /// Near the half vector, so that (N·H)^shininess is in this range.
    Highlight(Range),
    /// Anywhere with N·H in this range.
    Half(Range),
}

const ANY: Range = (-1.0, 1.0);
const LIT: Range = (0.05, 1.0);
const UNLIT: Range = (-1.0, -0.05);
/// Any distance: a view vector that is not normalised shows.
const FAR_AND_NEAR: Range = (0.7, 12.0);
/// Distances at which f32 keeps the direction of the view vector within 1e-6.
const MIDDLE: Range = (1.5, 12.0);

const fn design(opening: Range, distance: Range, normal: Normal, light: Range) -> Design {
    Design { opening, distance, normal, light }
}

/// Every group goes through these in order.
const DESIGNS: [Design; 20] = [
    // All terms at once, bright: the sum is over 1.
    design((2.0, 25.0), MIDDLE, Normal::Highlight((0.85, 1.0)), LIT),
    // Highlights in the course's own range of angles, at several levels.
    design((5.0, 40.0), FAR_AND_NEAR, Normal::Highlight((0.05, 0.4)), LIT),
    design((5.0, 40.0), FAR_AND_NEAR, Normal::Highlight((0.4, 0.9)), LIT),
    // Only the diffuse term, bright and dim, grazing, and with the half vector behind the surface.
    design((90.0, 160.0), FAR_AND_NEAR, Normal::Half((-0.2, 0.8)), (0.5, 1.0)),
    design((20.0, 150.0), FAR_AND_NEAR, Normal::Half((0.0, 0.8)), (0.1, 0.6)),
    design((20.0, 150.0), FAR_AND_NEAR, Normal::Half((0.0, 0.8)), (0.02, 0.12)),
    design((60.0, 160.0), FAR_AND_NEAR, Normal::Half((-0.9, -0.1)), (0.05, 0.7)),
    // Only the ambient term: light behind the surface, a little and fully.
    design((20.0, 150.0), FAR_AND_NEAR, Normal::Half((-0.5, 0.8)), UNLIT),
    design((100.0, 165.0), FAR_AND_NEAR, Normal::Half((0.1, 0.8)), (-0.7, -0.05)),
    // Half vector far behind the surface: even powers of a negative number.
    design((10.0, 120.0), MIDDLE, Normal::Half((-1.0, -0.985)), UNLIT),
    design((10.0, 120.0), MIDDLE, Normal::Half((-0.985, -0.9)), UNLIT),
    // Highlights with a wide angle between light and view: where a half vector that is not normalised is short.
    design((50.0, 100.0), MIDDLE, Normal::Highlight((0.1, 0.5)), LIT),
    design((50.0, 100.0), MIDDLE, Normal::Highlight((0.5, 1.0)), LIT),
    design((100.0, 150.0), MIDDLE, Normal::Highlight((0.3, 0.9)), LIT),
    design((25.0, 60.0), MIDDLE, Normal::Highlight((0.3, 0.95)), LIT),
    // Highlights where the light is behind the surface: the slide has no condition on N·L.
    design((150.0, 170.0), MIDDLE, Normal::Highlight((0.15, 0.6)), (-1.0, -0.03)),
    design((150.0, 170.0), MIDDLE, Normal::Highlight((0.4, 0.95)), (-1.0, -0.03)),
    // And where the eye is behind it (N·V < 0): with this opening that is so for N·L > 0.27.
    design((166.0, 171.0), MIDDLE, Normal::Highlight((0.08, 0.3)), (0.28, 1.0)),
    // The rim of a highlight, where another exponent shows best.
    design((10.0, 90.0), MIDDLE, Normal::Highlight((0.01, 0.1)), LIT),
    // Anything.
    design((10.0, 165.0), FAR_AND_NEAR, Normal::Half(ANY), ANY),
];

/// What the equation says about light and highlight.
pub(super) struct Light {
    /// Position in eye space, homogeneous.
    position: DVec4,
    shininess: f64,
}

/// The vectors of the equation at a point, in eye space.
struct Vectors {
    light: DVec3,
    half: DVec3,
}

impl Light {
    pub(super) fn of(assignment: &Assignment) -> Self {
        let value = |name: &str| {
            let found = assignment.constants.iter().find(|c| c.name == name);
            found.map_or(Value::from(f64::NAN), |c| c.value.clone())
        };
        Self {
            position: value(&assignment.probing.light).vec4(),
            shininess: value(&assignment.probing.shininess).float(),
        }
    }

    fn vectors(&self, p: DVec3) -> Vectors {
        let light = (self.position.truncate() - p * self.position.w).normalize();
        let view = -p.normalize();
        Vectors { light, half: (light + view).normalize() }
    }

    /// Which terms show at a vertex.
    pub(super) fn region(&self, vertex: &Vertex, matrices: &Matrices) -> Region {
        let p = (matrices.model_view * vertex.position).truncate();
        let n = (matrices.normal * vertex.normal).truncate().normalize();
        let v = self.vectors(p);
        let (nl, nh) = (n.dot(v.light), n.dot(v.half));
        let highlight = nh.max(0.0).powf(self.shininess);
        let (lit, unlit) = (nl > CLEAR_OF_CLAMP, nl < -CLEAR_OF_CLAMP);
        if unlit && nh < FAR_BEHIND {
            Region::FacingAway
        } else if unlit && highlight < NO_HIGHLIGHT {
            Region::AmbientOnly
        } else if lit && highlight < NO_HIGHLIGHT {
            Region::DiffuseOnly
        } else if lit && highlight > HIGHLIGHT {
            Region::Highlight
        } else if unlit && highlight > HIGHLIGHT {
            Region::HighlightBehind
        } else {
            Region::Between
        }
    }
}

/// The vertex in a group's `place`, carried back to object space; `position`: in object space, where it is given.
pub(super) fn vertex(
    random: &mut Random,
    place: usize,
    position: Option<DVec4>,
    light: &Light,
    matrices: &Matrices,
) -> Vertex {
    let design = &DESIGNS[place % DESIGNS.len()];
    let given = position.map(|position| (matrices.model_view * position).truncate());
    let (p, n) = in_eye_space(random, design, given, light);
    let normal = matrices.normal.inverse().transform_vector3(n).normalize();
    match position {
        Some(position) => Vertex::new(position.truncate(), normal),
        None => Vertex::new(matrices.model_view.inverse().transform_point3(p), normal),
    }
}

/// Position and normal as designed; after [`TRIES`] tries, whatever the last one was.
fn in_eye_space(random: &mut Random, design: &Design, given: Option<DVec3>, light: &Light) -> (DVec3, DVec3) {
    let towards_light = light.position.truncate().normalize();
    let mut last = (DVec3::NEG_Z, DVec3::Z);
    for _ in 0..TRIES {
        let opening = random.between(design.opening.0, design.opening.1);
        let view = random.at_angle(towards_light, opening.to_radians());
        let p = given.unwrap_or(-view * random.between(design.distance.0, design.distance.1));
        let vectors = light.vectors(p);
        let n = match design.normal {
            Normal::Highlight(level) => {
                let level = random.between(level.0, level.1);
                random.at_angle(vectors.half, level.powf(1.0 / light.shininess).acos())
            }
            Normal::Half(range) => {
                let cosine = random.between(range.0, range.1);
                random.at_angle(vectors.half, cosine.acos())
            }
        };
        last = (p, n);
        let nl = n.dot(vectors.light);
        if (design.light.0..=design.light.1).contains(&nl) {
            break;
        }
    }
    last
}
