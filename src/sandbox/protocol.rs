//! What parent and worker say to each other.

use super::message::Longest;
use super::protection::Protection;
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::report::{Area, Environment, Report};
use reference::Folder;
use serde::{Deserialize, Serialize};
use std::io;

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
    /// What was handed in has run; the answer follows.
    Drawn,
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

/// What a worker takes: the parent is trusted, and a file over the source stage's limit is refused there.
pub(super) const REQUEST: Longest = Longest { head: 1 << 20, body: 256 << 20 };

#[cfg(test)]
mod tests {
    use super::*;

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
}
