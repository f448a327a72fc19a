//! What lines of the rubric are about, by what the solution lacks without them.

use super::{homework, with_rubric};
use crate::Folder;
use crate::assignment::Assignment;

/// What each line of a homework is about, in the rubric's order.
fn about(folder: Folder) -> Vec<String> {
    let assignment = Assignment::load(folder).unwrap_or_else(|error| panic!("{error}"));
    assignment.rubric.iter().map(|line| format!("{}: {}", line.id, line.variables.join(" "))).collect()
}

/// The homework of rings with another solution and another rubric.
fn rings(solution: &str, rubric: &str) -> Folder {
    let mut folder = homework("rings");
    folder.files.insert("solution.frag".into(), solution.into());
    with_rubric(folder, rubric)
}

#[test]
fn a_line_is_about_what_its_feature_is_made_of() {
    let maps = about(homework("maps"));
    assert_eq!(maps, ["diffuse: base l n sum", "gloss: gloss h l n sum v", "ambient: base sum"]);
}

#[test]
fn what_goes_into_the_colour_in_other_ways_as_well_is_nobodys_own() {
    // The normal decides about the outline, and makes the light whose tones are counted.
    assert_eq!(about(homework("toon")), ["tones: colour lit", "outline: colour"]);
}

#[test]
fn where_two_features_meet_both_are_concerned() {
    let bumps = about(homework("bumps"));
    assert_eq!(bumps, ["shape: ", "relief: colour coordinates n", "paint: colour coordinates"]);
}

#[test]
fn a_function_has_what_it_is_given_from_elsewhere() {
    let solution = "#version 330 core\nuniform vec3 iResolution;\nuniform float iTime;\nout vec4 colour;\n\
        vec3 mapped(vec3 hdr) { vec3 sum = hdr + 1.0; return hdr / sum; }\n\
        void main() { vec2 at = gl_FragCoord.xy / iResolution.xy; float wave = sin(9.0 * at.x + iTime); vec3 glow = vec3(at.y); \
        vec3 light = glow + wave; colour = vec4(mapped(light), 1.0); }\n";
    let rubric = "[[rubric]]\nid = \"wave\"\npoints = 50\nlabel = { en = \"Wave\", ja = \"波\" }\n\
        without = { replace = [[\" + wave\", \"\"]] }\n\n[[rubric]]\nid = \"tone\"\npoints = 50\n\
        label = { en = \"Tone\", ja = \"階調\" }\nwithout = { replace = [[\"mapped(light)\", \"light\"]] }\n";
    assert_eq!(about(rings(solution, rubric)), ["wave: at colour light wave", "tone: colour hdr mapped sum"]);
}

#[test]
fn how_often_a_loop_goes_round_is_about_no_value_in_it() {
    let solution = "#version 330 core\nuniform vec3 iResolution;\nuniform float iTime;\nout vec4 colour;\n\
        void main() { vec2 at = gl_FragCoord.xy / iResolution.xy; float sum = 0.0; for (int i = 0; i < 3; i++) \
        { float wave = sin(float(i) + at.x + iTime); sum += wave; } colour = vec4(vec3(0.5 + 0.1 * sum), 1.0); }\n";
    let rubric = "[[rubric]]\nid = \"turns\"\npoints = 50\nlabel = { en = \"Turns\", ja = \"回数\" }\n\
        without = { replace = [[\"i < 3\", \"i < 1\"]] }\n\n[[rubric]]\nid = \"wave\"\npoints = 50\n\
        label = { en = \"Wave\", ja = \"波\" }\nwithout = { replace = [[\"sin(float(i) + at.x + iTime)\", \"0.0\"]] }\n";
    let about = about(rings(solution, rubric));
    assert_eq!(about[0], "turns: ");
    assert!(about[1].contains(" wave"), "{about:?}");
}
