//! The colours of what is seen: the fragment stage, run for the pixels that a triangle covers.

mod depth;
mod fragments;

use crate::interpreter::{NotedLookup, Outputs, Program, Texels, Texture, UndefinedCause};
use crate::pipeline::{PassedChannel, Pipeline, ShadedVertices, UniformsOf, scalars, slices};
use crate::rasteriser::{Coverage, Frame, SILHOUETTE_DISTANCE, Setup, Visible, quantised};
use crate::{Assignment, Value};
use fragments::Fragment;
use std::borrow::Cow;
use std::collections::HashMap;

/// Pixels that are shaded together: enough that a run costs little, few enough that their columns stay small.
const CHUNK: usize = 1 << 15;

/// So many things may stand one behind the other where fragments are thrown away.
const MOST_LAYERS: usize = 64;

/// A colour that changes by more than this, in steps of 8 bits, over the distance that rounding moves a surface by is left
/// to the rasteriser.
const SUDDEN: u8 = 2;

/// A colour that changes where what is rounded is this part more, or less, is decided by rounding.
const ROUNDING: f64 = 4e-6;

/// One of so many pixels says whether a uniform is on a threshold.
const FEW_OF_ALL: usize = 16;

/// How far what a fragment is given is from what it is.
#[derive(Clone, Copy, Default)]
struct Shake {
    /// Its place, in pixels.
    moved: [f64; 2],
    /// Uniforms that are rounded, by this part more, and what textures give, by this part less.
    rounded: f64,
}

impl Shake {
    fn uniforms(self, uniforms: &[Value]) -> Cow<'_, [Value]> {
        if self.rounded == 0.0 {
            return Cow::Borrowed(uniforms);
        }
        uniforms.iter().map(|value| value.rounded_up(self.rounded)).collect()
    }
}

/// What is drawn, and by what it is coloured.
pub(crate) struct Scenery<'a> {
    pub assignment: &'a Assignment,
    pub pipeline: &'a Pipeline,
    /// What is drawn, in this order.
    pub shapes: Vec<ShadedDraw<'a>>,
    /// A variable of the fragment stage's `main` that is shown in place of the colour.
    pub local: Option<&'a str>,
}

/// A draw after the vertex stage.
pub(crate) struct ShadedDraw<'a> {
    pub uniforms: Vec<Value>,
    pub vertices: ShadedVertices,
    pub triangles: &'a [[u32; 3]],
}

/// What a pixel's fragment came to.
#[derive(Clone, Copy, PartialEq)]
enum Shaded {
    Colour([f64; 3]),
    Discarded,
}

impl Scenery<'_> {
    /// Colours the pixels of a frame; what is visible then is what is seen through holes. Whether all colours are defined.
    pub fn shade(&self, visible: &mut Visible, frame: &mut Frame) -> bool {
        if let Some(handed) = self.pipeline.copied.filter(|_| self.local.is_none()) {
            self.hand_on(visible, handed, frame);
            frame.coverage.clone_from(&visible.coverage);
            return true;
        }
        let mut gone: HashMap<u32, Vec<u32>> = HashMap::new();
        let mut pixels: Vec<u32> = self.covered(visible);
        let mut sudden: Vec<u32> = Vec::new();
        let mut is_defined = true;
        for _ in 0..MOST_LAYERS {
            let shaded = self.pixels(visible, &pixels, Shake::default());
            sudden.extend(self.sudden(visible, &pixels, &shaded));
            is_defined &= !shaded.iter().any(is_undefined);
            let mut discarded = Vec::new();
            for (pixel, shaded) in pixels.iter().zip(&shaded) {
                match shaded {
                    Shaded::Colour(colour) => frame.pixels[*pixel as usize] = quantised(*colour),
                    Shaded::Discarded => {
                        gone.entry(*pixel).or_default().extend(visible.number(*pixel as usize));
                        discarded.push(*pixel);
                    }
                }
            }
            if discarded.is_empty() {
                break;
            }
            let again: HashMap<u32, Vec<u32>> = discarded.iter().map(|pixel| (*pixel, gone[pixel].clone())).collect();
            visible.reveal(&again);
            pixels = discarded.into_iter().filter(|pixel| visible.number(*pixel as usize).is_some()).collect();
        }
        frame.coverage.clone_from(&visible.coverage);
        sudden.into_iter().for_each(|pixel| frame.coverage[pixel as usize] = Coverage::Silhouette);
        is_defined
    }

    fn covered(&self, visible: &Visible) -> Vec<u32> {
        let count = visible.coverage.len() as u32;
        (0..count).filter(|pixel| visible.number(*pixel as usize).is_some()).collect()
    }

    /// The colours of a fragment stage that only hands them on.
    fn hand_on(&self, visible: &Visible, handed: [PassedChannel; 3], frame: &mut Frame) {
        let ramps: Vec<_> = visible.setups().iter().map(|setup| handed.map(|one| self.ramp(setup, one))).collect();
        let (width, height) = (f64::from(frame.width), f64::from(frame.height));
        for row in 0..frame.height as usize {
            let y = 1.0 - 2.0 * (row as f64 + 0.5) / height;
            for column in 0..frame.width as usize {
                let pixel = row * frame.width as usize + column;
                let Some(number) = visible.number(pixel) else { continue };
                let x = 2.0 * (column as f64 + 0.5) / width - 1.0;
                let divisor = visible.setups()[number as usize].divisor(x, y);
                frame.pixels[pixel] = quantised(ramps[number as usize].map(|ramp| ramp.at(x, y, divisor)));
            }
        }
    }

    fn ramp(&self, setup: &Setup, handed: PassedChannel) -> crate::rasteriser::Ramp {
        match handed {
            PassedChannel::Constant(number) => setup.ramp([number; 3], crate::interpreter::Interpolation::Flat),
            PassedChannel::Varying(scalar) => self.varying(setup, scalar),
        }
    }

    fn varying(&self, setup: &Setup, scalar: usize) -> crate::rasteriser::Ramp {
        let ShadedDraw { vertices, triangles, .. } = &self.shapes[setup.surface as usize];
        let values = triangles[setup.triangle as usize].map(|vertex| vertices.varyings[scalar][vertex as usize]);
        let varying = self.pipeline.varyings.iter().find(|varying| varying.scalars.contains(&scalar));
        setup.ramp(values, varying.map(|varying| varying.interpolation).unwrap_or_default())
    }

    /// What the fragments of these pixels come to.
    fn pixels(&self, visible: &Visible, pixels: &[u32], shake: Shake) -> Vec<Shaded> {
        self.each(visible, pixels, Shaded::Discarded, &|surface, chunk| self.run(visible, surface, chunk, shake))
    }

    /// What `run` makes of the fragments of these pixels, for each pixel; `nothing` where there is none.
    fn each<T: Copy>(
        &self,
        visible: &Visible,
        pixels: &[u32],
        nothing: T,
        run: &dyn Fn(u32, &[Fragment]) -> Vec<T>,
    ) -> Vec<T> {
        let fragments = self.fragments(visible, pixels);
        let mut all = vec![nothing; pixels.len()];
        // Triangles are numbered surface by surface.
        for own in fragments.chunk_by(|a, b| a.surface(visible) == b.surface(visible)) {
            for chunk in own.chunks(CHUNK) {
                for (fragment, found) in chunk.iter().zip(run(own[0].surface(visible), chunk)) {
                    fragment.pixel.into_iter().for_each(|place| all[place as usize] = found);
                }
            }
        }
        all
    }

    /// Runs the fragment stage.
    fn run(&self, visible: &Visible, surface: u32, fragments: &[Fragment], shake: Shake) -> Vec<Shaded> {
        let undefined = || vec![Shaded::Colour([f64::NAN; 3]); fragments.len()];
        let Some(outputs) = self.outputs(visible, surface, fragments, shake, false) else { return undefined() };
        let columns = match outputs.locals.first() {
            Some(local) => local.values.clone(),
            None => scalars(&outputs, self.pipeline.colour),
        };
        let channel = |at: usize, fragment: usize| columns.get(at).map_or(0.0, |column| column[fragment]);
        let shaded = |fragment: usize| match outputs.discarded[fragment] {
            true => Shaded::Discarded,
            false => Shaded::Colour([0, 1, 2].map(|at| channel(at, fragment))),
        };
        (0..fragments.len()).map(shaded).collect()
    }

    /// What the fragment stage writes, and where it looks textures up, if that is noted; `None` where it cannot be run.
    fn outputs(
        &self,
        visible: &Visible,
        surface: u32,
        fragments: &[Fragment],
        shake: Shake,
        notes_lookups: bool,
    ) -> Option<Outputs> {
        let program: &Program = &self.pipeline.fragment;
        let uniforms = &shake.uniforms(&self.shapes[surface as usize].uniforms);
        let given = self.inputs(visible, program, fragments, shake.moved);
        let slices: Vec<(&str, Vec<&[f64]>)> = given.iter().map(|(name, columns)| (*name, slices(columns))).collect();
        let mut run =
            self.assignment.fed(program, fragments.len(), UniformsOf::All(uniforms))?.texels(1.0 - shake.rounded);
        for (name, columns) in &slices {
            run = run.input(name, columns).ok()?;
        }
        let run = if notes_lookups { run.noting_lookups() } else { run };
        let locals: Vec<&str> = self.local.into_iter().collect();
        run.outputs_and_locals(&locals).ok()
    }

    /// Where the fragment that is seen at a pixel looks textures up.
    pub fn lookups(&self, visible: &Visible, pixel: u32) -> Vec<NotedLookup> {
        let fragments = self.fragments(visible, &[pixel]);
        let Some(place) = fragments.iter().position(|fragment| fragment.pixel.is_some()) else { return Vec::new() };
        let surface = fragments[place].surface(visible);
        let outputs = self.outputs(visible, surface, &fragments, Shake::default(), true);
        let all = outputs.into_iter().flat_map(|outputs| outputs.lookups);
        all.filter(|one| one.sample == place).collect()
    }

    /// Why a colour is undefined among those that are seen before anything is thrown away; `None` where all are defined.
    pub fn undefined(&self, visible: &Visible) -> Option<UndefinedCause> {
        let all = self.fragments(visible, &self.covered(visible));
        let mut chunks =
            all.chunk_by(|a, b| a.surface(visible) == b.surface(visible)).flat_map(|own| own.chunks(CHUNK));
        chunks.find_map(|chunk| {
            let outputs = self.outputs(visible, chunk[0].surface(visible), chunk, Shake::default(), false)?;
            let is_seen = |at: usize| chunk[at].pixel.is_some() && !outputs.discarded[at];
            let seen = [Some(self.pipeline.colour), self.pipeline.depth].into_iter().flatten();
            seen.filter_map(|place| outputs.outputs.get(place)).find_map(|output| output.first_undefined(is_seen))
        })
    }

    /// Whether a texture has texels of 8 bits, which are the same number in many places.
    fn reads_levels(&self) -> bool {
        let is_of_bytes = |texture: &Texture| matches!(texture.levels[0].texels, Texels::Bytes(_) | Texels::Srgb(_));
        self.assignment.textures.iter().any(is_of_bytes)
    }

    /// The pixels whose colour is another one a little beside: a step, or the edge of a hole; and those where rounding decides.
    fn sudden(&self, visible: &Visible, pixels: &[u32], shaded: &[Shaded]) -> Vec<u32> {
        let bytes = |shaded: &Shaded| match shaded {
            Shaded::Colour(colour) if colour.iter().all(|channel| channel.is_finite()) => Some(quantised(*colour)),
            _ => None,
        };
        let known: Vec<Option<[u8; 4]>> = shaded.iter().map(bytes).collect();
        let mut places = vec![u32::MAX; visible.coverage.len()];
        pixels.iter().enumerate().for_each(|(place, pixel)| places[*pixel as usize] = place as u32);
        let apart = |a: &Option<[u8; 4]>, b: &Option<[u8; 4]>| match (a, b) {
            (Some(a), Some(b)) => (0..3).any(|channel| a[channel].abs_diff(b[channel]) > SUDDEN),
            (a, b) => a.is_some() != b.is_some(),
        };
        // A step that passes near a pixel's middle lies between it and one of its neighbours.
        let width = visible.size().0 as isize;
        let differs_beside = |place: usize| {
            let pixel = pixels[place] as usize;
            [-1, 1, -width, width].into_iter().any(|step| {
                let beside = pixel.checked_add_signed(step).and_then(|beside| places.get(beside));
                let other = beside.and_then(|place| known.get(*place as usize));
                other.is_some_and(|other| apart(other, &known[place]))
            })
        };
        let steps: Vec<usize> = (0..pixels.len()).filter(|place| differs_beside(*place)).collect();
        let near = SILHOUETTE_DISTANCE;
        let mut sudden: Vec<u32> =
            pixels.iter().zip(shaded).filter(|(_, shaded)| is_undefined(shaded)).map(|(p, _)| *p).collect();
        let changed = |places: &[usize], shake: Shake| -> Vec<u32> {
            let at: Vec<u32> = places.iter().map(|place| pixels[*place]).collect();
            let there = self.pixels(visible, &at, shake);
            let differs = places.iter().zip(&there).filter(|(place, shaded)| apart(&known[**place], &bytes(shaded)));
            differs.map(|(place, _)| pixels[*place]).collect()
        };
        for moved in [[near, 0.0], [-near, 0.0], [0.0, near], [0.0, -near]] {
            sudden.extend(changed(&steps, Shake { moved, ..Shake::default() }));
        }
        if self.pipeline.nature.decides {
            let all: Vec<usize> = (0..pixels.len()).collect();
            let some: Vec<usize> = all.iter().copied().step_by(FEW_OF_ALL).collect();
            for rounded in [ROUNDING, -ROUNDING] {
                let shake = Shake { rounded, ..Shake::default() };
                // A texel of 8 bits is on a threshold here and there, a uniform everywhere.
                if self.reads_levels() || !changed(&some, shake).is_empty() {
                    sudden.extend(changed(&all, shake));
                }
            }
        }
        sudden
    }
}

fn is_undefined(shaded: &Shaded) -> bool {
    matches!(shaded, Shaded::Colour(colour) if colour.iter().any(|channel| channel.is_nan()))
}
