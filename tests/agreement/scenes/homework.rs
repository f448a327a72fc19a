//! A homework made for its fragment stages: two sheets in perspective, inputs, uniforms and textures of many types.

use crate::opengl::{OpenglDraw, Texels, ValueKind};
use crate::programs::Random;
use ggrade::render::{DrawCall, DrawState, RenderScene};
use ggrade::source;
use ggrade::translate::{HomeworkProgram, Linked, LinkedInterface, Stage, TranslationRefusal, Variable};
use reference::interpreter::{Filter, Scalar, Texture, Type, Wrap};
use reference::scene::{Cull, DepthTest};
use reference::{Value, Values};

/// Pixels of a row of the window, and rows. Not square, and no multiple of 16 rows.
pub const SIZE: [usize; 2] = [120, 90];

/// A homework with a fixed vertex stage, and what it draws.
pub struct Homework {
    pub vertex: &'static str,
    pub draws: Vec<OpenglDraw>,
    pub textures: Vec<(&'static str, Texels)>,
}

fn kind(kind: ValueKind) -> Type {
    match kind {
        ValueKind::Float(size) => Type::Vector(Scalar::Float, size),
        ValueKind::Int(size) => Type::Vector(Scalar::Int, size),
        ValueKind::Uint(size) => Type::Vector(Scalar::Uint, size),
        ValueKind::Bool(size) => Type::Vector(Scalar::Bool, size),
        ValueKind::Matrix(columns, rows) => Type::Matrix(Scalar::Float, columns, rows),
    }
}

pub fn batch(draw: &OpenglDraw) -> DrawCall {
    let uniform = |(path, of, numbers): &(String, ValueKind, Vec<f64>)| {
        (path.clone(), Value::new(kind(*of), numbers.clone()).expect("as many numbers as the type has"))
    };
    let attribute = |(name, of, numbers): &(String, ValueKind, Vec<f64>)| {
        (name.clone(), Values { kind: kind(*of), numbers: numbers.clone() })
    };
    DrawCall {
        uniforms: draw.uniforms.iter().map(uniform).collect(),
        attributes: draw.attributes.iter().map(attribute).collect(),
        triangles: draw.triangles.clone(),
        beside: Default::default(),
        state: DrawState { depth_test: draw.depth_test, cull: draw.cull },
    }
}

impl Homework {
    fn interface(&self) -> LinkedInterface {
        let variable =
            |(name, of, _): &(String, ValueKind, Vec<f64>)| Variable { name: name.clone(), ty: kind(*of).to_string() };
        let first = &self.draws[0];
        let sampler = |(name, _): &(&str, Texels)| Variable { name: (*name).into(), ty: "sampler2D".into() };
        LinkedInterface {
            stage: Stage::Vertex,
            inputs: first.attributes.iter().map(variable).collect(),
            attributes: Vec::new(),
            uniforms: first.uniforms.iter().map(variable).chain(self.textures.iter().map(sampler)).collect(),
            outputs: vec![Variable { name: "colour".into(), ty: "vec4".into() }],
            constants: Vec::new(),
            functions: Vec::new(),
            placed: Vec::new(),
            version: "#version 410 core".to_owned(),
            alike: None,
            fragment: c"".to_owned(),
        }
    }

    pub fn translate(&self, fragment: &str) -> Result<Linked, TranslationRefusal> {
        let program = HomeworkProgram::new(self.interface(), Some((Stage::Vertex, self.vertex)))
            .expect("the fixed stage is right");
        let source = source::read_stage(Stage::Fragment, "a.frag", fragment.as_bytes()).expect("a text");
        program.translate(&[(Stage::Fragment, &source)]).map_err(|refused| refused.refusal)
    }

    pub fn scene(&self) -> RenderScene {
        let [width, height] = SIZE.map(|side| side as u32);
        let draw = |draw: &OpenglDraw| {
            let mut batch = batch(draw);
            let sampler = Type::named("sampler2D").unwrap();
            for (number, (name, _)) in self.textures.iter().enumerate() {
                let value = Value::new(sampler.clone(), vec![number as f64]).expect("one number");
                batch.uniforms.push(((*name).to_owned(), value));
            }
            batch
        };
        let frames = vec![self.draws.iter().map(draw).collect()];
        let textures = self.textures.iter().map(|(_, from)| texture(from)).collect();
        RenderScene { width, height, background: [51, 102, 153, 0], frames, textures, ..RenderScene::default() }
    }
}

/// A texture as the renderer and the interpreter have it.
pub fn texture(from: &Texels) -> Texture {
    let texels: Vec<_> = from.texels.iter().map(|texel| texel.map(f64::from)).collect();
    let filter = if from.is_linear { Filter::Linear } else { Filter::Nearest };
    let wrap = if from.repeats { Wrap::Repeat } else { Wrap::ClampToEdge };
    Texture {
        magnify: filter,
        minify: filter,
        wrap: [wrap; 3],
        ..Texture::two_dimensional(from.width, from.height, texels)
    }
}

/// Numbers that follow one another without a pattern: Knuth's MMIX generator.
pub fn numbers(seed: u64, count: usize, low: f64, high: f64) -> Vec<f64> {
    let mut random = Random(seed);
    let mut next = || f64::from((low + (high - low) * (random.next() % 10_007) as f64 / 10_007.0) as f32);
    (0..count).map(|_| next()).collect()
}

/// A wavy sheet in perspective, in front of another: triangles by index, seen from the front and from behind.
pub fn sheets() -> Homework {
    const CELLS: u32 = 6;
    let places = |seed: u64| {
        let jitter = numbers(seed, 3 * 49, -0.08, 0.08);
        (0..=CELLS)
            .flat_map(|row| (0..=CELLS).map(move |column| [column, row]))
            .zip(jitter.chunks(3).map(<[f64]>::to_vec).collect::<Vec<_>>())
            .flat_map(|([column, row], jitter)| {
                let at = |n: u32| f64::from(n) / f64::from(CELLS) * 2.0 - 1.0;
                [at(column) + jitter[0], at(row) + jitter[1], jitter[2] * 6.0].map(|x| f64::from(x as f32))
            })
            .collect::<Vec<f64>>()
    };
    let triangles = |flip: bool| -> Vec<[u32; 3]> {
        let cell = |number: u32| {
            let (row, column) = (number / CELLS, number % CELLS);
            let a = row * (CELLS + 1) + column;
            let (b, c, d) = (a + 1, a + CELLS + 1, a + CELLS + 2);
            // Some run the other way round.
            if flip && number.is_multiple_of(3) { [[a, c, b], [b, c, d]] } else { [[a, b, c], [b, d, c]] }
        };
        (0..CELLS * CELLS).flat_map(cell).collect()
    };
    let draw = |seed: u64, turn: f64, back: f64| {
        let (sin, cos) = turn.sin_cos();
        // Column after column: a turn about y and a step back, then a projection with near 1 and far 10.
        let projection =
            [1.2, 0.0, 0.0, 0.0, 0.0, 1.6, 0.0, 0.0, 0.0, 0.0, -11.0 / 9.0, -1.0, 0.0, 0.0, -20.0 / 9.0, 0.0];
        let view = [cos, 0.0, -sin, 0.0, 0.0, 1.0, 0.0, 0.0, sin, 0.0, cos, 0.0, 0.1, 0.05, -back, 1.0];
        let matrix = |numbers: [f64; 16]| numbers.map(|x| f64::from(x as f32)).to_vec();
        let mat3 = numbers(seed + 9, 9, -1.0, 1.0);
        OpenglDraw {
            uniforms: [
                ("projection", ValueKind::Matrix(4, 4), matrix(projection)),
                ("view", ValueKind::Matrix(4, 4), matrix(view)),
                ("lights[0].on", ValueKind::Bool(1), vec![1.0]),
                ("lights[1].on", ValueKind::Bool(1), vec![0.0]),
                ("lights[0].at", ValueKind::Float(3), numbers(seed + 1, 3, -2.0, 2.0)),
                ("lights[1].at", ValueKind::Float(3), numbers(seed + 2, 3, -2.0, 2.0)),
                ("lights[0].colours[0]", ValueKind::Float(3), vec![0.25, 0.5, 0.75]),
                ("lights[0].colours[1]", ValueKind::Float(3), vec![0.5, 0.25, 0.0]),
                ("lights[1].colours[1]", ValueKind::Float(3), vec![1.0, 0.0, 0.5]),
                ("turn", ValueKind::Matrix(3, 3), mat3),
                ("squeeze", ValueKind::Matrix(2, 2), numbers(seed + 4, 4, -1.0, 1.0)),
                ("count", ValueKind::Int(1), vec![-3.0]),
                ("mask", ValueKind::Uint(2), vec![6.0, 4_000_000_000.0]),
                ("weights[0]", ValueKind::Float(1), vec![0.25]),
                ("weights[1]", ValueKind::Float(1), vec![0.5]),
                ("weights[2]", ValueKind::Float(1), vec![0.125]),
                ("switches", ValueKind::Bool(3), vec![1.0, 0.0, 1.0]),
                ("Surface.ambient", ValueKind::Float(4), numbers(seed + 5, 4, 0.0, 1.0)),
                ("Surface.shine", ValueKind::Float(1), vec![3.5]),
                ("Surface.basis", ValueKind::Matrix(4, 4), numbers(seed + 6, 16, -1.0, 1.0)),
                ("unused", ValueKind::Float(1), vec![1.0]),
            ]
            .map(|(path, kind, numbers)| (path.to_owned(), kind, numbers))
            .to_vec(),
            attributes: [
                ("place", ValueKind::Float(3), places(seed)),
                ("paint", ValueKind::Float(2), numbers(seed + 3, 2 * 49, 0.0, 1.0)),
                ("label", ValueKind::Int(1), (0..49).map(|n| f64::from(n * 7 % 5 - 2)).collect()),
                ("mark", ValueKind::Uint(2), (0..98).map(|n| f64::from(n * 3 % 11)).collect()),
            ]
            .map(|(name, kind, numbers)| (name.to_owned(), kind, numbers))
            .to_vec(),
            triangles: triangles(seed == 1),
            depth_test: Some(DepthTest::Less),
            cull: if seed == 2 { Cull::Back } else { Cull::None },
            instances: 1,
        }
    };
    let picture = |seed: u64, is_linear: bool, repeats: bool| Texels {
        width: 6,
        height: 5,
        texels: numbers(seed, 30, 0.0, 1.0).iter().map(|&x| [x, 1.0 - x, x * x, 0.5].map(|x| x as f32)).collect(),
        is_linear,
        repeats,
    };
    Homework {
        vertex: VERTEX,
        draws: vec![draw(1, 0.6, 2.6), draw(2, -0.4, 2.9)],
        textures: vec![
            ("first", picture(21, true, true)),
            ("second", picture(22, false, false)),
            ("skin.map", picture(23, false, true)),
            ("pair[0]", picture(24, true, false)),
            ("pair[1]", picture(25, true, true)),
        ],
    }
}

const VERTEX: &str = "#version 410
in vec4 place;
in vec3 paint;
in int label;
in uvec2 mark;
uniform mat4 projection, view;
uniform mat3 turn;
out vec3 normal;
out vec2 uv;
noperspective out vec2 screen;
flat out int number;
flat out uvec2 marks;
flat out vec3 tint;
centroid out float wave;
out mat3 frame;
out float steps[2];
out Bundle { vec3 at; vec4 clip; } bundle;
void main() {
    vec4 eye = view * place;
    gl_Position = projection * eye;
    normal = turn * place.xyz + vec3(0.0, 0.0, paint.z);
    uv = paint.xy;
    screen = paint.yx * 3.0;
    number = label;
    marks = mark;
    tint = vec3(paint.xy, place.w);
    wave = sin(place.x * 4.0);
    frame = turn * (1.0 + place.x);
    steps = float[2](place.x, place.y);
    bundle.at = eye.xyz;
    bundle.clip = gl_Position;
}
";
