//! Whether this process, and with it its workers, may have the memory that a grading needs.
//!
//! A shell's `ulimit -v`, a job server (Jobe's memory limit) or a service manager can bound the address space. Nothing
//! in a driver says so: it is not found, its device is lost, or an allocation fails in the midst of a grading, which must
//! not pass for the student's doing.

use crate::fault::Fault;
use crate::language::Text;
use crate::render::AdapterKind;
use nix::sys::resource::{RLIM_INFINITY, Resource, getrlimit};

/// Address space in which a worker opens its device, in bytes. Measured with Mesa 22.3 and LLVM 15: 0.57 GB, of which
/// the grader's stack is 0.27; below that it fails in one of several ways. The rest is room for larger drivers.
const WORKER: u64 = 1 << 30;

/// How far a worker got without enough memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// Its device was not opened yet.
    Start,
    /// It graded a file, which may take so many bytes over what the worker has.
    Grading(u64),
}

/// The fault where too little memory is why something failed, which `detail` tells; `None` where there is enough.
pub(super) fn shortage(adapter: AdapterKind, phase: Phase, detail: &Text) -> Option<Fault> {
    (adapter == AdapterKind::Software).then(|| shortage_within(limit()?, phase, detail)).flatten()
}

fn shortage_within(limit: u64, phase: Phase, detail: &Text) -> Option<Fault> {
    let file = match phase {
        Phase::Start => 0,
        Phase::Grading(file) => file,
    };
    (limit < WORKER + file).then(|| too_little(limit, detail))
}

/// The least of the bounds that are set on the memory of this process; `None` where no bound is set.
fn limit() -> Option<u64> {
    // A worker takes all of the first that it may; the second it leaves as it is.
    let space = getrlimit(Resource::RLIMIT_AS).map(|(_, hard)| hard);
    let data = getrlimit(Resource::RLIMIT_DATA).map(|(soft, _)| soft);
    [space, data].into_iter().flatten().filter(|limit| *limit != RLIM_INFINITY).min()
}

fn too_little(limit: u64, detail: &Text) -> Fault {
    let has = limit / 1_000_000;
    // What no grading exceeds: a worker, and the largest file on top of it.
    let needs = 2000;
    Fault::new(Text::new(
        format!("too little memory: this process may have {has} MB, and a grading needs up to {needs} MB ({})", detail.en),
        format!("メモリが足りません: このプロセスの上限は {has} MB ですが、採点には最大 {needs} MB 必要です ({})", detail.ja),
    ))
    .remedy(Text::new(
        "Raise the limit: `ulimit -v unlimited` in a shell, memory limit 0 in a CodeRunner question (and in Jobe's \
         configuration), LimitAS= of a systemd unit. ggrade bounds the memory of each submission itself.",
        "上限を引き上げてください。シェルでは `ulimit -v unlimited`、CodeRunner の問題 (および Jobe の設定) ではメモリ上限 0、\
         systemd のユニットでは LimitAS= です。提出ごとのメモリは ggrade 自身が制限します。",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_limit_that_is_too_low_is_blamed() {
        let detail = Text::new("no driver", "ドライバなし");
        let fault = shortage_within(400 << 20, Phase::Start, &detail).expect("a shortage");
        assert!(fault.message.en.contains("419 MB") && fault.message.en.contains("(no driver)"), "{fault}");
        assert!(fault.message.ja.contains("ドライバなし"));
        assert_eq!(shortage_within(WORKER, Phase::Start, &detail), None);
        // A worker starts in it, and a file may ask for more than is left.
        assert!(shortage_within(WORKER, Phase::Grading(768 << 20), &detail).is_some());
        assert_eq!(shortage_within(WORKER + (768 << 20), Phase::Grading(768 << 20), &detail), None);
    }
}
