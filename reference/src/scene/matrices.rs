//! The matrices of the course programs: column-major, acting on column vectors, right-handed (OpenGL).

use glam::{DMat3, DMat4, DVec3, DVec4};

/// The matrices of one moment, rounded to f32 as a uniform holds them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrices {
    /// From object space to world space.
    pub model: DMat4,
    /// From world space to eye space.
    pub view: DMat4,
    /// From eye space to clip space.
    pub projection: DMat4,
    /// From object space to eye space.
    pub model_view: DMat4,
    /// From object space to clip space.
    pub model_view_projection: DMat4,
    /// From normals in object space to normals in eye space.
    pub normal: DMat4,
}

impl Matrices {
    /// The matrices for a model-view and a projection matrix: what is drawn stands in world space.
    pub fn new(model_view: DMat4, projection: DMat4) -> Self {
        Self::of(DMat4::IDENTITY, model_view, model_view, projection)
    }

    /// The matrices of a model that is seen.
    pub fn seen(model: DMat4, view: DMat4, projection: DMat4) -> Self {
        Self::of(model, view, view * model, projection)
    }

    fn of(model: DMat4, view: DMat4, model_view: DMat4, projection: DMat4) -> Self {
        Self {
            model: rounded(model),
            view: rounded(view),
            projection: rounded(projection),
            model_view: rounded(model_view),
            model_view_projection: rounded(projection * model_view),
            normal: rounded(normal_matrix(model_view)),
        }
    }

    /// From world space to clip space.
    pub fn view_projection(&self) -> DMat4 {
        rounded(self.projection * self.view)
    }

    /// From normals in object space to normals in world space.
    pub fn world_normal(&self) -> DMat4 {
        rounded(normal_matrix(self.model))
    }

    /// Where the eye is, in world space.
    pub fn eye(&self) -> DVec3 {
        self.view.inverse().w_axis.truncate().as_vec3().as_dvec3()
    }
}

fn rounded(m: DMat4) -> DMat4 {
    m.as_mat4().as_dmat4()
}

/// The view matrix of `gluLookAt`: the eye at the origin, the target on the negative z axis, `up` in the half plane y > 0.
pub fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> DMat4 {
    let z = (eye - target).normalize();
    let x = up.cross(z).normalize();
    let y = z.cross(x);
    let rows = DMat3::from_cols(x, y, z);
    let rotation = rows.transpose();
    let origin = rotation * eye;
    DMat4::from_cols(
        rotation.x_axis.extend(0.0),
        rotation.y_axis.extend(0.0),
        rotation.z_axis.extend(0.0),
        (-origin).extend(1.0),
    )
}

/// Rotation by `angle` about the y axis: z turns towards x.
pub fn rotate_y(angle: f64) -> DMat4 {
    let (s, c) = angle.sin_cos();
    DMat4::from_cols(DVec4::new(c, 0.0, -s, 0.0), DVec4::Y, DVec4::new(s, 0.0, c, 0.0), DVec4::W)
}

/// The projection of `gluPerspective`: z = -near goes to -1 and z = -far to 1 after division by w.
pub fn perspective(fovy: f64, aspect: f64, near: f64, far: f64) -> DMat4 {
    let f = 1.0 / (fovy / 2.0).tan();
    let depth = far - near;
    DMat4::from_cols(
        DVec4::new(f / aspect, 0.0, 0.0, 0.0),
        DVec4::new(0.0, f, 0.0, 0.0),
        DVec4::new(0.0, 0.0, -(far + near) / depth, -1.0),
        DVec4::new(0.0, 0.0, -2.0 * far * near / depth, 0.0),
    )
}

/// The cofactors of the upper left 3×3, last row and column 0 0 0 1.
///
/// The cofactor matrix of (a b c) has the columns b×c, c×a, a×b; it is the transposed inverse times the determinant, so a
/// transformed normal stays perpendicular to the transformed surface.
pub fn normal_matrix(m: DMat4) -> DMat4 {
    let (a, b, c) = (m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate());
    DMat4::from_mat3(DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of a few f64 of magnitude 10: 10 × 2⁻⁵² × a few operations.
    const ROUNDING: f64 = 1e-13;

    fn near(a: DVec4, b: DVec4) -> bool {
        (a - b).abs().max_element() < ROUNDING
    }

    #[test]
    fn a_quarter_turn_takes_z_to_x_and_x_to_minus_z() {
        let quarter = rotate_y(std::f64::consts::FRAC_PI_2);
        assert!(near(quarter * DVec4::Z, DVec4::X));
        assert!(near(quarter * DVec4::X, -DVec4::Z));
        assert!(near(quarter * DVec4::Y, DVec4::Y));
    }

    #[test]
    fn look_at_puts_eye_and_target_on_the_z_axis() {
        let (eye, target) = (DVec3::new(0.0, 3.0, 4.0), DVec3::ZERO);
        let view = look_at(eye, target, DVec3::Y);
        assert!(near(view * eye.extend(1.0), DVec4::W));
        // The target is 5 away (3-4-5 triangle), straight ahead.
        assert!(near(view * target.extend(1.0), DVec4::new(0.0, 0.0, -5.0, 1.0)));
        // x stays x; world up has the component cos(angle of elevation) = 4/5 along y and 3/5 along z.
        assert!(near(view * DVec4::X, DVec4::X));
        assert!(near(view * DVec4::Y, DVec4::new(0.0, 0.8, 0.6, 0.0)));
    }

    #[test]
    fn perspective_takes_near_to_minus_one_and_far_to_one() {
        let p = perspective(std::f64::consts::FRAC_PI_2, 2.0, 1.0, 15.0);
        let near_plane = p * DVec4::new(0.0, 0.0, -1.0, 1.0);
        let far_plane = p * DVec4::new(0.0, 0.0, -15.0, 1.0);
        assert!((near_plane.z / near_plane.w + 1.0).abs() < ROUNDING);
        assert!((far_plane.z / far_plane.w - 1.0).abs() < ROUNDING);
        // At 90 degrees the top of the picture at distance 3 is at y = 3; with aspect 2 its right edge at x = 6.
        let corner = p * DVec4::new(6.0, 3.0, -3.0, 1.0);
        assert!((corner.x / corner.w - 1.0).abs() < ROUNDING);
        assert!((corner.y / corner.w - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn the_normal_matrix_keeps_normals_perpendicular_under_a_stretch() {
        let stretch = DMat4::from_scale(DVec3::new(2.0, 1.0, 1.0));
        // The plane x + y = 0 contains (1, -1, 0), which becomes (2, -1, 0); its normal is along (1, 2, 0).
        let normal = normal_matrix(stretch) * DVec4::new(1.0, 1.0, 0.0, 1.0);
        // Cofactors of diag(2, 1, 1) are diag(1, 2, 2).
        assert!(near(normal, DVec4::new(1.0, 2.0, 0.0, 1.0)));
    }

    #[test]
    fn the_normal_matrix_of_a_rotation_is_that_rotation() {
        let m = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0)) * rotate_y(0.7);
        let n = normal_matrix(m);
        assert!(near(n.x_axis, m.x_axis) && near(n.y_axis, m.y_axis) && near(n.z_axis, m.z_axis));
        assert!(near(n.w_axis, DVec4::W));
    }
}
