//! The small picture of each student's shader: one pose for the whole class, so that pictures can be compared at a glance.

use crate::fault::Fault;
use crate::pictures::{expected_pictures, telling_pose};
use crate::report::html::PictureCache;
use crate::report::{Picture, pictures};
use reference::Assignment;
use std::sync::Arc;

/// Pixels of the frame that become one of the portrait, across and down.
const REDUCTION: u32 = 4;

/// The pose of a class's portraits, and how the right answer looks there.
#[derive(Clone, Debug)]
pub struct Portraits {
    pose: usize,
    /// The right picture, a PNG.
    pub expected: Vec<u8>,
}

impl Portraits {
    /// The portraits of an assignment.
    pub fn new(assignment: &Assignment) -> Result<Self, Fault> {
        let pose = telling_pose(assignment);
        let poses = assignment.scene.all_poses();
        let frame = assignment.right_frame(&poses[pose]);
        let right = Picture::whole(frame.width, frame.height, frame.pixels.concat());
        Ok(Self { pose, expected: pictures::png(&reduced(&right))? })
    }

    /// The portrait in the frames of all poses; `None` where there are none. Gradings that share their frames have one portrait.
    pub fn of(&self, frames: &Arc<[Picture]>) -> Result<Option<Vec<u8>>, Fault> {
        static MADE: PictureCache<[Picture], usize, Vec<u8>> = PictureCache::new();
        let Some(frame) = frames.get(self.pose) else { return Ok(None) };
        MADE.get(frames, self.pose, || pictures::png(&reduced(frame))).map(Some)
    }
}

/// The right pictures of the homework's own scene, small and moving: a PNG that repeats for ever.
pub fn moving(assignment: &Assignment) -> Result<Vec<u8>, Fault> {
    let scene = &assignment.scene;
    let poses = scene.all_poses();
    let all = expected_pictures(assignment);
    let own = poses.iter().zip(all.iter()).filter(|(pose, _)| pose.view == 0);
    let frames: Vec<Picture> = own.map(|(_, frame)| reduced(frame)).collect();
    pictures::animated(&frames, scene.cycle)
}

/// The picture at a fraction of its size; each pixel is the mean of those that it stands for.
fn reduced(picture: &Picture) -> Picture {
    let (width, height) = (picture.width.div_ceil(REDUCTION), picture.height.div_ceil(REDUCTION));
    let pixels = picture.pixels();
    let means = (0..height).flat_map(|y| (0..width).map(move |x| (x * REDUCTION, y * REDUCTION)));
    let rgba = means.flat_map(|(left, top)| mean(&pixels, [picture.width, picture.height], left, top)).collect();
    Picture::whole(width, height, rgba)
}

/// The mean colour of the square whose upper left pixel this is, as far as it lies in the picture.
fn mean(pixels: &[[u8; 4]], [width, height]: [u32; 2], left: u32, top: u32) -> [u8; 4] {
    let (right, bottom) = ((left + REDUCTION).min(width), (top + REDUCTION).min(height));
    let mut sums = [0_u32; 4];
    for y in top..bottom {
        for pixel in &pixels[(y * width + left) as usize..(y * width + right) as usize] {
            for (sum, channel) in sums.iter_mut().zip(pixel) {
                *sum += u32::from(*channel);
            }
        }
    }
    let count = ((right - left) * (bottom - top)).max(1);
    sums.map(|sum| u8::try_from((sum + count / 2) / count).unwrap_or(u8::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, colour: impl Fn(u32, u32) -> u8) -> Picture {
        let at = |index: u32| [colour(index % width, index / width), 0, 9, 255];
        Picture::whole(width, height, (0..width * height).flat_map(at).collect())
    }

    #[test]
    fn a_pixel_is_the_mean_of_its_square() {
        // Columns 0 to 3 are 0, 10, 20, 30: mean 15. Column 4 alone is 40.
        let small = reduced(&picture(5, 4, |x, _| x as u8 * 10));
        assert_eq!((small.width, small.height), (2, 1));
        assert_eq!(small.rgba, [15, 0, 9, 255, 40, 0, 9, 255]);
    }

    #[test]
    fn every_portrait_has_the_size_of_the_right_one() {
        let assignment = reference::assignment("ggsample06").unwrap();
        let portraits = Portraits::new(assignment).unwrap();
        let frames: Arc<[Picture]> = vec![picture(640, 480, |_, _| 7); 25].into();
        let size = |png: &[u8]| image::load_from_memory(png).map(|image| (image.width(), image.height())).unwrap();
        assert_eq!(size(&portraits.expected), (160, 120));
        assert_eq!(size(&portraits.of(&frames).unwrap().unwrap()), (160, 120));
        assert_eq!(portraits.of(&Arc::default()).unwrap(), None);
    }
}
