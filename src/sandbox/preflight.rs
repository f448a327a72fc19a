//! A worker tries what it must not be able to do: the layers are judged by what they stop, not by what they claim.

use super::protection::Reach;
use nix::errno::Errno;
use nix::sys::signal::{Signal, kill};
use nix::unistd::{Uid, execv, getppid, setuid};
use std::fs::{File, OpenOptions};
use std::io;
use std::net::{Ipv4Addr, TcpStream, UdpSocket};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::process::Command;

/// Tries everything, and gives what went through.
pub(super) fn open() -> Vec<Reach> {
    [Reach::Read, Reach::Write, Reach::Socket, Reach::Connect, Reach::Child]
        .into_iter()
        .filter(|reach| reach.attempts().into_iter().any(|outcome| !is_refused(&outcome)))
        .collect()
}

impl Reach {
    fn attempts(self) -> Vec<io::Result<()>> {
        match self {
            Self::Read => {
                ["/etc/passwd", "/usr/lib", "/proc/self/environ"].map(|path| File::open(path).map(drop)).into()
            }
            Self::Write => [".", "/tmp", "/dev/shm", "/var/tmp"].map(create_in).into(),
            Self::Socket => vec![UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).map(drop), UnixStream::pair().map(drop)],
            // Port 9 discards; where nobody listens, "connection refused" still shows that the way is open.
            Self::Connect => vec![TcpStream::connect((Ipv4Addr::LOCALHOST, 9)).map(drop)],
            Self::Child => vec![start("/bin/true")],
        }
    }
}

fn create_in(folder: &str) -> io::Result<()> {
    let path = PathBuf::from(folder).join(format!("ggrade-preflight-{}", std::process::id()));
    OpenOptions::new().write(true).create_new(true).open(&path)?;
    // It should not have been possible; leave no trace of it.
    std::fs::remove_file(path)
}

fn start(program: &str) -> io::Result<()> {
    Command::new(program).spawn()?.wait().map(drop)
}

/// Refused by a right that is lacking. Any other error means that the kernel went further than to say no.
fn is_refused(outcome: &io::Result<()>) -> bool {
    let refusals = [Errno::EPERM, Errno::EACCES, Errno::ENOSYS].map(|errno| Some(errno as i32));
    outcome.as_ref().is_err_and(|error| refusals.contains(&error.raw_os_error()))
}

/// One thing that code which has broken into a worker would try. `ggrade worker --attempt` does it behind all layers:
/// the proof of the sandbox that needs no shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum IntrusionAttempt {
    /// Open a file for reading.
    Read,
    /// Create a file.
    Write,
    /// Make a socket.
    Socket,
    /// Connect to this machine.
    Connect,
    /// Start a program in a process of its own.
    Child,
    /// Become another program.
    Exec,
    /// Send the parent a signal.
    Signal,
    /// Become root.
    Root,
    /// Compute without end.
    Compute,
    /// Take memory without end.
    Allocate,
    /// Nothing: shows that a process which tries nothing ends well.
    Nothing,
}

impl IntrusionAttempt {
    /// Tries it.
    pub fn make(self) -> io::Result<()> {
        let first = |reach: Reach| {
            let through = reach.attempts().into_iter().find(|outcome| !is_refused(outcome));
            through.unwrap_or_else(|| Err(Errno::EPERM.into()))
        };
        match self {
            Self::Read => first(Reach::Read),
            Self::Write => first(Reach::Write),
            Self::Socket => first(Reach::Socket),
            Self::Connect => first(Reach::Connect),
            Self::Child => first(Reach::Child),
            Self::Exec => Ok(execv(c"/bin/true", &[c"true"]).map(drop)?),
            Self::Signal => Ok(kill(getppid(), Signal::SIGCONT)?),
            Self::Root => Ok(setuid(Uid::from_raw(0))?),
            Self::Compute => compute(),
            Self::Allocate => allocate(),
            Self::Nothing => Ok(()),
        }
    }
}

fn compute() -> io::Result<()> {
    let mut sum = 0_u64;
    loop {
        sum = std::hint::black_box(sum.wrapping_add(1));
        if sum == u64::MAX {
            return Ok(());
        }
    }
}

fn allocate() -> io::Result<()> {
    let mut taken: Vec<Vec<u8>> = Vec::new();
    loop {
        taken.push(vec![1; 16 << 20]);
        std::hint::black_box(&taken);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_walls_every_way_is_found_open() {
        assert_eq!(open(), [Reach::Read, Reach::Write, Reach::Socket, Reach::Connect, Reach::Child]);
    }

    #[test]
    fn only_a_lack_of_rights_counts_as_refused() {
        let error = |errno: Errno| Err(errno.into());
        assert!(is_refused(&error(Errno::EPERM)) && is_refused(&error(Errno::EACCES)));
        for way_in in [Ok(()), error(Errno::ECONNREFUSED), error(Errno::ENOENT), error(Errno::ENETUNREACH)] {
            assert!(!is_refused(&way_in), "{way_in:?}");
        }
    }
}
