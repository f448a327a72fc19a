//! Whether a stranger's archive has the folder of a homework. A worker that is used for nothing else unpacks it, reads it, and
//! grades its solution and the files that it hands out.

use super::Settings;
use super::child::{REPORT_BYTES, Worker};
use super::protocol::{self, Answered, Demand, FileHead, Longest};
use super::unpacked::{MOST_BYTES, unpacked};
use crate::expected;
use crate::fault::Fault;
use crate::grade::{self, Grader, Order};
use crate::language::Text;
use crate::render::Device;
use crate::report::Report;
use reference::{Assignment, Folder};
use std::sync::Arc;
use std::time::Duration;

/// How long unpacking, reading and two gradings may take: pictures may be shaded pixel by pixel, on a busy machine.
const DEADLINE: Duration = Duration::from_secs(60);

/// The folder of a homework, as a worker has read it.
#[derive(Clone, Debug)]
pub struct CheckedFolder {
    /// Its files, with those of the built-in homework that it extends.
    pub folder: Folder,
    /// What its own solution gets.
    pub solution: Report,
    /// What the files get that it hands out.
    pub handed_out: Report,
}

/// The parent's side. An error is ours; what is wrong with the archive is a text for its teacher.
pub(super) fn check(settings: &Settings, archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
    // The kernel ends a worker with the thread that started it: this one, which waits here.
    let started = Worker::spawn(settings).and_then(|mut worker| worker.greet(settings).map(|()| worker));
    let mut worker = started.map_err(|failure| failure.fault)?;
    let longest = Longest { head: 2 * REPORT_BYTES, body: MOST_BYTES };
    let (reply, body) = match worker.ask(&Demand::Check, archive, longest, DEADLINE) {
        Ok(answered) => answered,
        Err(how) => return Ok(Err(ended(&how))),
    };
    match reply.outcome {
        Answered::Checked { files, solution, handed_out } => {
            let garbled = |error| Fault::new(Text::verbatim(format!("the files of a checked folder: {error}")));
            let (files, _) = protocol::files(&files, &body).map_err(garbled)?;
            Ok(Ok(CheckedFolder { folder: Folder::of(files), solution: *solution, handed_out: *handed_out }))
        }
        Answered::Refused(why) => Ok(Err(why)),
        Answered::Failed(fault) => Err(fault),
        Answered::Loaded | Answered::Graded { .. } => Err(Fault::new(Text::verbatim("the answer to another question"))),
    }
}

/// The worker's side: the answer, and its body.
pub(super) fn answer(device: &Device, archive: &[u8]) -> (Answered, Vec<u8>) {
    match checked(device, archive) {
        Ok((folder, solution, handed_out)) => {
            let files = folder.files.iter().map(|(name, bytes)| FileHead::of(name, bytes)).collect();
            let body = folder.files.values().map(Vec::as_slice).collect::<Vec<_>>().concat();
            (Answered::Checked { files, solution: Box::new(solution), handed_out: Box::new(handed_out) }, body)
        }
        Err(why) => (Answered::Refused(why), Vec::new()),
    }
}

fn checked(device: &Device, archive: &[u8]) -> Result<(Folder, Report, Report), Text> {
    let folder = unpacked(archive)?;
    let loaded = folder.with_bases(None).and_then(Assignment::load);
    let assignment = Arc::new(loaded.map_err(|error| {
        let why = error.text();
        Text::new(why.en, why.ja)
    })?);
    // The device has drawn before: what cannot be drawn now is the folder's doing.
    let why = |fault: Fault| fault.message;
    let (expected, _) = expected::prepared(&assignment, None, None).map_err(why)?;
    let mut grader = Grader::new(device.clone(), Arc::clone(&assignment), expected).map_err(why)?;
    let mut report = |hand_in| grader.grade(&hand_in, Order::default()).map(|graded| graded.report).map_err(why);
    let solution = report(grade::solution(&assignment))?;
    let handed_out = report(grade::handed_out(&assignment))?;
    Ok(((*assignment.folder).clone(), solution, handed_out))
}

fn ended(how: &str) -> Text {
    Text::new(
        format!("the process that read it ended ({how}): it needs too much time or memory, or crashes what draws it"),
        format!(
            "読み込み中のプロセスが終了しました（{how}）。時間やメモリを使いすぎているか、描画処理を異常終了させています"
        ),
    )
}
