//! The parent's ends of a worker's three pipes: one message out, one message in, never longer than the deadline.
//!
//! A worker that does not read, does not write or writes nonsense costs the caller its deadline and no more, so all
//! ends are non-blocking and waited on together.

use super::message::{Longest, MessageBody, decode, needed};
use nix::fcntl::{FcntlArg, OFlag, fcntl};
use nix::poll::{PollFd, PollFlags, PollTimeout, poll};
use serde::de::DeserializeOwned;
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::os::fd::AsFd;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout};
use std::time::Instant;

/// What a pipe may hold without a privilege.
const PIPE_BYTES: i32 = 1 << 20;

/// How much of a worker's standard error is kept.
const TAIL_BYTES: usize = 4096;

/// The ends of a worker's pipes.
#[derive(Debug)]
pub(super) struct Channel {
    stdin: ChildStdin,
    stdout: ChildStdout,
    stderr: Option<ChildStderr>,
    tail: VecDeque<u8>,
}

/// Why no answer came.
#[derive(Debug)]
pub(super) enum LostAnswer {
    /// Not within the deadline.
    Timeout,
    /// The worker closed its output.
    Closed,
    /// The answer is none.
    Garbled(String),
}

impl Channel {
    /// Takes the pipes of a process that was started with all three.
    pub fn new(process: &mut Child) -> io::Result<Self> {
        let missing = || io::Error::other("a pipe is missing");
        let stdin = process.stdin.take().ok_or_else(missing)?;
        let stdout = process.stdout.take().ok_or_else(missing)?;
        let stderr = process.stderr.take().ok_or_else(missing)?;
        never_block(&stdin)?;
        never_block(&stdout)?;
        never_block(&stderr)?;
        // Frames are large, and every pause of theirs wakes two processes. A smaller pipe does as well.
        let _ = fcntl(&stdout, FcntlArg::F_SETPIPE_SZ(PIPE_BYTES));
        Ok(Self { stdin, stdout, stderr: Some(stderr), tail: VecDeque::new() })
    }

    /// Sends `message` and waits for one that fits into `longest`. `further` says until when to wait on, if at all: at the deadline, where
    /// there is nothing to show it, and for another message after the one that it is shown.
    pub fn exchange<T: DeserializeOwned>(
        &mut self,
        message: &[u8],
        longest: Longest,
        mut deadline: Instant,
        further: &mut dyn FnMut(Option<&T>) -> Option<Instant>,
    ) -> Result<(T, MessageBody), LostAnswer> {
        let mut unsent = message;
        let mut received = Vec::new();
        loop {
            match self.wait(!unsent.is_empty(), deadline) {
                Err(LostAnswer::Timeout) => deadline = further(None).ok_or(LostAnswer::Timeout)?,
                waited => waited?,
            }
            self.listen();
            unsent = self.push(unsent);
            let open = self.pull(&mut received, longest)?;
            match decode(&mut received, longest) {
                Ok(Some(answer)) => match further(Some(&answer.0)) {
                    Some(until) => deadline = until,
                    None if received.is_empty() => return Ok(answer),
                    None => return Err(LostAnswer::Garbled("more than one answer".into())),
                },
                Ok(None) if open => {}
                Ok(None) => return Err(LostAnswer::Closed),
                Err(error) => return Err(LostAnswer::Garbled(error.to_string())),
            }
        }
    }

    /// What the worker last wrote to its standard error.
    pub fn tail(&mut self) -> String {
        self.listen();
        String::from_utf8_lossy(self.tail.make_contiguous()).trim().to_owned()
    }

    /// Waits until something can be read or, where asked for, written.
    fn wait(&self, sending: bool, deadline: Instant) -> Result<(), LostAnswer> {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(LostAnswer::Timeout);
        }
        let mut ends = vec![PollFd::new(self.stdout.as_fd(), PollFlags::POLLIN)];
        ends.extend(self.stderr.as_ref().map(|stderr| PollFd::new(stderr.as_fd(), PollFlags::POLLIN)));
        if sending {
            ends.push(PollFd::new(self.stdin.as_fd(), PollFlags::POLLOUT));
        }
        // Rounded up: a poll that returns a little early would spin.
        let milliseconds = i32::try_from(left.as_millis() + 1).unwrap_or(i32::MAX);
        match poll(&mut ends, PollTimeout::try_from(milliseconds).unwrap_or(PollTimeout::MAX)) {
            Ok(_) | Err(nix::Error::EINTR) => Ok(()),
            Err(error) => Err(LostAnswer::Garbled(format!("poll: {error}"))),
        }
    }

    /// Writes what the pipe takes, and gives the rest. A worker that is gone takes all: its output tells how it went.
    fn push<'a>(&mut self, unsent: &'a [u8]) -> &'a [u8] {
        if unsent.is_empty() {
            return unsent;
        }
        match self.stdin.write(unsent) {
            Ok(written) => &unsent[written..],
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted) => unsent,
            Err(_) => &[],
        }
    }

    /// Reads what is there; false at the end of the pipe.
    fn pull(&mut self, received: &mut Vec<u8>, longest: Longest) -> Result<bool, LostAnswer> {
        loop {
            let needed = needed(received, longest).map_err(|error| LostAnswer::Garbled(error.to_string()))?;
            // One byte more would show: a writer that never pauses is left to who decodes.
            let end = needed + 1;
            if received.len() >= end {
                return Ok(true);
            }
            received.reserve(end - received.len());
            match (&mut self.stdout).take((end - received.len()) as u64).read_to_end(received) {
                // Either the pipe has ended, or its bytes say how many more are to come.
                Ok(0) => return Ok(false),
                Ok(_) => {}
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(true),
                Err(error) => return Err(LostAnswer::Garbled(error.to_string())),
            }
        }
    }

    /// Keeps the end of what standard error says, and never waits for more of it.
    fn listen(&mut self) {
        let mut chunk = [0; TAIL_BYTES];
        // As much as a pipe holds; who writes faster is heard in the next round.
        for _ in 0..16 {
            let Some(stderr) = &mut self.stderr else { return };
            match stderr.read(&mut chunk) {
                Ok(0) => self.stderr = None,
                Ok(read) => {
                    self.tail.extend(&chunk[..read]);
                    let excess = self.tail.len().saturating_sub(TAIL_BYTES);
                    self.tail.drain(..excess);
                }
                Err(_) => return,
            }
        }
    }
}

/// The flag belongs to this end of the pipe: the worker's own end still blocks.
fn never_block(end: &impl AsFd) -> io::Result<()> {
    fcntl(end, FcntlArg::F_SETFL(OFlag::O_NONBLOCK))?;
    Ok(())
}
