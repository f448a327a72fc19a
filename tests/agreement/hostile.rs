//! Fragment stages that mean harm: each ends soon, by itself or by a limit that names its line, and the renderer goes on.

#[path = "hostile/stages.rs"]
mod stages;

use super::scenes::homework::sheets;
use super::scenes::renderer;
use ggrade::diagnostic::{Diagnostic, DiagnosticStage};
use ggrade::translate::TranslationRefusal;
use stages::End::{OutOfFuel, Refused, Runs, TooMuch};
use stages::{STAGES, text};

#[test]
fn hostile_fragment_stages_end_by_name() {
    assert!(STAGES.len() >= 60, "only {} hostile stages", STAGES.len());
    let (mut renderer, homework) = (renderer(), sheets());
    let scene = homework.scene();
    let honest = homework.translate(&text("", "colour = vec4(uv, 0.5, 1.0);")).expect("an honest stage");
    let right = renderer.render_program(&honest, &scene).unwrap().frames.picture(0);
    let mut wrong = Vec::new();
    for (name, promised, globals, body) in STAGES {
        let (end, said) = match homework.translate(&text(globals, body)) {
            Err(TranslationRefusal::Rejected(diagnostics)) => (Refused, diagnostics.into_iter().next()),
            Err(TranslationRefusal::Stopped(diagnostics)) => (TooMuch, diagnostics.into_iter().next()),
            Err(TranslationRefusal::Fault(fault)) => {
                wrong.push(format!("{name}: {fault}"));
                continue;
            }
            Ok(linked) => match renderer.render_program(&linked, &scene) {
                Err(fault) => {
                    wrong.push(format!("{name}: {fault}"));
                    continue;
                }
                Ok(rendering) => match rendering.of_fragments.ran_out {
                    None => (Runs, None),
                    Some(ran_out) => (OutOfFuel, Some(linked.fragment.out_of_fuel(ran_out))),
                },
            },
        };
        let is_named =
            |said: &Diagnostic| !said.message.en.is_empty() && (end != OutOfFuel || said.stage == DiagnosticStage::Run);
        if end != *promised || (end != Runs && !said.as_ref().is_some_and(is_named)) {
            wrong.push(format!("{name}: promised {promised:?}, seen {end:?}: {:?}", said.map(|said| said.message.en)));
        }
        if end == OutOfFuel {
            // The neighbour is drawn as if nothing had been.
            let again = renderer.render_program(&honest, &scene).unwrap().frames.picture(0);
            assert!(again.rgba == right.rgba, "{name} changes the next picture");
        }
    }
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), STAGES.len(), wrong.join("\n"));
}
