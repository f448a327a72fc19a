//! From a solution to a homework: what `ggrade assignment new` writes grades at once, and what is no solution is named.

use super::ggrade;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

pub fn solution(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/authoring").join(name)
}

/// A homework that was written from solutions, in a folder `homework`.
pub struct Written {
    around: TempDir,
    pub said: String,
}

impl Written {
    pub fn from(files: &[&str]) -> Self {
        let around = tempfile::tempdir().unwrap();
        let folder = around.path().join("homework");
        let mut command = ggrade();
        command.args(["assignment", "new"]).arg(&folder).arg("--from").args(files.iter().map(|file| solution(file)));
        let output = command.output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(0), "{files:?}: {said}{}", String::from_utf8_lossy(&output.stderr));
        Self { around, said }
    }

    pub fn folder(&self) -> PathBuf {
        self.around.path().join("homework")
    }

    pub fn text(&self, file: &str) -> String {
        fs::read_to_string(self.folder().join(file)).unwrap()
    }

    /// The homework is what the schema says, which lies beside it, and its own check finds nothing.
    pub fn grades(&self) {
        let schema: serde_json::Value = serde_json::from_str(&self.text(".assignment.schema.json")).unwrap();
        let manifest: serde_json::Value = toml::from_str(&self.text("assignment.toml")).unwrap();
        jsonschema::validate(&schema, &manifest).unwrap();
        let checked = ggrade().args(["assignment", "check"]).arg(self.folder()).args(["--lang", "en"]).assert().code(0);
        let said = String::from_utf8_lossy(&checked.get_output().stdout).into_owned();
        assert!(said.contains("draws the same in all"), "real OpenGL has its say: {said}");
    }

    /// The report of a hand-in: the solution, with some texts replaced.
    pub fn graded(&self, changes: &[(&str, &str)]) -> serde_json::Value {
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
            .args(["--format", "json", "--deadline", "20", "--cross-check"])
            .output();
        serde_json::from_slice(&output.unwrap().stdout).unwrap()
    }

    /// The solution is right, and is not with a change that shows.
    pub fn tells(&self, from: &str, to: &str) {
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
fn a_solution_that_real_opengl_refuses_is_told() {
    let written = Written::from(&["ripples.vert"]);
    let path = written.folder().join("solution.vert");
    let text = fs::read_to_string(&path).unwrap();
    // glslang makes a float of it in every version; drivers do so from 4.20 on.
    fs::write(&path, text.replacen("void main", "float one() { return 1; }\nvoid main", 1)).unwrap();
    let check = || {
        let mut command = ggrade();
        command.args(["assignment", "check", "--lang", "en"]).arg(written.folder());
        command
    };
    let refused = check().output().unwrap();
    let said = String::from_utf8(refused.stdout).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("refuses the solution") && said.contains("`one' returning float"), "{said}");
    // Without a driver nothing is held against it, and it says so.
    let without = check().env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere").output().unwrap();
    let said = String::from_utf8(without.stdout).unwrap();
    assert_eq!(without.status.code(), Some(0), "{said}");
    assert!(said.contains("not held against real OpenGL") && said.contains("apt-get install libegl1"), "{said}");
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
    let written = Written::from(&["mist.frag"]);
    written.tells("pow(fogDensity * d, 2.0)", "fogDensity * d");
    let manifest = written.text("assignment.toml");
    for line in ["id = \"fog\"", "en = \"Fog\", ja = \"霧\"", "en = \"Diffuse reflection\", ja = \"拡散反射光\""]
    {
        assert!(manifest.contains(line), "{line} in {manifest}");
    }
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
fn reflections_in_a_room_become_a_homework() {
    let written = Written::from(&["room.vert", "room.frag"]);
    written.tells("pow(1.0 - max(dot(n, v), 0.0), 5.0)", "pow(1.0 - max(dot(n, v), 0.0), 4.0)");
    // A change that another one writes over is no mistake of the student's.
    let constant = written.graded(&[("mix(vec3(0.04), baseColor, metalness)", "vec3(0.04)")]);
    assert_eq!(constant["mistakes"], serde_json::json!(["derived-other-value-f0"]), "{constant:#}");
}

#[test]
fn a_dissolve_by_noise_becomes_a_homework() {
    let written = Written::from(&["moth.frag"]);
    written.tells("n < threshold", "n < 0.45");
}

#[test]
fn both_sides_of_a_surface_become_a_homework() {
    let written = Written::from(&["leaf.frag"]);
    assert!(!written.text("assignment.toml").contains("cull"), "the inside is seen through the holes");
    written.tells("n = -n;", "");
    let report = written.graded(&[("n = -n;", "")]);
    let mismatched = &report["probes"]["mismatched"];
    assert!(mismatched.as_u64().unwrap() > 20, "backs are probed: {mismatched}");
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
fn arrays_tables_and_whole_numbers_in_textures_become_a_homework() {
    let written = Written::from(&["tiles.frag"]);
    written.tells("float(tile)", "float(tile) + 1.0");
    for (from, to) in [
        ("texelFetch(map, cell, 0)", "texelFetch(map, cell.yx, 0)"),
        ("(c * (size - 1.0) + 0.5) / size", "c"),
        ("texture(ramp, uv.x)", "texture(ramp, uv.y)"),
    ] {
        assert_eq!(written.graded(&[(from, to)])["verdict"], "wrong", "{to}");
    }
    // Texels are read in other ways as well.
    let by_place = [("texelFetch(map, cell, 0)", "texture(map, (vec2(cell) + 0.5) / vec2(cells))")];
    assert_eq!(written.graded(&by_place)["verdict"], "correct");
    let report = written.graded(&[("uniform usampler2D map", "uniform isampler2D map"), ("uint tile", "int tile")]);
    assert_eq!(report["verdict"], "rejected");
    let said = report["diagnostics"][0]["message"].as_str().unwrap();
    assert!(said.contains("`isampler2D`") && said.contains("`usampler2D`"), "{said}");
}

#[test]
fn whole_numbers_of_vertices_become_a_homework() {
    let written = Written::from(&["skin.vert"]);
    written.tells("bones[boneIds[i]]", "bones[i]");
    // The same bits, without a sign.
    assert_eq!(written.graded(&[("in ivec4 boneIds", "in uvec4 boneIds")])["verdict"], "correct");
    let floats = written.graded(&[("in ivec4 boneIds", "in vec4 boneIds"), ("[boneIds[i]]", "[int(boneIds[i])]")]);
    assert_eq!(floats["verdict"], "rejected");
    // Two shares are no coordinates, and add up to 1 as well.
    let pair = Written::from(&["arm.vert"]);
    assert_eq!(pair.graded(&[("weights.y", "(1.0 - weights.x)")])["verdict"], "correct");
    assert_eq!(pair.graded(&[("boneIds.y", "boneIds.x")])["verdict"], "wrong");
}

#[test]
fn switches_and_kinds_in_a_block_become_a_homework() {
    let written = Written::from(&["workshop.frag"]);
    written.tells("if (!lamp.isOn)", "if (i < 0)");
    for (from, to) in [("case 1:", "case 7:"), ("case 2:", "case 7:"), ("sharpness)", "16.0)")] {
        assert_eq!(written.graded(&[(from, to)])["verdict"], "wrong", "{from} → {to}");
    }
    // A block is filled with bits, in which a truth value is a whole number.
    let number = [("bool isOn", "uint isOn"), ("!lamp.isOn", "lamp.isOn == 0u")];
    assert_eq!(written.graded(&number)["verdict"], "correct");
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
