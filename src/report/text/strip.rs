//! The strip of frames: one cell each, above the axis of t.

use super::{BAD, BOLD, DIM, GOOD, ReportWriter, number};
use crate::report::FrameResult;
use crate::report::difference::{BANDS, agreeing, band_of, shades};
use crate::report::wrap::{columns, pad, wrap};

impl ReportWriter {
    /// One cell a frame, shaded by how far off it is, above the axis of t.
    pub(super) fn strip(&mut self, frames: &[FrameResult], column: usize) {
        let labels = self.labels;
        let indent = " ".repeat(column + 2);
        let room = self.width - column - 2;
        let cell = if frames.len() * 2 <= room { 2 } else { 1 };
        let agree = frames.iter().filter(|frame| frame.agrees()).count();
        let heading = self.paint(BOLD, &pad(labels.frames, column));
        self.line(&format!("{heading}  {}", labels.frames_agree(agree, frames.len())));
        for row in frames.chunks(room / cell) {
            let cells: String = row.iter().map(|frame| self.cell(frame, cell)).collect();
            self.line(&format!("{indent}{cells}"));
            let axis = self.paint(DIM, &axis(row, cell, room));
            self.line(&format!("{indent}{axis}"));
        }
        if agree < frames.len() {
            let ramp: Vec<String> = shades().map(|(shade, range)| format!("{shade} {range}")).collect();
            let legend = format!("· {} ({})  {}", labels.agrees, agreeing(), ramp.join("  "));
            self.legend(column + 2, &legend);
            self.legend(column + 2, labels.legend);
        }
        if let Some((differing, most)) = FrameResult::shape_mismatches(frames) {
            self.legend(column + 2, &labels.shape_differs(differing, frames.len(), most));
        }
        self.gap();
    }

    fn legend(&mut self, indent: usize, text: &str) {
        let indent = if indent + columns(text) > self.width { 2 } else { indent };
        let room = self.width - indent;
        let lines = if columns(text) <= room { vec![text.to_owned()] } else { wrap(text, room) };
        for line in lines {
            let line = self.paint(DIM, &line);
            self.line(&format!("{}{line}", " ".repeat(indent)));
        }
    }

    fn cell(&self, frame: &FrameResult, width: usize) -> String {
        if frame.agrees() {
            return self.paint(GOOD, &pad("·", width));
        }
        // A frame that differs is never drawn as one that agrees, whatever its numbers are.
        let shade = BANDS[band_of(frame.largest_difference()).unwrap_or(0)].shade;
        self.paint(BAD, &shade.to_string().repeat(width))
    }
}

/// The values of t under the cells that they belong to, wherever there is room for one.
fn axis(frames: &[FrameResult], cell: usize, room: usize) -> String {
    let mut axis = String::new();
    for (index, frame) in frames.iter().enumerate() {
        let label = if index == 0 { format!("t = {}", number(frame.t)) } else { number(frame.t) };
        let start = index * cell;
        let due = index == 0 || index % 5 == 0 && start >= columns(&axis) + 2;
        if due && start + columns(&label) <= room {
            axis = pad(&axis, start) + &label;
        }
    }
    axis
}
