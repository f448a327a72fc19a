//! What a text is given, and whether its colour has anything of it.

use super::Stage;
use super::walk::roots;
use crate::diagnose::Evidence;
use crate::diagnose::columns::is_constant;
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges, chosen, place};
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Program, is_lookup};
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

/// The text of the stages, and their runs at some of the probes.
fn traced<'e>(evidence: &Evidence<'e>) -> Option<(&'e TracedProgram, [Option<Trace>; 2])> {
    let theirs = evidence.traced?;
    let places: Vec<Place<'_>> = chosen(evidence).iter().map(|at| place(evidence, *at)).collect();
    let in_quads = theirs.needs_quads(evidence.assignment);
    let mut bench = Bench::new(evidence.assignment, theirs, &places, in_quads, FUEL_OF_TRACE)?;
    let (_, traces) = bench.trace(&StageChanges::default())?;
    (!places.is_empty()).then_some((theirs, traces))
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

/// The variables that are read on the way of some events.
fn read_on_the_way(program: &Program, trace: &Trace, roots: &[usize]) -> Read {
    let way = way(trace, roots);
    let mut read = Read { all: BTreeSet::new(), varying: BTreeSet::new() };
    for event in way.into_iter().map(|number| &trace.events[number]) {
        let What::Read(name) = &program.sites()[event.site].what else { continue };
        if event.from.is_empty() && !is_constant(&event.values) && !NUMBERS.contains(&name.as_str()) {
            read.varying.insert(name.clone());
        }
        read.all.insert(name.clone());
    }
    read
}
