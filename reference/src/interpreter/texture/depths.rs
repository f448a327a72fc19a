//! Depths that are drawn when they are first read.

use std::fmt;
use std::sync::{Arc, OnceLock};

/// What draws a map: its texels row by row, the lowest row first.
type Draw = dyn Fn() -> Vec<f32> + Send + Sync;

/// The depths of a texture, one number a texel.
#[derive(Clone)]
pub struct Depths(Arc<Later>);

struct Later {
    count: usize,
    draw: OnceLock<Box<Draw>>,
    drawn: OnceLock<Vec<f32>>,
}

impl Depths {
    /// So many depths, of which is said [later](Self::are) how they are drawn.
    pub fn later(count: usize) -> Self {
        Self(Arc::new(Later { count, draw: OnceLock::new(), drawn: OnceLock::new() }))
    }

    /// Depths that are known.
    pub fn known(depths: Vec<f32>) -> Self {
        let later = Self::later(depths.len());
        let _ = later.0.drawn.set(depths);
        later
    }

    /// Says how they are drawn. The first that is said counts.
    pub fn are(&self, draw: impl Fn() -> Vec<f32> + Send + Sync + 'static) {
        let _ = self.0.draw.set(Box::new(draw));
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.count
    }

    /// The depths; 1 where nothing was ever drawn.
    pub fn drawn(&self) -> &[f32] {
        self.0.drawn.get_or_init(|| {
            let mut depths = self.0.draw.get().map_or_else(Vec::new, |draw| draw());
            depths.resize(self.0.count, 1.0);
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
