//! How a worker can end without an answer, whose doing that is, and what is said about it.
//!
//! | ending | whose | what follows |
//! | --- | --- | --- |
//! | deadline, CPU time | the file's | `stopped` |
//! | memory, stack, crash, forbidden system call | the file's, once a worker that has met no other file ends so too | `stopped` |
//! | killed, suspended or starved from outside; unreadable answer; our own exit | ours | another worker, at last a fault |
//! | any of these once the file has run | ours | a fault, after another worker where that may end otherwise |

use crate::fault::Fault;
use crate::language::Text;
use nix::sys::signal::Signal;
use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;
use std::time::Duration;

/// Why a worker gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Ending {
    /// It was at work all the time that there was.
    Deadline,
    /// The kernel ended it: out of CPU time.
    Cpu,
    /// An allocation failed.
    Memory,
    /// The student's nesting is deeper than the stack.
    Stack,
    /// A system call that no grading makes.
    Forbidden,
    /// A signal that a process brings upon itself, or an exit that the driver chose.
    Crash(String),
    /// A signal that only another process sends.
    Killed(String),
    /// Another process stopped it.
    Suspended,
    /// The machine gave it no processor.
    Starved,
    /// It ended on its own account: a fault or panic of ours.
    Exited(i32),
    /// Its answer cannot be read.
    Garbled(String),
    /// One of the file's endings, after all that was handed in had run: our own judgement ended so.
    Judging(Box<Ending>),
}

/// Whose doing an ending is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Blame {
    /// The file's.
    File,
    /// The file's, if a worker that has met no other file ends so too: an earlier file may have left damage.
    FileIfRepeated,
    /// Ours, or the machine's.
    Ours,
}

impl Ending {
    /// What an exit status says. The standard error tells limits from other crashes: a failed allocation and an
    /// overflowed stack both end in an abort.
    pub fn of(status: ExitStatus, stderr: &str) -> Self {
        let says = |texts: &[&str]| texts.iter().any(|text| stderr.contains(text));
        let Some(signal) = status.signal() else {
            return match status.code().unwrap_or_default() {
                // LLVM's fatal errors end in exit(1).
                1 if says(&OUT_OF_MEMORY) => Self::Memory,
                1 => Self::Crash("exit 1".into()),
                code => Self::Exited(code),
            };
        };
        let name = Signal::try_from(signal).map_or_else(|_| format!("signal {signal}"), |s| s.as_str().to_owned());
        match Signal::try_from(signal) {
            Ok(Signal::SIGXCPU) => Self::Cpu,
            Ok(Signal::SIGSYS) => Self::Forbidden,
            Ok(Signal::SIGABRT | Signal::SIGSEGV) if says(&STACK) => Self::Stack,
            Ok(Signal::SIGABRT | Signal::SIGSEGV | Signal::SIGTRAP) if says(&OUT_OF_MEMORY) => Self::Memory,
            Ok(
                Signal::SIGSEGV
                | Signal::SIGABRT
                | Signal::SIGBUS
                | Signal::SIGILL
                | Signal::SIGFPE
                | Signal::SIGTRAP
                | Signal::SIGXFSZ,
            ) => Self::Crash(name),
            _ => Self::Killed(name),
        }
    }

    pub fn blame(&self) -> Blame {
        match self {
            Self::Deadline | Self::Cpu => Blame::File,
            Self::Memory | Self::Stack | Self::Forbidden | Self::Crash(_) => Blame::FileIfRepeated,
            Self::Killed(_)
            | Self::Suspended
            | Self::Starved
            | Self::Exited(_)
            | Self::Garbled(_)
            | Self::Judging(_) => Blame::Ours,
        }
    }

    /// The same once all that was handed in has run: from there on nothing is the file's doing.
    pub fn while_judging(self) -> Self {
        if self.blame() == Blame::Ours { self } else { Self::Judging(Box::new(self)) }
    }

    /// Whether another worker would end so too.
    pub fn is_for_good(&self) -> bool {
        matches!(self, Self::Judging(ending) if ending.blame() == Blame::File)
    }

    /// What a student is told.
    pub fn message(&self, deadline: Duration, memory: u64) -> Text {
        let seconds = deadline.as_secs_f64();
        let megabytes = memory >> 20;
        match self {
            Self::Deadline => Text::new(
                format!("the shader did not finish within {seconds} s (time limit)"),
                format!("{seconds} 秒以内に処理が終わりませんでした (時間制限)"),
            ),
            Self::Cpu => Text::new(
                "the shader used up the processor time of a grading (CPU time limit)",
                "採点に使える CPU 時間を使い切りました (CPU 時間制限)",
            ),
            Self::Memory => Text::new(
                format!("compiling or running the shader took more than {megabytes} MiB of memory (memory limit)"),
                format!("コンパイルまたは実行に {megabytes} MiB を超えるメモリが必要でした (メモリ制限)"),
            ),
            Self::Stack => Text::new(
                "the shader is nested too deeply to be compiled (stack limit)",
                "入れ子が深すぎるため、コンパイルできませんでした (スタック制限)",
            ),
            Self::Forbidden => Text::new(
                "the shader made the renderer attempt a forbidden system call (SIGSYS)",
                "レンダラが、許可されていないシステムコールを実行しようとしました (SIGSYS)",
            ),
            Self::Crash(how) => Text::new(
                format!("the shader crashed the renderer ({how})"),
                format!("このシェーダでレンダラが異常終了しました ({how})"),
            ),
            ours => Text::verbatim(format!("{ours:?}")),
        }
    }

    /// What is said where it is not the file's doing.
    pub fn fault(&self) -> Fault {
        let (en, ja) = match self {
            Self::Killed(signal) => (
                format!("the grading process was killed from outside again and again ({signal})"),
                format!("採点プロセスが外部から繰り返し強制終了されました ({signal})"),
            ),
            Self::Suspended => (
                "the grading process was suspended from outside again and again".into(),
                "採点プロセスが外部から繰り返し一時停止されました".into(),
            ),
            Self::Starved => (
                "the machine is too busy: the grading process was given no processor".into(),
                "マシンの負荷が高く、採点プロセスに CPU が割り当てられませんでした".into(),
            ),
            Self::Judging(how) => (
                format!("the shader ran, but ggrade could not judge what it draws ({how:?})"),
                format!("シェーダの実行は終わりましたが、ggrade が結果を採点できませんでした ({how:?})"),
            ),
            Self::Garbled(detail) => (
                format!("the grading process gave an unreadable answer: {detail}"),
                format!("採点プロセスの応答を読み取れません: {detail}"),
            ),
            other => (
                format!("the grading process ended without an answer: {other:?}"),
                format!("採点プロセスが応答なしに終了しました: {other:?}"),
            ),
        };
        let fault = Fault::new(Text::new(en, ja));
        if self.is_for_good() {
            return fault.remedy(Text::new(
                "That is a mistake of ggrade: please send the file to those who make it.",
                "ggrade の不具合です。このファイルを添えて開発者に連絡してください。",
            ));
        }
        fault.remedy(Text::new(
            "Grade the file again when the machine has memory and processors to spare.",
            "メモリと CPU に余裕があるときに、もう一度採点してください。",
        ))
    }
}

/// Words of Rust, C++ and LLVM where an allocation fails. A foreign exception is `std::bad_alloc` too: it is the only
/// one that the compilers, which are built without exceptions, let through to Rust.
const OUT_OF_MEMORY: [&str; 6] = [
    "memory allocation of",
    "bad_alloc",
    "cannot catch foreign exceptions",
    "out of memory",
    "Unable to allocate",
    "Allocation failed",
];

/// Rust's words where a guard page is hit.
const STACK: [&str; 1] = ["has overflowed its stack"];

#[cfg(test)]
mod tests {
    use super::*;

    /// As `wait` gives it: the signal in the low seven bits, the exit code in the next byte.
    fn signal(signal: Signal) -> ExitStatus {
        ExitStatus::from_raw(signal as i32)
    }

    fn exit(code: i32) -> ExitStatus {
        ExitStatus::from_raw(code << 8)
    }

    #[test]
    fn limits_have_names() {
        assert_eq!(Ending::of(signal(Signal::SIGXCPU), ""), Ending::Cpu);
        assert_eq!(Ending::of(signal(Signal::SIGSYS), ""), Ending::Forbidden);
        let rust = "memory allocation of 1073741824 bytes failed";
        assert_eq!(Ending::of(signal(Signal::SIGABRT), rust), Ending::Memory);
        let cpp = "terminate called after throwing an instance of 'std::bad_alloc'";
        assert_eq!(Ending::of(signal(Signal::SIGABRT), cpp), Ending::Memory);
        assert_eq!(Ending::of(exit(1), "LLVM ERROR: out of memory"), Ending::Memory);
        let deep = "thread 'grader' (7) has overflowed its stack\nfatal runtime error: stack overflow";
        assert_eq!(Ending::of(signal(Signal::SIGABRT), deep), Ending::Stack);
    }

    #[test]
    fn a_crash_is_named_after_its_signal() {
        assert_eq!(Ending::of(signal(Signal::SIGSEGV), ""), Ending::Crash("SIGSEGV".into()));
        assert_eq!(Ending::of(signal(Signal::SIGABRT), "assertion failed"), Ending::Crash("SIGABRT".into()));
        assert_eq!(Ending::of(exit(1), "LLVM ERROR: Cannot select"), Ending::Crash("exit 1".into()));
    }

    #[test]
    fn what_another_process_does_is_never_the_files() {
        for signal in [Signal::SIGKILL, Signal::SIGTERM, Signal::SIGINT, Signal::SIGHUP, Signal::SIGUSR1] {
            let ending = Ending::of(self::signal(signal), "");
            assert_eq!(ending, Ending::Killed(signal.as_str().into()));
            assert_eq!(ending.blame(), Blame::Ours);
        }
        assert_eq!(Ending::of(exit(3), "").blame(), Blame::Ours);
        assert_eq!(Ending::of(exit(101), "panicked").blame(), Blame::Ours);
    }

    #[test]
    fn once_it_has_run_nothing_is_the_files() {
        for file in [Ending::Deadline, Ending::Cpu, Ending::Memory, Ending::Stack, Ending::Crash("SIGSEGV".into())] {
            let ending = file.clone().while_judging();
            assert_eq!((ending.blame(), ending.is_for_good()), (Blame::Ours, file.blame() == Blame::File), "{file:?}");
        }
        let ours = Ending::Killed("SIGKILL".into());
        assert_eq!((ours.clone().while_judging(), ours.is_for_good()), (ours, false));
    }
}
