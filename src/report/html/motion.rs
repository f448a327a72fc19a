//! How a sheet of poses moves, as a style sheet.

use super::sheet::{FilmStep, SheetGrid};
use crate::report::Area;
use crate::report::difference::ColourRamp;
use askama::Template;

/// Seconds for which the goal picture stands at its opening pose: as long as a page may take to be looked at.
const HELD: f64 = 3.0;

/// How a sheet moves so that one pose after the other is seen.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    pub(super) grid: SheetGrid,
    width: usize,
    height: usize,
    part: Option<Part>,
    opening: Option<usize>,
}

/// The part of every picture that the sheets show, in percent of a picture's sides from each side, and the colours of the background
/// around it.
#[derive(Clone, Copy, Debug)]
struct Part {
    top: f64,
    right: f64,
    bottom: f64,
    left: f64,
    blank: [u8; 3],
    agreeing: [u8; 3],
}

impl Motion {
    /// The motion of `poses` pictures, at least one, of a size.
    pub fn of(poses: usize, width: usize, height: usize) -> Self {
        Self { grid: SheetGrid::of(poses), width, height, part: None, opening: None }
    }

    /// The same where the sheets show only a part of the pictures, and the rest is of the colour `blank`.
    pub(super) fn within(self, part: Area, blank: [u8; 4]) -> Self {
        let percent = |pixels: u32, side: usize| 100.0 * f64::from(pixels) / side as f64;
        let ([r, g, b, _], beyond) = (blank, |end: u32, side: usize| (side as u32).saturating_sub(end));
        let part = (part != Area::whole(self.width as u32, self.height as u32)).then(|| Part {
            top: percent(part.y, self.height),
            right: percent(beyond(part.x + part.width, self.width), self.width),
            bottom: percent(beyond(part.y + part.height, self.height), self.height),
            left: percent(part.x, self.width),
            blank: [r, g, b],
            agreeing: ColourRamp::new().pixel(&blank, &blank),
        });
        Self { part, ..self }
    }

    /// The same for a page with a goal picture, which opens with this pose.
    pub fn opening_with(self, pose: usize) -> Self {
        Self { opening: Some(pose), ..self }
    }

    /// It as a style sheet, for an animation of `cycle` seconds.
    pub fn style(self, cycle: f64) -> String {
        let steps = self.grid.steps();
        let start = |pose: usize| cycle * pose as f64 / self.grid.count as f64;
        let opening = self.opening.and_then(|pose| {
            let FilmStep { x, y, .. } = *steps.get(pose)?;
            Some(Opening { x, y, held: HELD, delay: HELD - start(pose) })
        });
        let style = MotionStyle {
            columns: self.grid.columns,
            cycle,
            poses: self.grid.count,
            width: self.width,
            height: self.height,
            part: self.part,
            starts: (0..self.grid.count).map(start).collect(),
            steps,
            opening,
        };
        // Numbers into a string: there is nothing that could fail.
        style.render().unwrap_or_default()
    }
}

#[derive(Template)]
#[template(path = "report/html/templates/motion.css", escape = "none")]
struct MotionStyle {
    columns: usize,
    cycle: f64,
    poses: usize,
    width: usize,
    height: usize,
    part: Option<Part>,
    steps: Vec<FilmStep>,
    /// Seconds of the cycle that are over at each pose.
    starts: Vec<f64>,
    opening: Option<Opening>,
}

/// How the goal picture opens: with one pose, from which it goes on.
struct Opening {
    x: f64,
    y: f64,
    held: f64,
    delay: f64,
}
