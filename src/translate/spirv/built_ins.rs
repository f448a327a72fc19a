//! What OpenGL declares by itself, and what it says of a program as a whole, as wgpu takes it.

use super::code::{SpirvCode, SpirvInstruction};
use super::op::{self, built_in, decoration, execution_mode};
use reference::interpreter::WindowCoordinates;
use std::collections::HashSet;

/// Takes away what says which outputs transform feedback catches: the program catches none.
pub(super) fn uncaught(code: &mut SpirvCode) {
    use decoration::{OFFSET, XFB_BUFFER, XFB_STRIDE};
    code.heads.retain(|head| {
        !matches!(
            (head.opcode, &head.operands[..]),
            (op::EXECUTION_MODE, [_, execution_mode::XFB, ..])
                | (op::DECORATE, [_, OFFSET | XFB_BUFFER | XFB_STRIDE, ..])
                | (op::MEMBER_DECORATE, [_, _, XFB_BUFFER | XFB_STRIDE, ..])
        )
    });
}

/// How the stage counts places in the window, and takes away what says so and what it promises of its depth: a wrong promise is
/// undefined, and without it the driver looks at the depth itself. Tests before the stage are those behind one that throws nothing away
/// and writes no depth.
pub(super) fn window(code: &mut SpirvCode) -> WindowCoordinates {
    use execution_mode::{DEPTH_GREATER, DEPTH_LESS, DEPTH_UNCHANGED, EARLY_FRAGMENT_TESTS};
    use execution_mode::{ORIGIN_UPPER_LEFT, PIXEL_CENTER_INTEGER};
    let window = WindowCoordinates {
        from_top: code.has_mode(ORIGIN_UPPER_LEFT),
        in_whole_pixels: code.has_mode(PIXEL_CENTER_INTEGER),
    };
    code.drop_modes(&[PIXEL_CENTER_INTEGER, DEPTH_GREATER, DEPTH_LESS, DEPTH_UNCHANGED]);
    let throws_away = code.functions.iter().any(|one| one.opcode == op::KILL);
    if !throws_away && decoration_of(code, built_in::FRAG_DEPTH).is_none() {
        code.drop_modes(&[EARLY_FRAGMENT_TESTS]);
    }
    window
}

/// Makes `gl_VertexID` and `gl_InstanceID`, where they are read, inputs that are fed: what is drawn for probes has its vertices in
/// another order than their mesh, and each instance is a draw by itself.
pub(super) fn numbers_as_inputs(code: &mut SpirvCode) {
    for which in [built_in::VERTEX_ID, built_in::INSTANCE_ID] {
        let Some(at) = decoration_of(code, which) else { continue };
        let id = code.heads[at].operands[0];
        if code.functions.iter().any(|instruction| instruction.operands.contains(&id)) {
            code.heads.remove(at);
        }
    }
}

/// The variable of `gl_SamplePosition`: the one sample of a pixel is in its middle.
pub(super) fn sample_position(code: &SpirvCode) -> Option<u32> {
    decoration_of(code, built_in::SAMPLE_POSITION).map(|at| code.heads[at].operands[0])
}

/// Where a variable is said to be this built-in one.
fn decoration_of(code: &SpirvCode, which: u32) -> Option<usize> {
    let said = [decoration::BUILT_IN, which];
    let is_it = |head: &SpirvInstruction| head.opcode == op::DECORATE && head.operands.get(1..) == Some(&said);
    code.heads.iter().position(is_it)
}

/// The variables of `gl_BaseVertex`, `gl_BaseInstance` and `gl_DrawID`, zero in a plain draw; renames
/// OpenGL's built-ins to those that naga knows.
pub(super) fn draw_parameters(code: &mut SpirvCode) -> Vec<u32> {
    let mut found = Vec::new();
    let is_fragment = code.is_fragment();
    let used: HashSet<u32> = code.functions.iter().flat_map(|one| one.operands.iter().copied()).collect();
    for instruction in code.heads.iter_mut().filter(|i| i.opcode == op::DECORATE) {
        let [id, decoration::BUILT_IN, which] = &mut instruction.operands[..] else { continue };
        match *which {
            built_in::VERTEX_ID => *which = built_in::VERTEX_INDEX,
            built_in::INSTANCE_ID => *which = built_in::INSTANCE_INDEX,
            built_in::BASE_VERTEX..=built_in::DRAW_INDEX => found.push(*id),
            // Of fragments of triangles that are drawn to one layer with one sample a pixel.
            built_in::LAYER | built_in::VIEWPORT_INDEX | built_in::POINT_COORD => found.push(*id),
            built_in::SAMPLE_ID..=built_in::SAMPLE_MASK | built_in::HELPER_INVOCATION => found.push(*id),
            built_in::CLIP_DISTANCE | built_in::CULL_DISTANCE if is_fragment => found.push(*id),
            // What is declared and not written is the surface's own.
            built_in::FRAG_DEPTH if !used.contains(id) => found.push(*id),
            _ => {}
        }
    }
    code.heads.retain(|i| i.opcode != op::EXTENSION);
    // naga knows one origin of window coordinates; a fragment stage that reads none is the same with either.
    for mode in code.heads.iter_mut().filter(|i| i.opcode == op::EXECUTION_MODE) {
        if let [_, mode @ execution_mode::ORIGIN_LOWER_LEFT] = &mut mode.operands[..] {
            *mode = execution_mode::ORIGIN_UPPER_LEFT;
        }
    }
    for entry in code.heads.iter_mut().filter(|i| i.opcode == op::ENTRY_POINT) {
        let name =
            2 + entry.operands[2..].iter().position(|word| word.to_le_bytes()[3] == 0).map_or(0, |last| last + 1);
        let interface = entry.operands.split_off(name.min(entry.operands.len()));
        entry.operands.extend(interface.into_iter().filter(|id| !found.contains(id)));
    }
    found
}
