//! The lines that a slip of the solution costs, by what is left of it without their features.

use super::{homework, with_rubric};
use crate::assignment::Assignment;
use crate::mistake::FoundMistake;

/// Two parts that are dimmed together, and a root of all.
const SOLUTION: &str = "#version 330 core
uniform vec3 iResolution;
uniform float iTime;
out vec4 colour;
void main()
{
  vec2 at = gl_FragCoord.xy / iResolution.xy;
  float wave = 0.2 + 0.2 * sin(9.0 * at.x + iTime);
  float dim = 0.5 + 0.5 * at.x;
  float light = 0.3;
  light += (wave + 0.2 * at.y) * dim;
  light = sqrt(light);
  colour = vec4(vec3(light), 1.0);
}
";

/// The lines without whose features it is made otherwise.
const WITHOUT: [(&str, &str, &str); 3] = [
    ("wave", "wave + 0.2 * at.y", "0.2 * at.y"),
    ("rise", "wave + 0.2 * at.y", "wave"),
    ("root", "light = sqrt(light);", ""),
];

/// The ids of the lines that cost points where some words of the solution are left out or are others.
fn costly(assignment: &Assignment, id: &str, own: &str, instead: &str) -> Vec<String> {
    let mistake = assignment.mistake(id).unwrap_or_else(|| panic!("there is no {id}"));
    let is_it = |form: usize| {
        let slip = mistake.program(form).and_then(|program| program.slip.as_deref());
        slip.is_some_and(|(_, mark)| mark.texts.0 == own && mark.texts.1.as_deref() == Some(instead))
    };
    let all: Vec<_> =
        mistake.variants.iter().filter_map(|own| own.slip.as_ref().map(|slip| slip.1.texts.clone())).collect();
    let form =
        (0..mistake.ways()).find(|form| is_it(*form)).unwrap_or_else(|| panic!("{id}: no slip of {own}, but {all:?}"));
    let found = FoundMistake { id: id.into(), form, parameter: None };
    let lines = assignment.rubric.iter().filter(|line| assignment.keeps(&found, line) < 1.0);
    lines.map(|line| line.id.clone()).collect()
}

#[test]
fn a_slip_costs_the_lines_without_whose_features_nothing_is_left_of_it() {
    let mut folder = homework("rings");
    folder.files.insert("solution.frag".into(), SOLUTION.into());
    let line = |(id, own, instead): (&str, &str, &str)| {
        format!(
            "[[rubric]]\nid = \"{id}\"\npoints = 30\nlabel = {{ en = \"Line\", ja = \"行\" }}\n\
             without = {{ replace = [[\"{own}\", \"{instead}\"]] }}\n\n"
        )
    };
    let rubric: String = WITHOUT.into_iter().map(line).collect();
    let assignment = Assignment::load(with_rubric(folder, &rubric)).unwrap_or_else(|error| panic!("{error}"));
    let costly = |id, own, instead| costly(&assignment, id, own, instead);
    // What both parts are multiplied by is of both, though each stands in what the slip changes.
    let factor = ("(wave + (0.2 * at.y)) * dim", "(wave + (0.2 * at.y))");
    assert_eq!(costly("derived-factor-missing-light", factor.0, factor.1), ["wave", "rise"]);
    assert_eq!(costly("derived-function-missing-light", "sqrt(light)", "light"), ["root"]);
    assert_eq!(
        costly("derived-other-function-wave", "sin((9.0 * at.x) + iTime)", "cos((9.0 * at.x) + iTime)"),
        ["wave"]
    );
}
