//! One lookup.

use super::{Filter, Level, Texture, Wrap, cube};
use crate::interpreter::types::Dimension;

/// A lookup in one lane.
#[derive(Clone, Debug, Default)]
pub struct Lookup {
    /// Coordinates, then the layer; 0 for what the texture has not.
    pub coordinates: [f64; 4],
    /// What texels are compared with.
    pub reference: Option<f64>,
    /// Whole texels by which the place is moved.
    pub offset: [f64; 3],
    /// Derivatives of the coordinates along x and y, where the level comes from them.
    pub gradient: Option<[[f64; 3]; 2]>,
    /// The level, or what is added to it.
    pub level: f64,
}

/// A place on one layer or face, in the texture's own coordinates.
struct LayerPosition {
    at: [f64; 3],
    axes: usize,
    layer: usize,
}

impl Texture {
    fn place(&self, lookup: &Lookup) -> LayerPosition {
        let given = |index: usize| lookup.coordinates.get(index).copied().unwrap_or(0.0);
        let axes = usize::from(self.dimension.count());
        let layers = self.levels[0].size[if self.dimension == Dimension::One { 1 } else { 2 }];
        let nearest =
            |layer: f64, count: usize| ((layer + 0.5).floor().clamp(0.0, count.saturating_sub(1) as f64)) as usize;
        if self.dimension == Dimension::Cube {
            let (face, [s, t]) = cube::face([given(0), given(1), given(2)]);
            let layer = if self.array { nearest(given(3), layers / 6) } else { 0 };
            return LayerPosition { at: [s, t, 0.0], axes: 2, layer: layer * 6 + face };
        }
        let layer = if self.array { nearest(given(axes), layers) } else { 0 };
        LayerPosition { at: [given(0), given(1), given(2)], axes, layer }
    }

    /// The level of detail (section 3.8.11): the logarithm of how many texels lie between neighbours.
    fn level_of_detail(&self, lookup: &Lookup, place: &LayerPosition) -> f64 {
        let Some(gradient) = lookup.gradient else { return lookup.level };
        let size = self.levels[0].size;
        let along = |derivative: [f64; 3]| {
            let derivative = match self.dimension {
                Dimension::Cube => {
                    let moved = |index: usize| lookup.coordinates[index] + derivative[index];
                    let [s, t] = cube::on_face(place.layer % 6, [moved(0), moved(1), moved(2)]);
                    [s - place.at[0], t - place.at[1], 0.0]
                }
                _ => derivative,
            };
            let texels = |axis: usize| match self.dimension {
                Dimension::Rectangle => derivative[axis],
                _ => derivative[axis] * size[axis] as f64,
            };
            (0..place.axes).map(texels).map(|texels| texels * texels).sum::<f64>().sqrt()
        };
        along(gradient[0]).max(along(gradient[1])).log2() + lookup.level
    }

    /// The filtered value.
    pub fn sample(&self, lookup: &Lookup) -> [f64; 4] {
        let place = self.place(lookup);
        let detail = self.level_of_detail(lookup, &place);
        let sharp = match (self.magnify, self.minify, self.mipmap) {
            (Filter::Linear, Filter::Nearest, Some(_)) => 0.5,
            _ => 0.0,
        };
        // Of a constant coordinate the level is −∞.
        if detail.is_nan() || detail <= sharp {
            return self.filtered(0, self.magnify, &place, lookup);
        }
        let last = (self.levels.len() - 1) as f64;
        match self.mipmap {
            None => self.filtered(0, self.minify, &place, lookup),
            Some(Filter::Nearest) => {
                let level = (detail + 0.5).ceil() - 1.0;
                self.filtered(level.clamp(0.0, last) as usize, self.minify, &place, lookup)
            }
            Some(Filter::Linear) => {
                let (low, high) = (detail.floor().clamp(0.0, last), (detail.floor() + 1.0).clamp(0.0, last));
                let share = detail - detail.floor();
                let [low, high] = [low, high].map(|level| self.filtered(level as usize, self.minify, &place, lookup));
                std::array::from_fn(|c| low[c] * (1.0 - share) + high[c] * share)
            }
        }
    }

    fn filtered(&self, level: usize, filter: Filter, place: &LayerPosition, lookup: &Lookup) -> [f64; 4] {
        let level = &self.levels[level];
        let scaled = |axis: usize| {
            let size = if self.dimension == Dimension::Rectangle { 1.0 } else { level.size[axis] as f64 };
            place.at[axis] * size + lookup.offset[axis]
        };
        let value = |texel: [f64; 4]| self.compared(texel, lookup.reference);
        if filter == Filter::Nearest {
            let texel = std::array::from_fn(|axis| if axis < place.axes { scaled(axis).floor() } else { 0.0 });
            return value(self.texel(level, texel, place));
        }
        let mut sum = [0.0; 4];
        for corner in 0..1_usize << place.axes {
            let mut weight = 1.0;
            let mut texel = [0.0; 3];
            for (axis, texel) in texel.iter_mut().enumerate().take(place.axes) {
                let from = scaled(axis) - 0.5;
                let share = from - from.floor();
                let upper = corner >> axis & 1 == 1;
                *texel = from.floor() + f64::from(u8::from(upper));
                weight *= if upper { share } else { 1.0 - share };
            }
            let value = value(self.texel(level, texel, place));
            (0..4).for_each(|c| sum[c] += weight * value[c]);
        }
        sum
    }

    /// Whether each lookup without a gather is [that of one texel](Self::nearest).
    pub fn is_plain(&self) -> bool {
        let is_flat = self.dimension == Dimension::Two && !self.array && self.levels.len() == 1;
        is_flat && self.magnify == Filter::Nearest && self.minify == Filter::Nearest
    }

    /// What [`sample`](Self::sample) gives of a texture of two coordinates, one level and no filter.
    pub fn nearest(&self, at: [f64; 2], offset: [f64; 2], reference: Option<f64>) -> [f64; 4] {
        let level = &self.levels[0];
        let whole = |axis: usize| (at[axis] * level.size[axis] as f64 + offset[axis]).floor();
        let place = |axis: usize| wrapped(whole(axis), level.size[axis] as f64, self.wrap[axis]);
        let texel = match (place(0), place(1)) {
            (Some(x), Some(y)) => level.texels.at(y * level.size[0] + x),
            _ => self.border,
        };
        self.compared(texel, reference)
    }

    /// One component of the four texels that a linear filter reads, in the order of GLSL.
    pub fn gather(&self, lookup: &Lookup, component: usize) -> [f64; 4] {
        let place = self.place(lookup);
        let level = &self.levels[0];
        [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(|[right, up]| {
            let texel = |axis: usize, further: f64| {
                let size = if self.dimension == Dimension::Rectangle { 1.0 } else { level.size[axis] as f64 };
                (place.at[axis] * size + lookup.offset[axis] - 0.5).floor() + further
            };
            let texel = self.texel(level, [texel(0, right), texel(1, up), 0.0], &place);
            self.compared(texel, lookup.reference)[if lookup.reference.is_some() { 0 } else { component }]
        })
    }

    /// One texel by whole coordinates; `None` outside of the texture.
    pub fn fetch(&self, lookup: &Lookup) -> Option<[f64; 4]> {
        let level = self.levels.get(lookup.level as usize).filter(|_| lookup.level >= 0.0)?;
        let mut index = [0_usize; 3];
        let count = usize::from(self.dimension.count()) + usize::from(self.array);
        for (axis, index) in index.iter_mut().enumerate().take(count) {
            let at = lookup.coordinates[axis] + lookup.offset[axis];
            if at < 0.0 || at >= level.size[axis] as f64 {
                return None;
            }
            *index = at as usize;
        }
        Some(at(level, index))
    }

    fn compared(&self, texel: [f64; 4], reference: Option<f64>) -> [f64; 4] {
        let (Some(reference), Some(compare)) = (reference, self.compare) else { return texel };
        let reference = if self.clamps_reference { reference.clamp(0.0, 1.0) } else { reference };
        let result = compare.apply(reference, texel[0]);
        [result, result, result, 1.0]
    }

    /// The texel at whole coordinates, wherever they are.
    fn texel(&self, level: &Level, texel: [f64; 3], place: &LayerPosition) -> [f64; 4] {
        let mut index = [0_usize; 3];
        for (axis, index) in index.iter_mut().enumerate().take(place.axes) {
            let wrap = if self.dimension == Dimension::Cube { Wrap::ClampToEdge } else { self.wrap[axis] };
            match wrapped(texel[axis], level.size[axis] as f64, wrap) {
                Some(inside) => *index = inside,
                None => return self.border,
            }
        }
        if self.array || self.dimension == Dimension::Cube {
            index[place.axes] = place.layer;
        }
        at(level, index)
    }
}

fn at(level: &Level, [x, y, z]: [usize; 3]) -> [f64; 4] {
    level.texels.at((z * level.size[1] + y) * level.size[0] + x)
}

/// The coordinate inside of the texture; `None` for the border.
fn wrapped(texel: f64, size: f64, wrap: Wrap) -> Option<usize> {
    // What is not a number, or too far for whole numbers, is anywhere.
    let texel = if texel.is_finite() { texel } else { 0.0 };
    let inside = match wrap {
        Wrap::Repeat => texel.rem_euclid(size),
        Wrap::MirroredRepeat => {
            let twice = texel.rem_euclid(2.0 * size);
            if twice < size { twice } else { 2.0 * size - 1.0 - twice }
        }
        Wrap::ClampToEdge => texel.clamp(0.0, size - 1.0),
        Wrap::ClampToBorder if texel < 0.0 || texel >= size => return None,
        Wrap::ClampToBorder => texel,
    };
    Some(inside.clamp(0.0, size - 1.0) as usize)
}

#[cfg(test)]
mod tests;
