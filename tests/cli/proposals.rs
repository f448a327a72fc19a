//! What `ggrade assignment new` proposes: starters that run, values that show what they do, words that a lecturer keeps.

use super::authoring::{Written, solution};
use super::ggrade;
use std::fs;

#[test]
fn marks_around_a_return_or_a_whole_body_leave_a_starter_that_runs() {
    let written = Written::from(&["enclosed.frag"]);
    written.grades();
    let starter = written.text("starter.frag");
    for kept in [
        "    // Write your code here.\n    float near = 0.0;\n    return 1.0",
        "vec3 shade(vec3 n) {\n    // Write your code here.\n    return vec3(0.0);\n}",
        "    // Write your code here.\n    colour = vec3(0.5);\n}",
        "    // Write your code here.\n    FragColor = vec4(0.5, 0.5, 0.5, 1.0);\n}",
    ] {
        assert!(starter.contains(kept), "{kept} in {starter}");
    }
    assert!(written.said.contains("`return vec3(0.0);` stands for the `return` of `shade`"), "{}", written.said);
    // What is to stand in a place has to be said where a function would end without its result.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lacking.frag");
    let text = fs::read_to_string(solution("enclosed.frag")).unwrap();
    fs::write(&path, text.replacen("    vec3 toLight =", "    // ggrade: instead float d;\n    vec3 toLight =", 1))
        .unwrap();
    let mut command = ggrade();
    command.args(["assignment", "new", "--lang", "en"]).arg(folder.path().join("homework")).arg("--from").arg(&path);
    let refused = command.assert().code(2);
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(
        said.contains("line 13")
            && said.contains("`shade` has no `return`")
            && said.contains("instead return vec3(0.0);"),
        "{said}"
    );
}

#[test]
fn maps_of_one_kind_are_told_apart() {
    let written = Written::from(&["kettle.frag"]);
    written.tells("texture(material.metalnessMap, TexCoords)", "texture(material.roughnessMap, TexCoords)");
}

#[test]
fn lights_reach_the_scene_and_no_two_are_alike() {
    let written = Written::from(&["lanterns.frag"]);
    let manifest = written.text("assignment.toml");
    for light in ["intensity = 2.0, color = [0.9, 0.6, 0.4], radius = 6.0", "intensity = 2.6,", "radius = 5.4"] {
        assert!(manifest.contains(light), "{light} in {manifest}");
    }
    // Each light is seen, and so is where it ends.
    for (from, to) in [("i < lightCount", "i < lightCount - 1"), ("falloff * falloff", "falloff")] {
        assert_eq!(written.graded(&[(from, to)])["verdict"], "wrong", "{to}");
    }
}

#[test]
fn parts_are_called_by_words_of_the_lecture() {
    let manifest = Written::from(&["kettle.frag"]).text("assignment.toml");
    for label in ["en = \"Angle of the light, N·L\", ja = \"光の当たる角度（N·L）\"", "en = \"Diffuse reflection\""]
    {
        assert!(manifest.contains(label), "{label} in {manifest}");
    }
}

#[test]
fn a_power_of_a_negative_number_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kettle.frag");
    let text = fs::read_to_string(solution("kettle.frag")).unwrap();
    fs::write(
        &path,
        text.replacen("const float PI", "const float K = pow(-2.0, 2.0);\nconst float PI", 1).replacen(
            "0.03 * albedo",
            "0.03 * K * albedo",
            1,
        ),
    )
    .unwrap();
    let line = fs::read_to_string(&path).unwrap().lines().position(|line| line.contains("pow(-2.0")).unwrap() + 1;
    for (language, words) in [("en", "`pow` no value where the base is negative"), ("ja", "底が負のとき")] {
        let mut command = ggrade();
        command
            .args(["assignment", "new", "--lang", language])
            .arg(folder.path().join("homework"))
            .arg("--from")
            .arg(&path);
        let refused = command.assert().code(2);
        let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        let place = [format!("line {line}"), format!("{line} 行目")];
        assert!(said.contains(words) && place.iter().any(|place| said.contains(place)), "{said}");
    }
}
