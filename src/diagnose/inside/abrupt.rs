//! Where an answer decides between two things that it should go over gradually.

use super::walk::{made_of, roots};
use super::{Place, variable};
use crate::diagnose::Evidence;
use crate::diagnose::columns::is_number;
use crate::diagnose::locate::{Located, MistakeOrigin};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges};
use reference::interpreter::Stage;
use reference::interpreter::trace::{Event, What};
use reference::probes::EdgeDefect;
use reference::traced::Bench;

/// The last value on the way of the colour that is one of two at every place across edges, and changes there at once.
pub(in crate::diagnose) fn decision(evidence: &Evidence<'_>) -> Option<Located> {
    let ((crossings, _), theirs) = (evidence.across?, evidence.traced?);
    let places = Place::all(&crossings.probes);
    let in_quads = theirs.needs_quads(evidence.assignment);
    let mut bench = Bench::new(evidence.assignment, theirs, &places, in_quads, FUEL_OF_TRACE)?;
    let (_, mut traces) = bench.trace(&StageChanges::default())?;
    let trace = traces[Stage::Fragment as usize].take()?;
    let sites = theirs.stage(Stage::Fragment).sites();
    let changes_at_once = |event: &Event| {
        let each = event.lanes.len() / places.len().max(1);
        let Some(column) = event.values.first().filter(|_| each > 0) else { return false };
        let shades: Vec<[f64; 3]> = column.iter().step_by(each).map(|value| [*value; 3]).collect();
        crossings.course(&shades) == Some(EdgeDefect::Abrupt)
    };
    let way = made_of(&trace, &roots(&trace));
    let is_computed = |event: &&Event| !matches!(sites[event.site].what, What::Read(_));
    let mut events = way.iter().rev().map(|number| &trace.events[*number]).filter(is_computed);
    let last = events.find(|event| is_one_of_two(event) && changes_at_once(event))?;
    let name = variable(sites, last.site);
    Some(Located { line: sites[last.site].line, name, role: MistakeOrigin::Wrong, stage: Some(Stage::Fragment) })
}

/// Whether a value is computed everywhere, and is one of two wherever it is.
fn is_one_of_two(event: &Event) -> bool {
    let value = |lane: usize| event.values.iter().map(move |column| column[lane]);
    let is_same = |a: usize, b: usize| value(a).zip(value(b)).all(|(a, b)| is_number(a, b));
    let Some(other) = (1..event.lanes.len()).find(|lane| !is_same(*lane, 0)) else { return false };
    event.lanes.iter().all(|is_run| *is_run)
        && (0..event.lanes.len()).all(|lane| is_same(lane, 0) || is_same(lane, other))
}
