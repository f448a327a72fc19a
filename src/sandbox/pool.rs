//! Workers kept warm, each submission graded by one of them.

use super::Settings;
use super::child::{Ended, Worker};
use super::protocol::{Reply, Request, Tile};
use crate::diagnostic::{Diagnostic, Stage};
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::Text;
use crate::report::{Environment, Picture, Report, Verdict};
use std::sync::{Mutex, PoisonError};

/// A file to grade.
#[derive(Clone, Copy, Debug)]
pub struct Submission<'a> {
    /// Its name as handed in.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
    /// How it is to be graded.
    pub order: Order,
    /// Whether the frames are wanted, not only their comparison.
    pub wants_frames: bool,
}

/// A graded file.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The report.
    pub report: Report,
    /// The student's frames, where they were wanted and drawn.
    pub frames: Vec<Picture>,
}

/// Workers for one assignment. Any number of threads may grade at once; each takes a worker of its own.
#[derive(Debug)]
pub struct Pool {
    settings: Settings,
    assignment: &'static reference::Assignment,
    idle: Mutex<Vec<Worker>>,
}

impl Pool {
    /// Starts `workers` workers.
    pub fn start(settings: Settings, workers: usize) -> Result<Self, Fault> {
        let assignment = reference::assignment(&settings.assignment).ok_or_else(|| unknown(&settings.assignment))?;
        let started = std::thread::scope(|scope| {
            let starts: Vec<_> = (0..workers).map(|_| scope.spawn(|| Worker::start(&settings))).collect();
            starts.into_iter().map(|start| start.join().unwrap_or_else(|_| Err(panicked()))).collect()
        });
        let idle: Result<Vec<Worker>, Fault> = started;
        Ok(Self { settings, assignment, idle: Mutex::new(idle?) })
    }

    /// Grades one submission. A fault is ours; whatever the file does to a worker is a verdict.
    pub fn grade(&self, submission: Submission<'_>) -> Result<Answer, Fault> {
        let taken = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut worker = match taken {
            Some(worker) => worker,
            None => Worker::start(&self.settings)?,
        };
        let request =
            Request { name: submission.name.into(), order: submission.order, wants_frames: submission.wants_frames };
        let ended = match worker.grade(&request, submission.bytes, self.settings.deadline) {
            Ok((Reply::Graded { report, frames }, body)) => {
                let frames = self.paste(&frames, &body);
                self.put_back(worker);
                return Ok(Answer { report: *report, frames });
            }
            Ok((Reply::Failed(fault), _)) => return Err(fault),
            Err(ended) => ended,
        };
        let environment = worker.environment.clone();
        drop(worker);
        Ok(Answer { report: self.stopped(submission, ended, environment)?, frames: Vec::new() })
    }

    fn put_back(&self, worker: Worker) {
        if worker.gradings < self.settings.gradings_per_worker {
            self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(worker);
        }
    }

    /// The whole frames of which `tiles` are the painted parts.
    fn paste(&self, tiles: &[Tile], body: &[u8]) -> Vec<Picture> {
        let scene = &self.assignment.scene;
        let (width, height) = (scene.width, scene.height);
        let mut rest = body;
        let mut pictures = Vec::new();
        for tile in tiles {
            if tile.x + tile.width > width || tile.y + tile.height > height || rest.len() < tile.bytes() {
                break;
            }
            let (pixels, others) = rest.split_at(tile.bytes());
            rest = others;
            let mut rgba = scene.background.repeat((width * height) as usize);
            for (row, y) in pixels.chunks_exact(tile.width.max(1) as usize * 4).zip(tile.y..) {
                let start = ((y * width + tile.x) * 4) as usize;
                rgba[start..start + row.len()].copy_from_slice(row);
            }
            pictures.push(Picture { width, height, rgba });
        }
        pictures
    }

    fn stopped(&self, submission: Submission<'_>, ended: Ended, environment: Environment) -> Result<Report, Fault> {
        let message = match ended {
            Ended::Deadline => {
                let seconds = self.settings.deadline.as_secs_f64();
                Text::new(
                    format!("the shader did not finish within {seconds} s (time limit)"),
                    format!("{seconds} 秒以内に処理が終わりませんでした (時間制限)"),
                )
            }
            Ended::Died(status) => Text::new(
                format!("the shader crashed the renderer ({status})"),
                format!("このシェーダでレンダラが異常終了しました ({status})"),
            ),
            Ended::Protocol(detail) => return Err(protocol_broken(&detail)),
        };
        let diagnostic = Diagnostic::error(Stage::Run, message);
        Ok(crate::grade::unfinished(
            self.assignment,
            crate::grade::source_info(submission.name, submission.bytes),
            Verdict::Stopped,
            vec![diagnostic],
            environment,
        ))
    }
}

fn unknown(id: &str) -> Fault {
    Fault::new(Text::new(format!("there is no assignment `{id}`"), format!("課題 `{id}` はありません")))
}

fn panicked() -> Fault {
    Fault::new(Text::new("a start-up thread panicked", "起動スレッドが異常終了しました"))
}

fn protocol_broken(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("the grading process gave an unreadable answer: {detail}"),
        format!("採点プロセスの応答を読み取れません: {detail}"),
    ))
}
