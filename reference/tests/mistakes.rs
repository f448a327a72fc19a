//! The table of mistakes and the probes, held against one another: every mistake shows, and is found.

#[path = "mistakes/unexplained.rs"]
mod unexplained;

use reference::assignment::{Feed, Role};
use reference::fit::{Fit, TOLERANCE, explain};
use reference::mistake::FoundMistake;
use reference::probes::ProbeSet;
use reference::{Assignment, Value, assignment};

/// How far apart two mistakes must be somewhere.
const MARGIN: f64 = 10.0 * TOLERANCE;

const SEEDS: [u64; 5] = [1, 2, 3, 1_000_003, u64::MAX];

fn ggsample06() -> &'static Assignment {
    assignment("ggsample06").expect("built in")
}

/// Every form of every mistake, with a likely value for its free parameter.
fn all_forms(assignment: &Assignment) -> Vec<FoundMistake> {
    let forms = |m: &reference::mistake::Mistake| -> Vec<FoundMistake> {
        let found = |(form, f): (usize, &reference::mistake::MistakeForm)| FoundMistake {
            id: m.id.clone(),
            form,
            parameter: m.fit.as_ref().filter(|_| f.free).map(|p| p.example),
        };
        m.forms.iter().enumerate().map(found).collect()
    };
    assignment.mistakes.iter().flat_map(forms).collect()
}

fn samples(assignment: &Assignment, probes: &ProbeSet, mistakes: &[FoundMistake]) -> Vec<[f64; 3]> {
    let variant = assignment.variant(mistakes).expect("known mistakes");
    let colour = |p: &reference::probes::Probe| {
        let outcome = variant.evaluate(probes.uniforms(p), &p.attributes);
        outcome.colour().to_array()
    };
    probes.iter().map(colour).collect()
}

/// As f32 and a driver's `pow` would distort it: a relative error of up to 2e-4 that changes from sample to sample.
fn noisy(samples: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let distort = |(i, s): (usize, &[f64; 3])| {
        let error = 2e-4 * ((i * 7919 % 200) as f64 / 100.0 - 1.0);
        s.map(|x| f64::from((x * (1.0 + error)) as f32))
    };
    samples.iter().enumerate().map(distort).collect()
}

/// The greatest difference in the measure of the fit; infinite where only one of the two is defined.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let channels = a.iter().flatten().zip(b.iter().flatten());
    let apart = |(x, y): (&f64, &f64)| match (x.is_nan(), y.is_nan()) {
        (true, true) => 0.0,
        (false, false) => (x - y).abs() / x.abs().max(y.abs()).max(1.0),
        _ => f64::INFINITY,
    };
    channels.map(apart).fold(0.0, f64::max)
}

#[test]
fn every_mistake_is_told_from_every_other_and_from_the_right_answer() {
    let assignment = ggsample06();
    let forms = all_forms(assignment);
    for seed in SEEDS {
        let probes = assignment.probes(seed);
        let right = samples(assignment, &probes, &[]);
        let columns: Vec<_> = forms.iter().map(|f| samples(assignment, &probes, std::slice::from_ref(f))).collect();
        for (i, a) in forms.iter().enumerate() {
            let apart = distance(&columns[i], &right);
            assert!(apart >= MARGIN, "seed {seed}: {a:?} is right to {apart:e}");
            for (j, b) in forms.iter().enumerate().take(i) {
                let apart = distance(&columns[i], &columns[j]);
                assert!(a.id == b.id || apart >= MARGIN, "seed {seed}: {a:?} and {b:?} are only {apart:e} apart");
            }
        }
    }
}

#[test]
fn every_mistake_is_found_alone() {
    let assignment = ggsample06();
    for seed in [1, 99] {
        let probes = assignment.probes(seed);
        for planted in all_forms(assignment) {
            let given = noisy(&samples(assignment, &probes, std::slice::from_ref(&planted)));
            match explain(assignment, &probes, &given, TOLERANCE) {
                Fit::Explained(found) => {
                    let ids: Vec<_> = found.iter().map(|f| f.id.as_str()).collect();
                    assert_eq!(ids, [planted.id.as_str()], "{planted:?}");
                    if let (Some(x), Some(y)) = (found[0].parameter, planted.parameter) {
                        assert!((x / y - 1.0).abs() < 0.01, "{x} instead of {y}");
                    }
                }
                other => panic!("{planted:?}: {other:?}"),
            }
        }
    }
}

/// The mistakes that touch one line of the rubric only, in their first form.
fn first_forms_of<'a>(assignment: &'a Assignment, line: &'a str) -> impl Iterator<Item = FoundMistake> {
    let ids: Vec<String> = assignment
        .mistakes
        .iter()
        .filter(|m| m.keeps.len() == 1 && m.keeps[0].0 == line)
        .map(|m| m.id.clone())
        .collect();
    all_forms(assignment).into_iter().filter(move |f| f.form == 0 && f.parameter.is_none() && ids.contains(&f.id))
}

fn ids(mistakes: &[FoundMistake]) -> Vec<&str> {
    let mut ids: Vec<&str> = mistakes.iter().map(|m| m.id.as_str()).collect();
    ids.sort_unstable();
    ids
}

#[test]
fn mistakes_in_two_lines_are_both_found() {
    let assignment = ggsample06();
    let probes = assignment.probes(4);
    let (mut tried, mut same) = (0, 0);
    for (one, other) in [("ambient", "diffuse"), ("ambient", "specular"), ("diffuse", "specular")] {
        for a in first_forms_of(assignment, one) {
            for b in first_forms_of(assignment, other) {
                let planted = [a.clone(), b.clone()];
                let given = noisy(&samples(assignment, &probes, &planted));
                let fit = explain(assignment, &probes, &given, TOLERANCE);
                let found = match fit {
                    Fit::Explained(found) => found,
                    Fit::Unexplained(terms) => panic!("{planted:?}: {terms:?}"),
                };
                if ids(&found) != ids(&planted) {
                    // Some pairs compute the same as another pair or as one of the two: K_amb without a diffuse term and
                    // K_diff L_diff without ambient; an early clamp where nothing is over 1.
                    let theirs = samples(assignment, &probes, &found);
                    let apart = distance(&theirs, &samples(assignment, &probes, &planted));
                    assert!(apart < TOLERANCE, "{planted:?} taken for {found:?}");
                    println!("{:?} is also {:?}", ids(&planted), ids(&found));
                    same += 1;
                }
                tried += 1;
            }
        }
    }
    assert!(tried > 300 && same * 40 < tried, "{same} of {tried}");
}

#[test]
fn three_mistakes_are_found() {
    let assignment = ggsample06();
    let probes = assignment.probes(5);
    let mistake = |id: &str, parameter: Option<f64>| FoundMistake { id: id.to_owned(), form: 0, parameter };
    for planted in [
        [mistake("ambient-missing", None), mistake("diffuse-unclamped", None), mistake("specular-phong", None)],
        [
            mistake("ambient-added", None),
            mistake("specular-half-unnormalized", None),
            mistake("normal-not-transformed", None),
        ],
        [
            mistake("ambient-missing", None),
            mistake("diffuse-abs", None),
            mistake("specular-wrong-exponent", Some(12.0)),
        ],
    ] {
        let given = noisy(&samples(assignment, &probes, &planted));
        match explain(assignment, &probes, &given, TOLERANCE) {
            Fit::Explained(found) => {
                assert_eq!(found.len(), 3, "{found:?}");
                assert!(planted.iter().all(|p| found.contains(p)), "{found:?}");
            }
            other => panic!("{planted:?}: {other:?}"),
        }
    }
}

#[test]
fn right_answers_are_right_however_they_are_written() {
    let assignment = ggsample06();
    for seed in SEEDS {
        let probes = assignment.probes(seed);
        let given = noisy(&samples(assignment, &probes, &[]));
        assert!(explain(assignment, &probes, &given, TOLERANCE).is_right());
        // The normal from mat3(mw), computed here by hand.
        let mut other = assignment.clone();
        for uniform in &mut other.interface.uniforms {
            if matches!(uniform.feed, Feed::Role(Role::NormalMatrix)) {
                uniform.feed = Feed::Role(Role::ModelView);
            }
        }
        let rotated: Vec<[f64; 3]> = probes
            .iter()
            .map(|p| {
                let mut vertex = p.vertex;
                vertex.normal.w = 0.0;
                let uniforms = other.uniform_values(&other.scene.moment(0.0, probes.groups[p.group].matrices));
                let outcome = other.equation.right().evaluate(&uniforms, &other.attribute_values(&vertex));
                outcome.colour().to_array()
            })
            .collect();
        assert!(explain(assignment, &probes, &rotated, TOLERANCE).is_right());
    }
}

#[test]
fn an_answer_with_other_constants_is_right_for_those_constants() {
    let assignment = ggsample06();
    let probes = assignment.probes(8);
    let changed = assignment.with_constants(&[("kshi", Value::from(20.0))]).expect("a constant");
    let given = samples(&changed, &probes, &[]);
    assert!(explain(&changed, &changed.reprobe(&probes), &given, TOLERANCE).is_right());
    match explain(assignment, &probes, &given, TOLERANCE) {
        Fit::Explained(found) => assert_eq!(found[0].parameter, Some(20.0), "{found:?}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn two_free_numbers_are_found_together() {
    let assignment = ggsample06();
    let probes = assignment.probes(9);
    let number = |id: &str, form: usize, x: f64| FoundMistake { id: id.to_owned(), form, parameter: Some(x) };
    for planted in [
        vec![number("diffuse-scaled", 0, 0.5), number("specular-wrong-exponent", 0, 20.0)],
        vec![number("ambient-scaled", 0, 2.0), number("diffuse-scaled", 0, 0.7)],
        vec![number("ambient-scaled", 0, 1.5), number("specular-scaled", 0, 0.6)],
        vec![number("diffuse-with-exponent", 2, 3.0), number("specular-half-unnormalized", 2, 0.7)],
        vec![
            number("ambient-scaled", 0, 1.5),
            number("diffuse-scaled", 0, 0.5),
            number("specular-wrong-exponent", 0, 30.0),
        ],
    ] {
        let given = noisy(&samples(assignment, &probes, &planted));
        let Fit::Explained(found) = explain(assignment, &probes, &given, TOLERANCE) else {
            panic!("{planted:?} is not explained");
        };
        assert_eq!(ids(&found), ids(&planted));
        for (found, planted) in found.iter().zip(&planted) {
            let (x, y) = (found.parameter.unwrap(), planted.parameter.unwrap());
            assert!((x / y - 1.0).abs() < 0.01, "{found:?} instead of {planted:?}");
        }
    }
}

#[test]
fn a_view_vector_that_is_a_little_short_is_found() {
    let assignment = ggsample06();
    let probes = assignment.probes(10);
    for x in [0.99, 1.02, 0.7] {
        let planted = FoundMistake { id: "specular-view-unnormalized".into(), form: 2, parameter: Some(x) };
        let given = noisy(&samples(assignment, &probes, &[planted]));
        match explain(assignment, &probes, &given, TOLERANCE) {
            Fit::Explained(found) => assert_eq!(ids(&found), ["specular-view-unnormalized"], "{x}"),
            other => panic!("{x}: {other:?}"),
        }
    }
}

#[test]
fn what_is_missing_is_not_wrong_as_well() {
    let assignment = ggsample06();
    let probes = assignment.probes(12);
    // A fifth of the diffuse light, from the wrong side, and no ambient light: also "ambient times the reversed cosine, no
    // diffuse term".
    let colour = |p: &reference::probes::Probe| {
        let outcome = assignment.equation.right().evaluate(probes.uniforms(p), &p.attributes);
        let value = |name: &str| outcome.get(name).expect("a definition");
        let specular = value("specular").vec3();
        [0.12 * (-value("nl").float()).max(0.0) + specular.x, specular.y, specular.z]
    };
    let given: Vec<[f64; 3]> = probes.iter().map(colour).collect();
    if let Fit::Explained(found) = explain(assignment, &probes, &given, TOLERANCE) {
        let is = |id: &str| found.iter().any(|found| found.id == id);
        assert!(!(is("diffuse-missing") && is("diffuse-light-reversed")), "{found:?}");
    }
}

#[test]
fn a_form_costs_only_the_lines_that_it_reaches() {
    let assignment = ggsample06();
    let kept = |form: usize| -> Vec<f64> {
        let found = FoundMistake { id: "normal-not-transformed".into(), form, parameter: None };
        assignment.rubric.iter().map(|line| assignment.keeps(&found, line)).collect()
    };
    // The normal itself, only in the diffuse term, only in the highlight.
    assert_eq!(kept(0), [1.0, 1.0, 0.5, 0.75]);
    assert_eq!(kept(1), [1.0, 1.0, 0.5, 1.0]);
    assert_eq!(kept(2), [1.0, 1.0, 1.0, 0.75]);
}
