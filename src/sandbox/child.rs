//! The parent's side of one worker: start, ask, wait no longer than the deadline, end.

use super::Settings;
use super::protocol::{Hello, Reply, Request, receive, send};
use crate::fault::Fault;
use crate::language::Text;
use crate::report::Environment;
use std::io::{self, Read};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// How long a worker may take to open its device.
const START_DEADLINE: Duration = Duration::from_secs(20);

/// A running worker with a warm device.
#[derive(Debug)]
pub(super) struct Worker {
    process: Child,
    stdin: Option<ChildStdin>,
    replies: Receiver<io::Result<(Reply, Vec<u8>)>>,
    pub environment: Environment,
    pub gradings: u32,
}

/// Why a worker gave no answer.
#[derive(Debug)]
pub(super) enum Ended {
    /// It took longer than the deadline.
    Deadline,
    /// It went away: a crash, or a limit that the kernel holds.
    Died(ExitStatus),
    /// It answered, but not by the protocol.
    Protocol(String),
}

impl Worker {
    /// Starts a worker and waits until its device is warm.
    pub fn start(settings: &Settings) -> Result<Self, Fault> {
        let program = std::env::current_exe().map_err(|error| cannot_start(&error.to_string()))?;
        let mut process = Command::new(program)
            .arg("worker")
            .args(["--assignment", &settings.assignment])
            .args(["--adapter", settings.adapter.name()])
            .env_clear()
            .envs(environment())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| cannot_start(&error.to_string()))?;
        let stdin = process.stdin.take();
        let Some(stdout) = process.stdout.take() else { return Err(cannot_start("no pipe")) };
        let (hello, replies) = listen(stdout);
        let mut worker = Self { process, stdin, replies, environment: Environment::default(), gradings: 0 };
        match hello.recv_timeout(START_DEADLINE) {
            Ok(Ok(Hello::Ready(environment))) => {
                worker.environment = environment;
                Ok(worker)
            }
            Ok(Ok(Hello::Failed(fault))) => Err(fault),
            Ok(Err(error)) => Err(cannot_start(&format!("{error}; {}", worker.end()))),
            Err(_) => Err(cannot_start(&format!("not ready after {} s", START_DEADLINE.as_secs()))),
        }
    }

    /// Has one submission graded.
    pub fn grade(&mut self, request: &Request, bytes: &[u8], deadline: Duration) -> Result<(Reply, Vec<u8>), Ended> {
        self.gradings += 1;
        let sent = match &mut self.stdin {
            Some(stdin) => send(stdin, request, bytes),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        };
        if sent.is_err() {
            return Err(Ended::Died(self.end()));
        }
        match self.replies.recv_timeout(deadline) {
            Ok(Ok(answer)) => Ok(answer),
            Ok(Err(error)) if error.kind() == io::ErrorKind::UnexpectedEof => Err(Ended::Died(self.end())),
            Ok(Err(error)) => Err(Ended::Protocol(error.to_string())),
            Err(RecvTimeoutError::Disconnected) => Err(Ended::Died(self.end())),
            Err(RecvTimeoutError::Timeout) => Err(Ended::Deadline),
        }
    }

    /// Kills the process if it still runs, and reaps it.
    fn end(&mut self) -> ExitStatus {
        self.stdin = None;
        // A process that is gone already keeps the status it ended with.
        if let Ok(Some(status)) = self.process.try_wait() {
            return status;
        }
        std::thread::sleep(Duration::from_millis(1));
        if let Ok(Some(status)) = self.process.try_wait() {
            return status;
        }
        let _ = self.process.kill();
        self.process.wait().unwrap_or_default()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.end();
    }
}

/// Reads the worker's messages on a thread of its own, which ends with the pipe.
#[allow(clippy::type_complexity)]
fn listen(mut stdout: ChildStdout) -> (Receiver<io::Result<Hello>>, Receiver<io::Result<(Reply, Vec<u8>)>>) {
    let (to_hello, hello) = channel();
    let (to_replies, replies) = channel();
    std::thread::spawn(move || {
        let first = receive::<Hello>(&mut stdout).map(|(hello, _)| hello);
        let ready = first.is_ok();
        if to_hello.send(first).is_err() || !ready {
            return;
        }
        loop {
            let message = receive::<Reply>(&mut stdout);
            let last = message.is_err();
            if to_replies.send(message).is_err() || last {
                // Lets a worker that still writes see the pipe's end instead of a full pipe.
                let _ = io::copy(&mut stdout.by_ref().take(0), &mut io::sink());
                return;
            }
        }
    });
    (hello, replies)
}

/// The whole environment of a worker.
fn environment() -> Vec<(&'static str, &'static str)> {
    vec![
        // A cache on disk would carry one student's code into another's worker.
        ("MESA_SHADER_CACHE_DISABLE", "true"),
        // Frames are small: threads cost more than they bring, and the pool has a worker a core.
        ("LP_NUM_THREADS", "0"),
        // The Wayland client library, which the driver loads, complains where this is unset.
        ("XDG_RUNTIME_DIR", "/nonexistent"),
        ("LC_ALL", "C.UTF-8"),
    ]
}

fn cannot_start(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the grading process cannot be started: {detail}"),
        format!("採点プロセスを起動できません: {detail}"),
    ))
    .remedy(Text::new("`ggrade doctor` checks the machine.", "`ggrade doctor` でこのマシンを調べられます。"))
}
