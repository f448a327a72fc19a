//! A homework of two stages with derivatives, a `switch`, and an array between the stages, and what answers to it are told.

use super::authoring::Written;

const FRAGMENT: &str = "marble.frag";

fn written() -> Written {
    Written::from(&["marble.vert", "marble.frag"])
}

/// The pixels of four have different derivatives of such a height: those that are compared have the same place among them.
#[test]
fn a_derivative_of_what_is_no_plane_is_graded_as_it_is_drawn() {
    let written = written();
    written.tells("abs(dFdy(height))", "abs(dFdx(height))");
    let report = written.graded(&[("abs(dFdx(height)) + abs(dFdy(height))", "fwidth(height)")]);
    assert_eq!((&report["verdict"], &report["cross_check"]["opinion"]), (&"correct".into(), &"agrees".into()));
}

#[test]
fn an_attribute_of_another_name_is_known_by_its_location() {
    let written = written();
    let used = [("int(aTexCoords.y", "int(uv.y"), ("coords = aTexCoords", "coords = uv")];
    let report = written.graded(
        &[&[("in vec2 aTexCoords", "in vec4 uv"), used[0]][..], &[("coords = aTexCoords", "coords = uv.xy")]].concat(),
    );
    assert_eq!(
        (&report["verdict"], &report["cross_check"]["opinion"]),
        (&"correct".into(), &"agrees".into()),
        "{report:#}"
    );
    // A name that nobody feeds, and no location by which it could be.
    let report = written.graded(&[&[("layout(location = 2) in vec2 aTexCoords", "in vec2 uv")][..], &used].concat());
    assert_eq!(report["verdict"], "wrong");
}

#[test]
fn a_case_that_runs_into_the_next_is_named() {
    let report = written().graded(&[("palette[band % 3];\n    break;", "palette[band % 3];")]);
    let first = report["mistakes"][0].as_str().unwrap();
    assert!(first.starts_with("derived-falls-through-"), "{report:#}");
}

#[test]
fn what_the_stages_declare_differently_is_said_with_its_line() {
    let written = written();
    let said = |changes: &[(&str, &str)], part: &str| {
        let report = written.graded(changes);
        let first = &report["diagnostics"][0];
        assert_eq!((&report["verdict"], &first["file"]), (&"rejected".into(), &FRAGMENT.into()), "{report:#}");
        assert!(first["message"].as_str().unwrap().contains(part), "{first:#}");
        first["line"].as_u64()
    };
    assert_eq!(
        said(&[("out vec3 towards[2]", "out vec3 towards[3]")], "`vec3 towards[3]` in the vertex shader"),
        Some(3)
    );
    let placed = [
        ("#version 330 core\nlayout", "#version 410 core\nlayout"),
        ("#version 330 core\nin", "#version 410 core\nin"),
        ("out vec2 coords", "layout(location = 5) out vec2 coords"),
        ("in vec2 coords", "layout(location = 6) in vec2 coords"),
    ];
    assert_eq!(said(&placed, "location 5 in the vertex shader, and 6 here"), Some(5));
}
