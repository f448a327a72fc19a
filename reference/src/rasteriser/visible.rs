//! Which triangle each pixel shows.

use super::outline::{self, Corner, extent, pixels, span};
use super::{Coverage, Setup};
use crate::scene::{Cull, DepthTest};
use glam::{DVec2, DVec4};
use std::collections::HashSet;

/// What one draw gives: triangles in clip space, and what decides which of them are seen.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// Its vertices in clip space.
    pub positions: &'a [DVec4],
    /// For each vertex the first one that is the same in all that is interpolated.
    pub same: &'a [u32],
    /// Its triangles.
    pub triangles: &'a [[u32; 3]],
    /// Whether neighbours differ although their vertices are the same: their common edges are seen.
    pub is_faceted: bool,
    /// Which pixels are drawn over others.
    pub depth_test: Option<DepthTest>,
    /// Which triangles are left out.
    pub cull: Cull,
}

/// The triangles that are seen.
#[derive(Clone, Debug)]
pub struct Visible {
    pub(super) width: u32,
    pub(super) height: u32,
    /// One more than the place of what is seen in `setups`; 0 is the background.
    pub(super) hits: Vec<u32>,
    /// The depths that are written; empty as long as nothing is tested.
    pub(super) depths: Vec<f64>,
    pub(super) setups: Vec<Setup>,
    /// Pixels where two things are equally deep, as far as roundings go.
    pub(super) doubtful: HashSet<u32>,
    /// The edges from which no neighbour goes on: the place of the triangle in `setups`, and both ends in pixels.
    pub(super) contours: Vec<(usize, DVec2, DVec2)>,
    /// Where each pixel lies.
    pub coverage: Vec<Coverage>,
    /// Whether a surface's pixels are tested, and how.
    pub(super) tests: Vec<Option<DepthTest>>,
    /// Whether the fragment stage writes the depths: any edge may then be seen.
    pub(super) is_open: bool,
}

/// The depths of surfaces, each moved by a polygon offset (factor and units), row by row, the lowest first; 1 where nothing is drawn.
pub fn depth_map(size: [u32; 2], surfaces: &[Surface<'_>], offset: [f64; 2]) -> Vec<f64> {
    let [width, height] = size;
    let mut depths = vec![1.0_f64; width as usize * height as usize];
    let mut window = Visible::new(width, height);
    for surface in surfaces {
        window.tests.push(surface.depth_test);
        for triangle in 0..surface.triangles.len() {
            let Some(mut setup) = window.setup(surface, triangle) else { continue };
            setup.offset(offset, size.map(f64::from));
            window.each_pixel(&setup.outline, |_, pixel, x, y| {
                let (depth, there) = (setup.depth(x, y).clamp(0.0, 1.0), &mut depths[pixel]);
                let is_kept = match surface.depth_test {
                    Some(DepthTest::Less) => depth < *there,
                    Some(DepthTest::LessEqual) => depth <= *there,
                    None => true,
                };
                if is_kept {
                    *there = depth;
                }
            });
        }
    }
    depths.chunks_exact(width.max(1) as usize).rev().flatten().copied().collect()
}

impl Visible {
    /// A window that shows nothing yet.
    pub fn new(width: u32, height: u32) -> Self {
        let count = width as usize * height as usize;
        Self {
            width,
            height,
            hits: vec![0; count],
            depths: Vec::new(),
            setups: Vec::new(),
            doubtful: HashSet::new(),
            contours: Vec::new(),
            coverage: vec![Coverage::Outside; count],
            tests: Vec::new(),
            is_open: false,
        }
    }

    /// The same where the fragment stage writes the depths, if it does.
    pub fn with_depths_of_its_own(self, is_open: bool) -> Self {
        Self { is_open, ..self }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (f64, f64) {
        (f64::from(self.width), f64::from(self.height))
    }

    /// Draws surfaces, one after the other.
    pub fn draw(&mut self, surfaces: &[Surface<'_>]) {
        if surfaces.iter().any(|surface| surface.depth_test.is_some()) {
            self.depths = vec![1.0; self.hits.len()];
        }
        for surface in surfaces {
            self.tests.push(surface.depth_test);
            for triangle in 0..surface.triangles.len() {
                if let Some(setup) = self.setup(surface, triangle) {
                    self.fill(setup);
                }
            }
        }
        self.mark(surfaces);
    }

    /// The triangle with what is linear over its picture. A vertex that is not finite draws nothing.
    fn setup(&self, surface: &Surface<'_>, triangle: usize) -> Option<Setup> {
        let corners = surface.triangles[triangle];
        let positions = corners.map(|vertex| surface.positions[vertex as usize]);
        if !positions.iter().all(|position| position.is_finite()) {
            return None;
        }
        let size = [f64::from(self.width), f64::from(self.height)];
        let outline = outline::outline(positions, size);
        let is_front = outline::area(&outline) > 0.0;
        let is_culled = match surface.cull {
            Cull::None => false,
            Cull::Back => !is_front,
            Cull::Front => is_front,
        };
        if outline.len() < 3 || is_culled {
            return None;
        }
        let place = [self.tests.len() as u32 - 1, triangle as u32];
        Some(Setup::new(place, positions, outline, is_front, size))
    }

    fn fill(&mut self, setup: Setup) {
        self.setups.push(setup);
        let number = self.setups.len();
        let outline = std::mem::take(&mut self.setups[number - 1].outline);
        self.each_pixel(&outline, |visible, pixel, x, y| visible.test(number, pixel, x, y));
        self.setups[number - 1].outline = outline;
    }

    /// Does something for each pixel whose centre lies inside, with its place in the picture.
    fn each_pixel(&mut self, outline: &[Corner], mut each: impl FnMut(&mut Self, usize, f64, f64)) {
        let (top, bottom) = extent(outline.iter().map(|corner| corner.at.y));
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        for row in pixels(top, bottom, self.height) {
            let y = row as f64 + 0.5;
            let Some((left, right)) = span(outline, y) else { continue };
            let ndc_y = 1.0 - 2.0 * y / height;
            let line = row * self.width as usize;
            for column in pixels(left, right, self.width) {
                each(self, line + column, 2.0 * (column as f64 + 0.5) / width - 1.0, ndc_y);
            }
        }
    }

    /// Shows a triangle at a pixel, unless it lies behind what is there.
    fn test(&mut self, number: usize, pixel: usize, x: f64, y: f64) {
        let setup = &self.setups[number - 1];
        if !self.depths.is_empty() {
            let test = self.tests[setup.surface as usize];
            let (depth, there) = (setup.depth(x, y), self.depths[pixel]);
            let other = (self.hits[pixel] as usize).checked_sub(1).map(|other| &self.setups[other]);
            let slack = setup.slack + other.map_or(0.0, |other| other.slack);
            let is_close = test.is_some() && other.is_some() && (depth - there).abs() <= slack;
            let is_shown = match test {
                Some(DepthTest::Less) => depth < there,
                Some(DepthTest::LessEqual) => depth <= there,
                None => true,
            };
            if is_close {
                self.doubtful.insert(pixel as u32);
            } else if is_shown {
                self.doubtful.remove(&(pixel as u32));
            }
            if !is_shown {
                return;
            }
            if test.is_some() {
                self.depths[pixel] = depth;
            }
        }
        self.hits[pixel] = number as u32;
        self.coverage[pixel] = Coverage::Interior;
    }

    /// The triangle that a pixel shows.
    pub fn at(&self, pixel: usize) -> Option<&Setup> {
        self.hits[pixel].checked_sub(1).map(|number| &self.setups[number as usize])
    }

    /// The place of the pixel's triangle among all.
    pub fn number(&self, pixel: usize) -> Option<u32> {
        self.hits[pixel].checked_sub(1)
    }

    /// The triangles that are drawn.
    pub fn setups(&self) -> &[Setup] {
        &self.setups
    }

    /// How what a pixel shows is tested.
    pub fn test_at(&self, pixel: usize) -> Option<DepthTest> {
        self.at(pixel).and_then(|setup| self.tests[setup.surface as usize])
    }

    /// For each pixel the first triangle that covers it, in the order in which they are drawn; then the second one, and so on.
    pub fn layers(&mut self, most: usize) -> Vec<Vec<Option<u32>>> {
        let mut layers: Vec<Vec<Option<u32>>> = Vec::new();
        let mut covered = vec![0_usize; self.hits.len()];
        for number in 0..self.setups.len() {
            let outline = std::mem::take(&mut self.setups[number].outline);
            self.each_pixel(&outline, |visible, pixel, _, _| {
                let layer = covered[pixel];
                covered[pixel] += 1;
                if layer == layers.len() && layer < most {
                    layers.push(vec![None; visible.hits.len()]);
                }
                if let Some(layer) = layers.get_mut(layer) {
                    layer[pixel] = Some(number as u32);
                }
            });
            self.setups[number].outline = outline;
        }
        layers
    }

    /// Shows these triangles, pixel by pixel.
    pub fn show(&mut self, shown: &[Option<u32>]) {
        for ((hit, coverage), number) in self.hits.iter_mut().zip(&mut self.coverage).zip(shown) {
            *hit = number.map_or(0, |number| number + 1);
            *coverage = match (*coverage, number) {
                (Coverage::Silhouette, _) => Coverage::Silhouette,
                (_, Some(_)) => Coverage::Interior,
                (_, None) => Coverage::Outside,
            };
        }
    }

    /// Takes triangles away where fragments were thrown away, and shows there what lies behind. `gone`: for each pixel the
    /// triangles that it shows no more.
    pub fn reveal(&mut self, gone: &std::collections::HashMap<u32, Vec<u32>>) {
        for pixel in gone.keys() {
            let pixel = *pixel as usize;
            self.hits[pixel] = 0;
            if !self.depths.is_empty() {
                self.depths[pixel] = 1.0;
            }
            if self.coverage[pixel] == Coverage::Interior {
                self.coverage[pixel] = Coverage::Outside;
            }
        }
        for number in 0..self.setups.len() {
            let outline = std::mem::take(&mut self.setups[number].outline);
            self.each_pixel(&outline, |visible, pixel, x, y| {
                let is_open = gone.get(&(pixel as u32)).is_some_and(|gone| !gone.contains(&(number as u32)));
                let before = visible.coverage[pixel];
                if is_open {
                    visible.test(number + 1, pixel, x, y);
                }
                if before == Coverage::Silhouette {
                    visible.coverage[pixel] = before;
                }
            });
            self.setups[number].outline = outline;
        }
        self.mark_contours();
    }
}
