//! From a solution to a homework: what `ggrade assignment new` writes grades at once, and what is no solution is named.

use super::ggrade;
use predicates::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn solution(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/authoring").join(name)
}

/// A homework that was written from solutions, in a folder `homework`.
struct Written {
    around: TempDir,
    said: String,
}

impl Written {
    fn from(files: &[&str]) -> Self {
        let around = tempfile::tempdir().unwrap();
        let folder = around.path().join("homework");
        let mut command = ggrade();
        command.args(["assignment", "new"]).arg(&folder).arg("--from").args(files.iter().map(|file| solution(file)));
        let output = command.output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(0), "{files:?}: {said}{}", String::from_utf8_lossy(&output.stderr));
        Self { around, said }
    }

    fn folder(&self) -> PathBuf {
        self.around.path().join("homework")
    }

    fn text(&self, file: &str) -> String {
        fs::read_to_string(self.folder().join(file)).unwrap()
    }

    /// The homework is what the schema says, which lies beside it, and its own check finds nothing.
    fn grades(&self) {
        let schema: serde_json::Value = serde_json::from_str(&self.text(".assignment.schema.json")).unwrap();
        let manifest: serde_json::Value = toml::from_str(&self.text("assignment.toml")).unwrap();
        jsonschema::validate(&schema, &manifest).unwrap();
        ggrade().args(["assignment", "check"]).arg(self.folder()).assert().code(0);
    }

    /// The report of a hand-in: the solution, with some texts replaced.
    fn graded(&self, changes: &[(&str, &str)]) -> serde_json::Value {
        let hand_in = self.around.path().join("hand-in");
        fs::create_dir_all(&hand_in).unwrap();
        let manifest = self.text("assignment.toml");
        let names = manifest.lines().filter_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"'));
        let mut count = 0;
        for name in names.filter(|name| name.ends_with(".vert") || name.ends_with(".frag")) {
            let mut text = self.text(&format!("solution.{}", name.rsplit('.').next().unwrap()));
            for (from, to) in changes {
                count += text.matches(from).count();
                text = text.replacen(from, to, 1);
            }
            fs::write(hand_in.join(name), text).unwrap();
        }
        assert_eq!(count, changes.len(), "each change stands once in the solution: {changes:?}");
        let output = ggrade()
            .arg("grade")
            .arg(&hand_in)
            .arg("--assignment")
            .arg(self.folder())
            .args(["--format", "json"])
            .output();
        serde_json::from_slice(&output.unwrap().stdout).unwrap()
    }

    /// The solution is right, and is not with a change that shows.
    fn tells(&self, from: &str, to: &str) {
        self.grades();
        let wrong = self.graded(&[(from, to)]);
        assert_eq!(wrong["verdict"], "wrong", "{from} → {to}");
        assert!(wrong["score"].as_f64().unwrap() < 100.0);
    }
}

#[test]
fn a_fragment_shader_with_maps_and_a_lamp_becomes_a_homework() {
    let written = Written::from(&["varnish.frag"]);
    written.tells("texture(material.specular, TexCoords).r", "1.0");
    let report = written.graded(&[("ambient + diffuse + varnish", "ambient + diffuse")]);
    assert_eq!(report["mistakes"][0], "no-varnish", "{report:#}");
}

#[test]
fn several_lamps_in_an_array_of_structures_become_a_homework() {
    let written = Written::from(&["lamps.frag"]);
    written.tells("i < LAMPS", "i < LAMPS - 1");
    let manifest = written.text("assignment.toml");
    assert!(manifest.contains("name = \"lamps\"\nvalue = [\n    { position = "), "one entry for the array: {manifest}");
}

#[test]
fn fog_becomes_a_homework() {
    Written::from(&["mist.frag"]).tells("pow(fogDensity * d, 2.0)", "fogDensity * d");
}

#[test]
fn tone_mapping_of_a_window_becomes_a_homework() {
    let written = Written::from(&["develop.frag"]);
    written.tells("1.0 / gamma", "gamma");
    assert!(written.text("assignment.toml").contains("fullscreen"), "nothing of a camera is in it");
}

#[test]
fn a_cube_map_and_fresnel_in_both_stages_become_a_homework() {
    let written = Written::from(&["glass.vert", "glass.frag"]);
    written.tells("reflect(-V, N)", "reflect(V, N)");
}

#[test]
fn a_dissolve_by_noise_becomes_a_homework() {
    let written = Written::from(&["moth.frag"]);
    written.tells("n < threshold", "n < 0.45");
}

#[test]
fn a_picture_of_a_page_that_shares_shaders_becomes_a_homework() {
    let written = Written::from(&["tunnel.frag"]);
    written.tells("10.0 / r + iTime", "10.0 / r");
    let solution = written.text("solution.frag");
    assert!(
        solution.starts_with("#version 330 core\nuniform vec3 iResolution;\nuniform float iTime;\nout vec4 pixel;")
    );
    assert!(written.text("starter.frag").contains("fragColor = vec4(0.5, 0.5, 0.5, 1.0);"));
}

#[test]
fn a_vertex_shader_with_the_names_of_this_course_becomes_a_homework() {
    let written = Written::from(&["course.vert"]);
    written.tells("vec3 h = normalize(l + v)", "vec3 h = l + v");
    let manifest = written.text("assignment.toml");
    for (name, carries) in [
        ("pv", "position"),
        ("nv", "normal"),
        ("mw", "model-view"),
        ("mc", "model-view-projection"),
        ("mg", "normal-matrix"),
    ] {
        assert!(manifest.contains(&format!("name = \"{name}\"\ncarries = \"{carries}\"")), "{name}");
    }
    assert!(manifest.contains("環境光") && manifest.contains("Specular reflection"));
}

#[test]
fn waves_become_a_homework() {
    Written::from(&["ripples.vert"]).tells("amplitude * sin(phase)", "amplitude * cos(phase)");
}

#[test]
fn a_normal_map_with_a_block_between_the_stages_becomes_a_homework() {
    Written::from(&["brick.vert", "brick.frag"])
        .tells("2.0 * texture(u_normalMap, fs_in.uv).xyz - 1.0", "texture(u_normalMap, fs_in.uv).xyz");
}

#[test]
fn a_shader_in_the_space_of_the_eye_becomes_a_homework() {
    let written = Written::from(&["eye-space.frag"]);
    written.tells("pow(1.0 - max(dot(n, v), 0.0), 3.0)", "pow(1.0 - max(dot(n, v), 0.0), 2.0)");
    assert!(written.text("fixed.vert").contains("vViewPosition = (view"), "{}", written.text("fixed.vert"));
}

#[test]
fn a_shader_with_the_names_of_old_becomes_a_homework() {
    let written = Written::from(&["old.vert", "old.frag"]);
    written.tells("8.0 * place.y", "8.0 * place.x");
    assert!(written.text("starter.frag").contains("gl_FragColor = vec4(0.5, 0.5, 0.5, 1.0);"));
}

#[test]
fn what_stands_between_marks_is_not_handed_out() {
    let written = Written::from(&["marked.frag"]);
    written.grades();
    let starter = written.text("starter.frag");
    assert!(!starter.contains("normalize(l + v)") && !starter.contains("ggrade:"), "{starter}");
    // What the rest uses is declared.
    assert!(
        starter.contains(
            "    // Write your code here.\n    float diffuse = 0.0;\n    float specular = 0.0;\n    vec3 c ="
        )
    );
    assert!(written.said.contains("between `// ggrade: begin` and `// ggrade: end`"));
    // A value in the file is what the host sets.
    assert!(written.text("assignment.toml").contains("name = \"shininess\"\nvalue = 24.0"));
}

#[test]
fn tests_of_piglit_become_homeworks() {
    let squares = Written::from(&["squares.shader_test"]);
    squares.tells("gl_FragCoord.x", "gl_FragCoord.y");
    let manifest = squares.text("assignment.toml");
    assert!(manifest.contains("i < 1 ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(0.0, 0.0, 1.0, 1.0)"), "{manifest}");
    assert!(manifest.contains("window = [120, 100]"));
    let fan = Written::from(&["fan.shader_test"]);
    fan.tells("colour * colour", "colour");
    assert!(fan.text("assignment.toml").contains("triangles = [[0, 1, 2], [0, 2, 3]]"));
}

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
    let sampler =
        "#version 330 core\nuniform sampler3D fog;\nin vec3 p;\nout vec4 c;\nvoid main() { c = texture(fog, p); }\n";
    refused("a.frag", sampler, &["line 2, column 19: `fog` is a sampler3D", "sampler2D and samplerCube"], "sampler3D");
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
    let used = "#version 330 core\nout vec4 c;\nvec4 f()\n{\n// ggrade: begin\n    vec4 x = vec4(0.2);\n// ggrade: end\n    return x;\n}\nvoid main()\n{\n    c = f();\n}\n";
    refused("a.frag", used, &["line 8, column 12", "`// ggrade: instead"], "コンパイルできません");
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
        command.args(["assignment", "new"]).arg(around.path()).args(arguments).arg("--from").arg(solution("mist.frag"));
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

#[test]
fn a_folder_is_shown_as_a_person_reads_it() {
    for (language, parts) in [
        (
            "en",
            [
                "ggsample06: Gouraud shading",
                "vec4 pv  carries position",
                "diffuse  30 points",
                "specular-half-unnormalized",
            ],
        ),
        ("ja", ["グーローシェーディング", "mat4 mc  carries model-view-projection", "合計 100 点", "ダイジェスト"]),
    ] {
        let mut command = ggrade();
        let assert = command.args(["assignment", "show", "ggsample06", "--lang", language]).assert().code(0);
        let said = String::from_utf8_lossy(&assert.get_output().stdout).into_owned();
        parts.iter().for_each(|part| assert!(said.contains(part), "{part} in {said}"));
    }
    ggrade().args(["assignment", "show", "no-such"]).assert().code(2);
}
