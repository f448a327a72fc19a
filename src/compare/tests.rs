//! The comparison against one that looks at every pixel on its own, and cases counted by hand.

use super::*;
use crate::report::Area;
use crate::report::Picture;

const BACKGROUND: [u8; 4] = [255, 255, 255, 0];
const WIDTH: u32 = 50;
const HEIGHT: u32 = 6;
const WHOLE: Area = Area { x: 0, y: 0, width: WIDTH, height: HEIGHT };

/// Columns 10 to 39 are inside in rows 1 to 4, with a pixel of silhouette on either side. 120 pixels inside.
fn expected() -> Frame {
    let mut frame = Frame::cleared(WIDTH, HEIGHT, BACKGROUND);
    for y in 1..5 {
        for x in 9..41 {
            let place = y * WIDTH as usize + x;
            frame.coverage[place] = if x == 9 || x == 40 { Coverage::Silhouette } else { Coverage::Interior };
            frame.pixels[place] = [(x * 5) as u8, (y * 40) as u8, 100, 255];
        }
    }
    frame
}

fn picture(frame: &Frame) -> Picture {
    Picture::whole(frame.width, frame.height, frame.pixels.concat())
}

fn set(picture: &mut Picture, x: usize, y: usize, pixel: [u8; 4]) {
    let start = (y * WIDTH as usize + x) * 4;
    picture.rgba[start..start + 4].copy_from_slice(&pixel);
}

fn compared(picture: Picture, area: Area) -> FrameResult {
    frame(&ExpectedFrame::new(0.25, &expected(), BACKGROUND), &Frames::of(BACKGROUND, &[(picture, area)]), 0)
}

#[test]
fn the_expected_picture_agrees() {
    let result = compared(picture(&expected()), WHOLE);
    assert!(result.agrees() && result.shape_agrees());
    assert_eq!((result.t, result.max_difference, result.mean_difference), (0.25, 0.0, 0.0));
}

#[test]
fn only_the_area_is_looked_at_and_the_rest_is_background() {
    let tight = Area { x: 9, y: 1, width: 32, height: 4 };
    assert_eq!(compared(picture(&expected()), tight), compared(picture(&expected()), WHOLE));
    // Rows 1 and 2 only, columns 10 to 19: what is left of the 120 is missing.
    let cut = compared(picture(&expected()), Area { x: 10, y: 1, width: 10, height: 2 });
    assert_eq!((cut.coverage_mismatches, cut.mismatched_pixels), (100, 0));
}

#[test]
fn nothing_drawn_misses_every_pixel_inside() {
    let result = compared(picture(&Frame::cleared(WIDTH, HEIGHT, BACKGROUND)), WHOLE);
    assert_eq!((result.coverage_mismatches, result.mean_difference), (120, 0.0));
    assert!(!result.shape_agrees());
}

#[test]
fn a_difference_is_counted_where_it_exceeds_the_tolerance() {
    let mut picture = picture(&expected());
    // Expected are (50, 40, 100) at column 10 and (195, 40, 100) at column 39 of row 1.
    set(&mut picture, 10, 1, [52, 40, 100, 255]);
    set(&mut picture, 39, 1, [195, 40, 97, 255]);
    let result = compared(picture, WHOLE);
    assert_eq!((result.mismatched_pixels, result.max_difference), (1, 3.0));
    // 2 + 3 over 120 pixels of three channels.
    assert_eq!(result.mean_difference, 5.0 / 360.0);
}

#[test]
fn alpha_and_the_silhouette_do_not_count() {
    let mut picture = picture(&expected());
    set(&mut picture, 20, 2, [100, 80, 100, 3]);
    set(&mut picture, 9, 2, [0, 0, 0, 0]);
    set(&mut picture, 40, 3, BACKGROUND);
    assert!(compared(picture, WHOLE).agrees());
}

#[test]
fn paint_outside_is_of_another_shape() {
    let mut picture = picture(&expected());
    for (x, y) in [(0, 0), (8, 2), (41, 2), (49, 5)] {
        set(&mut picture, x, y, [1, 2, 3, 4]);
    }
    // The same colour with another alpha is not seen.
    set(&mut picture, 3, 3, [255, 255, 255, 9]);
    let result = compared(picture, WHOLE);
    assert_eq!((result.coverage_mismatches, result.mismatched_pixels), (4, 0));
}

#[test]
fn pixels_compared_together_give_what_they_give_one_by_one() {
    // A generator by Lehmer: every pixel differs by up to 8 in each channel, some are missing.
    let mut state = 12345_u64;
    let mut random = |below: u64| {
        state = state * 48271 % 2_147_483_647;
        state % below
    };
    let mut found = picture(&expected());
    for pixel in found.rgba.chunks_exact_mut(4) {
        pixel.iter_mut().for_each(|channel| *channel = channel.saturating_add(random(9) as u8));
        if random(12) == 0 {
            pixel.copy_from_slice(&BACKGROUND);
        }
    }
    let (mut missing, mut far, mut sum, mut covered, mut largest, mut outside) = (0, 0, 0_u64, 0, 0, 0);
    let right = expected();
    for (place, pixel) in found.rgba.chunks_exact(4).enumerate() {
        match right.coverage[place] {
            Coverage::Outside => outside += u32::from(pixel[..3] != BACKGROUND[..3]),
            Coverage::Silhouette => {}
            Coverage::Interior if *pixel == BACKGROUND => missing += 1,
            Coverage::Interior => {
                let difference = [0, 1, 2].map(|c| u64::from(right.pixels[place][c].abs_diff(pixel[c])));
                let worst = difference.into_iter().max().unwrap();
                largest = largest.max(worst);
                far += u32::from(worst > u64::from(PIXEL_TOLERANCE));
                sum += difference.iter().sum::<u64>();
                covered += 3;
            }
        }
    }
    assert!(missing > 0 && far > 0 && largest == 8);
    let result = compared(found, WHOLE);
    assert_eq!((result.coverage_mismatches, result.mismatched_pixels), (missing + outside, far));
    assert_eq!((result.max_difference, result.mean_difference), (largest as f64, sum as f64 / f64::from(covered)));
}

#[test]
#[should_panic(expected = "frame sizes")]
fn pictures_of_unlike_sizes_are_not_compared() {
    let small = Picture::whole(1, 1, vec![0; 4]);
    compared(small, Area { x: 0, y: 0, width: 1, height: 1 });
}

#[test]
fn the_innermost_wrong_pixel_lies_amid_the_largest_patch() {
    let mut wrong = vec![false; 12 * 8];
    assert_eq!(innermost(&wrong, 12), None);
    // One pixel alone, and a patch of 5 × 3 whose middle is (7, 5).
    wrong[12 + 1] = true;
    for (x, y) in (5..10).flat_map(|x| (4..7).map(move |y| (x, y))) {
        wrong[y * 12 + x] = true;
    }
    let found = innermost(&wrong, 12).unwrap();
    assert!((6..=8).contains(&found[0]) && found[1] == 5, "{found:?}");
    // What is beyond the frame is not wrong: no corner is amid anything.
    assert!(innermost(&[true; 25], 5).is_some_and(|found| found == [2, 2]));
}

#[test]
fn wrong_pixels_are_those_that_are_counted() {
    let mut drawn = picture(&expected());
    // Expected are (100, 80, 100) and (105, 80, 100); the silhouette and what is outside are not judged.
    set(&mut drawn, 20, 2, [100, 80, 103, 255]);
    set(&mut drawn, 21, 2, [107, 80, 100, 255]);
    set(&mut drawn, 9, 2, [0, 0, 0, 255]);
    let right = ExpectedFrame::new(0.25, &expected(), BACKGROUND);
    let wrong = wrong_pixels(&right, &Frames::of(BACKGROUND, &[(drawn, WHOLE)]), 0);
    let found: Vec<usize> = (0..wrong.len()).filter(|place| wrong[*place]).collect();
    assert_eq!(found, [2 * WIDTH as usize + 20]);
}
