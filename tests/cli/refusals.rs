//! What `ggrade assignment new` does not take, named with the place and what to write instead.

use super::ggrade;
use predicates::prelude::*;
use std::fs;
use std::path::Path;

/// What `new` says where it refuses, in both languages; nothing is written.
fn refused(name: &str, text: &str, en: &[&str], ja: &str) {
    let around = tempfile::tempdir().unwrap();
    let (file, folder) = (around.path().join(name), around.path().join("homework"));
    fs::write(&file, text).unwrap();
    for (language, parts) in [("en", en), ("ja", &[ja][..])] {
        let mut command = ggrade();
        command.args(["assignment", "new"]).arg(&folder).arg("--from").arg(&file).args(["--lang", language]);
        let assert = command.assert().code(2).stdout("");
        let said = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
        parts.iter().for_each(|part| assert!(said.contains(part), "{part} in {said}"));
    }
    assert!(!folder.exists());
}

#[test]
fn an_error_in_a_solution_is_named_with_line_and_column() {
    let text = "#version 330 core\nin vec3 n;\nout vec4 c;\nvoid main()\n{\n    c = vec4(nn, 1.0);\n}\n";
    refused("a.frag", text, &["line 6, column 14: there is no variable `nn`"], "6 行目 14 桁目");
    let three =
        "#version 330 core\nin vec3 position;\nvoid main() { gl_Position = modelViewMatrix * vec4(position, 1.0); }\n";
    refused("a.vert", three, &["line 3", "write `uniform mat4 modelViewMatrix;`"], "uniform mat4 modelViewMatrix;");
    refused(
        "old.frag",
        "void main() { gl_FragColor = vec4(1.0); }\n",
        &["old.frag, line 1: there is no #version", "#version 330 core"],
        "#version がありません",
    );
    refused(
        "es.frag",
        "#version 300 es\nvoid main() { }\n",
        &["es.frag, line 1: #version 300 es is not desktop GLSL"],
        "#version 300 es",
    );
    let sampler = "#version 400 core\nuniform samplerCubeArray fog;\nin vec4 p;\nout vec4 c;\nvoid main() { c = texture(fog, p); }\n";
    refused(
        "a.frag",
        sampler,
        &["line 2, column 26: `fog` is a samplerCubeArray", "sampler3D and samplerCube"],
        "samplerCubeArray",
    );
}

#[test]
fn marks_that_do_not_fit_are_named_by_their_line() {
    let around =
        |body: &str| format!("#version 330 core\nout vec4 c;\nvoid main()\n{{\n{body}\n    c = vec4(1.0);\n}}\n");
    refused(
        "a.frag",
        &around("// ggrade: begin"),
        &["line 5: the part that begins here does not end"],
        "終わりがありません",
    );
    refused("a.frag", &around("// ggrade: end"), &["line 5: no part begins before this mark"], "始まりがありません");
    refused(
        "a.frag",
        &around("// ggrade: stop"),
        &["line 5, column 12: `stop` is no mark"],
        "`stop` という印はありません",
    );
    let used = "#version 330 core\nout vec4 c;\nvec4 f()\n{\n// ggrade: begin\n    const int x = 3;\n// ggrade: end\n    float a[x];\n    a[0] = 1.0;\n    return vec4(a[0]);\n}\nvoid main()\n{\n    c = f();\n}\n";
    refused("a.frag", used, &["line 8", "`// ggrade: instead"], "コンパイルできません");
}

#[test]
fn what_a_test_of_piglit_has_beyond_a_homework_is_named_by_its_line() {
    let test = |more: &str| {
        format!(
            "[require]\nGLSL >= 1.30\n\n[vertex shader passthrough]\n\n[fragment shader]\n#version 130\nout vec4 c;\nvoid main() {{ c = vec4(0.1); }}\n{more}\n[test]\ndraw rect -1 -1 2 2\n"
        )
    };
    refused(
        "a.shader_test",
        &test("[geometry shader]"),
        &["line 10, column 1: `[geometry shader]` is not taken"],
        "[geometry shader]",
    );
    refused(
        "a.shader_test",
        &test("[test]\ntolerance 0.1 0.1 0.1 0.1"),
        &["line 11, column 1: `tolerance"],
        "tolerance",
    );
    refused("a.shader_test", "[fragment shader]\nvoid main() { }\n", &["there is no [vertex shader]"], "ありません");
}

#[test]
fn nothing_is_overwritten() {
    let around = tempfile::tempdir().unwrap();
    fs::write(around.path().join("mine.txt"), "mine").unwrap();
    let new = |arguments: &[&str]| {
        let mut command = ggrade();
        command
            .args(["assignment", "new"])
            .arg(around.path())
            .args(arguments)
            .arg("--from")
            .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/authoring/mist.frag"));
        command
    };
    new(&[]).assert().code(2).stderr(predicate::str::contains("is not an empty folder"));
    assert_eq!(fs::read_dir(around.path()).unwrap().count(), 1);
    ggrade()
        .args(["assignment", "new"])
        .arg(around.path().join("other"))
        .assert()
        .code(2)
        .stderr(predicate::str::contains("--from solution.frag"));
}
