//! A sky as a cube map: what is seen in a direction.

use super::TexturePicture;
use super::colour::Colour;
use super::generator::{painted, within};
use crate::Text;
use crate::text::both;
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;

/// From straight down over the horizon to straight up, and a sun.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sky {
    zenith: Colour,
    horizon: Colour,
    ground: Colour,
    /// It shows which way one looks.
    sun: Sun,
}

/// A disc.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sun {
    /// Where it is seen, from the middle of the cube.
    direction: [f64; 3],
    colour: Colour,
    /// The angle from its middle to its edge, in degrees; half of it is a soft edge.
    radius: f64,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            zenith: Colour([0.15, 0.35, 0.75, 1.0]),
            horizon: Colour([0.8, 0.9, 1.0, 1.0]),
            ground: Colour([0.35, 0.3, 0.2, 1.0]),
            sun: Sun::default(),
        }
    }
}

impl Default for Sun {
    fn default() -> Self {
        Self { direction: [1.0, 1.0, 0.5], colour: Colour([1.0, 0.95, 0.8, 1.0]), radius: 15.0 }
    }
}

impl Sky {
    /// The faces +x, -x, +y, -y, +z, -z, each with the rows in the order in which OpenGL takes them.
    pub(super) fn pictures(&self, size: [usize; 2]) -> Result<Vec<TexturePicture<f64>>, Text> {
        within("radius", self.sun.radius, 0.1, 180.0)?;
        let to_sun = DVec3::from_array(self.sun.direction).try_normalize().ok_or_else(|| {
            both("`direction` of the sun has no length", "太陽の `direction` の長さが 0 です。向きを書いてください")
        })?;
        let face =
            |number: usize| painted(size, |[s, t]| self.seen(direction(number, 2.0 * s - 1.0, 2.0 * t - 1.0), to_sun));
        Ok((0..6).map(face).collect())
    }

    fn seen(&self, towards: DVec3, to_sun: DVec3) -> Colour {
        let beyond = if towards.y >= 0.0 { self.zenith } else { self.ground };
        let sky = Colour::mixed(self.horizon, beyond, towards.y.abs());
        let angle = towards.dot(to_sun).clamp(-1.0, 1.0).acos().to_degrees();
        let inside = (2.0 - 2.0 * angle / self.sun.radius).clamp(0.0, 1.0);
        Colour::mixed(sky, self.sun.colour, inside)
    }
}

/// The direction to a place on a face (OpenGL 4.1 core, table 3.18), of length 1; `s` and `t` are -1 to 1.
fn direction(face: usize, s: f64, t: f64) -> DVec3 {
    let towards = match face {
        0 => [1.0, -t, -s],
        1 => [-1.0, -t, s],
        2 => [s, 1.0, t],
        3 => [s, -1.0, -t],
        4 => [s, -t, 1.0],
        _ => [-s, -t, -1.0],
    };
    DVec3::from_array(towards).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpreter::{Program, Stage, Texture};
    use crate::texture::Generator;

    #[test]
    fn a_direction_meets_what_is_seen_there() {
        let generator = Generator::Sky(Sky::default());
        let faces = generator.pictures([64, 64]).expect("a sky");
        let texture = Texture::cube(64, faces.into_iter().flat_map(|face| face.texels).collect::<Vec<_>>());
        let text = "#version 410\nuniform samplerCube sky; in vec3 towards; out vec4 colour;\n\
                    void main() { colour = texture(sky, towards); }";
        let program = Program::compile(text, Stage::Fragment).expect("a program");
        let directions: Vec<DVec3> =
            [[3.0, 1.0, -2.0], [-3.0, 0.5, 1.0], [1.0, 4.0, 0.5], [0.3, -2.0, 1.0], [1.0, 1.0, 2.0]]
                .into_iter()
                .chain([[-0.5, -0.7, -2.0], [1.0, 1.0, 0.5]])
                .map(|of| DVec3::from_array(of).normalize())
                .collect();
        let columns = [0, 1, 2].map(|axis| directions.iter().map(|towards| towards[axis]).collect::<Vec<_>>());
        let textures = [texture];
        let run = program.run(directions.len()).textures(&textures).uniform("sky", &[0.0]).expect("a sampler");
        let outputs = run.input("towards", &columns.each_ref().map(Vec::as_slice)).expect("an input").outputs();
        let outputs = outputs.expect("colours");
        let to_sun = DVec3::from_array(Sun::default().direction).normalize();
        for (sample, towards) in directions.iter().enumerate() {
            let expected = Sky::default().seen(*towards, to_sun);
            for channel in 0..4 {
                let found = outputs.outputs[0].values[channel][sample];
                // Half a texel of 64 is 1/64 of a face; the edge of the sun is the steepest: 1 within 7.5 degrees.
                assert!((found - expected.0[channel]).abs() < 0.2, "{towards}: {found}, {:?}", expected.0);
            }
        }
    }
}
