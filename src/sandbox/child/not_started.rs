//! Why there is no worker, and what is said of that.

use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::protection::Protection;
use crate::sandbox::{Settings, memory};
use reference::Assignment;

/// Why there is no worker.
#[derive(Debug)]
pub(in crate::sandbox) struct NotStarted {
    pub fault: Fault,
    /// Whether another try may end otherwise.
    pub transient: bool,
}

impl NotStarted {
    /// The same with too little memory as the reason, where that is it.
    pub(super) fn explained(self, settings: &Settings) -> Self {
        match memory::shortage(settings.adapter, memory::Phase::Start, &self.fault.message) {
            Some(fault) => Self { fault, transient: false },
            None => self,
        }
    }
}

pub(super) fn cannot_start(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the grading process cannot be started: {detail}"),
        format!("採点プロセスを起動できません: {detail}"),
    ))
    .remedy(Text::new("`ggrade doctor` checks the machine.", "`ggrade doctor` でこのマシンを調べられます。"))
}

pub(super) fn cannot_read(assignment: &Assignment, detail: &str) -> Fault {
    let id = &assignment.id;
    Fault::new(Text::new(
        format!("the grading process cannot read the assignment {id}: {detail}"),
        format!("採点プロセスが課題 {id} を読み込めません: {detail}"),
    ))
    .remedy(Text::new(
        "`ggrade assignment check FOLDER` checks the folder, `ggrade doctor` the machine.",
        "`ggrade assignment check フォルダ` で課題のフォルダを、`ggrade doctor` でこのマシンを調べられます。",
    ))
}

pub(super) fn not_closed(protection: &Protection) -> Fault {
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
