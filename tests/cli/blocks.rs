//! Blocks: those of uniforms, with all that std140 lays out in ways of its own, and those that go from stage to stage.

use super::authoring::Written;
use super::folders::{Copy, MANIFEST};
use super::{ggrade, json};
use std::fs;

/// Matrices of two rows, rows before columns, and arrays of numbers lie in blocks in ways of their own. The check holds the picture
/// against that of real OpenGL, which lays the blocks out by itself.
#[test]
fn blocks_and_structures_hold_all_kinds_of_matrices_and_arrays() {
    let declared = "uniform int tones;\nstruct Turn { mat2 by; float much; };\nuniform Turn own;\nlayout (std140) uniform Light {\n\
         mat2 turn; float strengths[3]; layout (row_major) mat3 mixing; layout (row_major) mat2x3 tilt; mat3x2 shears[2];\n\
         Turn turns[2];\n} light;\n";
    let computed = "vec2 turned = light.turn * own.by * light.turns[1].by * colour.rg + light.shears[1] * colour;\n\
         colour = light.mixing * vec3(turned, colour.b) * light.strengths[1] * own.much * light.turns[1].much;\n\
         tint = vec4(colour + light.tilt * turned + vec3(light.turn[1], own.by[0][1]) * 0.1, 1.0)";
    let turn = "by = [0.9, 0.1, 0.2, 0.8], much = 0.9";
    let values = format!(
        "\n[[uniform]]\nname = \"own\"\nvalue = {{ {turn} }}\n[[uniform]]\nname = \"Light\"\nvalue = {{ turn = [1, 0.2, 0.1, 0.7], \
         strengths = [0.1, 0.8, 0.3], mixing = [1, 0.1, 0, 0.2, 0.9, 0, 0, 0.3, 0.8], tilt = [0.1, 0.2, 0, 0, 0.1, 0.05], \
         shears = [[1, 2, 3, 4, 5, 6], [0, 0.1, 0.2, 0, 0.05, 0.1]], turns = [{{ {turn} }}, {{ by = [1, 0, 0.3, 1], much = 0.7 }}] }}\n"
    );
    let copy = Copy::of("tests/homeworks/toon")
        .replace("starter.frag", "uniform int tones;\n", declared)
        .replace("solution.frag", "uniform int tones;\n", declared)
        .replace("solution.frag", "tint = vec4(colour, 1.0)", computed);
    let manifest = fs::read_to_string(copy.path(MANIFEST)).unwrap();
    fs::write(copy.path(MANIFEST), manifest + &values).unwrap();
    let output = ggrade().args(["assignment", "check"]).arg(copy.folder()).args(["--lang", "en"]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("ok   the solution: Correct") && !said.contains("otherwise"), "{said}");
}

const WAVING: &str = r#"
id = "waving"
title = { en = "Waving", ja = "波" }
file = [
  { name = "waving.vert", stage = "vertex", starter = "starter.vert", solution = "solution.vert" },
  { name = "waving.frag", stage = "fragment", starter = "starter.frag", solution = "solution.frag" },
]
input = [{ name = "place", carries = "position" }, { name = "normal", carries = "normal" }]
uniform = [
  { name = "model", carries = "model" },
  { name = "camera", carries = "view-projection" },
  { name = "sun", value = [1, 2, 3], probe = { within = [[-1, -1, -1], [1, 1, 1]] } },
]
[scene]
mesh = { grid = {} }
turn = 6.2831853
eye = [0, 1.6, 3]
target = [0, 0, 0]
up = [0, 1, 0]
fovy = 0.8
near = 0.1
far = 20
window = [160, 120]
background = [20, 20, 30, 255]
poses = 2
depth_test = "less"
[[rubric]]
id = "shape"
points = 30
judges = "gl_Position"
label = { en = "Shape", ja = "形" }
[[rubric]]
id = "colour"
points = 70
label = { en = "Colour", ja = "色" }
"#;

const VERTEX: &str = "#version 410 core
in vec4 place;
in vec3 normal;
uniform mat4 model, camera;
out Handed { vec3 facing; flat int number; mat2 turn; } handed;
void main()
{
  handed.facing = transpose(inverse(mat3(model))) * normal;
  handed.number = gl_VertexID % 3;
  handed.turn = mat2(1.0, place.x, place.z, 1.0);
  gl_Position = camera * model * place;
}
";

const FRAGMENT: &str = "#version 410 core
uniform vec3 sun;
in Handed { vec3 facing; flat int number; mat2 turn; } own;
out vec4 colour;
void main()
{
  float lit = max(dot(normalize(own.facing), normalize(sun)), 0.0);
  colour = vec4(lit, 0.3 * float(own.number), abs((own.turn * vec2(0.2, 0.3)).x), 1.0);
}
";

#[test]
fn a_block_goes_from_stage_to_stage_and_a_slip_is_named_where_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let homework = folder.path().join("waving");
    fs::create_dir(&homework).unwrap();
    let starters =
        [VERTEX, FRAGMENT].map(|text| text.lines().filter(|line| !line.contains("wn.") && !line.contains("ed.")));
    let [vertex, fragment] = starters.map(|lines| lines.collect::<Vec<_>>().join("\n"));
    let fragment = fragment.replace("void main()\n{", "void main()\n{\n  colour = vec4(1.0);");
    let files = [
        (MANIFEST, WAVING),
        ("solution.vert", VERTEX),
        ("solution.frag", FRAGMENT),
        ("starter.vert", &vertex),
        ("starter.frag", &fragment),
    ];
    files.iter().for_each(|(name, text)| fs::write(homework.join(name), text).unwrap());
    let output = ggrade().args(["assignment", "check"]).arg(&homework).args(["--lang", "en"]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("ok   real OpenGL"), "{said}");
    // The fragment stage is as it should be, and reads what the vertex stage has wrong.
    let wrong = VERTEX.replace("transpose(inverse(mat3(model))) * normal", "normal");
    let [vertex, fragment] = ["waving.vert", "waving.frag"].map(|name| folder.path().join(name));
    fs::write(&vertex, wrong).unwrap();
    fs::write(&fragment, FRAGMENT).unwrap();
    let rest = [fragment.to_str().unwrap(), "--assignment", homework.to_str().unwrap()];
    let report = json(&vertex, &rest);
    let lines = report["rubric"].as_array().unwrap();
    let colour = lines.iter().find(|line| line["id"] == "colour").unwrap();
    assert_eq!((&colour["file"], &colour["line"]), (&"waving.vert".into(), &8.into()), "{colour}");
}

/// The program fills a block byte by byte, as the homework lays it out: names are a student's own affair, the order is not.
#[test]
fn a_block_is_filled_by_its_bytes_whatever_its_members_are_called() {
    let written = Written::from(&["lanterns.frag"]);
    let said = |report: &serde_json::Value| report["diagnostics"][0]["message"].as_str().unwrap_or_default().to_owned();
    let line = |report: &serde_json::Value| report["diagnostics"][0]["line"].as_u64().unwrap_or_default();
    // Other names, and one vector for a vector and a number behind it.
    let members = "    vec3 position;\n    float intensity;\n    vec3 color;\n    float radius;\n";
    let renamed = [
        (members, "    vec3 at;\n    float strength;\n    vec3 paint;\n    float reach;\n"),
        ("light.position", "light.at"),
        ("light.radius", "light.reach"),
        ("light.color * light.intensity", "light.paint * light.strength"),
        ("Light lights[3]", "Light lamps[3]"),
        ("shade(lights[i]", "shade(lamps[i]"),
    ];
    let packed = [
        (members, "    vec4 at;\n    vec4 paint;\n"),
        ("light.position", "light.at.xyz"),
        ("light.radius", "light.paint.w"),
        ("light.color * light.intensity", "light.paint.rgb * light.at.w"),
    ];
    for changes in [&renamed[..], &packed[..]] {
        let report = written.graded(changes);
        let found = (&report["verdict"], &report["cross_check"]["opinion"], &report["diagnostics"]);
        assert_eq!(found, (&"correct".into(), &"agrees".into(), &serde_json::json!([])), "{report:#}");
    }
    // Members of one type in another order have each other's values.
    let swapped = "    vec3 color;\n    float radius;\n    vec3 position;\n    float intensity;\n";
    let report = written.graded(&[(members, swapped)]);
    assert_eq!((&report["verdict"], line(&report)), (&"wrong".into(), 3), "{report:#}");
    assert!(
        said(&report)
            .contains("`lights[0].color` lies in the block `Lights` where the program writes `lights[0].position`")
    );
    assert_eq!(report["diagnostics"][0]["severity"], "warning");
    // Of other types there is no value.
    let report =
        written.graded(&[("    Light lights[3];\n    int lightCount;", "    int lightCount;\n    Light lights[3];")]);
    assert_eq!((&report["verdict"], line(&report)), (&"rejected".into(), 10), "{report:#}");
    assert!(
        said(&report).contains("`lightCount` lies in the block `Lights` where the program writes `lights[0].position`")
    );
}

/// A student's block may have another layout than the homework's: OpenGL reads the program's bytes by it.
#[test]
fn a_block_is_read_by_the_layout_that_the_student_declares() {
    let block = "layout (std140) uniform Mix { float gain; mat3 mixing; mat2x3 tilt; } own;\n";
    let computed = "colour = own.gain * (own.mixing * colour) + own.tilt * colour.xy;\n  tint = vec4(colour, 1.0)";
    let values = "\n[[uniform]]\nname = \"Mix\"\nvalue = { gain = 0.8, mixing = [1, 0.1, 0, 0.2, 0.9, 0, 0, 0.3, 0.8], \
                  tilt = [0.1, 0.2, 0, 0, 0.1, 0.05] }\n";
    let copy = Copy::of("tests/homeworks/toon")
        .replace("starter.frag", "uniform int tones;\n", &format!("uniform int tones;\n{block}"))
        .replace("solution.frag", "uniform int tones;\n", &format!("uniform int tones;\n{block}"))
        .replace("solution.frag", "tint = vec4(colour, 1.0)", computed);
    let manifest = fs::read_to_string(copy.path(MANIFEST)).unwrap();
    fs::write(copy.path(MANIFEST), manifest + values).unwrap();
    let right = fs::read_to_string(copy.path("solution.frag")).unwrap();
    let graded = |layout: &str, changes: &[[&str; 2]]| {
        let text = right.replace(block, layout).replace("#version 330 core", "#version 440 core");
        let text = changes.iter().fold(text, |text, [from, to]| text.replace(from, to));
        let file = copy.path("toon.frag");
        fs::write(&file, text).unwrap();
        json(&file, &["--assignment", copy.folder().to_str().unwrap()])
    };
    let rows =
        "layout (std140, row_major) uniform Mix { float gain; mat3 mixing; layout (column_major) mat2x3 tilt; } own;\n";
    let mixed = ["own.mixing * colour", "colour * own.mixing"];
    assert_eq!(graded(rows, &[mixed])["score"], 100.0);
    let transposed = graded(rows, &[]);
    assert_eq!(transposed["verdict"], "wrong");
    let said = transposed["diagnostics"].to_string();
    assert!(said.contains("`mixing` is read from its block row by row"), "{said}");
    // Rows of two numbers, 16 bytes each, lie where columns of two do.
    let default = "layout (std140, row_major) uniform;\nuniform Mix { float gain; mat3 mixing; mat3x2 turned; } own;\n";
    let turned = ["own.tilt * colour.xy", "colour.xy * own.turned"];
    assert_eq!(graded(default, &[mixed, turned])["score"], 100.0);
    let offset = "layout (std140) uniform Mix { layout (offset = 64) mat2x3 tilt; } own;\n";
    let written_in = [["own.gain", "0.8"], ["own.mixing", "mat3(1, 0.1, 0, 0.2, 0.9, 0, 0, 0.3, 0.8)"]];
    assert_eq!(graded(offset, &written_in)["score"], 100.0);
    assert_eq!(graded(&offset.replace("64", "96"), &written_in)["verdict"], "rejected");
}
