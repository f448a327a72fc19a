//! The interpreter on the samples of the corpus, without a driver.

use glam::DVec4;
use reference::interpreter::{Program, Stage};
use reference::{Assignment, Value, assignment};
use std::path::{Path, PathBuf};

/// Largest difference from the equation, which is evaluated in f64 as well: some samples say 3.14159 for π, or go
/// through values of 16 bits.
const TOLERANCE: f64 = 1e-4;

/// Samples that ask for what GLSL does not promise: whether the root of −1 is no number, whether 1 / 0 is infinite.
const ASK_FOR_MORE: [&str; 2] = ["builtin-float-bits", "builtin-isnan-isinf"];

fn samples(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../submissions/ggsample06").join(folder);
    let mut folders = vec![root];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of samples") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "vert") {
                files.push(path);
            }
        }
    }
    files.sort();
    assert!(!files.is_empty(), "no sample in {folder}");
    files
}

/// The text of a sample; none where it is not UTF-8.
fn text(path: &Path) -> Option<String> {
    let text = String::from_utf8(std::fs::read(path).expect("a sample")).ok()?;
    Some(text.trim_start_matches('\u{feff}').to_owned())
}

/// All probes as columns, one for each scalar of an interface's variable.
struct Columns(Vec<(String, Vec<Vec<f64>>)>);

impl Columns {
    fn new<'a>(names: impl Iterator<Item = &'a String>, samples: &[&[Value]]) -> Self {
        let column = |(index, name): (usize, &String)| {
            let count = samples[0][index].numbers().len();
            let mut columns = vec![Vec::new(); count];
            for sample in samples {
                columns.iter_mut().zip(sample[index].numbers()).for_each(|(column, number)| column.push(*number));
            }
            (name.clone(), columns)
        };
        Self(names.enumerate().map(column).collect())
    }
}

/// What a program gives for all probes: colours and positions, and how many of them are undefined.
fn probed(assignment: &Assignment, program: &Program) -> Result<(Vec<[DVec4; 2]>, usize), String> {
    let probes = assignment.probes(1);
    let attributes: Vec<&[Value]> = probes.iter().map(|probe| probe.attributes.as_slice()).collect();
    let uniforms: Vec<&[Value]> = probes.iter().map(|probe| probes.uniforms(probe)).collect();
    let attributes = Columns::new(assignment.interface.inputs.iter().map(|input| &input.name), &attributes);
    let uniforms = Columns::new(assignment.interface.uniforms.iter().map(|uniform| &uniform.path), &uniforms);
    let mut run = program.run(probes.probes.len());
    for (name, columns) in &attributes.0 {
        if let Some(input) = program.inputs().iter().find(|input| input.name == *name) {
            let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            let count = input.kind.slots().unwrap_or(0).min(columns.len());
            run = run.input(name, &columns[..count]).map_err(|error| error.to_string())?;
        }
    }
    for (name, columns) in &uniforms.0 {
        if program.uniforms().iter().any(|uniform| uniform.name == *name) {
            let columns = columns.iter().map(Vec::as_slice);
            run = run.uniform_of_each(name, columns).map_err(|error| error.to_string())?;
        }
    }
    let outputs = run.outputs().map_err(|stopped| format!("stopped at line {}", stopped.line))?;
    let output = |name: &str| outputs.get(name).ok_or_else(|| format!("there is no {name}"));
    let (colour, position) = (output("vc")?, output("gl_Position")?);
    let vector = |values: Vec<f64>| DVec4::from_array([0, 1, 2, 3].map(|n| values.get(n).copied().unwrap_or(1.0)));
    let values = (0..probes.probes.len()).map(|n| [vector(colour.sample(n)), vector(position.sample(n))]).collect();
    let is_undefined = |n: &usize| {
        let red_green_blue = (0..3).any(|scalar| colour.undefined(scalar, *n).is_some());
        red_green_blue || (0..4).any(|scalar| position.undefined(scalar, *n).is_some())
    };
    let undefined = (0..probes.probes.len()).filter(is_undefined).count();
    Ok((values, undefined))
}

/// Every accepted sample, whatever it is written with, computes what the equation says, and nothing undefined.
#[test]
fn accepted_samples_compute_the_equation() {
    let assignment = assignment("ggsample06").expect("built in");
    let probes = assignment.probes(1);
    let mut wrong = Vec::new();
    let mut checked = 0;
    for path in samples("accepted") {
        let Some(text) = text(&path) else { continue };
        checked += 1;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let program = match Program::compile(&text, Stage::Vertex) {
            Ok(program) => program,
            Err(refusal) => {
                wrong.push(format!("{name}: {refusal}"));
                continue;
            }
        };
        match probed(assignment, &program) {
            Err(error) => wrong.push(format!("{name}: {error}")),
            Ok((values, undefined)) => {
                let difference = |(probe, [colour, position]): (&reference::probes::Probe, &[DVec4; 2])| {
                    // What is not a number is as far off as can be.
                    if !colour.truncate().is_finite() || !position.is_finite() {
                        return f64::INFINITY;
                    }
                    let scale = probe.position.abs().max_element().max(1.0);
                    let apart = (position - probe.position).abs().max_element() / scale;
                    (colour.truncate() - probe.colour).abs().max_element().max(apart)
                };
                let worst = probes.iter().zip(&values).map(difference).fold(0.0, f64::max);
                if worst > TOLERANCE || (undefined > 0 && !ASK_FOR_MORE.contains(&&*name)) {
                    wrong.push(format!("{name}: differs by {worst:.1e}, {undefined} undefined"));
                }
            }
        }
    }
    assert!(checked > 430, "only {checked} samples");
    assert!(wrong.is_empty(), "{} of {checked}:\n{}", wrong.len(), wrong.join("\n"));
}

/// Every wrong sample that a driver takes is taken.
#[test]
fn wrong_samples_are_taken() {
    for path in samples("wrong") {
        let Some(text) = text(&path) else { continue };
        if let Err(refusal) = Program::compile(&text, Stage::Vertex) {
            panic!("{}: {refusal}", path.display());
        }
    }
}

/// Whatever a hostile file contains, it is refused or ends.
#[test]
fn hostile_samples_end() {
    let (mut ended, mut stopped, mut refused) = (0, 0, 0);
    for path in samples("hostile").into_iter().chain(samples("rejected")) {
        let text = String::from_utf8_lossy(&std::fs::read(&path).expect("a sample")).into_owned();
        match Program::compile(&text, Stage::Vertex) {
            Err(_) => refused += 1,
            Ok(program) => match program.run(8).fuel(2_000_000).outputs() {
                Ok(_) => ended += 1,
                Err(_) => stopped += 1,
            },
        }
    }
    assert!(ended > 100 && stopped > 10 && refused > 100, "{ended} ended, {stopped} were stopped, {refused} refused");
}
