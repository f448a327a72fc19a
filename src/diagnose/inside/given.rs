//! What a text is given, and whether its colour has anything of it.

use super::Stage;
use super::walk::roots;
use crate::diagnose::Evidence;
use crate::diagnose::columns::is_constant;
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges, chosen, place};
use reference::assignment::RubricItem;
use reference::feature::FeatureValue;
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Program, ProgramVariable, is_lookup, root};
use reference::pipeline::POSITION;
use reference::traced::{Bench, Place, TracedProgram};
use std::collections::BTreeSet;

/// Whether all that is seen is made of nothing that a program gives the shaders: of no attribute and of no uniform.
pub(in crate::diagnose) fn ignores_all(evidence: &Evidence<'_>) -> bool {
    let Some((theirs, [vertex, Some(fragment)])) = traced(evidence) else { return false };
    let uniforms = &evidence.assignment.interface.uniforms;
    let is_uniform = |name: &String| uniforms.iter().any(|own| own.path.split('.').next() == Some(name));
    let read = read_on_the_way(theirs.stage(Stage::Fragment), &fragment, &roots(&fragment));
    let outputs = read.varying.iter().map(|name| theirs.interpolated_from(name)).collect::<Option<Vec<usize>>>();
    let Some(outputs) = outputs.filter(|_| !read.all.iter().any(is_uniform)) else { return false };
    let Some(vertex) = vertex else { return outputs.is_empty() };
    let roots: Vec<usize> = outputs.iter().flat_map(|output| vertex.outputs[*output].clone()).collect();
    let read = read_on_the_way(theirs.stage(Stage::Vertex), &vertex, &roots);
    read.varying.is_empty() && !read.all.iter().any(is_uniform)
}

/// Whether something of what is seen is made of what a texture holds.
pub(in crate::diagnose) fn looks_up(evidence: &Evidence<'_>) -> bool {
    let Some((theirs, [_, Some(fragment)])) = traced(evidence) else { return false };
    let sites = theirs.stage(Stage::Fragment).sites();
    let reads = |event: &usize| match &sites[fragment.events[*event].site].what {
        What::Call(name) => is_lookup(name),
        _ => false,
    };
    way(&fragment, &roots(&fragment)).iter().any(reads)
}

/// The ids of the rubric's lines of which nothing can be right: what they judge is made of what a program gives the shaders, and what is
/// seen is made of nothing of that. None where uniforms are read that the student added: they stand for others. `is_right`: whether a line
/// is right where it shows beside no other.
pub(in crate::diagnose) fn absent_lines(evidence: &Evidence<'_>, is_right: &dyn Fn(&str) -> bool) -> Vec<String> {
    let assignment = evidence.assignment;
    let (Some(theirs), Some(solution)) = (traced(evidence), assignment.traced_solution()) else {
        return Vec::new();
    };
    let Some(solution) = runs(evidence, solution).map(|runs| (solution, runs)) else { return Vec::new() };
    let stages = [Stage::Vertex, Stage::Fragment];
    let is_known =
        |own: &ProgramVariable| assignment.interface.uniforms.iter().any(|known| root(&known.path) == root(&own.name));
    if !stages.iter().all(|stage| theirs.0.stage(*stage).uniforms().iter().all(is_known)) {
        return Vec::new();
    }
    let last = if theirs.1[1].is_some() { Stage::Fragment } else { Stage::Vertex };
    let seen = given_for(&theirs, last, &colours(&theirs, last));
    if seen.contains(UNKNOWN) {
        return Vec::new();
    }
    let lines = || assignment.rubric.iter().enumerate().filter(|(_, line)| !assignment.judges_position(line));
    let needed: Vec<(&RubricItem, Option<Needed>)> =
        lines().map(|(number, line)| (line, needed(evidence, &solution, number))).collect();
    let is_there = |own: &Needed| !own.names.is_disjoint(&seen);
    let is_absent = |own: &Needed| !own.names.is_empty() && !is_there(own);
    let is_any = |is: &dyn Fn(&Needed) -> bool| needed.iter().filter_map(|(_, own)| own.as_ref()).any(is);
    // A way in which all is drawn is not there where none of the values is.
    let no_way = is_any(&is_absent) && !is_any(&is_there);
    let absent = needed.iter().filter(|(line, own)| match own {
        Some(own) => is_absent(own) && !(own.is_shared && is_right(&line.id)),
        None => no_way,
    });
    absent.map(|(line, _)| line.id.clone()).collect()
}

/// What the values that a line judges are made of in the solution.
struct Needed {
    names: BTreeSet<String>,
    /// Whether what is there without the line's feature is made of all of that as well.
    is_shared: bool,
}

/// `None` where a line judges all that is seen.
fn needed(evidence: &Evidence<'_>, solution: &Runs<'_>, number: usize) -> Option<Needed> {
    let assignment = evidence.assignment;
    let line = &assignment.rubric[number];
    let names = match line.variables.as_slice() {
        [] if assignment.equation.index(&line.judges) == Some(assignment.equation.colour()) => {
            let of_value = |FeatureValue { program, stage, site, .. }: &FeatureValue| {
                let runs = (program, runs(evidence, program)?);
                Some(given_for(&runs, *stage, &events_where(&runs, *stage, |event| event.site == *site)))
            };
            let [value, instead] = assignment.feature_values(number)?;
            let (names, instead) = (of_value(&value)?, of_value(&instead)?);
            return Some(Needed { is_shared: names.is_subset(&instead), names });
        }
        [] => std::slice::from_ref(&line.judges),
        names => names,
    };
    let stages = [Stage::Vertex, Stage::Fragment].into_iter();
    let names = stages.flat_map(|stage| given_for(solution, stage, &givers(solution, stage, names))).collect();
    Some(Needed { names, is_shared: false })
}

/// What stands for a value that differs from place to place, and of which it is not known who gives it.
const UNKNOWN: &str = "";

/// A program with its runs at some probes.
type Runs<'t> = (&'t TracedProgram, [Option<Trace>; 2]);

/// The events that give a stage's colours their values.
fn colours((program, traces): &Runs<'_>, stage: Stage) -> Vec<usize> {
    let Some(trace) = &traces[stage as usize] else { return Vec::new() };
    let own = program.stage(stage).outputs().iter().zip(&trace.outputs);
    own.filter(|(output, _)| output.name != POSITION).flat_map(|(_, events)| events.clone()).collect()
}

/// The events that give variables of these names their values.
fn givers(runs: &Runs<'_>, stage: Stage, names: &[String]) -> Vec<usize> {
    let sites = runs.0.stage(stage).sites();
    let is_giver = |event: &Event| matches!(&sites[event.site].what, What::Assign { name, .. } if names.contains(name));
    events_where(runs, stage, is_giver)
}

/// The events of a stage for which this holds.
fn events_where((_, traces): &Runs<'_>, stage: Stage, is_one: impl Fn(&Event) -> bool) -> Vec<usize> {
    let events = traces[stage as usize].iter().flat_map(|trace| trace.events.iter().enumerate());
    events.filter(|(_, event)| is_one(event)).map(|(number, _)| number).collect()
}

/// The attributes and uniforms that events of a stage are made of; lookups of a texture are one of them.
fn given_for(runs: &Runs<'_>, stage: Stage, events: &[usize]) -> BTreeSet<String> {
    let (program, traces) = runs;
    let Some(trace) = &traces[stage as usize] else { return BTreeSet::new() };
    let own = program.stage(stage);
    let mut given = BTreeSet::new();
    for event in way(trace, events).into_iter().map(|number| &trace.events[number]) {
        let name = match &own.sites()[event.site].what {
            What::Read(name) if is_given(own, trace, event, name) => name,
            What::Call(name) if is_lookup(name) => {
                given.insert("texture".into());
                continue;
            }
            _ => continue,
        };
        let handed_over =
            Some(stage).filter(|stage| *stage == Stage::Fragment).and_then(|_| program.interpolated_from(name));
        match (handed_over, &traces[0]) {
            (Some(output), Some(vertex)) => given.extend(given_for(runs, Stage::Vertex, &vertex.outputs[output])),
            _ if own.inputs().iter().any(|input| input.written == *name) => _ = given.insert(name.clone()),
            _ if let Some(own) = own.uniforms().iter().find(|own| root(&own.written) == root(name)) => {
                given.insert(root(&own.name).to_owned());
            }
            _ if is_constant(&event.values) => {}
            _ => _ = given.insert(UNKNOWN.into()),
        }
    }
    given
}

/// The text of the stages, and their runs at some of the probes.
fn traced<'e>(evidence: &Evidence<'e>) -> Option<Runs<'e>> {
    let theirs = evidence.traced?;
    Some((theirs, runs(evidence, theirs)?))
}

/// The runs of a program at some of the probes.
fn runs(evidence: &Evidence<'_>, program: &TracedProgram) -> Option<[Option<Trace>; 2]> {
    let places: Vec<Place<'_>> = chosen(evidence).iter().map(|at| place(evidence, *at)).collect();
    let in_quads = program.needs_quads(evidence.assignment);
    let mut bench = Bench::new(evidence.assignment, program, &places, in_quads, FUEL_OF_TRACE)?;
    let (_, traces) = bench.trace(&StageChanges::default())?;
    (!places.is_empty()).then_some(traces)
}

/// Variables that are read.
struct Read {
    all: BTreeSet<String>,
    /// Those that have another value from place to place which nothing gave them there: inputs.
    varying: BTreeSet<String>,
}

/// Inputs that only say which vertex or which pixel it is.
const NUMBERS: [&str; 6] =
    ["gl_VertexID", "gl_InstanceID", "gl_PrimitiveID", "gl_FragCoord", "gl_FrontFacing", "gl_PointCoord"];

/// What some events are made of, and what decides whether it is computed.
fn way(trace: &Trace, roots: &[usize]) -> BTreeSet<usize> {
    let mut way = BTreeSet::new();
    let mut open = roots.to_vec();
    while let Some(event) = open.pop() {
        if way.insert(event) {
            let Event { from, under, .. } = &trace.events[event];
            open.extend(from.iter().chain(under));
        }
    }
    way
}

/// Whether the text gives a variable no value that is read. An index that it is read with is none.
fn is_given(program: &Program, trace: &Trace, event: &Event, name: &str) -> bool {
    let gives = |from: &usize| {
        let site = &program.sites()[trace.events[*from].site];
        matches!(&site.what, What::Assign { name: given, .. } if given == name)
    };
    !event.from.iter().any(gives)
}

/// The variables that are read on the way of some events.
fn read_on_the_way(program: &Program, trace: &Trace, roots: &[usize]) -> Read {
    let way = way(trace, roots);
    let mut read = Read { all: BTreeSet::new(), varying: BTreeSet::new() };
    for event in way.into_iter().map(|number| &trace.events[number]) {
        let What::Read(name) = &program.sites()[event.site].what else { continue };
        if is_given(program, trace, event, name) && !is_constant(&event.values) && !NUMBERS.contains(&name.as_str()) {
            read.varying.insert(name.clone());
        }
        read.all.insert(name.clone());
    }
    read
}
