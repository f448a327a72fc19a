//! What no known mistake explains: each line is judged where its term shows alone.

use super::{ggsample06, samples};
use reference::Value;
use reference::fit::{Fit, TOLERANCE, explain};

#[test]
fn an_unknown_mistake_is_judged_where_terms_stand_alone() {
    let assignment = ggsample06();
    let probes = assignment.probes(6);
    // The diffuse term by a rule of its own: squared, and tinted by the position.
    let given: Vec<[f64; 3]> = probes
        .iter()
        .map(|p| {
            let outcome = assignment.equation.right().evaluate(probes.uniforms(p), &p.attributes);
            let cosine = outcome.get("lambert").expect("a definition").float();
            let tint = 0.3 + 0.05 * p.vertex.position.truncate();
            (p.colour + cosine * cosine * tint).to_array()
        })
        .collect();
    let Fit::Unexplained(terms) = explain(assignment, &probes, &given, TOLERANCE) else {
        panic!("something explains it");
    };
    let right: Vec<(&str, bool)> = terms.iter().map(|t| (t.line.as_str(), t.is_right())).collect();
    assert_eq!(right, [("ambient", true), ("diffuse", false), ("specular", true)]);
    let worst = terms[1].worst.expect("a place");
    assert_eq!(worst.region, probes.probes[worst.probe].region);
    assert_eq!(worst.expected, probes.probes[worst.probe].colour);
}

#[test]
fn a_wrong_but_constant_ambient_term_does_not_spoil_the_others() {
    let assignment = ggsample06();
    let probes = assignment.probes(6);
    let shifted = |p: &reference::probes::Probe| [p.colour.x - 0.05, p.colour.y + 0.31, p.colour.z];
    let given: Vec<[f64; 3]> = probes.iter().map(shifted).collect();
    let Fit::Unexplained(terms) = explain(assignment, &probes, &given, TOLERANCE) else {
        panic!("something explains it");
    };
    let right: Vec<bool> = terms.iter().map(|t| t.is_right()).collect();
    assert_eq!(right, [false, true, true]);
}

/// The lines whose term is right, for a shader that computes `colour` from the right definitions.
fn right_lines(colour: impl Fn(&reference::probes::Probe, &dyn Fn(&str) -> Value) -> [f64; 3]) -> Vec<String> {
    let assignment = ggsample06();
    let probes = assignment.probes(11);
    let one = |p: &reference::probes::Probe| {
        let outcome = assignment.equation.right().evaluate(probes.uniforms(p), &p.attributes);
        colour(p, &|name| outcome.get(name).expect("a definition"))
    };
    let given: Vec<[f64; 3]> = probes.iter().map(one).collect();
    match explain(assignment, &probes, &given, TOLERANCE) {
        Fit::Unexplained(terms) => terms.into_iter().filter(|t| t.is_right()).map(|t| t.line).collect(),
        Fit::Explained(found) => panic!("{found:?} explains it"),
    }
}

#[test]
fn another_light_costs_the_ambient_term_nothing() {
    let right = right_lines(|_, value| {
        let (n, v) = (value("n").vec3(), value("v").vec3());
        let l = glam::DVec3::new(1.0, 1.0, 1.0).normalize();
        let highlight = 0.4 * n.dot((l + v).normalize()).max(0.0).powi(80);
        [0.12 + 0.6 * n.dot(l).max(0.0) + highlight, highlight, highlight]
    });
    assert_eq!(right, ["ambient"]);
}

#[test]
fn a_term_that_overflows_costs_the_others_nothing() {
    // The highlight is the reciprocal of a power: infinite where the right one is 0, and huge in most other places.
    let right = right_lines(|_, value| {
        let highlight = f64::from((0.4 / value("facing").float().powi(80)) as f32);
        let red = 0.12 + 0.6 * value("lambert").float();
        [red + highlight, highlight, highlight]
    });
    assert_eq!(right, ["ambient", "diffuse"]);
    // The diffuse term is divided by its own reflectance: 0 / 0 in green and blue.
    let right = right_lines(|p, value| [p.colour.x + 0.4 * value("lambert").float(), f64::NAN, f64::NAN]);
    assert_eq!(right, ["ambient", "specular"]);
}

#[test]
fn a_term_that_is_wrong_where_it_stands_alone_is_not_right_by_its_colour() {
    // Ambient and diffuse light are both red. Here the ambient term varies with the normal.
    let right = right_lines(|p, value| [p.colour.x + 0.1 * value("n").vec3().y.abs() + 0.1, p.colour.y, p.colour.z]);
    assert_eq!(right, ["specular"]);
}

#[test]
fn samples_that_are_no_numbers_or_missing_are_never_right() {
    let assignment = ggsample06();
    let probes = assignment.probes(7);
    let right = samples(assignment, &probes, &[]);
    for poison in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut given = right.clone();
        given[100][1] = poison;
        assert!(matches!(explain(assignment, &probes, &given, TOLERANCE), Fit::Unexplained(_)));
    }
    for count in [0, 1, right.len() - 1] {
        assert!(matches!(explain(assignment, &probes, &right[..count], TOLERANCE), Fit::Unexplained(_)));
    }
}
