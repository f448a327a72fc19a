//! What parent and worker say to each other: a JSON head and raw bytes, both with their length in front.

use super::protection::Protection;
use crate::fault::Fault;
use crate::grade::Order;
use crate::report::{Environment, Report};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::io::{self, Read, Write};

/// Bytes of the two lengths in front of a message.
const LENGTHS: usize = 8;

/// Parent → worker: grade this; the body is the file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Request {
    /// Comes back in the reply, so that an answer is never taken for another file's.
    pub id: u64,
    pub name: String,
    pub order: Order,
    pub wants_frames: bool,
}

/// Worker → parent, first message: ready, or why not.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Hello {
    Ready { environment: Environment, protection: Protection },
    Failed(Fault),
}

/// Worker → parent: the answer; the body is the frames' pixels.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Reply {
    /// The request's.
    pub id: u64,
    /// The worker has grown so much that another should take its place.
    pub spent: bool,
    pub outcome: Outcome,
}

/// How a grading ended inside the worker.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Outcome {
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
    /// Bytes of its pixels, where it lies within a frame of this size.
    pub fn bytes_within(&self, width: u32, height: u32) -> Option<usize> {
        let inside = self.x.checked_add(self.width)? <= width && self.y.checked_add(self.height)? <= height;
        inside.then(|| self.width as usize * self.height as usize * 4)
    }
}

/// The longest message that a side takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Longest {
    pub head: usize,
    pub body: usize,
}

/// What a worker takes: the parent is trusted, and a file over the source stage's limit is refused there.
pub(super) const REQUEST: Longest = Longest { head: 1 << 20, body: 256 << 20 };

/// A message as it is sent.
pub(super) fn encode(head: &impl Serialize, body: &[u8]) -> io::Result<Vec<u8>> {
    let head = serde_json::to_vec(head)?;
    let length = |bytes: &[u8]| u32::try_from(bytes.len()).map_err(|_| io::Error::other("message too long"));
    let mut message = Vec::with_capacity(LENGTHS + head.len() + body.len());
    message.extend(length(&head)?.to_le_bytes());
    message.extend(length(body)?.to_le_bytes());
    message.extend(&head);
    message.extend(body);
    Ok(message)
}

/// How many bytes of head and body the message has that starts so; none before its lengths are there.
pub(super) fn lengths(start: &[u8], longest: Longest) -> io::Result<Option<(usize, usize)>> {
    let Some((lengths, _)) = start.split_at_checked(LENGTHS) else { return Ok(None) };
    let length = |at: usize| lengths[at..at + 4].iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
    let (head, body) = (length(0), length(4));
    if head > longest.head || body > longest.body {
        let text = format!("a message of {head} and {body} bytes");
        return Err(io::Error::new(io::ErrorKind::InvalidData, text));
    }
    Ok(Some((head, body)))
}

/// The message in `bytes`, once it is there in full; bytes beyond it are an error, for nobody asked for them.
pub(super) fn decode<T: DeserializeOwned>(bytes: &[u8], longest: Longest) -> io::Result<Option<(T, Vec<u8>)>> {
    let Some((head, body)) = lengths(bytes, longest)? else { return Ok(None) };
    let message = &bytes[LENGTHS..];
    match message.len().cmp(&(head + body)) {
        std::cmp::Ordering::Less => Ok(None),
        std::cmp::Ordering::Equal => {
            let (head, body) = message.split_at(head);
            Ok(Some((serde_json::from_slice(head)?, body.to_vec())))
        }
        std::cmp::Ordering::Greater => Err(io::Error::new(io::ErrorKind::InvalidData, "more than one answer")),
    }
}

/// Writes one message.
pub(super) fn send(to: &mut impl Write, head: &impl Serialize, body: &[u8]) -> io::Result<()> {
    to.write_all(&encode(head, body)?)?;
    to.flush()
}

/// Reads one message; an error of kind `UnexpectedEof` where the other side is gone.
pub(super) fn receive<T: DeserializeOwned>(from: &mut impl Read, longest: Longest) -> io::Result<(T, Vec<u8>)> {
    let mut bytes = vec![0; LENGTHS];
    from.read_exact(&mut bytes)?;
    let Some((head, body)) = lengths(&bytes, longest)? else { return Err(io::ErrorKind::UnexpectedEof.into()) };
    // Grows as bytes come, so that a length alone costs no memory.
    from.take((head + body) as u64).read_to_end(&mut bytes)?;
    decode(&bytes, longest)?.ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONGEST: Longest = Longest { head: 100, body: 10 };

    #[test]
    fn a_message_comes_back_as_it_was_sent() {
        let message = encode(&"head", b"body").unwrap();
        assert_eq!(decode::<String>(&message, LONGEST).unwrap(), Some(("head".into(), b"body".to_vec())));
        assert_eq!(receive::<String>(&mut message.as_slice(), LONGEST).unwrap(), ("head".into(), b"body".to_vec()));
    }

    #[test]
    fn every_beginning_of_a_message_is_waited_on() {
        let message = encode(&"head", b"body").unwrap();
        for cut in 0..message.len() {
            assert_eq!(decode::<String>(&message[..cut], LONGEST).unwrap(), None, "{cut} bytes");
            let error = receive::<String>(&mut &message[..cut], LONGEST).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::UnexpectedEof, "{cut} bytes");
        }
    }

    #[test]
    fn what_is_too_long_is_refused_by_its_length_alone() {
        for lengths in [[101_u32, 0], [0, 11], [u32::MAX, u32::MAX]] {
            let start = lengths.map(u32::to_le_bytes).concat();
            assert_eq!(decode::<String>(&start, LONGEST).unwrap_err().kind(), io::ErrorKind::InvalidData);
        }
    }

    #[test]
    fn bytes_after_the_message_are_refused() {
        let mut message = encode(&"head", b"body").unwrap();
        message.push(0);
        assert!(decode::<String>(&message, LONGEST).is_err());
    }

    #[test]
    fn a_tile_outside_its_frame_has_no_pixels() {
        let tile = |x, y, width, height| Tile { x, y, width, height }.bytes_within(4, 3);
        assert_eq!(tile(1, 1, 3, 2), Some(3 * 2 * 4));
        assert_eq!(tile(2, 1, 3, 2), None);
        assert_eq!(tile(1, 2, 3, 2), None);
        assert_eq!(tile(u32::MAX, 0, 2, 1), None);
    }
}
