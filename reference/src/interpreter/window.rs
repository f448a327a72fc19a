//! How a fragment stage counts places in the window (GLSL 4.60, 4.4.1.3).

/// By which rules `gl_FragCoord` counts: OpenGL's own begin in the lower left corner, and the middle of the first pixel is at 0.5.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WindowCoordinates {
    /// `layout(origin_upper_left)`: rows are counted from the top.
    pub from_top: bool,
    /// `layout(pixel_center_integer)`: the middle of the first pixel is at 0.
    pub in_whole_pixels: bool,
}

impl WindowCoordinates {
    /// What a program's input that counts so is called by who feeds it.
    pub fn input(self) -> &'static str {
        match (self.from_top, self.in_whole_pixels) {
            (false, false) => "gl_FragCoord",
            (true, false) => "gl_FragCoord(origin_upper_left)",
            (false, true) => "gl_FragCoord(pixel_center_integer)",
            (true, true) => "gl_FragCoord(origin_upper_left, pixel_center_integer)",
        }
    }

    /// How an input of this name counts; `None` where it is no place in the window.
    pub fn of(input: &str) -> Option<Self> {
        let all = [(false, false), (true, false), (false, true), (true, true)];
        let all = all.map(|(from_top, in_whole_pixels)| Self { from_top, in_whole_pixels });
        all.into_iter().find(|own| own.input() == input)
    }

    /// What is read along an axis where OpenGL's own rules say `at`, in a window of so many rows.
    pub fn along(self, axis: usize, at: f64, rows: f64) -> f64 {
        let at = if self.from_top && axis == 1 { rows - at } else { at };
        if self.in_whole_pixels && axis < 2 { at - 0.5 } else { at }
    }
}
