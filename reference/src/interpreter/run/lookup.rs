//! What a lane computes together with others: derivatives and texture lookups.

use super::NotedLookup;
use super::machine::Machine;
use super::memory::{CauseNumber, UndefinedCause};
use super::undefined::Undefined;
use crate::interpreter::code::{DerivativeAxis, Slot};
use crate::interpreter::texture::{Lookup, LookupMode, Query, Texture};

/// So many lookups are noted.
const MOST_NOTED: usize = 1_000;

/// What an incomplete texture reads as.
const INCOMPLETE: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

impl Machine<'_> {
    /// The lanes of a pixel and of its neighbour, in the 2 × 2 pixels that stand row by row, the lower one first.
    fn neighbours(lane: usize, direction: DerivativeAxis, coarse: bool) -> (usize, usize) {
        let quad = lane / 4 * 4;
        let own = if coarse { 0 } else { lane % 4 };
        match direction {
            DerivativeAxis::X => (quad + (own & 2), quad + (own & 2) + 1),
            DerivativeAxis::Y => (quad + (own & 1), quad + (own & 1) + 2),
        }
    }

    fn difference(&self, of: Slot, lane: usize, direction: DerivativeAxis, coarse: bool) -> f64 {
        let (low, high) = Self::neighbours(lane, direction, coarse);
        let column = self.memory.column(of);
        match (column.get(low), column.get(high)) {
            (Some(low), Some(high)) => high - low,
            _ => f64::NAN,
        }
    }

    /// Whether all four pixels of the lane's quad run.
    fn is_whole(&self, lane: usize) -> bool {
        let quad = lane / 4 * 4;
        quad + 4 <= self.lanes && (quad..quad + 4).all(|lane| self.active.has(lane))
    }

    pub(super) fn derivative(&mut self, to: Slot, of: Slot, direction: DerivativeAxis, coarse: bool, line: u32) {
        let values: Vec<f64> = (0..self.lanes).map(|lane| self.difference(of, lane, direction, coarse)).collect();
        let inherited = |lane: usize| {
            let (low, high) = Self::neighbours(lane, direction, coarse);
            let of_low = if low < self.lanes { self.memory.cause(of, low) } else { 0 };
            if of_low != 0 || high >= self.lanes { of_low } else { self.memory.cause(of, high) }
        };
        let causes: Vec<CauseNumber> = (0..self.lanes).map(inherited).collect();
        let outside: Vec<bool> = (0..self.lanes).map(|lane| !self.is_whole(lane)).collect();
        self.memory.column_mut(to).copy_from_slice(&values);
        if causes.iter().any(|&cause| cause != 0) {
            self.memory.causes_mut(to).copy_from_slice(&causes);
        }
        if outside.contains(&true) {
            let cause = self.memory.number(UndefinedCause { what: Undefined::Derivative, line });
            self.memory.mark(to, cause, |lane| outside[lane]);
        }
    }

    /// Notes where each lane looks, where lookups are noted.
    fn note(&mut self, query: &Query) {
        let is_place = !matches!(query.mode, LookupMode::Size(_) | LookupMode::Levels) && query.coordinates.len() >= 2;
        let Some(mut noted) = self.lookups.take() else { return };
        for lane in (0..self.lanes).filter(|lane| is_place && self.active.has(*lane)) {
            let value = |slot: &Slot| self.memory.column(*slot)[lane];
            let number = value(&query.texture);
            let Some(texture) = self.textures.get(number as usize).filter(|_| number >= 0.0) else { continue };
            let at = [0, 1].map(|axis| {
                let size = texture.levels[0].size[axis] as f64;
                let own = value(&query.coordinates[axis]);
                let own = if matches!(query.mode, LookupMode::Fetch(_)) { (own + 0.5) / size } else { own };
                own + query.offset.get(axis).map_or(0.0, value) / size
            });
            let reference = query.reference.as_ref().map(value);
            if noted.len() == MOST_NOTED {
                break;
            }
            noted.push(NotedLookup { sample: lane, texture: number as usize, at, reference, line: query.line });
        }
        self.lookups = Some(noted);
    }

    pub(super) fn lookup(&mut self, query: &Query) {
        self.note(query);
        let plain = self.plain(query);
        let mut results = vec![[0.0; 4]; self.lanes];
        let mut open: Vec<Option<Undefined>> = vec![None; self.lanes];
        for (lane, found) in results.iter_mut().zip(&mut open).enumerate().filter(|(lane, _)| self.active.has(*lane)) {
            (*found.0, *found.1) = match plain {
                Some(texture) => self.look_up_plain(texture, query, lane),
                None => self.look_up_one(query, lane),
            };
        }
        if self.texels != 1.0 && query.sampler.texel.is_floating() && !query.sampler.shadow {
            let inexact = results.iter_mut().flatten().filter(|value| **value != 0.0 && **value != 1.0);
            inexact.for_each(|value| *value *= self.texels);
        }
        let inherited = |lane: usize| {
            query.operands().map(|slot| self.memory.cause(slot, lane)).find(|&cause| cause != 0).unwrap_or(0)
        };
        let causes: Vec<CauseNumber> = (0..self.lanes).map(inherited).collect();
        for (component, &to) in query.to.iter().enumerate() {
            let column = self.memory.column_mut(to);
            column.iter_mut().zip(&results).for_each(|(value, result)| *value = result[component]);
            if causes.iter().any(|&cause| cause != 0) {
                self.memory.causes_mut(to).copy_from_slice(&causes);
            }
            for what in [Undefined::Texture, Undefined::Derivative] {
                if open.contains(&Some(what)) {
                    let cause = self.memory.number(UndefinedCause { what, line: query.line });
                    self.memory.mark(to, cause, |lane| open[lane] == Some(what));
                }
            }
        }
    }

    /// The one texture that all lanes read, where each reads a single texel of it: of many lookups most are such.
    fn plain(&self, query: &Query) -> Option<&Texture> {
        let numbers = self.memory.column(query.texture);
        let lanes = || (0..self.lanes).filter(|lane| self.active.has(*lane));
        let number = numbers[lanes().next()?];
        let texture = self.textures.get(number as usize).filter(|_| number >= 0.0)?;
        let is_plain = texture.is_plain() && texture.fits(query.sampler);
        let takes_one = matches!(query.mode, LookupMode::Implicit(_) | LookupMode::Level(_));
        (is_plain && takes_one && lanes().all(|lane| numbers[lane] == number)).then_some(texture)
    }

    fn look_up_plain(&self, texture: &Texture, query: &Query, lane: usize) -> ([f64; 4], Option<Undefined>) {
        let value = |slot: &Slot| self.memory.column(*slot)[lane];
        let at = [0, 1].map(|axis| query.coordinates.get(axis).map_or(0.0, value));
        let offset = [0, 1].map(|axis| query.offset.get(axis).map_or(0.0, value));
        let reference = query.reference.as_ref().map(value);
        let is_number = at.iter().chain(&reference).all(|number| number.is_finite());
        (texture.nearest(at, offset, reference), (!is_number).then_some(Undefined::Texture))
    }

    fn look_up_one(&self, query: &Query, lane: usize) -> ([f64; 4], Option<Undefined>) {
        let value = |slot: Slot| self.memory.column(slot)[lane];
        let difference = |slot, direction| self.is_whole(lane).then(|| self.difference(slot, lane, direction, false));
        look_up(self.textures, query, &value, &difference)
    }
}

/// What one sample reads, and why that is left open, where it is. `value`: what a slot holds; `difference`: how much it changes
/// to the neighbour, where there is one.
pub(super) fn look_up(
    textures: &[Texture],
    query: &Query,
    value: &dyn Fn(Slot) -> f64,
    difference: &dyn Fn(Slot, DerivativeAxis) -> Option<f64>,
) -> ([f64; 4], Option<Undefined>) {
    let number = value(query.texture);
    let bound = textures.get(number as usize).filter(|_| number >= 0.0);
    let Some(texture) = bound.filter(|texture| texture.fits(query.sampler)) else {
        // A texture that is there and does not fit, or is compared with though there is none, is left open.
        let open = bound.is_some() || query.reference.is_some();
        return (INCOMPLETE, open.then_some(Undefined::Texture));
    };
    let mut lookup = Lookup { reference: query.reference.map(value), ..Lookup::default() };
    for (coordinate, &slot) in lookup.coordinates.iter_mut().zip(&query.coordinates) {
        *coordinate = value(slot);
    }
    for (offset, &slot) in lookup.offset.iter_mut().zip(&query.offset) {
        *offset = value(slot);
    }
    let is_number = lookup.coordinates.iter().chain(&lookup.reference).all(|coordinate| coordinate.is_finite());
    let mut open = (!is_number).then_some(Undefined::Texture);
    let result = match &query.mode {
        LookupMode::Implicit(bias) => {
            if texture.levels.len() > 1 && texture.mipmap.is_some() || texture.magnify != texture.minify {
                let along = |direction| {
                    let of = |axis: usize| {
                        query.coordinates.get(axis).map_or(Some(0.0), |&slot| difference(slot, direction))
                    };
                    Some([of(0)?, of(1)?, of(2)?])
                };
                match (along(DerivativeAxis::X), along(DerivativeAxis::Y)) {
                    (Some(x), Some(y)) => lookup.gradient = Some([x, y]),
                    _ => open = open.or(Some(Undefined::Derivative)),
                }
            }
            lookup.level = bias.map_or(0.0, value);
            texture.sample(&lookup)
        }
        LookupMode::Level(level) => {
            lookup.level = value(*level);
            texture.sample(&lookup)
        }
        LookupMode::Gradient(x, y) => {
            let along = |slots: &[Slot]| std::array::from_fn(|axis| slots.get(axis).map_or(0.0, |&slot| value(slot)));
            lookup.gradient = Some([along(x), along(y)]);
            texture.sample(&lookup)
        }
        LookupMode::Fetch(level) => {
            lookup.level = value(*level);
            texture.fetch(&lookup).unwrap_or_else(|| {
                open = Some(Undefined::Texture);
                [0.0; 4]
            })
        }
        LookupMode::Gather(component) => texture.gather(&lookup, (value(*component).clamp(0.0, 3.0)) as usize),
        LookupMode::Size(level) => size(texture, value(*level)).unwrap_or_else(|| {
            open = Some(Undefined::Texture);
            [0.0; 4]
        }),
        LookupMode::Levels => [texture.levels.len() as f64; 4],
    };
    (result, open)
}
/// The size of a level as `textureSize` gives it; layers of a cube are counted in cubes.
fn size(texture: &Texture, level: f64) -> Option<[f64; 4]> {
    let size = texture.levels.get(level as usize).filter(|_| level >= 0.0)?.size;
    let [width, height, depth] = size.map(|side| side as f64);
    let is_cube = texture.dimension == crate::interpreter::types::Dimension::Cube;
    Some([width, height, if is_cube { depth / 6.0 } else { depth }, 1.0])
}
