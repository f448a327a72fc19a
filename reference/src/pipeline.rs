//! A vertex and a fragment stage, linked: what is handed from one to the other, and what is seen of it.

mod uniforms;

pub use uniforms::UniformSource;
pub(crate) use uniforms::UniformsOf;

use crate::assignment::{Input, Interface};
use crate::interpreter::{Copied, Interpolation, Nature, Outputs, Program, ProgramVariable, Texture};
use crate::probes::at_pixel;
use crate::scene::Vertex;
use crate::text::{Text, both};
use crate::{Assignment, Value};
use glam::DVec4;
use std::sync::Arc;

/// Where the position of a vertex stands.
pub const POSITION: &str = "gl_Position";

/// Where a fragment stage writes its depth.
const DEPTH: &str = "gl_FragDepth";

/// Two stages that fit.
#[derive(Clone, Debug)]
pub struct Pipeline {
    /// The vertex stage.
    pub vertex: Arc<Program>,
    /// The fragment stage.
    pub fragment: Arc<Program>,
    pub(crate) varyings: Vec<Varying>,
    /// The output of the fragment stage that is seen.
    pub(crate) colour: usize,
    /// The output that is the depth, where the fragment stage writes one.
    pub(crate) depth: Option<usize>,
    pub(crate) nature: Nature,
    /// Where red, green and blue come from, if they are only handed on.
    pub(crate) copied: Option<[PassedChannel; 3]>,
}

/// A variable between the stages.
#[derive(Clone, Debug)]
pub(crate) struct Varying {
    /// The vertex stage's output, by its place.
    pub output: usize,
    /// The fragment stage's input, by its place.
    pub input: usize,
    /// Its scalars among those of all varyings.
    pub scalars: std::ops::Range<usize>,
    pub interpolation: Interpolation,
}

/// A channel that is only handed on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PassedChannel {
    /// A scalar of the varyings.
    Varying(usize),
    /// A number.
    Constant(f64),
}

impl Pipeline {
    /// Whether the same is handed over between the stages as between those of another one.
    pub(crate) fn hands_over_as(&self, other: &Self) -> bool {
        let way = |varying: &Varying| (varying.output, varying.interpolation);
        let is_same = |own: &Varying| other.varyings.iter().any(|theirs| way(theirs) == way(own));
        Arc::ptr_eq(&self.vertex, &other.vertex) && self.varyings.iter().all(is_same)
    }

    /// Links two stages. `colour`: the output that is seen; without it, the one at location 0, or else the first.
    ///
    /// # Errors
    /// The stages do not fit: what does not.
    pub fn link(vertex: &Arc<Program>, fragment: &Arc<Program>, colour: Option<&str>) -> Result<Self, Text> {
        let mut varyings: Vec<Varying> = Vec::new();
        for (input, read) in fragment.inputs().iter().enumerate().filter(|(_, read)| !read.name.starts_with("gl_")) {
            let outputs = || vertex.outputs().iter().enumerate();
            let placed = outputs().find(|(_, output)| read.location.is_some() && output.location == read.location);
            let found = placed.or_else(|| outputs().find(|(_, output)| output.name == read.name));
            let Some((output, written)) = found else {
                let name = &read.name;
                return Err(both(
                    format!("the fragment stage reads `{name}`, which the vertex stage does not write"),
                    format!("フラグメントシェーダが読む `{name}` を、バーテックスシェーダが書いていません"),
                ));
            };
            if !written.kind.is_like(&read.kind) {
                let (name, from, to) = (&read.name, &written.kind, &read.kind);
                return Err(both(
                    format!("`{name}` is a {from} in the vertex stage and a {to} in the fragment stage"),
                    format!("`{name}` の型が、バーテックスシェーダでは {from}、フラグメントシェーダでは {to} です"),
                ));
            }
            let first = varyings.last().map_or(0, |last| last.scalars.end);
            let scalars = first..first + read.kind.slots().unwrap_or(0);
            varyings.push(Varying { output, input, scalars, interpolation: read.interpolation });
        }
        let colour = seen(fragment.outputs(), colour)?;
        let handed = |copied: &Copied| match copied {
            Copied::Constant(number) => Some(PassedChannel::Constant(*number)),
            Copied::Input(input, scalar) => {
                let varying = varyings.iter().find(|varying| varying.input == *input)?;
                Some(PassedChannel::Varying(varying.scalars.start + scalar))
            }
        };
        let depth = fragment.outputs().iter().position(|output| output.name == DEPTH);
        let copied = fragment.copies().filter(|_| depth.is_none()).and_then(|copies| {
            let channel = |at: usize| copies[colour].get(at).map_or(Some(PassedChannel::Constant(0.0)), handed);
            Some([channel(0)?, channel(1)?, channel(2)?])
        });
        let (vertex, nature) = (Arc::clone(vertex), fragment.nature());
        Ok(Self { vertex, fragment: Arc::clone(fragment), varyings, colour, depth, nature, copied })
    }

    /// Whether a fragment depends on its neighbours: by derivatives, or by lookups that choose a level or a filter.
    pub(crate) fn needs_quads(&self, textures: &[Texture]) -> bool {
        let by_neighbours = |texture: &Texture| {
            texture.mipmap.is_some() && texture.levels.len() > 1 || texture.magnify != texture.minify
        };
        self.nature.derivatives || self.nature.implicit_levels && textures.iter().any(by_neighbours)
    }

    /// Whether it takes derivatives, so that what the pixels beside are given is seen.
    pub(crate) fn has_derivatives(&self) -> bool {
        self.nature.derivatives
    }

    /// What a pixel `at` so many pixels to the right and above is given, where it is known here and at the two pixels `beside`.
    /// Without derivatives nobody sees it.
    pub(crate) fn at_pixel(&self, here: f64, beside: [f64; 2], at: [f64; 2]) -> f64 {
        if self.has_derivatives() { at_pixel(here, beside, at) } else { here }
    }

    /// How many scalars are handed from stage to stage.
    pub(crate) fn width(&self) -> usize {
        self.varyings.last().map_or(0, |last| last.scalars.end)
    }
}

/// The output that the window shows.
fn seen(outputs: &[ProgramVariable], name: Option<&str>) -> Result<usize, Text> {
    let own = || outputs.iter().enumerate().filter(|(_, output)| output.name != DEPTH);
    let found = match name {
        Some(name) => own().find(|(_, output)| output.name == name),
        None => own().find(|(_, output)| output.location == Some(0)).or_else(|| own().next()),
    };
    found.map(|(place, _)| place).ok_or_else(|| match name {
        Some(name) => both(
            format!("the fragment stage has no output `{name}`"),
            format!("フラグメントシェーダに出力 `{name}` がありません"),
        ),
        None => both(
            "the fragment stage has no output: declare `out vec4 a_name;`",
            "フラグメントシェーダに出力がありません。`out vec4 a_name;` と宣言してください",
        ),
    })
}

/// The vertices of a draw after the vertex stage.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadedVertices {
    pub positions: Vec<DVec4>,
    /// For each scalar of the varyings its value at each vertex.
    pub varyings: Vec<Vec<f64>>,
}

/// What an attribute has where less is given.
pub const LACKING: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// A column of all samples for each scalar of a variable.
pub(crate) fn columns<'v>(variable: &ProgramVariable, values: impl Iterator<Item = &'v Value>) -> Vec<Vec<f64>> {
    let count = variable.kind.slots().unwrap_or(0);
    let mut columns = vec![Vec::new(); count];
    for value in values {
        for (scalar, column) in columns.iter_mut().enumerate() {
            let lacking = LACKING.get(scalar).copied().unwrap_or(0.0);
            column.push(value.numbers().get(scalar).copied().unwrap_or(lacking));
        }
    }
    columns
}

pub(crate) fn slices(columns: &[Vec<f64>]) -> Vec<&[f64]> {
    columns.iter().map(Vec::as_slice).collect()
}

impl Interface {
    /// Runs a vertex stage on all vertices of a mesh.
    pub(crate) fn run_vertices(
        &self,
        program: &Program,
        uniforms: UniformsOf<'_>,
        vertices: &[Vertex],
        textures: &[Texture],
    ) -> Option<Outputs> {
        let mut given: Vec<(&str, Vec<Vec<f64>>)> = Vec::new();
        for input in program.inputs() {
            let own = Input::fed(&self.inputs, program, input);
            let columns = match own {
                Some(own) => own.stream.columns(&own.kind, input, vertices),
                None => match Vertex::number_by(&input.name) {
                    Some(number) => vec![vertices.iter().map(|vertex| f64::from(number(vertex))).collect()],
                    None => continue,
                },
            };
            given.push((&input.name, columns));
        }
        let columns: Vec<(&str, Vec<&[f64]>)> = given.iter().map(|(name, columns)| (*name, slices(columns))).collect();
        let mut run = self.fed(program, vertices.len(), uniforms, textures)?;
        for (name, columns) in &columns {
            run = run.input(name, columns).ok()?;
        }
        run.outputs().ok()
    }
}

impl Assignment {
    /// Runs a vertex stage on all vertices of a mesh.
    pub(crate) fn run_vertices(
        &self,
        program: &Program,
        uniforms: UniformsOf<'_>,
        vertices: &[Vertex],
    ) -> Option<Outputs> {
        self.interface.run_vertices(program, uniforms, vertices, &self.textures)
    }
}

/// The scalars of an output for each sample; what is undefined is not a number.
pub(crate) fn scalars(outputs: &Outputs, place: usize) -> Vec<Vec<f64>> {
    let Some(column) = outputs.outputs.get(place) else { return Vec::new() };
    let of = |(scalar, values): (usize, &Vec<f64>)| {
        let defined = |(sample, value): (usize, &f64)| match column.undefined(scalar, sample) {
            None => *value,
            Some(_) => f64::NAN,
        };
        values.iter().enumerate().map(defined).collect()
    };
    column.values.iter().enumerate().map(of).collect()
}

/// The position of each vertex.
pub(crate) fn positions(outputs: &Outputs, count: usize) -> Vec<DVec4> {
    let place = outputs.outputs.iter().position(|output| output.name == POSITION);
    let Some(columns) = place.map(|place| scalars(outputs, place)) else { return vec![DVec4::NAN; count] };
    (0..count).map(|vertex| DVec4::from_array(std::array::from_fn(|axis| columns[axis][vertex]))).collect()
}
