//! Where frames lie in the texture that they are drawn to: of each only the part that its triangles can reach.

use crate::fault::Fault;
use crate::language::Text;
use crate::report::Area;

/// Side of the texture that holds the frames; every Vulkan driver for desktops takes it.
const MAX_TEXTURE_SIDE: u32 = 8192;

/// A side of a tile is a multiple of this, in pixels: answers that differ in the last bit have tiles alike, and the
/// texture serves for the next one too.
const GRAIN: u32 = 16;

/// Pixels around a triangle's corners that its rasterisation may reach. Drivers round a corner by less than one.
const MARGIN: f64 = 2.0;

/// How far outside the picture, in half its sides, a corner may lie for the bounds of a triangle to be taken from its
/// corners. Beyond it, a driver's rounding is better not relied upon.
const NEAR: f64 = 8.0;

impl Area {
    /// The part of a frame of this size outside of which the triangles of these vertices paint nothing.
    pub(super) fn painted(positions: impl Iterator<Item = [f32; 4]>, width: u32, height: u32) -> Self {
        let whole = Self { x: 0, y: 0, width, height };
        let mut corners = Vec::new();
        for position in positions {
            let [x, y, _, w] = position.map(f64::from);
            let (x, y) = (x / w, y / w);
            // A corner behind the eye is at no place of the picture, and NaN is at none at all.
            if !(w > 0.0 && x.abs() < NEAR && y.abs() < NEAR) {
                return whole;
            }
            corners.push(((x + 1.0) / 2.0 * f64::from(width), (y + 1.0) / 2.0 * f64::from(height)));
        }
        let extent = |values: &mut dyn Iterator<Item = f64>, size: u32| {
            let (low, high) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
            // A cast from float saturates.
            let low = (low - MARGIN).floor().max(0.0) as u32 / GRAIN * GRAIN;
            let high = ((high + MARGIN).ceil().max(0.0) as u32).next_multiple_of(GRAIN).min(size);
            (low.min(high), high)
        };
        let (left, right) = extent(&mut corners.iter().map(|corner| corner.0), width);
        // From below, so that blocks of 2 × 2 pixels are those of the whole frame.
        let (bottom, top) = extent(&mut corners.iter().map(|corner| corner.1), height);
        Self { x: left, y: height - top, width: right - left, height: top - bottom }
    }
}

/// One frame's part and where it lies in the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct TextureTile {
    pub area: Area,
    /// Its lower left corner in the texture, whose rows run upwards.
    pub x: u32,
    pub y: u32,
}

impl TextureTile {
    /// Where the lower left corner of the whole frame, `height` rows high, is in the texture, whose rows run upwards.
    pub fn origin(&self, height: u32) -> [f32; 2] {
        let bottom = height - self.area.y - self.area.height;
        [self.x as f32 - self.area.x as f32, self.y as f32 - bottom as f32]
    }

    /// From a place in the texture to that in the frame.
    pub fn shift(&self, height: u32) -> [f32; 2] {
        self.origin(height).map(|at| -at)
    }
}

/// How the parts of all frames lie in one texture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tiles {
    pub tiles: Vec<TextureTile>,
    width: u32,
    height: u32,
}

impl Tiles {
    /// Places the parts row by row, the highest first.
    pub fn place(areas: &[Area]) -> Result<Self, Fault> {
        let pixels: u64 = areas.iter().map(|area| u64::from(area.width) * u64::from(area.height)).sum();
        let widest = areas.iter().map(|area| area.width).max().unwrap_or(0);
        // Near a square: no side grows past the limit before it must.
        let limit = (pixels.isqrt() as u32 + widest / 2).max(widest);
        let mut order: Vec<usize> = (0..areas.len()).filter(|index| !areas[*index].is_empty()).collect();
        order.sort_by_key(|index| (std::cmp::Reverse(areas[*index].height), *index));
        let mut tiles: Vec<TextureTile> = areas.iter().map(|&area| TextureTile { area, x: 0, y: 0 }).collect();
        let (mut x, mut y, mut row, mut width) = (0, 0, 0, 0);
        for index in order {
            let area = areas[index];
            if x + area.width > limit {
                (x, y, row) = (0, y + row, 0);
            }
            tiles[index] = TextureTile { area, x, y };
            // Even, so that a block of 2 × 2 pixels is one in the texture as well.
            x += area.width.next_multiple_of(2);
            row = row.max(area.height.next_multiple_of(2));
            width = width.max(x);
        }
        let placed = Self { tiles, width: width.max(1), height: (y + row).max(1) };
        if placed.width > MAX_TEXTURE_SIDE || placed.height > MAX_TEXTURE_SIDE {
            return Err(too_large(areas.len()));
        }
        Ok(placed)
    }

    pub fn size(&self) -> wgpu::Extent3d {
        wgpu::Extent3d { width: self.width, height: self.height, depth_or_array_layers: 1 }
    }

    pub fn bytes_per_row(&self) -> u32 {
        (self.width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
    }
}

fn too_large(count: usize) -> Fault {
    Fault::new(Text::new(
        format!("{count} frames do not fit a texture of {MAX_TEXTURE_SIDE}²"),
        format!("画像 {count} 枚が {MAX_TEXTURE_SIDE}² のテクスチャに収まりません"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: [[f32; 4]; 3]) -> Area {
        Area::painted(corners.into_iter(), 640, 480)
    }

    const WHOLE: Area = Area { x: 0, y: 0, width: 640, height: 480 };

    #[test]
    fn a_triangle_in_view_has_its_corners_and_little_more() {
        // Corners at (160, 360), (480, 360) and (320, 120): columns 158 to 482 and rows 118 to 362, in steps of 16.
        let found = area([[-0.5, -0.5, 0.0, 1.0], [1.0, -1.0, 0.0, 2.0], [0.0, 0.5, 0.0, 1.0]]);
        assert_eq!(found, Area { x: 144, y: 112, width: 496 - 144, height: 368 - 112 });
    }

    #[test]
    fn what_has_no_place_in_the_picture_may_be_anywhere() {
        let fine = [0.0, 0.0, 0.0, 1.0];
        for odd in [
            [0.0, 0.0, 0.0, -1.0],
            [0.0; 4],
            [f32::NAN, 0.0, 0.0, 1.0],
            [0.0, f32::INFINITY, 0.0, 1.0],
            [9.0, 0.0, 0.0, 1.0],
        ] {
            assert_eq!(area([fine, odd, fine]), WHOLE, "{odd:?}");
        }
    }

    #[test]
    fn a_triangle_out_of_view_has_no_part() {
        let found = area([[2.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 1.0], [2.0, 0.5, 0.0, 1.0]]);
        assert!(found.is_empty(), "{found:?}");
        assert_eq!(Tiles::place(&[found]).unwrap().size().width, 1);
    }

    #[test]
    fn no_two_tiles_share_a_pixel_and_all_lie_in_the_texture() {
        let areas: Vec<Area> =
            (0..40).map(|n| Area { x: 0, y: 0, width: n * 37 % 200, height: n * 53 % 170 }).collect();
        let placed = Tiles::place(&areas).unwrap();
        let size = placed.size();
        let shown: Vec<&TextureTile> = placed.tiles.iter().filter(|tile| !tile.area.is_empty()).collect();
        assert!(shown.len() > 30);
        for (index, a) in shown.iter().enumerate() {
            assert!(a.x + a.area.width <= size.width && a.y + a.area.height <= size.height);
            for b in &shown[..index] {
                let apart = a.x + a.area.width <= b.x
                    || b.x + b.area.width <= a.x
                    || a.y + a.area.height <= b.y
                    || b.y + b.area.height <= a.y;
                assert!(apart, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn whole_frames_of_the_course_fit_and_a_thousand_do_not() {
        assert!(Tiles::place(&[WHOLE; 60]).is_ok());
        assert!(Tiles::place(&[WHOLE; 1000]).is_err());
    }
}
