//! What a worker gives up before its first thread starts: rights, descriptors, memory, files.

use super::protection::{Layer, LayerState};
use super::{WorkerLimits, files};
use crate::render::AdapterKind;
use nix::sys::prctl;
use nix::sys::resource::{Resource, UsageWho, getrlimit, getrusage, setrlimit};
use nix::sys::signal::Signal;
use nix::sys::stat::{Mode, umask};
use nix::unistd::{Gid, Uid, close, dup, dup2_stdout, setgid, setgroups, setuid};
use std::fs::File;
use std::io;
use std::os::fd::AsRawFd;
use std::os::unix::fs::FileExt;

/// `nobody` and `nogroup`, the same on every Linux: an identity that owns nothing.
const NOBODY: u32 = 65534;

/// The address space that no worker exceeds, however many files it has graded.
const MOST_MEMORY: u64 = 8 << 30;

/// The CPU seconds after which a worker is at its end, however many files it has graded.
const MOST_CPU_SECONDS: u64 = 7200;

/// The descriptors that a driver may need while it starts.
const MOST_DESCRIPTORS: u64 = 256;

/// A confined process: what is left of it.
#[derive(Debug)]
pub(super) struct Confined {
    /// Where answers go. Standard output itself leads to standard error, so that no library's chatter becomes an answer.
    pub output: File,
    /// How the layers hold.
    pub layers: Vec<LayerState>,
    /// The worker's own bounds, to be set anew for each file.
    pub meter: GradingMeter,
}

/// Gives up all that grading does not need. To be called while the process has one thread, for some of it is by thread.
pub(super) fn enter(limits: WorkerLimits, adapter: AdapterKind) -> io::Result<Confined> {
    let output = File::from(dup(io::stdout())?);
    dup2_stdout(io::stderr())?;
    close_others(&output)?;
    let meter = GradingMeter { status: File::open("/proc/self/status")?, limits };
    std::env::set_current_dir("/")?;
    umask(Mode::all());
    let user = drop_root();
    // A change of user resets both, so they come after it.
    prctl::set_pdeathsig(Signal::SIGKILL)?;
    prctl::set_dumpable(false)?;
    prctl::set_no_new_privs()?;
    let bounds = bound(adapter);
    let layers = vec![
        state(Layer::User, user),
        state(Layer::Limits, bounds.map_err(|error| error.to_string())),
        state(Layer::Files, files::restrict(adapter)),
    ];
    Ok(Confined { output, layers, meter })
}

/// A layer by what setting it up gave.
pub(super) fn state(layer: Layer, outcome: Result<String, String>) -> LayerState {
    let holds = outcome.is_ok();
    LayerState { layer, holds, detail: outcome.unwrap_or_else(|detail| detail) }
}

/// Closes what the parent process left open by mistake: everything but the three standard streams and `keep`.
fn close_others(keep: &File) -> io::Result<()> {
    let open: Vec<i32> = std::fs::read_dir("/proc/self/fd")?
        .filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok())
        .filter(|&descriptor| descriptor > 2 && descriptor != keep.as_raw_fd())
        .collect();
    for descriptor in open {
        // The listing's own descriptor is closed already.
        let _ = close(descriptor);
    }
    Ok(())
}

fn drop_root() -> Result<String, String> {
    if !Uid::effective().is_root() {
        return Ok(format!("uid {}", Uid::effective()));
    }
    setgroups(&[]).map_err(|error| format!("setgroups: {error}"))?;
    setgid(Gid::from_raw(NOBODY)).map_err(|error| format!("setgid: {error}"))?;
    setuid(Uid::from_raw(NOBODY)).map_err(|error| format!("setuid: {error}"))?;
    Ok(format!("uid {NOBODY}"))
}

/// The bounds that hold from the start; [`GradingMeter::next`] draws those of memory and time closer.
fn bound(adapter: AdapterKind) -> nix::Result<String> {
    lower(Resource::RLIMIT_CORE, 0)?;
    lower(Resource::RLIMIT_NOFILE, MOST_DESCRIPTORS)?;
    lower(Resource::RLIMIT_MSGQUEUE, 0)?;
    lower(Resource::RLIMIT_MEMLOCK, 0)?;
    lower(Resource::RLIMIT_CPU, MOST_CPU_SECONDS)?;
    if adapter == AdapterKind::Gpu {
        // A card's driver maps the card's whole memory and more.
        return Ok("CPU time, core size, descriptors".into());
    }
    lower(Resource::RLIMIT_AS, MOST_MEMORY)?;
    // Not zero: newer drivers keep their buffers in an anonymous file of memory.
    lower(Resource::RLIMIT_FSIZE, MOST_MEMORY)?;
    Ok("memory, CPU time, file size, core size, descriptors".into())
}

/// Lowers both limits, but never raises one that is lower already.
pub(super) fn lower(resource: Resource, limit: u64) -> nix::Result<()> {
    let (_, hard) = getrlimit(resource)?;
    let limit = limit.min(hard);
    setrlimit(resource, limit, limit)
}

/// Bounds on one grading, over what the worker took before it: an earlier file's leak is never a later one's limit.
#[derive(Debug)]
pub(super) struct GradingMeter {
    /// Opened while files could be opened.
    status: File,
    limits: WorkerLimits,
}

impl GradingMeter {
    /// Gives the next file its own share of memory and so many times the usual CPU time; the size of the process beforehand.
    pub fn next(&self, adapter: AdapterKind, time: u32) -> io::Result<u64> {
        let cpu_seconds = self.limits.cpu_seconds.saturating_mul(u64::from(time));
        self.give(WorkerLimits { cpu_seconds, ..self.limits }, adapter)
    }

    /// Gives what comes next such a share.
    pub fn give(&self, limits: WorkerLimits, adapter: AdapterKind) -> io::Result<u64> {
        self.give_time(limits.cpu_seconds)?;
        let size = self.size()?;
        if adapter == AdapterKind::Software {
            soft(Resource::RLIMIT_AS, size + limits.memory)?;
        }
        Ok(size)
    }

    /// Gives what comes next so many CPU seconds.
    pub fn give_time(&self, seconds: u64) -> io::Result<()> {
        let usage = getrusage(UsageWho::RUSAGE_SELF)?;
        let used = (usage.user_time().tv_sec() + usage.system_time().tv_sec()).unsigned_abs();
        Ok(soft(Resource::RLIMIT_CPU, used + 1 + seconds)?)
    }

    /// The address space in use.
    pub fn size(&self) -> io::Result<u64> {
        let mut bytes = [0; 2048];
        let read = self.status.read_at(&mut bytes, 0)?;
        let text = String::from_utf8_lossy(&bytes[..read]);
        let line = text.lines().find_map(|line| line.strip_prefix("VmSize:"));
        let kilobytes = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok());
        kilobytes.map(|size| size << 10).ok_or_else(|| io::Error::other("no VmSize in /proc/self/status"))
    }
}

fn soft(resource: Resource, limit: u64) -> nix::Result<()> {
    let (_, hard) = getrlimit(resource)?;
    setrlimit(resource, limit.min(hard), hard)
}
