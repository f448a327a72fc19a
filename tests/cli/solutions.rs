//! Solutions with what is rare in GLSL: each becomes a homework whose pictures are those of real OpenGL, and answers in other words are right.

use super::authoring::Written;

/// An answer with these changes of the solution is right, and the interpreter computes what the driver does.
fn is_right(written: &Written, changes: &[(&str, &str)]) {
    let report = written.graded(changes);
    assert_eq!(
        (&report["verdict"], &report["cross_check"]["opinion"]),
        (&"correct".into(), &"agrees".into()),
        "{report:#}"
    );
}

#[test]
fn what_covers_what_follows_the_depth_that_a_solution_writes() {
    let written = Written::from(&["shells.frag"]);
    written.tells("0.4 * gl_FragCoord.z", "0.6 + 0.4 * gl_FragCoord.z");
    is_right(&written, &[("layout(depth_any) out float gl_FragDepth;", "")]);
    // Without a depth of its own a fragment has the surface's.
    let plain = written.graded(&[("    gl_FragDepth = gl_FrontFacing ?", "    float unused = gl_FrontFacing ?")]);
    assert_eq!(plain["verdict"], "wrong", "{plain:#}");
}

#[test]
fn the_window_is_counted_from_the_top_where_a_solution_says_so() {
    let written = Written::from(&["page.frag"]);
    written.tells("layout(origin_upper_left, pixel_center_integer) in", "layout(pixel_center_integer) in");
    let halves = [
        (
            "layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;",
            "layout(origin_upper_left) in vec4 gl_FragCoord;",
        ),
        ("gl_FragCoord.xy /", "(gl_FragCoord.xy - 0.5) /"),
        ("mod(gl_FragCoord.y,", "mod(gl_FragCoord.y - 0.5,"),
    ];
    is_right(&written, &halves);
    let own = [
        ("layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;", "vec2 place;"),
        ("void main()\n{", "void main()\n{\n    place = vec2(gl_FragCoord.x, resolution.y - gl_FragCoord.y) - 0.5;"),
        ("gl_FragCoord.xy /", "place /"),
        ("mod(gl_FragCoord.y,", "mod(place.y,"),
        ("- 0.2 * dFdy(gl_FragCoord.y)", "+ 0.2"),
    ];
    is_right(&written, &own);
}

#[test]
fn each_block_of_an_array_is_filled() {
    let written = Written::from(&["beams.frag"]);
    written.tells("i < beams.length()", "i < 1");
    is_right(
        &written,
        &[("} beams[2];", "} lamps[2];"), ("beams.length()", "2"), ("vec3 sum", "#define beams lamps\n    vec3 sum")],
    );
}

#[test]
fn a_second_opinion_reads_a_block_as_an_answer_declares_it() {
    let written = Written::from(&["lit.vert"]);
    let named = [
        ("vec4 ldiff; };", "vec4 ldiff; } light;"),
        ("(lpos * p.w - p * lpos.w)", "(light.lpos * p.w - p * light.lpos.w)"),
        ("* ldiff;", "* light.ldiff;"),
        ("= lamb +", "= light.lamb +"),
    ];
    let renamed = [
        ("vec4 lpos; vec4 lamb; vec4 ldiff;", "vec4 at; vec4 all[2];"),
        ("(lpos * p.w - p * lpos.w)", "(at * p.w - p * at.w)"),
        ("* ldiff;", "* all[1];"),
        ("= lamb +", "= all[0] +"),
    ];
    for changes in [named, renamed] {
        is_right(&written, &changes);
        let found = &written.graded(&changes)["cross_check"];
        assert_eq!(found["undefined"], 0, "{found:#}");
    }
}

#[test]
fn instances_are_counted() {
    let written = Written::from(&["flags.vert"]);
    assert!(written.text("assignment.toml").contains("instances = 3"));
    written.tells("+ 0.4 * far", "");
    is_right(
        &written,
        &[("float far = float(gl_InstanceID)", "float far = 0.0;\n    for (int i = 0; i < gl_InstanceID; i++) far++")],
    );
}

#[test]
fn structures_and_arrays_of_blocks_go_from_stage_to_stage() {
    let written = Written::from(&["sieve.vert", "sieve.frag"]);
    written.tells("normalMatrix * aNormal", "aNormal");
    Written::from(&["sieve.vert"]).grades();
    let named = [
        ("} from[2];", "} own[2];"),
        ("normalize(from[i].way)", "normalize(own[i].way)"),
        ("dot(from[1].screen, from[1].screen)", "dot(own[0].screen, own[0].screen)"),
    ];
    is_right(&written, &named);
    // What is not thrown away stands where it should.
    let whole = written.graded(&[("discard;", ";")]);
    let shape = whole["rubric"].as_array().unwrap().iter().find(|line| line["id"] == "shape").unwrap();
    assert_eq!((&whole["verdict"], &shape["points"]), (&"wrong".into(), &shape["max_points"]), "{whole:#}");
}
