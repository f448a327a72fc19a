//! The parent's side of one worker: start, ask, wait no longer than the deadline, end.

use super::channel::{Channel, Lost};
use super::ending::Ending;
use super::protection::{Policy, Protection};
use super::protocol::{self, Body, Hello, Longest, Reply, Request};
use super::{Settings, environment, memory, schedule};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::report::Environment;
use nix::sys::signal::{Signal, killpg};
use nix::unistd::Pid;
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long a worker may take to open its device.
const START_DEADLINE: Duration = Duration::from_secs(10);

/// How long a worker that has closed its output may take to die: the kernel has its memory to tidy up.
const DYING: Duration = Duration::from_millis(300);

/// The longest first message.
const HELLO: Longest = Longest { head: 64 << 10, body: 0 };

/// The longest report without its frames.
const REPORT_BYTES: usize = 4 << 20;

/// A process that is to become a worker, or is one.
#[derive(Debug)]
pub(super) struct Worker {
    process: Child,
    channel: Channel,
    pub environment: Environment,
    pub protection: Protection,
    /// How many submissions it has met.
    pub gradings: u32,
}

/// Why there is no worker.
#[derive(Debug)]
pub(super) struct NotStarted {
    pub fault: Fault,
    /// Whether another try may end otherwise.
    pub transient: bool,
}

impl NotStarted {
    /// The same with too little memory as the reason, where that is it.
    fn explained(self, settings: &Settings) -> Self {
        match memory::shortage(settings.adapter, memory::Phase::Start, &self.fault.message) {
            Some(fault) => Self { fault, transient: false },
            None => self,
        }
    }
}

impl Worker {
    /// Starts the process. The kernel ends it with the thread that calls this.
    pub fn spawn(settings: &Settings) -> Result<Self, NotStarted> {
        let cannot = |error: std::io::Error| NotStarted { fault: cannot_start(&error.to_string()), transient: true };
        // This very program, also when its file was replaced by a newer one since it was started.
        let program = settings.program.clone().unwrap_or_else(|| PathBuf::from("/proc/self/exe"));
        let limits = settings.limits();
        let mut command = Command::new(program);
        command
            .arg0("ggrade")
            .arg("worker")
            .args(["--assignment", &settings.assignment])
            .args(["--adapter", settings.adapter.name()])
            .args(["--memory", &limits.memory.to_string()])
            .args(["--cpu-seconds", &limits.cpu_seconds.to_string()]);
        if settings.warm_up {
            command.arg("--warm-up");
        }
        let mut process = command
            .env_clear()
            .envs(environment::variables(settings.adapter))
            .process_group(0)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(cannot)?;
        let channel = Channel::new(&mut process).inspect_err(|_| {
            let _ = process.kill().and_then(|()| process.wait());
        });
        Ok(Self {
            channel: channel.map_err(cannot)?,
            process,
            environment: Environment::default(),
            protection: Protection::default(),
            gradings: 0,
        })
    }

    /// Waits until the device is warm and the sandbox closed.
    pub fn greet(&mut self, settings: &Settings) -> Result<(), NotStarted> {
        let hello = self.channel.exchange::<Hello>(&[], HELLO, Instant::now() + START_DEADLINE);
        let hello = hello.map_err(|lost| {
            let how = match lost {
                Lost::Timeout => format!("not ready after {} s", START_DEADLINE.as_secs()),
                Lost::Garbled(detail) => detail,
                Lost::Closed => self.died().map_or_else(|| "no answer".into(), |status| status.to_string()),
            };
            // No student's text has met this worker: what it says can be shown.
            let said = self.channel.tail();
            NotStarted { fault: cannot_start(format!("{how} {said}").trim_end()), transient: true }.explained(settings)
        })?;
        let (environment, protection) = match hello.0 {
            Hello::Failed(fault) => return Err(NotStarted { fault, transient: false }.explained(settings)),
            Hello::Ready { environment, protection } => (environment, protection),
        };
        if settings.policy == Policy::Required && !protection.is_closed() {
            return Err(NotStarted { fault: not_closed(&protection), transient: false });
        }
        self.environment = environment;
        self.protection = protection;
        Ok(())
    }

    /// Its process, which is also its process group.
    pub fn id(&self) -> u32 {
        self.process.id()
    }

    /// Has one submission graded.
    pub fn grade(
        &mut self,
        request: &Request,
        hand_in: &HandIn,
        frames_bytes: usize,
        deadline: Duration,
    ) -> Result<(Reply, Body), Ending> {
        self.gradings += 1;
        let message =
            protocol::encode(request, &hand_in.concatenated()).map_err(|error| Ending::Garbled(error.to_string()))?;
        let before = schedule::cpu_time(self.id());
        let longest = Longest { head: REPORT_BYTES, body: frames_bytes };
        match self.channel.exchange::<Reply>(&message, longest, Instant::now() + deadline) {
            Ok((reply, body)) if reply.id == request.id => Ok((reply, body)),
            Ok(_) => Err(Ending::Garbled("the answer to another question".into())),
            Err(Lost::Garbled(detail)) => Err(Ending::Garbled(detail)),
            Err(Lost::Timeout) => Err(schedule::of_late(self.id(), before, deadline)),
            Err(Lost::Closed) => Err(match self.died() {
                Some(status) => Ending::of(status, &self.channel.tail()),
                None => Ending::Garbled("the output was closed".into()),
            }),
        }
    }

    /// How the process ended; none where it has not.
    fn died(&mut self) -> Option<ExitStatus> {
        let end = Instant::now() + DYING;
        loop {
            match self.process.try_wait() {
                Ok(None) if Instant::now() < end => std::thread::sleep(Duration::from_millis(1)),
                Ok(status) => return status,
                Err(_) => return None,
            }
        }
    }
}

impl Drop for Worker {
    /// Ends the process with its whole group, and reaps it.
    fn drop(&mut self) {
        // A process that is reaped already has given its number back; its group was itself.
        if let Ok(None) = self.process.try_wait() {
            end_group(self.id());
            let _ = self.process.wait();
        }
    }
}

/// Ends a process group that is this process's child.
pub(super) fn end_group(id: u32) {
    if let Ok(id) = i32::try_from(id) {
        let _ = killpg(Pid::from_raw(id), Signal::SIGKILL);
    }
}

fn cannot_start(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the grading process cannot be started: {detail}"),
        format!("採点プロセスを起動できません: {detail}"),
    ))
    .remedy(Text::new("`ggrade doctor` checks the machine.", "`ggrade doctor` でこのマシンを調べられます。"))
}

fn not_closed(protection: &Protection) -> Fault {
    let notice = protection.notice().unwrap_or_default();
    Fault::new(Text::new(
        format!("the sandbox is not closed: {}", notice.en),
        format!("サンドボックスが不完全です: {}", notice.ja),
    ))
    .remedy(Text::new(
        "`ggrade doctor` shows each layer. --sandbox best-effort grades all the same: only for files that you trust.",
        "`ggrade doctor` で各層の状態を確かめられます。--sandbox best-effort を付けると採点できますが、\
         信頼できるファイルだけにしてください。",
    ))
}
