//! The parent's side of one worker: start, ask, wait no longer than the deadline, end.

mod not_started;

use super::channel::{Channel, LostAnswer};
use super::ending::Ending;
use super::library::{PictureLibrary, Turn};
use super::message::{Longest, MessageBody, encode};
use super::protection::{Policy, Protection};
use super::protocol::{Answered, Demand, GradingRequest, Hello, Load, Reply};
use super::schedule::Allowance;
use super::{Settings, environment};
use crate::expected::Pack;
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::report::Environment;
use nix::sys::signal::{Signal, killpg};
use nix::unistd::Pid;
pub(super) use not_started::NotStarted;
use not_started::{cannot_read, cannot_start, not_closed};
use reference::Assignment;
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long a worker may take to open its device.
const START_DEADLINE: Duration = Duration::from_secs(10);

/// How long a worker may take to read an assignment, for which it has two minutes of processor time and, on a busy machine, half of one.
const LOAD_DEADLINE: Duration = Duration::from_secs(240);

/// The longest packed pictures.
const PICTURES_BYTES: usize = 128 << 20;

/// How many assignments one worker reads.
pub const MOST_ASSIGNMENTS: usize = 16;

/// How long a worker that has closed its output may take to die: the kernel has its memory to tidy up.
const DYING: Duration = Duration::from_millis(300);

/// The longest first message.
const HELLO: Longest = Longest { head: 64 << 10, body: 0 };

/// The longest report without its frames.
pub(super) const REPORT_BYTES: usize = 4 << 20;

/// A process that is to become a worker, or is one.
#[derive(Debug)]
pub(super) struct Worker {
    process: Child,
    channel: Channel,
    pub environment: Environment,
    pub protection: Protection,
    /// How many submissions it has met.
    pub gradings: u32,
    /// The digests of the assignments that it has read.
    assignments: Vec<String>,
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
            .args(["--adapter", settings.adapter.name()])
            .args(["--memory", &limits.memory.to_string()])
            .args(["--cpu-seconds", &limits.cpu_seconds.to_string()]);
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
            assignments: Vec::new(),
        })
    }

    /// Waits until the device is warm and the sandbox closed.
    pub fn greet(&mut self, settings: &Settings) -> Result<(), NotStarted> {
        let hello = self.channel.exchange::<Hello>(&[], HELLO, Instant::now() + START_DEADLINE, &mut |_| None);
        let hello = hello.map_err(|lost| {
            let how = match lost {
                LostAnswer::Timeout => format!("not ready after {} s", START_DEADLINE.as_secs()),
                LostAnswer::Garbled(detail) => detail,
                LostAnswer::Closed => self.died().map_or_else(|| "no answer".into(), |status| status.to_string()),
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

    /// Whether it has read this assignment.
    pub fn has_read(&self, assignment: &Assignment) -> bool {
        self.assignments.contains(&assignment.digest)
    }

    /// Whether it may read another assignment.
    pub fn may_read(&self, assignment: &Assignment, library: &PictureLibrary) -> bool {
        self.assignments.len() < MOST_ASSIGNMENTS && (self.gradings == 0 || library.is_settled(assignment))
    }

    /// Has it read an assignment, with the right pictures where they are known.
    pub fn read(
        &mut self,
        assignment: &Assignment,
        library: &PictureLibrary,
        settings: &Settings,
    ) -> Result<(), NotStarted> {
        let turn = library.turn(assignment, settings);
        let given = if let Turn::Given(pack) = &turn { Some(pack.bytes()) } else { None };
        let (mut load, body) = Load::new(0, &assignment.folder, given);
        load.warm_up = settings.warm_up;
        if let Turn::ForAll(_) = turn {
            load.wants_pictures_above_ms = u64::try_from(settings.keep_above.as_millis()).ok();
        }
        let failed = |fault: Fault, transient| NotStarted { fault, transient }.explained(settings);
        let longest = Longest { head: REPORT_BYTES, body: PICTURES_BYTES };
        let answered = self.ask(&Demand::Load(load), &body, longest, LOAD_DEADLINE);
        let (reply, body) = answered.map_err(|how| failed(cannot_read(assignment, &how), true))?;
        match reply.outcome {
            Answered::Loaded => {}
            Answered::Failed(fault) => return Err(failed(fault, false)),
            _ => return Err(failed(cannot_read(assignment, "another answer"), true)),
        }
        if let Turn::ForAll(maker) = turn {
            maker.done(assignment, (!body.is_empty()).then(|| Pack::of_bytes(&body)), settings);
        }
        self.assignments.push(assignment.digest.clone());
        Ok(())
    }

    /// Has a worker that has met no student's file do something; where no answer comes, what there is to say of that.
    pub fn ask(
        &mut self,
        demand: &Demand,
        body: &[u8],
        longest: Longest,
        deadline: Duration,
    ) -> Result<(Reply, MessageBody), String> {
        let message = encode(demand, body).map_err(|error| error.to_string())?;
        self.channel.exchange::<Reply>(&message, longest, Instant::now() + deadline, &mut |_| None).map_err(|lost| {
            let how = match lost {
                LostAnswer::Timeout => format!("no answer after {} s", deadline.as_secs()),
                LostAnswer::Garbled(detail) => detail,
                LostAnswer::Closed => self.died().map_or_else(|| "no answer".into(), |status| status.to_string()),
            };
            format!("{how} {}", self.channel.tail()).trim_end().to_owned()
        })
    }

    /// Its process, which is also its process group.
    pub fn id(&self) -> u32 {
        self.process.id()
    }

    /// Has one submission graded. The deadline is that of what was handed in; once that has run, [`JUDGING`] is. `overtime` is called
    /// once where what was handed in has had a processor for long and does not end.
    pub fn grade(
        &mut self,
        request: &GradingRequest,
        hand_in: &HandIn,
        frames_bytes: usize,
        [deadline, judging]: [Duration; 2],
        overtime: &mut dyn FnMut(),
    ) -> Result<(Reply, MessageBody), Ending> {
        self.gradings += 1;
        let message = encode(&Demand::Grade(request.clone()), &hand_in.concatenated())
            .map_err(|error| Ending::Garbled(error.to_string()))?;
        let longest = Longest { head: REPORT_BYTES, body: frames_bytes };
        let (id, mut is_drawn, mut is_long) = (self.id(), false, false);
        let mut allowance = Allowance::new(id, deadline);
        let first = allowance.next_look();
        let mut further = |reply: Option<&Reply>| match reply {
            None if is_drawn || is_long => allowance.later(),
            None => {
                let next = allowance.next_look();
                is_long = next == allowance.end();
                if is_long {
                    overtime();
                }
                Some(next)
            }
            Some(Reply { outcome: Answered::Drawn, .. }) if !is_drawn => {
                is_drawn = true;
                allowance = Allowance::new(id, judging);
                Some(allowance.end())
            }
            Some(_) => None,
        };
        let ending = match self.channel.exchange::<Reply>(&message, longest, first, &mut further) {
            Ok((reply, body)) if reply.id == request.id => return Ok((reply, body)),
            Ok(_) => Ending::Garbled("the answer to another question".into()),
            Err(LostAnswer::Garbled(detail)) => Ending::Garbled(detail),
            Err(LostAnswer::Timeout) => allowance.of_late(),
            Err(LostAnswer::Closed) => match self.died() {
                Some(status) => Ending::of(status, &self.channel.tail()),
                None => Ending::Garbled("the output was closed".into()),
            },
        };
        Err(if is_drawn { ending.while_judging() } else { ending })
    }

    /// How the process ended; `None` where it has not.
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
