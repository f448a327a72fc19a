//! The child's side: a confined process with a warm device, which reads assignments, and grades one submission after the
//! other.

use super::confine::{self, Confined, GradingMeter, lower};
use super::message::{receive, send};
use super::preflight::{self, IntrusionAttempt};
use super::protection::{Layer, Protection};
use super::protocol::{Answered, Demand, FileHead, GradingRequest, Hello, Load, REQUEST, Reply};
use super::{JUDGING, WorkerLimits, check, syscalls};
use crate::expected::{self, Pack};
use crate::fault::Fault;
use crate::ffi::allocator;
use crate::grade::{self, Graded, Grader, Order};
use crate::language::Text;
use crate::render::{AdapterKind, Device, Frames};
use crate::report::Area;
use crate::slots;
use crate::translate;
use nix::sys::resource::Resource;
use reference::{Assignment, Folder};
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;
use std::time::Duration;

/// Stack of the thread that grades: translators recurse over the student's nesting.
const STACK_BYTES: usize = 256 << 20;

/// What reading an assignment may take: its pictures may be shaded pixel by pixel, which takes seconds.
const LOADING: WorkerLimits = WorkerLimits { memory: 1 << 30, cpu_seconds: 120 };

/// What a worker is started for.
#[derive(Clone, Copy, Debug)]
pub struct WorkerTask {
    /// What renders.
    pub adapter: AdapterKind,
    /// What one submission may take.
    pub limits: WorkerLimits,
    /// Whether to end once the first assignment is read.
    pub rehearsal: bool,
}

/// Serves the parent on standard input and output until it closes them.
pub fn run(job: WorkerTask) -> io::Result<()> {
    let confined = confine::enter(job.limits, job.adapter)?;
    on_large_stack(move || serve(job, confined))
}

/// Enters the sandbox as [`run`] does, tries one forbidden thing there, and gives what came of it.
pub fn attempt(job: WorkerTask, attempt: IntrusionAttempt) -> io::Result<io::Result<()>> {
    let confined = confine::enter(job.limits, job.adapter)?;
    on_large_stack(move || {
        let Confined { layers, meter, .. } = confined;
        let _ready = prepare(job, layers).map_err(|fault| io::Error::other(fault.message.en))?;
        meter.next(job.adapter, 1)?;
        Ok(attempt.make())
    })
}

fn on_large_stack<T: Send + 'static>(work: impl FnOnce() -> io::Result<T> + Send + 'static) -> io::Result<T> {
    let thread = std::thread::Builder::new().name("grader".into()).stack_size(STACK_BYTES);
    thread.spawn(work)?.join().map_err(|_| io::Error::other("the grader panicked"))?
}

fn serve(job: WorkerTask, confined: Confined) -> io::Result<()> {
    let Confined { mut output, layers, meter } = confined;
    let (device, protection) = match prepare(job, layers) {
        Ok(ready) => ready,
        Err(fault) => return send(&mut output, &Hello::Failed(fault), 0, |_| Ok(())),
    };
    let hello = Hello::Ready { environment: grade::environment(&device), protection };
    send(&mut output, &hello, 0, |_| Ok(()))?;
    let size = meter.size()?;
    let mut desk = ReadyWorker { job, output, meter, device, graders: HashMap::new(), size };
    let mut input = io::stdin().lock();
    loop {
        let (demand, body) = match receive::<Demand>(&mut input, REQUEST) {
            Ok(message) => message,
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(()),
            Err(error) => return Err(error),
        };
        match demand {
            Demand::Load(load) => desk.load(&load, &body)?,
            Demand::Grade(request) => desk.grade(&request, &body)?,
            Demand::Check => desk.check(&body)?,
            Demand::Read(files) => desk.read_again(&files, &body)?,
        }
        if job.rehearsal {
            return Ok(());
        }
    }
}

/// Opens the device, warms the compiler meanwhile, and closes the sandbox around them. What is read after that, the
/// assignment's folder included, is read inside.
fn prepare(job: WorkerTask, mut layers: Vec<super::LayerState>) -> Result<(Device, Protection), Fault> {
    let device = std::thread::scope(|scope| {
        let device = scope.spawn(|| Device::open(job.adapter));
        translate::warm_up();
        device.join()
    });
    let device = device.map_err(|_| Fault::new(Text::new("start-up panicked", "起動処理が異常終了しました")))??;
    let filtered = syscalls::restrict(job.adapter);
    if filtered.is_err() {
        // Without filters this at least keeps new processes away, and new threads with them.
        let _ = lower(Resource::RLIMIT_NPROC, 0);
    }
    let open = preflight::open();
    let filtered = filtered.and_then(|detail| syscalls::make_deadly().map(|()| detail));
    layers.push(confine::state(Layer::SystemCalls, filtered));
    Ok((device, Protection { layers, open }))
}

/// A worker that is ready: its device, and the assignments that it has read.
struct ReadyWorker {
    job: WorkerTask,
    output: File,
    meter: GradingMeter,
    device: Device,
    /// By the digest of the assignment.
    graders: HashMap<String, Grader>,
    /// The size of the process before the first submission.
    size: u64,
}

impl ReadyWorker {
    fn load(&mut self, load: &Load, body: &[u8]) -> io::Result<()> {
        self.meter.give(LOADING, self.job.adapter)?;
        let (folder, pictures) = load.folder(body)?;
        let loaded = self.read(load, folder, pictures);
        self.size = self.size.max(self.meter.size()?);
        let (outcome, pack) = match loaded {
            Ok(pack) => (Answered::Loaded, pack),
            Err(fault) => (Answered::Failed(fault), None),
        };
        let body = pack.as_ref().map(Pack::bytes).unwrap_or_default();
        let reply = Reply { id: load.id, spent: false, outcome };
        send(&mut self.output, &reply, body.len(), |to| to.write_all(body))
    }

    /// Reads an assignment; gives its pictures where they are wanted.
    fn read(&mut self, load: &Load, folder: Folder, pictures: Option<&[u8]>) -> Result<Option<Pack>, Fault> {
        let assignment = Assignment::load(folder).map_err(|error| Fault::new(error.text().into()))?;
        let given = pictures.map(Pack::of_bytes);
        let above = load.wants_pictures_above_ms.map(Duration::from_millis);
        let (expected, pack) = expected::prepared(&assignment, given.as_ref(), above)?;
        let assignment = Arc::new(assignment);
        let mut grader = Grader::new(self.device.clone(), Arc::clone(&assignment), expected)?;
        if load.warm_up {
            grader.grade(&slots::handed_out(&assignment), Order::default())?;
            // A spare may wait for hours, and of several homeworks most do: frames and what the compilers freed are 20 MB.
            grader.put_away();
            allocator::trim();
        }
        self.graders.insert(assignment.digest.clone(), grader);
        Ok(pack)
    }

    /// Reads a stranger's archive, and grades the files in it.
    fn check(&mut self, archive: &[u8]) -> io::Result<()> {
        self.meter.give(LOADING, self.job.adapter)?;
        let (outcome, body) = check::answer(&self.device, archive);
        send(&mut self.output, &Reply { id: 0, spent: true, outcome }, body.len(), |to| to.write_all(&body))
    }

    /// Reads a folder, as the service will.
    fn read_again(&mut self, files: &[FileHead], body: &[u8]) -> io::Result<()> {
        self.meter.give(check::READING, self.job.adapter)?;
        let outcome = check::read_again(files, body);
        send(&mut self.output, &Reply { id: 0, spent: true, outcome }, 0, |_| Ok(()))
    }

    /// Grades one submission.
    fn grade(&mut self, request: &GradingRequest, body: &[u8]) -> io::Result<()> {
        let time = self.graders.get(&request.assignment).map_or(1, |grader| grader.assignment().time);
        self.meter.next(self.job.adapter, time)?;
        let unread = || Fault::new(Text::verbatim("the assignment was not read"));
        let hand_in = request.hand_in(body)?;
        let grader = self.graders.get_mut(&request.assignment).ok_or_else(unread);
        let (output, meter) = (&mut self.output, &self.meter);
        let reply = |spent, outcome| Reply { id: request.id, spent, outcome };
        let mut told = Ok(());
        let mut drawn = || {
            let time = meter.give_time(JUDGING.as_secs().saturating_mul(u64::from(time)));
            told = time.and_then(|()| send(output, &reply(false, Answered::Drawn), 0, |_| Ok(())));
        };
        let graded = grader.and_then(|grader| grader.grade_in_two(&hand_in, request.order, &mut drawn));
        told?;
        let spent = meter.size()? > self.size + self.job.limits.memory;
        let reply = |outcome| reply(spent, outcome);
        let Graded { report, frames } = match graded {
            Ok(graded) => graded,
            Err(fault) => return send(output, &reply(Answered::Failed(fault)), 0, |_| Ok(())),
        };
        let frames = frames.filter(|_| request.wants_frames).unwrap_or_default();
        let areas: Vec<Area> = (0..frames.count).map(|index| painted(&frames, index)).collect();
        let length = areas.iter().map(|area| area.width as usize * area.height as usize * 4).sum();
        let graded = Answered::Graded { report: Box::new(report), frames: areas.clone() };
        // Row by row from where the device left them: a copy of all would be as large as everything else.
        send(output, &reply(graded), length, |to| {
            for (index, area) in (0..).zip(&areas) {
                let left = area.x.saturating_sub(frames.area(index).x) as usize * 4;
                for y in area.rows() {
                    to.write_all(&frames.row(index, y)[left..left + area.width as usize * 4])?;
                }
            }
            Ok(())
        })
    }
}

/// The least part that holds every pixel that was painted.
fn painted(frames: &Frames, index: u32) -> Area {
    Area::foreground(frames.area(index), frames.background, |y| frames.row(index, y).as_chunks().0)
}
