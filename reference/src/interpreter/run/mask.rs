//! Which lanes run.

/// A column of 0 and 1.
#[derive(Clone, Debug, Default)]
pub struct Mask {
    lanes: Vec<f64>,
    /// Whether any lane is in it.
    any: bool,
    /// Whether all are.
    all: bool,
}

impl Mask {
    /// All lanes, or none.
    pub fn new(lanes: usize, yes: bool) -> Self {
        Self { lanes: vec![f64::from(u8::from(yes)); lanes], any: yes && lanes > 0, all: yes }
    }

    fn counted(lanes: Vec<f64>) -> Self {
        let any = lanes.iter().fold(false, |any, &lane| any | (lane != 0.0));
        let all = lanes.iter().fold(true, |all, &lane| all & (lane != 0.0));
        Self { lanes, any, all }
    }

    /// Whether any lane is in it.
    pub fn any(&self) -> bool {
        self.any
    }

    /// Whether all lanes are in it.
    pub fn all(&self) -> bool {
        self.all
    }

    /// Whether this lane is in it.
    pub fn has(&self, lane: usize) -> bool {
        self.lanes[lane] != 0.0
    }

    /// The lanes of it where the condition is true, and those where it is false.
    pub fn split(&self, condition: &[f64]) -> (Self, Self) {
        let part = |wanted: bool| {
            let one = |(&lane, &value): (&f64, &f64)| if (value != 0.0) == wanted { lane } else { 0.0 };
            Self::counted(self.lanes.iter().zip(condition).map(one).collect())
        };
        let yes = part(true);
        if yes.all {
            let none = Self::new(self.lanes.len(), false);
            return (yes, none);
        }
        (yes, part(false))
    }

    /// The lanes that `wanted` takes.
    pub fn filter(&self, wanted: impl Fn(usize) -> bool) -> Self {
        let one = |(index, &lane): (usize, &f64)| if lane != 0.0 && wanted(index) { 1.0 } else { 0.0 };
        Self::counted(self.lanes.iter().enumerate().map(one).collect())
    }

    /// Adds lanes.
    pub fn add(&mut self, other: &Self) {
        if other.any {
            self.lanes.iter_mut().zip(&other.lanes).for_each(|(lane, other)| *lane = lane.max(*other));
            *self = Self::counted(std::mem::take(&mut self.lanes));
        }
    }

    /// Copies `from` to `to` in its lanes.
    pub fn copy(&self, to: &mut [f64], from: &[f64]) {
        if self.all {
            to.copy_from_slice(from);
            return;
        }
        for ((to, &from), &lane) in to.iter_mut().zip(from).zip(&self.lanes) {
            *to = if lane != 0.0 { from } else { *to };
        }
    }
}
