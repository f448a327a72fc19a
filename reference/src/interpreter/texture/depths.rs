//! Depths that are drawn when they are first read.

use std::fmt;
use std::sync::{Arc, OnceLock};

/// What draws a map: its texels row by row, the lowest row first.
type DrawDepths = dyn Fn() -> Vec<f32> + Send + Sync;

/// The depths of a texture: one number a texel, or their moments, which are two.
#[derive(Clone)]
pub struct Depths(Arc<Later>);

struct Later {
    count: usize,
    each: usize,
    draw: OnceLock<Box<DrawDepths>>,
    drawn: OnceLock<Vec<f32>>,
}

impl Depths {
    /// So many texels of so many numbers each, of which is said [later](Self::are) how they are drawn.
    pub fn later(count: usize, each: usize) -> Self {
        Self(Arc::new(Later { count, each, draw: OnceLock::new(), drawn: OnceLock::new() }))
    }

    /// Texels of so many numbers each that are known.
    pub fn known(depths: Vec<f32>, each: usize) -> Self {
        let later = Self::later(depths.len() / each.max(1), each);
        let _ = later.0.drawn.set(depths);
        later
    }

    /// Says how they are drawn. The first that is said counts.
    pub fn are(&self, draw: impl Fn() -> Vec<f32> + Send + Sync + 'static) {
        let _ = self.0.draw.set(Box::new(draw));
    }

    /// How many texels there are.
    pub fn count(&self) -> usize {
        self.0.count
    }

    /// How many numbers a texel has: a depth, or the mean of depths and that of their squares.
    pub fn each(&self) -> usize {
        self.0.each
    }

    /// Red and green of a texel.
    pub fn at(&self, place: usize) -> [f32; 2] {
        let all = self.drawn();
        match self.0.each {
            1 => [all[place], 0.0],
            each => [all[place * each], all[place * each + 1]],
        }
    }

    /// The numbers of all texels; 1 where nothing was ever drawn.
    pub fn drawn(&self) -> &[f32] {
        self.0.drawn.get_or_init(|| {
            let mut depths = self.0.draw.get().map_or_else(Vec::new, |draw| draw());
            depths.resize(self.0.count * self.0.each, 1.0);
            depths
        })
    }
}

/// The same map is the same; that two maps are alike nobody asks.
impl PartialEq for Depths {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for Depths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} depths", self.0.count)
    }
}
