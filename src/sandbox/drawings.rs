//! The frames that workers send: what was drawn alike lately is held once, so that what is made of it can be made once.

use crate::report::{Area, Picture};
use reference::scene::Scene;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// So many drawings are held, some 5 MB each. Of 30 right answers to ggsample06 26 draw the very same pixels, and wrong answers
/// have much in common as well.
const KEPT: usize = 4;

/// What was drawn lately.
#[derive(Debug, Default)]
pub(super) struct Drawings {
    /// The latest first.
    recent: Mutex<VecDeque<Arc<[Picture]>>>,
}

impl Drawings {
    /// The frames of a scene of which `body` has the pixels, area by area; `None` where they do not fit.
    pub fn of(&self, scene: &Scene, areas: &[Area], body: &[u8]) -> Option<Arc<[Picture]>> {
        let mut rest = body;
        let mut parts = Vec::with_capacity(areas.len());
        for area in areas {
            let (pixels, others) = rest.split_at_checked(area.pixels_within(scene.width, scene.height)? * 4)?;
            parts.push((*area, pixels));
            rest = others;
        }
        if !rest.is_empty() {
            return None;
        }
        if parts.is_empty() {
            return Some(Arc::default());
        }
        let is_this = |drawing: &Arc<[Picture]>| {
            let pairs = || drawing.iter().zip(&parts);
            let is_alike = |(picture, (area, _)): (&Picture, &(Area, _))| {
                let size = (picture.width, picture.height, picture.blank);
                picture.area == *area && size == (scene.width, scene.height, scene.background)
            };
            drawing.len() == parts.len()
                && pairs().all(is_alike)
                && pairs().all(|(one, (_, pixels))| one.rgba == *pixels)
        };
        let lock = || self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        // Not under the lock: pixels are compared for a millisecond.
        let recent = lock().clone();
        if let Some(known) = recent.iter().find(|drawing| is_this(drawing)) {
            let mut recent = lock();
            if let Some(place) = recent.iter().position(|drawing| Arc::ptr_eq(drawing, known))
                && let Some(drawing) = recent.remove(place)
            {
                recent.push_front(drawing);
            }
            return Some(Arc::clone(known));
        }
        let picture = |(area, pixels): (Area, &[u8])| Picture {
            width: scene.width,
            height: scene.height,
            blank: scene.background,
            area,
            rgba: pixels.to_vec(),
        };
        let drawing: Arc<[Picture]> = parts.into_iter().map(picture).collect();
        let mut recent = lock();
        recent.push_front(Arc::clone(&drawing));
        recent.truncate(KEPT);
        Some(drawing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> &'static Scene {
        &reference::assignment("ggsample06").expect("an assignment").scene
    }

    const AREAS: [Area; 2] = [Area { x: 1, y: 2, width: 2, height: 1 }, Area { x: 0, y: 0, width: 0, height: 0 }];

    #[test]
    fn what_is_drawn_alike_is_held_once() {
        let drawings = Drawings::default();
        let drawn = |body: [u8; 8]| drawings.of(scene(), &AREAS, &body).expect("frames");
        let first = drawn([1; 8]);
        assert_eq!((first.len(), first[0].rgba.as_slice()), (2, [1; 8].as_slice()));
        assert_eq!(first[1].pixels().into_owned(), vec![scene().background; first[1].pixels().len()]);
        let other = drawn([1, 1, 1, 1, 1, 1, 2, 1]);
        assert!(!Arc::ptr_eq(&first, &other));
        assert!(Arc::ptr_eq(&first, &drawn([1; 8])));
        // The same pixels elsewhere.
        let moved = [Area { x: 2, ..AREAS[0] }, AREAS[1]];
        assert!(!Arc::ptr_eq(&first, &drawings.of(scene(), &moved, &[1; 8]).expect("frames")));
        // What comes again stays, and what does not goes.
        for value in 3..10 {
            drawn([value; 8]);
            assert!(Arc::ptr_eq(&first, &drawn([1; 8])));
        }
        assert!(!Arc::ptr_eq(&other, &drawn([1, 1, 1, 1, 1, 1, 2, 1])));
        assert_eq!(drawings.recent.lock().expect("a list").len(), KEPT);
    }

    #[test]
    fn pixels_that_do_not_fit_are_no_frames() {
        let drawings = Drawings::default();
        assert!(drawings.of(scene(), &AREAS, &[1; 7]).is_none());
        assert!(drawings.of(scene(), &AREAS, &[1; 9]).is_none());
        let outside = [Area { x: u32::MAX, ..AREAS[0] }];
        assert!(drawings.of(scene(), &outside, &[1; 8]).is_none());
        assert_eq!(drawings.of(scene(), &[], &[]).expect("nothing").len(), 0);
    }
}
