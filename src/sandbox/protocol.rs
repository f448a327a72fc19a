//! What parent and worker say to each other: a JSON head and raw bytes, both with their length in front.

use super::protection::Protection;
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::report::{Area, Environment, Report};
use reference::Folder;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::io::{self, Read, Write};
use std::ops::Deref;

/// Bytes of the two lengths in front of a message.
const LENGTHS: usize = 8;
/// Bytes of a large message that are written at once.
const PIECE: usize = 256 << 10;

/// Parent → worker.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Demand {
    Load(Load),
    Grade(GradingRequest),
    /// Unpack the archive that is the body, read the folder of a homework in it, and grade that folder's own files.
    Check,
    /// Read the folder whose files are the body, and draw what is right, within what that may take of a service.
    Read(Vec<FileHead>),
}

/// Read this assignment; the body is the files of its folder, one behind the other, and then its packed pictures.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Load {
    pub id: u64,
    pub files: Vec<FileHead>,
    /// Bytes of the packed pictures; 0 where they are not known.
    pub pictures: usize,
    /// Pictures that take more milliseconds than this to compute are wanted in the reply.
    pub wants_pictures_above_ms: Option<u64>,
    /// Whether to grade the handed-out files, so that nobody's grading is slower than the next one's.
    pub warm_up: bool,
}

/// Grade this; the body is the files, one behind the other.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct GradingRequest {
    /// Comes back in the reply, so that an answer is never taken for another file's.
    pub id: u64,
    /// The digest of an assignment that was read.
    pub assignment: String,
    pub files: Vec<FileHead>,
    pub order: Order,
    pub wants_frames: bool,
}

/// One file in a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct FileHead {
    pub name: String,
    pub bytes: usize,
}

impl FileHead {
    pub fn of(name: &str, bytes: &[u8]) -> Self {
        Self { name: name.to_owned(), bytes: bytes.len() }
    }
}

/// A file in a body: its name, and its bytes.
pub(super) type FilePart<'b> = (&'b str, &'b [u8]);

/// The files at the beginning of a body, and the rest of it.
pub(super) fn files<'b>(heads: &'b [FileHead], body: &'b [u8]) -> io::Result<(Vec<FilePart<'b>>, &'b [u8])> {
    let mut rest = body;
    let mut files = Vec::with_capacity(heads.len());
    for FileHead { name, bytes } in heads {
        let (file, others) = rest.split_at_checked(*bytes).ok_or(io::ErrorKind::InvalidData)?;
        files.push((name.as_str(), file));
        rest = others;
    }
    Ok((files, rest))
}

impl Load {
    /// The demand that a folder be read, and its body.
    pub fn new(id: u64, folder: &Folder, pictures: Option<&[u8]>) -> (Self, Vec<u8>) {
        let heads = folder.files.iter().map(|(name, bytes)| FileHead::of(name, bytes)).collect();
        let pictures = pictures.unwrap_or_default();
        let body = folder.files.values().map(Vec::as_slice).chain([pictures]).collect::<Vec<_>>().concat();
        let load = Self { id, files: heads, pictures: pictures.len(), wants_pictures_above_ms: None, warm_up: false };
        (load, body)
    }

    /// The folder, and the packed pictures where there are any.
    pub fn folder<'b>(&'b self, body: &'b [u8]) -> io::Result<(Folder, Option<&'b [u8]>)> {
        let (files, rest) = files(&self.files, body)?;
        if rest.len() != self.pictures {
            return Err(io::ErrorKind::InvalidData.into());
        }
        Ok((Folder::of(files), (self.pictures > 0).then_some(rest)))
    }
}

impl GradingRequest {
    /// A request to grade these files.
    pub fn new(id: u64, assignment: &str, hand_in: &HandIn, order: Order, wants_frames: bool) -> Self {
        let head = |file: &HandedInFile| FileHead::of(&file.name, &file.bytes);
        let files = hand_in.files.iter().map(head).collect();
        Self { id, assignment: assignment.to_owned(), files, order, wants_frames }
    }

    /// The files, whose bytes are the body.
    pub fn hand_in(&self, body: &[u8]) -> io::Result<HandIn> {
        let (files, rest) = files(&self.files, body)?;
        let files = files.into_iter().map(|(name, bytes)| HandedInFile::new(name, bytes)).collect();
        if rest.is_empty() { Ok(HandIn { files }) } else { Err(io::ErrorKind::InvalidData.into()) }
    }
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
    pub outcome: Answered,
}

/// How it ended inside the worker.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Answered {
    /// The assignment is read; the body is its packed pictures, where they are wanted.
    Loaded,
    Graded {
        report: Box<Report>,
        /// The part of each frame that is not background.
        frames: Vec<Area>,
    },
    /// The archive has a homework; the body is the files of its folder, with what it extends.
    Checked {
        files: Vec<FileHead>,
        solution: Box<Report>,
        handed_out: Box<Report>,
    },
    /// It has none.
    Refused(Text),
    Failed(Fault),
}

/// The longest message that a side takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Longest {
    pub head: usize,
    pub body: usize,
}

/// What a worker takes: the parent is trusted, and a file over the source stage's limit is refused there.
pub(super) const REQUEST: Longest = Longest { head: 1 << 20, body: 256 << 20 };

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

/// The message in `bytes`, once it is there in full, and takes it out of there; bytes beyond it are an error, for nobody asked
/// for them.
pub(super) fn decode<T: DeserializeOwned>(
    bytes: &mut Vec<u8>,
    longest: Longest,
) -> io::Result<Option<(T, MessageBody)>> {
    let Some((head, body)) = lengths(bytes, longest)? else { return Ok(None) };
    let start = LENGTHS + head;
    match bytes.len().cmp(&(start + body)) {
        std::cmp::Ordering::Less => Ok(None),
        std::cmp::Ordering::Equal => {
            let head = serde_json::from_slice(&bytes[LENGTHS..start])?;
            Ok(Some((head, MessageBody { message: std::mem::take(bytes), start })))
        }
        std::cmp::Ordering::Greater => Err(io::Error::new(io::ErrorKind::InvalidData, "more than one answer")),
    }
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
    fn a_request_has_its_files() {
        let files = [("a.vert", "12"), ("b.frag", ""), ("c", "3")].map(|(name, text)| HandedInFile::new(name, text));
        let hand_in = HandIn { files: files.into() };
        let request = GradingRequest::new(1, "", &hand_in, Order::default(), false);
        assert_eq!(request.hand_in(b"123").unwrap(), hand_in);
        for body in ["", "12", "1234"] {
            assert_eq!(request.hand_in(body.as_bytes()).unwrap_err().kind(), io::ErrorKind::InvalidData, "{body}");
        }
    }

    #[test]
    fn a_folder_comes_back_as_it_was_sent() {
        let folder = Folder::of([("assignment.toml", "12"), ("meshes/a.obj", ""), ("z", "3")]);
        for pictures in [None, Some(b"456".as_slice())] {
            let (load, body) = Load::new(1, &folder, pictures);
            assert_eq!(load.folder(&body).unwrap(), (folder.clone(), pictures));
            for wrong in [&body[1..], &[body.as_slice(), b"7"].concat()] {
                assert_eq!(load.folder(wrong).unwrap_err().kind(), io::ErrorKind::InvalidData);
            }
        }
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
    fn bytes_after_the_message_are_refused() {
        let mut message = encode(&"head", b"body").unwrap();
        message.push(0);
        assert!(decode::<String>(&mut message, LONGEST).is_err());
    }

    #[test]
    fn an_area_outside_its_frame_has_no_pixels() {
        let area = |x, y, width, height| Area { x, y, width, height }.pixels_within(4, 3);
        assert_eq!(area(1, 1, 3, 2), Some(3 * 2));
        assert_eq!(area(2, 1, 3, 2), None);
        assert_eq!(area(1, 2, 3, 2), None);
        assert_eq!(area(u32::MAX, 0, 2, 1), None);
    }
}
