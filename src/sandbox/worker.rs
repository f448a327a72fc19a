//! The child's side: a warm device, one submission after the other.

use super::protocol::{Hello, Reply, Request, Tile, receive, send};
use crate::fault::Fault;
use crate::grade::{Graded, Grader};
use crate::render::{AdapterKind, Frames};
use std::io::{self, Read, Write};

/// Stack of the thread that grades: translators recurse over the student's nesting.
const STACK_BYTES: usize = 256 << 20;

/// Serves the parent on standard input and output until it closes them.
pub fn run(assignment: &'static reference::Assignment, adapter: AdapterKind) -> io::Result<()> {
    let thread = std::thread::Builder::new().name("grader".into()).stack_size(STACK_BYTES);
    let served = thread.spawn(move || serve(assignment, adapter, &mut io::stdin().lock(), &mut io::stdout().lock()))?;
    served.join().map_err(|_| io::Error::other("the grader panicked"))?
}

fn serve(
    assignment: &'static reference::Assignment,
    adapter: AdapterKind,
    input: &mut impl Read,
    output: &mut impl Write,
) -> io::Result<()> {
    let mut grader = match Grader::new(assignment, adapter) {
        Ok(grader) => grader,
        Err(fault) => return send(output, &Hello::Failed(fault), &[]),
    };
    send(output, &Hello::Ready(grader.environment().clone()), &[])?;
    loop {
        let (request, bytes) = match receive::<Request>(input) {
            Ok(message) => message,
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(error),
        };
        let (reply, body) = answer(grader.grade(&request.name, &bytes, request.order), request.wants_frames);
        send(output, &reply, &body)?;
    }
}

fn answer(outcome: Result<Graded, Fault>, wants_frames: bool) -> (Reply, Vec<u8>) {
    match outcome {
        Err(fault) => (Reply::Failed(fault), Vec::new()),
        Ok(Graded { report, frames }) => {
            let (tiles, body) = frames.filter(|_| wants_frames).map(|frames| cut(&frames)).unwrap_or_default();
            (Reply::Graded { report: Box::new(report), frames: tiles }, body)
        }
    }
}

/// The frames without their margins of background.
fn cut(frames: &Frames) -> (Vec<Tile>, Vec<u8>) {
    let mut body = Vec::new();
    let tiles = (0..frames.count)
        .map(|index| {
            let tile = painted(frames, index);
            for y in tile.y..tile.y + tile.height {
                let row = frames.row(index, y);
                body.extend_from_slice(&row[tile.x as usize * 4..][..tile.width as usize * 4]);
            }
            tile
        })
        .collect();
    (tiles, body)
}

/// The least rectangle that holds every pixel that was painted.
fn painted(frames: &Frames, index: u32) -> Tile {
    let blank = frames.background.as_slice();
    let (mut left, mut right, mut top, mut bottom) = (frames.width, 0, frames.height, 0);
    for y in 0..frames.height {
        let row = frames.row(index, y);
        let unlike = |pixel: &[u8]| pixel != blank;
        let Some(first) = row.chunks_exact(4).position(unlike) else { continue };
        let last = row.chunks_exact(4).rposition(unlike).unwrap_or(first);
        left = left.min(first as u32);
        right = right.max(last as u32 + 1);
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
