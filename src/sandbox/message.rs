//! A message between parent and worker as bytes: a JSON head and a body, both with their length in front.

use serde::{Serialize, de::DeserializeOwned};
use std::io::{self, Read, Write};
use std::ops::Deref;

/// Bytes of the two lengths in front of a message.
const LENGTHS: usize = 8;
/// Bytes of a large message that are written at once.
const PIECE: usize = 256 << 10;

/// The longest message that a side takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Longest {
    pub head: usize,
    pub body: usize,
}

/// What follows the head of a message.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct MessageBody {
    /// The whole message: a body can be large, and is not copied out of it.
    message: Vec<u8>,
    start: usize,
}

impl Deref for MessageBody {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        self.message.get(self.start..).unwrap_or_default()
    }
}

/// A message as it is sent.
pub(super) fn encode(head: &impl Serialize, body: &[u8]) -> io::Result<Vec<u8>> {
    let mut message = beginning(head, body.len())?;
    message.extend(body);
    Ok(message)
}

/// A message up to its body of so many bytes.
fn beginning(head: &impl Serialize, body: usize) -> io::Result<Vec<u8>> {
    let head = serde_json::to_vec(head)?;
    let length = |bytes: usize| u32::try_from(bytes).map_err(|_| io::Error::other("message too long"));
    let mut message = Vec::with_capacity(LENGTHS + head.len());
    message.extend(length(head.len())?.to_le_bytes());
    message.extend(length(body)?.to_le_bytes());
    message.extend(&head);
    Ok(message)
}

/// How many bytes have to be there before more can be said of a message that starts so: all that it has, once its lengths
/// are known.
pub(super) fn needed(start: &[u8], longest: Longest) -> io::Result<usize> {
    Ok(lengths(start, longest)?.map_or(LENGTHS, |(head, body)| LENGTHS + head + body))
}

/// How many bytes of head and body the message has that starts so; none before its lengths are there.
fn lengths(start: &[u8], longest: Longest) -> io::Result<Option<(usize, usize)>> {
    let Some((lengths, _)) = start.split_at_checked(LENGTHS) else { return Ok(None) };
    let length = |at: usize| lengths[at..at + 4].iter().rev().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
    let (head, body) = (length(0), length(4));
    if head > longest.head || body > longest.body {
        let text = format!("a message of {head} and {body} bytes");
        return Err(io::Error::new(io::ErrorKind::InvalidData, text));
    }
    Ok(Some((head, body)))
}

/// The message that `bytes` begin with, once it is there in full, and takes it out of there.
pub(super) fn decode<T: DeserializeOwned>(
    bytes: &mut Vec<u8>,
    longest: Longest,
) -> io::Result<Option<(T, MessageBody)>> {
    let Some((head, body)) = lengths(bytes, longest)? else { return Ok(None) };
    let start = LENGTHS + head;
    if bytes.len() < start + body {
        return Ok(None);
    }
    let rest = bytes.split_off(start + body);
    let message = std::mem::replace(bytes, rest);
    let head = serde_json::from_slice(&message[LENGTHS..start])?;
    Ok(Some((head, MessageBody { message, start })))
}

/// Writes one message, whose body of so many bytes `body` writes.
pub(super) fn send<W: Write>(
    to: &mut W,
    head: &impl Serialize,
    length: usize,
    body: impl FnOnce(&mut io::BufWriter<&mut W>) -> io::Result<()>,
) -> io::Result<()> {
    let mut to = io::BufWriter::with_capacity(PIECE, to);
    to.write_all(&beginning(head, length)?)?;
    body(&mut to)?;
    to.flush()
}

/// Reads one message; an error of kind `UnexpectedEof` where the other side is gone.
pub(super) fn receive<T: DeserializeOwned>(from: &mut impl Read, longest: Longest) -> io::Result<(T, MessageBody)> {
    let mut bytes = vec![0; LENGTHS];
    from.read_exact(&mut bytes)?;
    // Grows as bytes come, so that a length alone costs no memory.
    from.take((needed(&bytes, longest)? - LENGTHS) as u64).read_to_end(&mut bytes)?;
    decode(&mut bytes, longest)?.ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONGEST: Longest = Longest { head: 100, body: 10 };

    #[test]
    fn a_message_comes_back_as_it_was_sent() {
        let message = encode(&"head", b"body").unwrap();
        let mut sent = Vec::new();
        send(&mut sent, &"head", 4, |to| to.write_all(b"bo").and_then(|()| to.write_all(b"dy"))).unwrap();
        assert_eq!(sent, message);
        let (head, body) = receive::<String>(&mut message.as_slice(), LONGEST).unwrap();
        assert_eq!((head.as_str(), &*body), ("head", b"body".as_slice()));
        let (head, body) = decode::<String>(&mut sent, LONGEST).unwrap().unwrap();
        assert_eq!((head.as_str(), &*body, sent), ("head", b"body".as_slice(), Vec::new()));
    }

    #[test]
    fn every_beginning_of_a_message_is_waited_on() {
        let message = encode(&"head", b"body").unwrap();
        for cut in 0..message.len() {
            assert_eq!(decode::<String>(&mut message[..cut].to_vec(), LONGEST).unwrap(), None, "{cut} bytes");
            assert!(needed(&message[..cut], LONGEST).unwrap() > cut, "{cut} bytes");
            let error = receive::<String>(&mut &message[..cut], LONGEST).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::UnexpectedEof, "{cut} bytes");
        }
    }

    #[test]
    fn what_is_too_long_is_refused_by_its_length_alone() {
        for lengths in [[101_u32, 0], [0, 11], [u32::MAX, u32::MAX]] {
            let mut start = lengths.map(u32::to_le_bytes).concat();
            assert_eq!(decode::<String>(&mut start, LONGEST).unwrap_err().kind(), io::ErrorKind::InvalidData);
        }
    }

    #[test]
    fn a_message_leaves_what_follows_it() {
        let mut bytes = [encode(&"first", b"body").unwrap(), encode(&"second", b"").unwrap(), vec![0]].concat();
        let (first, body) = decode::<String>(&mut bytes, LONGEST).unwrap().unwrap();
        assert_eq!((first.as_str(), &*body), ("first", b"body".as_slice()));
        let (second, body) = decode::<String>(&mut bytes, LONGEST).unwrap().unwrap();
        assert_eq!((second.as_str(), &*body, bytes), ("second", b"".as_slice(), vec![0]));
    }
}
