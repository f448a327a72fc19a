//! Right answers that are written in another way than the solution, where ggrade once told them from it.

use super::authoring::Written;
use super::folders::Copy;
use super::json;
use std::fs;

/// Real pixels lie in the window, so that a remainder of their places may be taken in any way.
#[test]
fn the_pixels_of_probes_lie_in_the_window() {
    let last = "tint = vec4(colour, 1.0);";
    let copy = Copy::of("tests/homeworks/toon").replace(
        "solution.frag",
        last,
        "if ((int(gl_FragCoord.x) & 1) == 0) colour *= 0.8;\n  tint = vec4(colour, 1.0);",
    );
    let solution = fs::read_to_string(copy.path("solution.frag")).unwrap();
    for other in ["mod(floor(gl_FragCoord.x), 2.0) < 0.5", "uint(gl_FragCoord.x) % 2u == 0u"] {
        let own = solution.replace("(int(gl_FragCoord.x) & 1) == 0", other);
        assert_ne!(own, solution);
        assert_eq!(graded(&copy, &own)["verdict"], "correct", "{other}");
    }
}

/// A member of a block is known by its place, whatever it is called.
#[test]
fn nobody_is_told_that_a_renamed_member_of_a_block_is_not_read() {
    let (plain, block) = ("uniform int tones;", "layout (std140) uniform Steps { int tones; };");
    let copy =
        Copy::of("tests/homeworks/toon").replace("starter.frag", plain, block).replace("solution.frag", plain, block);
    let solution = fs::read_to_string(copy.path("solution.frag")).unwrap();
    let renamed = solution.replace("tones", "count").replace("< 0.3", "< 0.5");
    let said = graded(&copy, &renamed)["diagnostics"].to_string();
    assert!(!said.contains("does not read"), "{said}");
    let forgotten = solution.replace(block, "const int tones = 3;");
    let said = graded(&copy, &forgotten)["diagnostics"].to_string();
    assert!(said.contains("does not read `Steps`"), "{said}");
}

/// A lookup is run as slowly as ever, but compiled once of its kind.
#[test]
fn many_lookups_may_be_written_out() {
    let lookup = "texture(material.specular, TexCoords).r";
    let written_out = vec![lookup; 28].join(" + ");
    let report = Written::from(&["varnish.frag"]).graded(&[(lookup, &format!("(({written_out}) / 28.0)"))]);
    assert_eq!(report["verdict"], "correct", "{report:#}");
}

/// HLSL's names for types are macros at most.
#[test]
fn a_macro_may_be_the_type_of_a_member() {
    let written = Written::from(&["varnish.frag"]);
    let light = "struct Light { vec3 position; vec3 ambient; vec3 diffuse; vec3 specular; };";
    let macros =
        "#define float3 vec3\nstruct Light { float3 position; float3 ambient; float3 diffuse; float3 specular; };";
    let report = written.graded(&[(light, macros)]);
    assert_eq!(report["verdict"], "correct", "{report:#}");
}

/// GLSL before 1.30 has no `texture`.
#[test]
fn old_lookups_are_right_in_old_versions() {
    let written = Written::from(&["moth.frag"]);
    for version in ["#version 120", "#version 110", ""] {
        let report = written.graded(&[
            ("#version 330 core", version),
            ("in vec2 uv", "varying vec2 uv"),
            ("in vec3 normal", "varying vec3 normal"),
            ("out vec4 color;", ""),
            ("texture(noiseTex", "texture2D(noiseTex"),
            ("color = vec4", "gl_FragColor = vec4"),
        ]);
        assert_eq!(report["verdict"], "correct", "{report:#}");
        assert!(report["diagnostics"].to_string().contains("`texture2D` is a name of old GLSL"), "{report:#}");
    }
}

/// The compiler has `inverse` from GLSL 1.50 on.
#[test]
fn the_inverse_is_there_where_drivers_have_it() {
    let inverse = ("  vec4 p = mv * position;", "  vec4 p = inverse(inverse(mv)) * position;");
    let report = Written::from(&["lit.vert"]).graded(&[("#version 410 core", "#version 140"), inverse]);
    assert_eq!(report["verdict"], "correct", "{report:#}");
    assert!(report["diagnostics"].to_string().contains("only from `#version 150` on"), "{report:#}");
}

/// The driver keeps each member of an array of structures in an array of its own.
#[test]
fn lights_may_be_handed_to_a_function_as_a_whole() {
    let colour = vec!["all[i].color"; 24].join(" + ");
    let report = Written::from(&["lanterns.frag"]).graded(&[
        ("vec3 shade(Light light, vec3 n)\n{", "vec3 shade(Light all[3], int i, vec3 n)\n{\n    Light light = all[i];"),
        ("return light.color", &format!("return ({colour}) / 24.0")),
        ("shade(lights[i], n)", "shade(lights, i, n)"),
    ]);
    assert_eq!(report["verdict"], "correct", "{report:#}");
}

fn graded(copy: &Copy, text: &str) -> serde_json::Value {
    let file = copy.around.path().join("toon.frag");
    fs::write(&file, text).unwrap();
    json(&file, &["--assignment", &copy.folder().display().to_string(), "--lang", "en"])
}
