//! The pipeline: the only module that knows all the stages.

mod extended;
mod judged;
mod map_lookup;
mod own_values;
mod programs;
mod unfinished;
mod vertex_shader;

pub use unfinished::{sources, unfinished};

use programs::Programs;

use crate::compare::ExpectedFrame;
use crate::diagnose::advice::{self, Beyond};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::expected;
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::render::{AdapterKind, Device, Frames, RenderScene, Renderer};
use crate::report::{Environment, Hints, Report, SourceInfo, Verdict};
use crate::slots::{self, Trust};
use crate::translate::{self, LinkedInterface};
use reference::Assignment;
use reference::accepted::AcceptedAnswer;
use reference::probes::{Crossings, ProbeSet};
use serde::{Deserialize, Serialize};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

/// How a hand-in is to be graded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Order {
    /// Seed of the fresh probes; the same seed gives the same ones.
    pub seed: u64,
    /// How much the messages help.
    pub hints: Hints,
    /// Whether the interpreter runs the file as well.
    #[serde(default)]
    pub cross_check: bool,
}

/// A graded hand-in.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The report.
    pub report: Report,
    /// What the shader drew, where it drew.
    pub frames: Option<Frames>,
}

/// Grades files for one assignment on one device. It meets untrusted bytes: run it in a worker process.
#[derive(Debug)]
pub struct Grader {
    assignment: Arc<Assignment>,
    interface: LinkedInterface,
    renderer: Renderer,
    expected: Vec<ExpectedFrame>,
    /// The same of every answer that is right beside the solution.
    accepted: Vec<(AcceptedAnswer, Vec<ExpectedFrame>)>,
    /// The probes that judge.
    probes: ProbeSet,
    /// Those across edges, where the homework judges by them.
    crossings: Option<Crossings>,
    environment: Environment,
    /// What advice comes from.
    beyond: Vec<Beyond>,
    /// The program, where the homework is more than a vertex shader of definitions.
    programs: Option<Programs>,
    /// The last seed's: a class is graded with one seed.
    last: Option<Rc<SeedScene>>,
}

/// What is drawn for one seed.
#[derive(Debug)]
struct SeedScene {
    fresh: ProbeSet,
    scene: RenderScene,
}

impl Grader {
    /// A grader of its own device, which computes what is expected.
    pub fn open(assignment: Arc<Assignment>, adapter: AdapterKind) -> Result<Self, Fault> {
        let (expected, _) = expected::prepared(&assignment, None, None)?;
        Self::new(Device::open(adapter)?, assignment, expected)
    }

    /// What it grades.
    pub fn assignment(&self) -> &Assignment {
        &self.assignment
    }

    /// A grader on an open device. `expected` are the assignment's right pictures, in the order of [`expected::frames`].
    pub fn new(device: Device, assignment: Arc<Assignment>, expected: Vec<ExpectedFrame>) -> Result<Self, Fault> {
        let interface = LinkedInterface::of(&assignment)?;
        let environment = environment(&device);
        let programs = Programs::of(&assignment)?;
        let fixed = match &programs {
            Some(_) => None,
            None => Some(translate::fixed_stage(&interface, assignment.files[0].starter_shader())?),
        };
        let renderer = Renderer::new(device, fixed.as_ref())?;
        renderer.prepare(&assignment.textures);
        let mut expected = expected;
        let mut others = expected.split_off(assignment.scene.all_poses().len().min(expected.len()));
        let poses = expected.len();
        let accepted = assignment.accepted().map(|answer| {
            let rest = others.split_off(poses.min(others.len()));
            (answer.clone(), std::mem::replace(&mut others, rest))
        });
        let accepted = accepted.collect();
        let probes = assignment.judging_probes();
        let crossings = assignment.crossings();
        let beyond = advice::beyond(&assignment, &probes);
        Ok(Self {
            assignment,
            interface,
            renderer,
            expected,
            accepted,
            probes,
            crossings,
            environment,
            beyond,
            programs,
            last: None,
        })
    }

    /// Gives back what the last grading leaves for the next, where none may follow for long.
    pub fn put_away(&mut self) {
        self.renderer.put_away();
    }

    /// Grades one hand-in.
    pub fn grade(&mut self, hand_in: &HandIn, order: Order) -> Result<Graded, Fault> {
        self.grade_in_two(hand_in, order, &mut || ())
    }

    /// The same. `drawn` is called once what was handed in has run: what still takes time from there on is ours.
    pub fn grade_in_two(&mut self, hand_in: &HandIn, order: Order, drawn: &mut dyn FnMut()) -> Result<Graded, Fault> {
        let start = Instant::now();
        // A panic of the translator or renderer is our limit. The process is not to be used again.
        let judged = catch_unwind(AssertUnwindSafe(|| self.judge(hand_in, order, drawn)));
        let mut graded = judged.unwrap_or_else(|panic| {
            Err(translate::unsupported(&format!("ggrade broke off ({})", panic_message(&*panic))))
        })?;
        graded.report.name_file();
        graded.report.hints = order.hints;
        if order.hints == Hints::None {
            graded.report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.hint = None);
        }
        graded.report.elapsed_ms = start.elapsed().as_secs_f64() * 1e3;
        Ok(graded)
    }

    fn judge(&mut self, hand_in: &HandIn, order: Order, drawn: &mut dyn FnMut()) -> Result<Graded, Fault> {
        let arranged = slots::arrange(&self.assignment.files, hand_in, Trust::Named);
        let sources = unfinished::described(&self.assignment, hand_in, arranged.as_ref().ok());
        let files = match arranged {
            Ok(arranged) => arranged.files,
            Err(why) => return Ok(self.rejected(sources, vec![Diagnostic::error(DiagnosticStage::Source, why)])),
        };
        match files.as_slice() {
            [file] if self.programs.is_none() => self.judge_vertex_shader(sources, file, order, drawn),
            files => self.judge_program(sources, files, order, drawn),
        }
    }

    fn probing(&mut self, seed: u64) -> Rc<SeedScene> {
        if let Some(last) = self.last.as_ref().filter(|last| last.fresh.seed == seed) {
            return Rc::clone(last);
        }
        let fresh = self.assignment.fresh_probes(seed);
        let sets: Vec<&ProbeSet> = [&self.probes, &fresh]
            .into_iter()
            .chain(self.crossings.iter().map(|crossings| &crossings.probes))
            .collect();
        let scene = RenderScene::of(&self.assignment, &sets);
        Rc::clone(self.last.insert(Rc::new(SeedScene { fresh, scene })))
    }

    fn rejected(&self, sources: Vec<SourceInfo>, diagnostics: Vec<Diagnostic>) -> Graded {
        self.refused(sources, Verdict::Rejected, diagnostics)
    }

    fn refused(&self, sources: Vec<SourceInfo>, verdict: Verdict, diagnostics: Vec<Diagnostic>) -> Graded {
        let environment = self.environment.clone();
        let report = unfinished(&self.assignment, sources, verdict, diagnostics, environment);
        Graded { report, frames: None }
    }
}

/// What grades on a device.
pub fn environment(device: &Device) -> Environment {
    Environment {
        ggrade: env!("CARGO_PKG_VERSION").into(),
        renderer: device.renderer.clone(),
        driver: device.driver.clone(),
    }
}

/// What a panic says.
fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("internal error").to_owned()
}

/// A seed that nobody knows beforehand, small enough to be typed and to be exact in every JSON reader.
pub fn random_seed() -> u64 {
    use std::hash::{BuildHasher, RandomState};
    RandomState::new().hash_one(std::process::id()) % 1_000_000_000
}
