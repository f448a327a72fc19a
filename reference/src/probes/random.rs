//! Random numbers.

use glam::{DQuat, DVec3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use std::ops::RangeInclusive;

/// Random numbers that are the same on every machine.
pub(super) struct Random(pub(super) ChaCha8Rng);

impl Random {
    /// Uniform in [from, to).
    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        // The upper 53 bits fill the significand of an f64.
        let unit = (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        from + (to - from) * unit
    }

    /// Uniform among the whole numbers from 0 to before `count`.
    pub(super) fn below(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }

    /// Uniform within a range.
    pub(super) fn within(&mut self, range: &RangeInclusive<f64>) -> f64 {
        self.between(*range.start(), *range.end())
    }

    /// Uniform on the unit sphere: height and longitude are independent (Archimedes).
    pub(super) fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (s, c) = self.between(0.0, std::f64::consts::TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * c, r * s, z)
    }

    /// A unit vector at `angle` from `axis`, in a random direction around it.
    pub(super) fn at_angle(&mut self, axis: DVec3, angle: f64) -> DVec3 {
        let aside = axis.any_orthonormal_vector();
        let around = DQuat::from_axis_angle(axis, self.between(0.0, std::f64::consts::TAU));
        axis * angle.cos() + around * aside * angle.sin()
    }
}
