//! Three corners around the middle of each probe's pixel.

use super::place;
use crate::render::fragments::{FragmentStage, is_flat};
use crate::render::scene::{DrawCall, WINDOW};
use crate::translate::StageVariable;
use naga::ScalarKind;

/// Inputs that are no student's.
const PLACE: &str = "gl_FragCoord";
const FACING: &str = "gl_FrontFacing";

/// The records of all corners in a target of this `size`, and what is added to the `gl_FragCoord` of each.
pub(super) fn corners(stage: &FragmentStage, batches: &[DrawCall], size: wgpu::Extent3d) -> [Vec<u8>; 2] {
    let (mut records, mut shifts): (Vec<u32>, Vec<f32>) = (Vec::new(), Vec::new());
    let mut number = 0;
    for batch in batches {
        let column = |name: &str| batch.attributes.iter().find(|(own, _)| own == name).map(|(_, column)| column);
        let beside = |pixel: usize, input: &StageVariable| {
            let is_mixed = stage.has_derivatives && !is_flat(input);
            batch.beside[pixel].iter().find(|(own, _)| is_mixed && *own == input.name).map(|(_, column)| column)
        };
        let inputs: Vec<_> = stage
            .inputs
            .iter()
            .map(|input| (input, column(&input.name), beside(0, input).zip(beside(1, input))))
            .collect();
        let [given_place, facing, window] = [PLACE, FACING, WINDOW].map(column);
        for vertex in 0..batch.vertices() as usize {
            let middle = place(number).map(|at| f64::from(at) + 0.5);
            number += 1;
            let given = |axis: usize| given_place.and_then(|place| place.iter().nth(vertex)?.get(axis).copied());
            let shift: [f64; 2] = std::array::from_fn(|axis| given(axis).map_or(0.0, |at| at - middle[axis]));
            let window_rows = window.and_then(|window| window.iter().nth(vertex)?.get(1).copied()).unwrap_or(0.0);
            let shift = stage.shift(shift, window_rows);
            // Window depth d is (z/w + 1)/2, and `gl_FragCoord.w` is 1/w.
            let w = given(3).filter(|inverse| *inverse > 0.0).map_or(1.0, f64::recip);
            let z = given(2).map_or(0.0, |depth| 2.0 * depth - 1.0);
            let is_back = facing.and_then(|facing| facing.iter().nth(vertex)?.first().copied()) == Some(0.0);
            let mut around = [[-0.4, -0.4], [0.4, -0.4], [0.0, 0.4]];
            if is_back {
                around.swap(0, 1);
            }
            for [dx, dy] in around {
                let x = (middle[0] + dx) / f64::from(size.width) * 2.0 - 1.0;
                let y = (middle[1] + dy) / f64::from(size.height) * 2.0 - 1.0;
                records.extend([x * w, y * w, z * w, w].map(|number| (number as f32).to_bits()));
                for (input, column, beside) in &inputs {
                    let numbers = column.and_then(|column| column.iter().nth(vertex)).unwrap_or_default();
                    let beside =
                        beside.and_then(|(right, above)| right.iter().nth(vertex).zip(above.iter().nth(vertex)));
                    let number = |axis: usize| {
                        let here = numbers.get(axis).copied().unwrap_or(if axis == 3 { 1.0 } else { 0.0 });
                        let beside = beside.and_then(|(right, above)| Some([*right.get(axis)?, *above.get(axis)?]));
                        beside.map_or(here, |beside| reference::probes::at_pixel(here, beside, [dx, dy]))
                    };
                    records.extend([0, 1, 2, 3].map(number).map(|number| match input.kind {
                        Some(ScalarKind::Sint) => (number as i32).cast_unsigned(),
                        Some(ScalarKind::Uint) => number as u32,
                        _ => (number as f32).to_bits(),
                    }));
                }
                shifts.extend(shift);
            }
        }
    }
    if records.is_empty() {
        (records, shifts) = (vec![0; 4], vec![0.0; 2]);
    }
    [bytemuck::cast_slice(&records).to_vec(), bytemuck::cast_slice(&shifts).to_vec()]
}
