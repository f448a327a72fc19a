//! Whether a stranger's archive has the folder of a homework. A worker that is used for nothing else unpacks it, reads it, and
//! grades its solution and the files that it hands out. That worker runs shaders of the stranger's, so nothing that it says of
//! the files is believed: a second one, which runs none, is given them and reads them within [`READING`]. What it has read, and
//! no other file, is read by the service.

use super::child::{REPORT_BYTES, Worker};
use super::message::Longest;
use super::protocol::{self, Answered, Demand, FileHead, Reply};
use super::unpacked::{MOST_BYTES, unpacked};
use super::{Settings, WorkerLimits};
use crate::expected;
use crate::fault::Fault;
use crate::grade::{Grader, Order};
use crate::language::Text;
use crate::pictures;
use crate::render::Device;
use crate::report::Report;
use crate::slots;
use reference::{Assignment, Folder};
use std::sync::Arc;
use std::time::Duration;

/// How long unpacking, reading and two gradings may take: pictures may be shaded pixel by pixel, on a busy machine.
const DEADLINE: Duration = Duration::from_secs(60);

/// What reading a folder and drawing what is right may take: the service does both once more, and so does each of its workers.
/// The built-in homeworks that an unoptimised build checks within the deadline are all read within this.
pub(super) const READING: WorkerLimits = WorkerLimits { memory: 256 << 20, cpu_seconds: 30 };

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
    let mut worker = fresh(settings)?;
    let longest = Longest { head: 2 * REPORT_BYTES, body: MOST_BYTES };
    let (reply, body) = match worker.ask(&Demand::Check, archive, longest, DEADLINE) {
        Ok(answered) => answered,
        Err(how) => return Ok(Err(ended(&how))),
    };
    match reply.outcome {
        Answered::Checked { files, solution, handed_out } => {
            let garbled = |error| Fault::new(Text::verbatim(format!("the files of a checked folder: {error}")));
            let (own, _) = protocol::files(&files, &body).map_err(garbled)?;
            let folder = Folder::of(own);
            let read = read(settings, files, &body)?;
            Ok(read.map(|()| CheckedFolder { folder, solution: *solution, handed_out: *handed_out }))
        }
        Answered::Refused(why) => Ok(Err(why)),
        Answered::Failed(fault) => Err(fault),
        Answered::Loaded | Answered::Drawn | Answered::Graded { .. } => Err(another_answer()),
    }
}

/// A worker that has met nobody's file. The kernel ends it with the thread that started it: the one that asks it, and waits.
fn fresh(settings: &Settings) -> Result<Worker, Fault> {
    let started = Worker::spawn(settings).and_then(|mut worker| worker.greet(settings).map(|()| worker));
    started.map_err(|failure| failure.fault)
}

/// Has the files read by a worker that draws nothing of theirs; why they cannot be, where they cannot.
fn read(settings: &Settings, files: Vec<FileHead>, body: &[u8]) -> Result<Result<(), Text>, Fault> {
    let longest = Longest { head: REPORT_BYTES, body: 0 };
    match fresh(settings)?.ask(&Demand::Read(files), body, longest, DEADLINE) {
        Ok((Reply { outcome: Answered::Loaded, .. }, _)) => Ok(Ok(())),
        Ok((Reply { outcome: Answered::Refused(why), .. }, _)) => Ok(Err(why)),
        Ok((Reply { outcome: Answered::Failed(fault), .. }, _)) => Err(fault),
        Ok(_) => Err(another_answer()),
        Err(how) => Ok(Err(too_much(&how))),
    }
}

fn another_answer() -> Fault {
    Fault::new(Text::verbatim("the answer to another question"))
}

/// The worker's side of [`read`].
pub(super) fn read_again(files: &[FileHead], body: &[u8]) -> Answered {
    let folder = match protocol::files(files, body) {
        Ok((files, [])) => Folder::of(files),
        _ => return Answered::Failed(Fault::new(Text::verbatim("files that do not fit their body"))),
    };
    match Assignment::load(folder) {
        Ok(assignment) => {
            pictures::expected_pictures(&assignment);
            pictures::telling_pose(&assignment);
            Answered::Loaded
        }
        Err(error) => Answered::Refused(error.text().into()),
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
    let assignment = Arc::new(loaded.map_err(|error| error.text())?);
    // The device has drawn before: what cannot be drawn now is the folder's doing.
    let why = |fault: Fault| fault.message;
    let (expected, _) = expected::prepared(&assignment, None, None).map_err(why)?;
    let mut grader = Grader::new(device.clone(), Arc::clone(&assignment), expected).map_err(why)?;
    let mut report = |hand_in| grader.grade(&hand_in, Order::default()).map(|graded| graded.report).map_err(why);
    let solution = report(slots::solution(&assignment))?;
    let handed_out = report(slots::handed_out(&assignment))?;
    Ok(((*assignment.folder).clone(), solution, handed_out))
}

fn too_much(how: &str) -> Text {
    let (seconds, mebibytes) = (READING.cpu_seconds, READING.memory >> 20);
    let how = how.lines().next().unwrap_or_default();
    Text::new(
        format!(
            "reading it and drawing its right pictures takes more than {seconds} s or {mebibytes} MiB ({how}): make its textures, meshes and window smaller, or draw fewer poses"
        ),
        format!(
            "読み込みと正解の画像の描画に {seconds} 秒または {mebibytes} MiB を超える時間やメモリが必要です（{how}）。テクスチャ、メッシュ、ウィンドウを小さくするか、ポーズを減らしてください"
        ),
    )
}

fn ended(how: &str) -> Text {
    Text::new(
        format!("the process that read it ended ({how}): it needs too much time or memory, or crashes what draws it"),
        format!(
            "読み込み中のプロセスが終了しました（{how}）。時間やメモリを使いすぎているか、描画処理を異常終了させています"
        ),
    )
}
