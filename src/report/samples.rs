//! Reports and pictures made by hand, for the tests of the views.

use super::*;
use crate::diagnostic::DiagnosticStage;
use crate::hand_in::HandedInFile;
use crate::source::{self, Source};
use reference::interpreter::Stage;
use std::sync::Arc;

/// The course's frame, an eighth in each direction.
pub(crate) const WIDTH: u32 = 80;
pub(crate) const HEIGHT: u32 = 60;
const POSES: u32 = 25;

pub(crate) const SOURCE: &str = "#version 410 core
// 中間ベクトルを正規化していない <script>alert(1)</script>
in vec4 pv;
in vec4 cv;
uniform mat4 mw;
uniform mat4 mc;
uniform mat4 mg;
out vec4 vc;
void main(void)
{
  vec3 h = (l + v) / 2.0;\t// H
  if (a < b && c > d) discard;
}
";

pub(crate) fn all() -> [Report; 4] {
    [correct(), wrong(), rejected(), stopped()]
}

/// [`SOURCE`] as a file of this name.
pub(crate) fn source(name: &str) -> Source {
    source::readable(&HandedInFile::new(name, SOURCE)).unwrap()
}

/// The homework that they are of.
pub(crate) fn assignment() -> &'static reference::Assignment {
    reference::assignment("ggsample06").expect("built in")
}

pub(crate) fn correct() -> Report {
    let fine = || Text::new("Right in every frame and probe.", "すべてのフレームと検査点で正しい結果です。");
    let line = |id: &str, en: &str, ja: &str, points: f64| RubricLine {
        id: id.into(),
        label: Text::new(en, ja),
        points,
        max_points: points,
        mistake: None,
        message: fine(),
        file: None,
        line: None,
        graded: None,
    };
    Report {
        assignment: "ggsample06".into(),
        assignment_digest: "0123456789abcdef".into(),
        sources: vec![SourceInfo {
            name: "ggsample06.vert".into(),
            stage: Some(Stage::Vertex),
            sha256: "3f".repeat(32),
            bytes: 1833,
            encoding: "utf-8".into(),
        }],
        verdict: Verdict::Correct,
        score: 100.0,
        max_score: 100.0,
        rubric: vec![
            line("shape", "Shape", "形状", 10.0),
            line("ambient", "Ambient", "環境光", 20.0),
            line("diffuse", "Diffuse", "拡散反射光", 30.0),
            line("specular", "Specular", "鏡面反射光", 40.0),
        ],
        mistakes: vec![],
        repairs: Vec::new(),
        explanation: None,
        advice: vec![],
        diagnostics: vec![],
        frames: (0..POSES).map(|k| frame(k, 0.0)).collect(),
        probes: ProbeResult { seed: 20_240_613, samples: 640, mismatched: 0, max_difference: Some(4.1e-7) },
        map_lookup: None,
        own_values: None,
        environment: Environment {
            ggrade: "0.1.0".into(),
            renderer: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
            driver: "llvmpipe Mesa 22.3.6".into(),
        },
        cross_check: None,
        hints: Hints::Full,
        elapsed_ms: 412.25,
        lateness: None,
        comments: Vec::new(),
    }
}

pub(crate) fn wrong() -> Report {
    let mut report = correct();
    report.verdict = Verdict::Wrong;
    report.score = 80.0;
    report.mistakes = vec!["specular-half-unnormalized".into()];
    report.rubric[3] = RubricLine {
        points: 20.0,
        mistake: Some("specular-half-unnormalized".into()),
        message: Text::new(
            "The half vector `h` on line 11 is not a unit vector. `(l + v) / 2` gets shorter as the angle \
             between `l` and `v` opens, and raised to the 80th power that darkens the highlight. H on \
             slide 21 has length 1: what is the length of yours?",
            "11 行目の中間ベクトル `h` の長さが 1 になっていません。`(l + v) / 2` は `l` と `v` の間の角が開くほど\
             短くなり、80 乗するとハイライトが暗くなります。スライド 21 枚目の H は単位ベクトルです。`h` の長さを調べてみましょう。",
        ),
        line: Some(11),
        ..report.rubric[3].clone()
    };
    report.diagnostics = vec![
        Diagnostic::warning(
            DiagnosticStage::Compile,
            Text::new("This drivers' extension <b>differs</b>.", "この書き方を受け付けないドライバがあります <b>。"),
        )
        .at(12, Some(9))
        .spanning(1)
        .hint(Text::new("Write `h` in another way.", "`h` を別の書き方にしてみましょう。")),
    ];
    let level = |k: u32| f64::from([0, 1, 5, 20, 90, 255][(k % 6) as usize]);
    report.frames = (0..POSES).map(|k| frame(k, level(k))).collect();
    report.probes.mismatched = 231;
    report.probes.max_difference = Some(0.2131);
    report
}

/// What [`wrong`] computes on its way: `h` on line 11 is not what it should be, and what is computed from it neither.
pub(crate) fn own_values() -> OwnValues {
    let all = |numbers: &[f64]| -> Vec<Option<f64>> { numbers.iter().copied().map(Some).collect() };
    let place = |x: f64, yours: f64, agrees| ValuePlace {
        frame: Some(4),
        at: Some([x, 0.75]),
        pixel: None,
        yours: all(&[yours, 0.0, 0.0]),
        right: all(&[0.5, 0.0, 0.0]),
        agrees,
    };
    let known = |value: f64, right: f64| {
        Some(ValueAt { value: all(&[value]), right: Some(all(&[right])), agrees: Some(value == right) })
    };
    let line = |line, name: &str, values| ValueLine {
        file: None,
        line,
        name: name.into(),
        function: None,
        times: 1,
        means: None,
        values,
    };
    let unknown = ValueAt { value: vec![None, Some(-2.0)], right: None, agrees: None };
    let h = ValueLine {
        means: Some(Text::new("the half vector", "中間ベクトル")),
        function: Some("half_way".into()),
        times: 3,
        ..line(11, "h", vec![known(0.75, 1.0), known(1.0, 1.0)])
    };
    OwnValues {
        places: vec![place(0.25, 0.25, false), place(0.75, 0.5, true)],
        lines: vec![
            line(10, "a.xy", vec![Some(unknown), None]),
            h,
            line(12, "vc", vec![known(0.25, 0.5), known(0.5, 0.5)]),
        ],
    }
}

/// [`wrong`] of a homework of two files: the mistake is in the second one.
pub(crate) fn two_files() -> Report {
    let mut report = wrong();
    let source = |name: &str, stage| SourceInfo { name: name.into(), stage: Some(stage), ..report.sources[0].clone() };
    let (vertex, fragment) = (Stage::Vertex, Stage::Fragment);
    report.sources = vec![source("ggsample11.vert", vertex), source("ggsample11.frag", fragment)];
    report.rubric[3].file = Some("ggsample11.frag".into());
    report.diagnostics[0].file = Some("ggsample11.vert".into());
    report
}

pub(crate) fn rejected() -> Report {
    let mut report = nothing_drawn(Verdict::Rejected);
    report.diagnostics = vec![
        Diagnostic::error(
            DiagnosticStage::Compile,
            Text::new("`Max` is not declared.", "`Max` は宣言されていません。"),
        )
        .at(11, Some(12))
        .spanning(3)
        .hint(Text::new(
            "GLSL tells capital letters from small ones: look at `max`.",
            "GLSL は大文字と小文字を区別します。`max` と比べてみましょう。",
        )),
        Diagnostic::error(
            DiagnosticStage::Link,
            Text::new("The output `vc` is missing.", "出力変数 `vc` がありません。"),
        ),
    ];
    report
}

pub(crate) fn stopped() -> Report {
    let mut report = nothing_drawn(Verdict::Stopped);
    report.diagnostics = vec![
        Diagnostic::error(
            DiagnosticStage::Run,
            Text::new("A loop ran more than 65536 times.", "ループが 65536 回を超えて繰り返されました。"),
        )
        .at(10, None),
    ];
    report
}

fn nothing_drawn(verdict: Verdict) -> Report {
    let mut report = correct();
    report.verdict = verdict;
    report.score = 0.0;
    report.frames.clear();
    report.probes = ProbeResult::default();
    for line in &mut report.rubric {
        line.points = 0.0;
        line.message = Text::new("Not drawn.", "描画されていません。");
    }
    report
}

fn frame(pose: u32, level: f64) -> FrameResult {
    FrameResult {
        t: f64::from(pose) / f64::from(POSES),
        coverage_mismatches: 0,
        max_difference: level,
        mean_difference: level / 3.0,
        mismatched_pixels: if level > 0.0 { 100 * pose + 1 } else { 0 },
    }
}

/// Shaded triangles that turn; the highlight of `yours` is a little darker.
pub(crate) fn pictures() -> Pictures {
    let pair = |shine| (0..POSES).map(move |pose| triangle(pose, shine));
    Pictures {
        yours: pair(60).collect(),
        expected: pair(100).collect(),
        terms: Arc::new([TermPictures {
            id: "specular".into(),
            t: 0.48,
            yours: Some(Arc::new(triangle(12, 30))),
            expected: Arc::new(triangle(12, 90)),
        }]),
        cycle: 5.0,
    }
}

fn triangle(pose: u32, shine: u32) -> Picture {
    let turn = (f64::from(pose) / f64::from(POSES) * std::f64::consts::TAU).cos().abs();
    let mut rgba = Vec::new();
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let half = f64::from(y) * 0.5 * turn;
            let inside = (f64::from(x) - 40.0).abs() <= half && y > 8;
            let glow = (shine * y / HEIGHT) as u8;
            rgba.extend(if inside { [100 + glow, glow, glow, 255] } else { [255, 255, 255, 0] });
        }
    }
    Picture::whole(WIDTH, HEIGHT, rgba)
}
