//! Mistakes that are derived from the solution.

use reference::derived::{Derived, is_derived};
use reference::fit::{Fit, TOLERANCE, contradicted, explain, explain_derived};
use reference::mistake::FoundMistake;
use reference::probes::ProbeSet;
use reference::{Assignment, Folder, assignment};
use std::path::Path;

fn homework(name: &str) -> Assignment {
    if let Some(own) = assignment(name) {
        return Assignment::clone(own);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/homeworks").join(name);
    Assignment::load(Folder::read(&folder).expect("a folder")).unwrap_or_else(|error| panic!("{error}"))
}

/// What the solution computes with these mistakes in it.
fn samples(assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet) -> Vec<[f64; 3]> {
    let variant = assignment.variant(found).expect("mistakes with forms");
    let colour = |probe| variant.evaluate(probes.uniforms(probe), &probe.attributes).colour().to_array();
    probes.iter().map(colour).collect()
}

fn derived_from(assignment: &Assignment, probes: &ProbeSet, samples: &[[f64; 3]]) -> Option<Vec<FoundMistake>> {
    let found = |count| explain_derived(count, assignment, probes, samples, &|_, _| true, TOLERANCE);
    found(1).or_else(|| found(2))
}

fn ids(found: &[FoundMistake]) -> Vec<&str> {
    found.iter().map(|found| found.id.as_str()).collect()
}

/// Each form of which nothing is free.
fn forms(derived: &Derived) -> impl Iterator<Item = FoundMistake> + '_ {
    derived.mistakes().iter().flat_map(|mistake| {
        let fixed = mistake.forms.iter().enumerate().filter(|(_, form)| !form.free);
        fixed.map(|(form, _)| FoundMistake { id: mistake.id.clone(), form, parameter: None })
    })
}

#[test]
fn what_an_operator_makes_is_explained_and_the_same_each_time() {
    for name in ["ggsample06", "lamp", "fog", "waves"] {
        let assignment = homework(name);
        let probes = assignment.judging_probes();
        // Every seventh: all of them take a minute.
        for found in forms(assignment.derived()).step_by(7) {
            let samples = samples(&assignment, std::slice::from_ref(&found), &probes);
            // What is 0 or too large nearly everywhere tells nothing.
            let defined = samples.iter().flatten().filter(|x| x.is_finite()).count();
            let varies = samples.iter().any(|sample| (0..3).any(|at| (sample[at] - samples[0][at]).abs() > 0.01));
            if defined < 3 * samples.len() || !varies {
                continue;
            }
            if let Fit::Explained(_) = explain(&assignment, &probes, &samples, TOLERANCE) {
                continue;
            }
            let explained = derived_from(&assignment, &probes, &samples);
            let explained = explained.unwrap_or_else(|| panic!("{name}: {found:?} is not explained"));
            assert!(explained.len() == 1 && is_derived(&explained[0].id), "{name}: {found:?} became {explained:?}");
            assert!(!contradicted(&assignment, &explained, &probes, &samples, TOLERANCE).contains(&true));
            assert_eq!(derived_from(&assignment, &probes, &samples), Some(explained), "{name}");
        }
    }
}

#[test]
fn a_derived_mistake_costs_the_lines_that_it_changes_and_no_other() {
    let assignment = homework("ggsample06");
    let keeps = |id: &str, form: usize| -> Vec<f64> {
        let found = FoundMistake { id: id.into(), form, parameter: None };
        assignment.rubric.iter().map(|line| assignment.keeps(&found, line)).collect()
    };
    // The rubric: shape, ambient, diffuse, specular.
    assert_eq!(keeps("derived-other-components-n", 0), [1.0, 1.0, 0.5, 0.5]);
    assert_eq!(keeps("derived-other-function-nh", 0), [1.0, 1.0, 1.0, 0.4]);
    assert_eq!(keeps("derived-operator-ambient", 0), [1.0, 0.5, 1.0, 1.0]);
    assert_eq!(keeps("derived-complement-colour", 0), [1.0, 0.4, 0.4, 0.4]);
    // In the sum only the part that is added twice.
    let twice: Vec<Vec<f64>> = (0..2).map(|form| keeps("derived-twice-total", form)).collect();
    assert!(twice.iter().all(|keeps| keeps.iter().filter(|kept| **kept < 1.0).count() == 1), "{twice:?}");
}

#[test]
fn two_mistakes_are_found_one_of_them_derived_or_both() {
    let assignment = homework("ggsample06");
    let probes = assignment.judging_probes();
    let forms = |id: &str| -> Vec<FoundMistake> {
        let count = if is_derived(id) { assignment.mistake(id).expect("a mistake").forms.len() } else { 1 };
        (0..count).map(|form| FoundMistake { id: id.into(), form, parameter: None }).collect()
    };
    for pair in [
        ["diffuse-unclamped", "derived-other-components-n"],
        ["derived-operator-ambient", "derived-other-function-nh"],
        ["specular-half-unnormalized", "derived-operator-ambient"],
    ] {
        // A form that equals a written mistake takes its name.
        let [first, second] = pair.map(forms);
        let mut pairs = first.iter().flat_map(|one| second.iter().map(move |other| [one.clone(), other.clone()]));
        let is_found = |both: [FoundMistake; 2]| {
            let samples = samples(&assignment, &both, &probes);
            matches!(explain(&assignment, &probes, &samples, TOLERANCE), Fit::Unexplained(_))
                && derived_from(&assignment, &probes, &samples).is_some_and(|explained| ids(&explained) == pair)
        };
        assert!(pairs.any(is_found), "{pair:?}");
    }
}

#[test]
fn a_number_that_is_free_is_found() {
    let assignment = homework("lamp");
    let probes = assignment.judging_probes();
    let number = FoundMistake { id: "derived-number-specular".into(), form: 0, parameter: Some(9.0) };
    let samples = samples(&assignment, &[number], &probes);
    let explained = derived_from(&assignment, &probes, &samples).unwrap_or_default();
    assert_eq!(ids(&explained), ["derived-number-specular"]);
    assert!(explained[0].parameter.is_some_and(|found| (found - 9.0).abs() < 0.01), "{explained:?}");
}

#[test]
fn nothing_is_derived_from_what_is_the_same_everywhere_or_has_no_structure() {
    let assignment = homework("lamp");
    let probes = assignment.judging_probes();
    assert_eq!(derived_from(&assignment, &probes, &vec![[1.0; 3]; probes.probes.len()]), None);
    let noise = |at: usize| [0.5 + 0.4 * (at as f64 * 12.9).sin(), 0.5 + 0.4 * (at as f64 * 78.2).sin(), 0.3];
    let noise: Vec<[f64; 3]> = (0..probes.probes.len()).map(noise).collect();
    assert_eq!(derived_from(&assignment, &probes, &noise), None);
}

#[test]
fn programs_are_derived_of_solutions_that_are_no_list_of_definitions() {
    for (name, id) in [("toon", "derived-normalize-missing-n"), ("maps", "derived-clamp-missing-sum")] {
        let assignment = homework(name);
        let probes = assignment.judging_probes();
        let mistake = assignment.mistake(id).unwrap_or_else(|| panic!("{name}: there is no {id}"));
        let shown = assignment.probes_of(&mistake.variants[0], &probes);
        let samples: Vec<[f64; 3]> = shown.iter().map(|probe| probe.colour.to_array()).collect();
        let explained = derived_from(&assignment, &probes, &samples).unwrap_or_default();
        assert_eq!(ids(&explained), [id], "{name}");
        assert!(assignment.rubric.iter().any(|line| assignment.keeps(&explained[0], line) < 1.0), "{name}");
    }
}
