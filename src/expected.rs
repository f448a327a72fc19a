//! The right pictures of an assignment: computed once for each version of its folder, and kept on disk.
//!
//! Pictures that the interpreter shades pixel by pixel take a second or two, which nobody should wait for twice. So the
//! first worker that reads an assignment computes them, the parent process keeps them, and every later worker is given
//! them. [`frames`] computes, [`Pack`] is what is kept and sent, [`cache`] the folder on disk.

pub mod cache;
mod pack;

pub use pack::{Damaged, Pack, Packer};

use crate::compare::ExpectedFrame;
use crate::fault::Fault;
use crate::language::Text;
use reference::Assignment;
use reference::rasteriser::Frame;
use std::time::{Duration, Instant};

/// How many pictures there are: every pose of the solution, then every pose of each answer that is right as well.
pub fn count(assignment: &Assignment) -> usize {
    assignment.scene.all_poses().len() * (1 + assignment.accepted().count())
}

/// Those pictures, computed one at a time: all of them together are large.
pub fn frames(assignment: &Assignment) -> impl Iterator<Item = Frame> {
    let poses = assignment.scene.all_poses();
    let of_solution = poses.clone().into_iter().map(move |pose| assignment.right_frame(&pose));
    let of_answers = assignment.accepted().flat_map(move |answer| {
        let poses = poses.clone();
        poses.into_iter().map(move |pose| assignment.frame_of(answer, &pose))
    });
    of_solution.chain(of_answers)
}

/// How long it has to take to compute the pictures of an assignment for them to be kept.
///
/// A worker reads ggsample06 in 20 ms of processor time when it computes the 25 pictures of one triangle, in 20 to 30 when it is
/// given them packed (130 kB), and packing them takes another 20: keeping those brings nothing. What is shaded pixel by pixel takes a
/// second or two. The threshold stands an order of magnitude above the one and below the other.
pub const KEEP_ABOVE: Duration = Duration::from_millis(200);

/// The pictures prepared for comparison, in the order of [`frames`]: unpacked where they are given, else computed. They are
/// packed as well where computing them takes longer than `pack_above`, by what the first picture takes.
///
/// # Errors
/// The memory cannot be had.
pub fn prepared(
    assignment: &Assignment,
    given: Option<&Pack>,
    pack_above: Option<Duration>,
) -> Result<(Vec<ExpectedFrame>, Option<Pack>), Fault> {
    let times: Vec<f64> = assignment.scene.all_poses().iter().map(|pose| pose.t).collect();
    let background = assignment.scene.background;
    let prepare = |(frame, t): (&Frame, &f64)| ExpectedFrame::new(*t, frame, background);
    if let Some(pack) = given {
        let unpacked = pack.frames(assignment).zip(times.iter().cycle());
        let unpacked: Result<Vec<_>, Damaged> = unpacked.map(|(frame, t)| Ok(prepare((&frame?, t)))).collect();
        if let Ok(frames) = unpacked {
            return Ok((frames, None));
        }
    }
    let start = Instant::now();
    let mut packer = None;
    let mut prepared = Vec::new();
    for (frame, t) in frames(assignment).zip(times.iter().cycle()) {
        if prepared.is_empty() && pack_above.is_some_and(|above| start.elapsed() * count(assignment) as u32 > above) {
            packer = Some(Packer::default());
        }
        if let Some(packer) = &mut packer {
            packer.add(&frame).map_err(unpacked)?;
        }
        prepared.push(prepare((&frame, t)));
    }
    let pack = packer.map(Packer::finish).transpose().map_err(unpacked)?;
    Ok((prepared, pack))
}

fn unpacked(error: std::io::Error) -> Fault {
    Fault::new(Text::verbatim(format!("the right pictures cannot be packed: {error}")))
}

/// The pictures of the solution alone: those that are kept, else computed.
pub fn of_solution(assignment: &Assignment) -> impl Iterator<Item = Frame> {
    let poses = assignment.scene.all_poses().len();
    let kept = cache::folder().and_then(|folder| cache::read(&folder, assignment));
    let kept = kept.and_then(|pack| pack.frames(assignment).take(poses).collect::<Result<Vec<_>, _>>().ok());
    let computed = kept.is_none().then(|| frames(assignment).take(poses));
    kept.into_iter().flatten().chain(computed.into_iter().flatten())
}
