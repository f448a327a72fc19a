//! What parent and worker say to each other: a JSON head and raw bytes, both with their length in front.

use crate::fault::Fault;
use crate::grade::Order;
use crate::report::{Environment, Report};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::io::{self, Read, Write};

/// Longest head and longest body that either side takes.
const MAX_HEAD_BYTES: u32 = 8 << 20;
const MAX_BODY_BYTES: u32 = 256 << 20;

/// Parent → worker: grade this; the body is the file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Request {
    pub name: String,
    pub order: Order,
    pub wants_frames: bool,
}

/// Worker → parent, first message: ready, or why not.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Hello {
    Ready(Environment),
    Failed(Fault),
}

/// Worker → parent: the answer; the body is the frames' pixels.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Reply {
    Graded { report: Box<Report>, frames: Vec<Tile> },
    Failed(Fault),
}

/// One frame, cut to the rectangle that is not background.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Tile {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Tile {
    pub fn bytes(&self) -> usize {
        self.width as usize * self.height as usize * 4
    }
}

/// Writes one message.
pub(super) fn send(to: &mut impl Write, head: &impl Serialize, body: &[u8]) -> io::Result<()> {
    let head = serde_json::to_vec(head)?;
    let length = |bytes: &[u8]| u32::try_from(bytes.len()).map_err(|_| io::Error::other("message too long"));
    to.write_all(&length(&head)?.to_le_bytes())?;
    to.write_all(&length(body)?.to_le_bytes())?;
    to.write_all(&head)?;
    to.write_all(body)?;
    to.flush()
}

/// Reads one message; an error of kind `UnexpectedEof` where the other side is gone.
pub(super) fn receive<T: DeserializeOwned>(from: &mut impl Read) -> io::Result<(T, Vec<u8>)> {
    let head = length(from, MAX_HEAD_BYTES)?;
    let body = length(from, MAX_BODY_BYTES)?;
    let head = exactly(from, head)?;
    let body = exactly(from, body)?;
    Ok((serde_json::from_slice(&head)?, body))
}

fn length(from: &mut impl Read, limit: u32) -> io::Result<u32> {
    let mut bytes = [0; 4];
    from.read_exact(&mut bytes)?;
    let length = u32::from_le_bytes(bytes);
    if length > limit {
        return Err(io::Error::new(io::ErrorKind::InvalidData, format!("a message of {length} bytes")));
    }
    Ok(length)
}

fn exactly(from: &mut impl Read, length: u32) -> io::Result<Vec<u8>> {
    // Grows as bytes come, so that a length alone costs no memory.
    let mut bytes = Vec::new();
    from.take(u64::from(length)).read_to_end(&mut bytes)?;
    if bytes.len() == length as usize { Ok(bytes) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
}
