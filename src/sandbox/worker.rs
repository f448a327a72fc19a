//! The child's side: a confined process with a warm device, one submission after the other.

use super::confine::{self, Confined, Meter, lower};
use super::preflight::{self, Attempt};
use super::protection::{Layer, Protection};
use super::protocol::{Hello, Outcome, REQUEST, Reply, Request, Tile, receive, send};
use super::{Limits, syscalls};
use crate::fault::Fault;
use crate::grade::{self, Graded, Grader, Order};
use crate::render::{AdapterKind, Frames};
use nix::sys::resource::Resource;
use reference::Assignment;
use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::Arc;

/// Stack of the thread that grades: translators recurse over the student's nesting.
const STACK_BYTES: usize = 256 << 20;

/// What a worker is started for.
#[derive(Clone, Debug)]
pub struct Job {
    /// The homework.
    pub assignment: Arc<Assignment>,
    /// What renders.
    pub adapter: AdapterKind,
    /// What one submission may take.
    pub limits: Limits,
    /// Whether to grade the handed-out file first, so that nobody's grading is slower than the next one's.
    pub warm_up: bool,
}

/// Serves the parent on standard input and output until it closes them.
pub fn run(job: Job) -> io::Result<()> {
    let confined = confine::enter(job.limits, job.adapter)?;
    on_large_stack(move || serve(&job, confined))
}

/// Enters the sandbox as [`run`] does, tries one forbidden thing there, and gives what came of it.
pub fn attempt(job: Job, attempt: Attempt) -> io::Result<io::Result<()>> {
    let confined = confine::enter(job.limits, job.adapter)?;
    on_large_stack(move || {
        let Confined { layers, meter, .. } = confined;
        let _ready = prepare(&job, layers).map_err(|fault| io::Error::other(fault.message.en))?;
        meter.next(job.adapter)?;
        Ok(attempt.make())
    })
}

fn on_large_stack<T: Send + 'static>(work: impl FnOnce() -> io::Result<T> + Send + 'static) -> io::Result<T> {
    let thread = std::thread::Builder::new().name("grader".into()).stack_size(STACK_BYTES);
    thread.spawn(work)?.join().map_err(|_| io::Error::other("the grader panicked"))?
}

fn serve(job: &Job, confined: Confined) -> io::Result<()> {
    let Confined { mut output, layers, meter } = confined;
    let (mut grader, protection) = match prepare(job, layers) {
        Ok(ready) => ready,
        Err(fault) => return send(&mut output, &Hello::Failed(fault), 0, |_| Ok(())),
    };
    let hello = Hello::Ready { environment: grader.environment().clone(), protection };
    let size = meter.size()?;
    send(&mut output, &hello, 0, |_| Ok(()))?;
    let mut input = io::stdin().lock();
    while answer(&mut input, &mut output, &mut grader, job, &meter, size)? {}
    Ok(())
}

/// Makes the device warm, and closes the sandbox around it.
fn prepare(job: &Job, mut layers: Vec<super::LayerState>) -> Result<(Grader, Protection), Fault> {
    let mut grader = Grader::new(Arc::clone(&job.assignment), job.adapter)?;
    if job.warm_up {
        grader.grade(&grade::handed_out(&job.assignment), Order::default())?;
    }
    let filtered = syscalls::restrict(job.adapter);
    if filtered.is_err() {
        // Without filters this at least keeps new processes away, and new threads with them.
        let _ = lower(Resource::RLIMIT_NPROC, 0);
    }
    let open = preflight::open();
    let filtered = filtered.and_then(|detail| syscalls::make_deadly().map(|()| detail));
    layers.push(confine::state(Layer::SystemCalls, filtered));
    Ok((grader, Protection { layers, open }))
}

/// Grades one submission; false where the parent has closed the pipe. `start` is the size of the process before the first.
fn answer(
    input: &mut impl Read,
    output: &mut File,
    grader: &mut Grader,
    job: &Job,
    meter: &Meter,
    start: u64,
) -> io::Result<bool> {
    let (request, bytes) = match receive::<Request>(input, REQUEST) {
        Ok(message) => message,
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(false),
        Err(error) => return Err(error),
    };
    meter.next(job.adapter)?;
    let graded = grader.grade(&request.hand_in(&bytes)?, request.order);
    let spent = meter.size()? > start + job.limits.memory;
    let reply = |outcome| Reply { id: request.id, spent, outcome };
    let Graded { report, frames } = match graded {
        Ok(graded) => graded,
        Err(fault) => return send(output, &reply(Outcome::Failed(fault)), 0, |_| Ok(())).map(|()| true),
    };
    let frames = frames.filter(|_| request.wants_frames).unwrap_or_default();
    let tiles = tiles(&frames);
    let length = tiles.iter().map(|tile| tile.width as usize * tile.height as usize * 4).sum();
    let graded = Outcome::Graded { report: Box::new(report), frames: tiles.clone() };
    // Row by row from where the device left them: a copy of all would be as large as everything else.
    send(output, &reply(graded), length, |to| {
        for (index, tile) in (0..).zip(&tiles) {
            let left = tile.x.saturating_sub(frames.area(index).x) as usize * 4;
            for y in tile.y..tile.y + tile.height {
                to.write_all(&frames.row(index, y)[left..left + tile.width as usize * 4])?;
            }
        }
        Ok(())
    })?;
    Ok(true)
}

/// The frames' parts without their margins of background.
fn tiles(frames: &Frames) -> Vec<Tile> {
    (0..frames.count).map(|index| painted(frames, index)).collect()
}

/// The least rectangle that holds every pixel that was painted.
fn painted(frames: &Frames, index: u32) -> Tile {
    let blank = frames.background.as_slice();
    let area = frames.area(index);
    let (mut left, mut right, mut top, mut bottom) = (frames.width, 0, frames.height, 0);
    for y in area.y..area.y + area.height {
        let row = frames.row(index, y);
        let unlike = |pixel: &[u8]| pixel != blank;
        let Some(first) = row.chunks_exact(4).position(unlike) else { continue };
        let last = row.chunks_exact(4).rposition(unlike).unwrap_or(first);
        left = left.min(area.x + first as u32);
        right = right.max(area.x + last as u32 + 1);
        top = top.min(y);
        bottom = y + 1;
    }
    Tile {
        x: left.min(right),
        y: top.min(bottom),
        width: right.saturating_sub(left),
        height: bottom.saturating_sub(top),
    }
}
