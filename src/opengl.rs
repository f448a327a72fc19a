//! What the machine's own OpenGL driver draws of a homework: a third opinion, beside the interpreter's and wgpu's.

use crate::ffi::opengl::{Driver, LinkedProgram, OpenglDraw, Rejection, ValueKind, Version, Window};
use crate::render::{DrawCall, RenderScene};
use crate::translate::INSTANCE_NUMBER;
use reference::assignment::HandedIn;
use reference::interpreter::Stage;
use reference::interpreter::{Scalar, Texture, Type};
use reference::rasteriser::{Coverage, Frame};
use reference::{Assignment, Value};
use serde::{Deserialize, Serialize};

/// Largest difference of a channel, in 1/255, between a driver in f32 and the reference in f64: rounding at .5, and the driver's
/// own rounding while it interpolates. Of 28 homeworks no judged pixel differs by more than 2.
pub const REFERENCE_TOLERANCE: u8 = 2;

/// One of so many judged pixels may be unlike all colours around it: a value of a texture decides them, of which drivers keep
/// fewer bits than the reference. A noise of 64 × 64 texels that cuts holes has 12 of 117,699; a wrong solution has hundreds.
const DOUBTFUL: usize = 500;

/// How far OpenGL agrees with the reference about the solution.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Agreement {
    /// The driver.
    pub renderer: String,
    /// Why the driver refuses the solution.
    pub refusal: Option<String>,
    /// The frames, in the order of all poses.
    pub frames: Vec<FrameAgreement>,
}

/// The same for one frame.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct FrameAgreement {
    /// Pixels that are judged.
    pub judged: usize,
    /// How many of them differ by more than [`REFERENCE_TOLERANCE`].
    pub differing: usize,
    /// How many of these are none of the colours around their place either. Drivers keep the weights of a texture's filter in 8
    /// bits, so what is cut off at a value of a texture has its edge up to a pixel elsewhere.
    pub unlike: usize,
}

impl FrameAgreement {
    /// Whether no more differs than between two drivers.
    pub fn agrees(&self) -> bool {
        self.unlike <= self.judged / DOUBTFUL
    }
}

/// Holds the solution's frames against the reference's.
///
/// # Errors
/// There is no OpenGL driver: what to install.
pub fn agreement(assignment: &Assignment) -> Result<Agreement, String> {
    let driver = Driver::start(Version::Raised460)?;
    let scene = RenderScene::of(assignment, &[]);
    let texts = texts(assignment, |file| &file.solution.text);
    let mut agreement = Agreement { renderer: driver.renderer(), refusal: None, frames: Vec::new() };
    let all: Vec<usize> = (0..scene.frames.len()).collect();
    match frames(&driver, assignment, &scene, texts, &all) {
        Ok(all) => agreement.frames.extend(assignment.frames().iter().zip(all).map(|(right, drawn)| {
            let judged = right.coverage.iter().filter(|coverage| **coverage != Coverage::Silhouette).count();
            let (differing, unlike) = (disagreeing(right, &drawn), unlike(right, &drawn));
            FrameAgreement { judged, differing, unlike }
        })),
        Err(rejection) => agreement.refusal = Some(rejection.log),
    }
    Ok(agreement)
}

/// The text of each stage, vertex before fragment; of those that are handed in it is what `handed_in` gives.
///
/// # Panics
/// The homework has no such stage. Reading its folder has made sure that it has.
pub fn texts<'a>(assignment: &'a Assignment, handed_in: impl Fn(&'a HandedIn) -> &'a str) -> [&'a str; 2] {
    [Stage::Vertex, Stage::Fragment].map(|wanted| {
        let handed_in = assignment.files.iter().map(|file| (file.stage, handed_in(file)));
        let fixed = assignment.fixed.iter().map(|fixed| (fixed.stage, fixed.text.as_str()));
        handed_in.chain(fixed).find(|(stage, _)| *stage == wanted).map(|(_, text)| text).expect("a stage")
    })
}

/// Some frames as OpenGL draws them: 8 bits a channel, rows from above. The driver compiles the program once for all of them, which
/// takes it longer than to draw.
///
/// # Errors
/// The driver refuses the program.
pub fn frames(
    driver: &Driver,
    assignment: &Assignment,
    scene: &RenderScene,
    [vertex, fragment]: [&str; 2],
    which: &[usize],
) -> Result<Vec<Vec<[u8; 4]>>, Rejection> {
    let program = driver.link(vertex, fragment, &[])?;
    let drawn = which.iter().map(|number| frame(driver, program, assignment, scene, *number)).collect();
    driver.delete(program);
    Ok(drawn)
}

fn frame(
    driver: &Driver,
    program: LinkedProgram,
    assignment: &Assignment,
    scene: &RenderScene,
    frame: usize,
) -> Vec<[u8; 4]> {
    let (width, height) = (scene.width as usize, scene.height as usize);
    let background = scene.background.map(|channel| f32::from(channel) / 255.0);
    let window = Window { width, height, background, is_float: false };
    // A host program compares with the depths of a texture for a sampler that does, and for no other.
    let is_compared = |unit: usize| {
        let uniforms = scene.frames[frame].iter().flat_map(|batch| &batch.uniforms);
        let mut samplers = uniforms.filter(|(_, value)| value.numbers().first() == Some(&(unit as f64)));
        samplers.any(|(_, value)| matches!(value.kind(), Type::Sampler(sampler) if sampler.shadow))
    };
    let texture = |(unit, texture): (usize, &Texture)| Texture {
        compare: texture.compare.filter(|_| is_compared(unit)),
        ..texture.clone()
    };
    let textures: Vec<Texture> = assignment.textures.iter().enumerate().map(texture).collect();
    let textures: Vec<(&str, &Texture)> = textures.iter().map(|texture| ("", texture)).collect();
    let mut draws: Vec<OpenglDraw> = Vec::new();
    for own in scene.frames[frame].iter().map(draw) {
        match draws.last_mut() {
            // What is given the same uniforms a program draws as instances at once, and `gl_InstanceID` counts them.
            Some(last) if instance(&own) == last.instances && own.uniforms == last.uniforms => last.instances += 1,
            _ => draws.push(own),
        }
    }
    let drawn = driver.scene_of(program, &draws, &textures, window, 1).remove(0);
    let rows = drawn.chunks_exact(width).rev().flatten();
    rows.map(|pixel| pixel.map(|channel| (channel * 255.0).round() as u8)).collect()
}

/// How many pixels of a right frame that are judged are not what OpenGL draws.
pub fn disagreeing(right: &Frame, drawn: &[[u8; 4]]) -> usize {
    count(right, drawn, |at, drawn| !is_between(right.pixels[at], right.pixels[at], drawn))
}

/// How many of them are no mixture of the colours around their place either.
fn unlike(right: &Frame, drawn: &[[u8; 4]]) -> usize {
    let (width, height) = (right.width as usize, right.height as usize);
    count(right, drawn, |at, drawn| {
        let (column, row) = (at % width, at / width);
        let rows = row.saturating_sub(1)..=(row + 1).min(height - 1);
        let columns = || column.saturating_sub(1)..=(column + 1).min(width - 1);
        let around = rows.flat_map(|row| columns().map(move |column| right.pixels[row * width + column]));
        let extremes = around.fold(([255; 4], [0; 4]), |(least, most): ([u8; 4], [u8; 4]), pixel| {
            let each =
                |pick: fn(u8, u8) -> u8, from: [u8; 4]| std::array::from_fn(|axis| pick(from[axis], pixel[axis]));
            (each(u8::min, least), each(u8::max, most))
        });
        !is_between(extremes.0, extremes.1, drawn)
    })
}

fn count(right: &Frame, drawn: &[[u8; 4]], is_off: impl Fn(usize, [u8; 4]) -> bool) -> usize {
    let judged = right.coverage.iter().zip(drawn).enumerate();
    // Most pixels are the same to the last bit.
    let others = judged.filter(|(at, (_, drawn))| right.pixels[*at] != **drawn);
    others.filter(|(at, (coverage, drawn))| **coverage != Coverage::Silhouette && is_off(*at, **drawn)).count()
}

/// Whether red, green and blue lie between two colours, or no further outside than [`REFERENCE_TOLERANCE`].
fn is_between(least: [u8; 4], most: [u8; 4], colour: [u8; 4]) -> bool {
    (0..3).all(|axis| {
        let (least, most) =
            (least[axis].saturating_sub(REFERENCE_TOLERANCE), most[axis].saturating_add(REFERENCE_TOLERANCE));
        (least..=most).contains(&colour[axis])
    })
}

fn draw(batch: &DrawCall) -> OpenglDraw {
    let uniform = |(path, value): &(String, Value)| (path.clone(), kind(value.kind()), value.numbers().to_vec());
    OpenglDraw {
        uniforms: batch.uniforms.iter().map(uniform).collect(),
        attributes: batch
            .attributes
            .iter()
            .map(|(name, values)| (name.clone(), kind(&values.kind), values.numbers.clone()))
            .collect(),
        triangles: batch.triangles.clone(),
        depth_test: batch.state.depth_test,
        cull: batch.state.cull,
        instances: 1,
    }
}

/// The number of the instance that a draw is.
fn instance(draw: &OpenglDraw) -> u32 {
    let numbers = draw.attributes.iter().find(|(name, ..)| name == INSTANCE_NUMBER);
    numbers.and_then(|(.., numbers)| numbers.first()).map_or(0, |number| *number as u32)
}

fn kind(kind: &Type) -> ValueKind {
    match kind {
        Type::Vector(Scalar::Float, size) => ValueKind::Float(*size),
        Type::Vector(Scalar::Uint, size) => ValueKind::Uint(*size),
        Type::Vector(Scalar::Bool, size) => ValueKind::Bool(*size),
        Type::Vector(_, size) => ValueKind::Int(*size),
        Type::Matrix(_, columns, rows) => ValueKind::Matrix(*columns, *rows),
        // The number of a texture is that of its unit.
        _ => ValueKind::Int(1),
    }
}
