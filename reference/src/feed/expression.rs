//! Values that are computed: expressions of GLSL over the time, the instance and the camera.

use crate::Value;
use crate::interpreter::{Program, Refusal, Stage, Type, expression};
use crate::scene::Moment;
use crate::value::rounded;
use std::sync::Arc;

/// Steps that one value may take: a loop over some thousand numbers.
const FUEL: u64 = 10_000_000;

/// What an expression may use. Angles are in radians; `turn` is one turn in a cycle.
const PRELUDE: &str = "#version 460
in float t; in int i, scene; in vec2 resolution; in mat4 model, view, projection, pass_view, pass_projection; in vec3 eye;
#define pi 3.141592653589793
#define turn (6.283185307179586 * t)
mat4 translate(vec3 by) { return mat4(1,0,0,0, 0,1,0,0, 0,0,1,0, by,1); }
mat4 translate(float x, float y, float z) { return translate(vec3(x, y, z)); }
mat4 scale(vec3 by) { return mat4(by.x,0,0,0, 0,by.y,0,0, 0,0,by.z,0, 0,0,0,1); }
mat4 scale(float x, float y, float z) { return scale(vec3(x, y, z)); }
mat4 scale(float by) { return scale(vec3(by)); }
mat4 rotate_x(float a) { float c = cos(a), s = sin(a); return mat4(1,0,0,0, 0,c,s,0, 0,-s,c,0, 0,0,0,1); }
mat4 rotate_y(float a) { float c = cos(a), s = sin(a); return mat4(c,0,-s,0, 0,1,0,0, s,0,c,0, 0,0,0,1); }
mat4 rotate_z(float a) { float c = cos(a), s = sin(a); return mat4(c,s,0,0, -s,c,0,0, 0,0,1,0, 0,0,0,1); }
mat4 perspective(float fovy, float aspect, float near, float far) {
  float f = 1.0 / tan(fovy / 2.0), d = far - near;
  return mat4(f / aspect,0,0,0, 0,f,0,0, 0,0,-(far + near) / d,-1, 0,0,-2.0 * far * near / d,0); }
mat4 look_at(vec3 eye, vec3 target, vec3 up) {
  vec3 z = normalize(eye - target), x = normalize(cross(up, z)), y = cross(z, x);
  return mat4(x.x,y.x,z.x,0, x.y,y.y,z.y,0, x.z,y.z,z.z,0, -dot(x, eye),-dot(y, eye),-dot(z, eye),1); }
";

/// An expression of the folder, compiled.
#[derive(Clone, Debug)]
pub struct FeedExpression {
    program: Arc<Program>,
    kind: Type,
}

impl FeedExpression {
    /// Compiles an expression of a type.
    ///
    /// # Errors
    /// It is not an expression, not of the type, or uses what is not there.
    pub fn compile(text: &str, kind: &Type) -> Result<Self, Refusal> {
        // By itself first: no text may end the statement that it stands in.
        expression(text)?;
        let source = format!("{PRELUDE}out {kind} value_;\nvoid main() {{ value_ = {text}\n; }}\n");
        let program = Program::compile(&source, Stage::Vertex)?;
        Ok(Self { program: Arc::new(program), kind: kind.clone() })
    }

    /// Its value, as a uniform holds it; `None` where GLSL leaves it undefined, or it is no number.
    pub fn value(&self, moment: &Moment) -> Option<Value> {
        let Moment { t, i, scene, resolution, matrices, pass: [pass_view, pass_projection], .. } = moment;
        let given = |name: &str| match name {
            "t" => vec![*t],
            "i" => vec![f64::from(*i)],
            "scene" => vec![f64::from(*scene)],
            "pass_view" => pass_view.to_cols_array().to_vec(),
            "pass_projection" => pass_projection.to_cols_array().to_vec(),
            "resolution" => resolution.to_vec(),
            "model" => matrices.model.to_cols_array().to_vec(),
            "view" => matrices.view.to_cols_array().to_vec(),
            "projection" => matrices.projection.to_cols_array().to_vec(),
            "eye" => matrices.eye().to_array().to_vec(),
            _ => Vec::new(),
        };
        let inputs: Vec<(&str, Vec<f64>)> =
            self.program.inputs().iter().map(|input| (input.name.as_str(), given(&input.name))).collect();
        let columns: Vec<Vec<&[f64]>> = inputs.iter().map(|(_, numbers)| numbers.chunks(1).collect()).collect();
        let mut run = self.program.run(1).fuel(FUEL);
        for ((name, _), columns) in inputs.iter().zip(&columns) {
            run = run.input(name, columns).ok()?;
        }
        let outputs = run.outputs().ok()?;
        let value = outputs.get("value_")?;
        let is_defined = (0..value.values.len()).all(|scalar| value.undefined(scalar, 0).is_none());
        let value = Value::new(self.kind.clone(), value.sample(0)).filter(|_| is_defined)?;
        value.numbers().iter().all(|number| number.is_finite()).then(|| rounded(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Matrices;
    use crate::scene::{look_at, perspective};
    use glam::{DMat4, DVec3};

    fn moment(t: f64, i: u32) -> Moment {
        let matrices = Matrices::new(DMat4::IDENTITY, DMat4::IDENTITY);
        let pass = [DMat4::from_scale(DVec3::splat(2.0)), DMat4::from_scale(DVec3::splat(3.0))];
        Moment { t, i, scene: 1, picture: None, pass, resolution: [640.0, 480.0], matrices }
    }

    fn value(text: &str, kind: &Type, moment: &Moment) -> Vec<f64> {
        let expression = FeedExpression::compile(text, kind).unwrap_or_else(|refusal| panic!("{text}: {refusal}"));
        expression.value(moment).expect(text).numbers().to_vec()
    }

    #[test]
    fn an_expression_knows_time_instance_and_window() {
        assert_eq!(value("vec3(t, float(i), resolution.x)", &Type::vector(3), &moment(0.25, 7)), [0.25, 7.0, 640.0]);
        assert_eq!(value("i == 1 ? 3 : 4", &Type::INT, &moment(0.0, 1)), [3.0]);
        let half = value("rotate_y(turn) * vec4(0, 0, 1, 1)", &Type::VEC4, &moment(0.25, 0));
        // A quarter of a turn takes z to x.
        assert!((half[0] - 1.0).abs() < 1e-7 && half[2].abs() < 1e-7, "{half:?}");
        assert_eq!(
            value("scale(2.0) * translate(1.0, 2.0, 3.0)", &Type::MAT4, &moment(0.0, 0))[12..],
            [2.0, 4.0, 6.0, 1.0]
        );
    }

    #[test]
    fn an_expression_knows_scene_and_pass() {
        assert_eq!(value("scene == 1 ? 3 : 4", &Type::INT, &moment(0.0, 0)), [3.0]);
        let matrix = value("pass_projection * pass_view", &Type::MAT4, &moment(0.0, 0));
        assert_eq!([matrix[0], matrix[5], matrix[10], matrix[15]], [6.0, 6.0, 6.0, 1.0]);
    }

    #[test]
    fn cameras_of_expressions_are_those_of_scenes() {
        let near = |text: &str, matrix: DMat4| {
            let found = value(text, &Type::MAT4, &moment(0.0, 0));
            let off = found.iter().zip(matrix.to_cols_array()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6, "{text}: {found:?}");
        };
        let (eye, target) = (DVec3::new(2.0, 3.2, 1.2), DVec3::new(-0.3, 0.0, -0.2));
        near("look_at(vec3(2.0, 3.2, 1.2), vec3(-0.3, 0.0, -0.2), vec3(0, 1, 0))", look_at(eye, target, DVec3::Y));
        near("perspective(1.9, 0.75, 0.5, 9.0)", perspective(1.9, 0.75, 0.5, 9.0));
    }

    #[test]
    fn values_are_those_of_32_bits() {
        assert_eq!(value("t", &Type::FLOAT, &moment(0.1, 0)), [f64::from(0.1_f32)]);
    }

    #[test]
    fn what_is_no_expression_of_the_type_is_refused() {
        for text in ["1.0; } float f() { return 1.0", "vec2(1.0)", "later", "", "1.0 // "] {
            let compiled = FeedExpression::compile(text, &Type::FLOAT);
            assert_eq!(compiled.is_ok(), text == "1.0 // ", "{text}");
        }
        assert!(
            FeedExpression::compile("1.0 / (t - t)", &Type::FLOAT).expect("valid").value(&moment(0.0, 0)).is_none()
        );
    }
}
