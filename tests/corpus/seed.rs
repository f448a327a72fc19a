//! The seed decides nothing, and what is made for the known probes is found out.

use assert_cmd::Command;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// The reports of a folder's files by name: score, points of each line, mistakes and messages.
fn reports(folder: &Path, seed: u64) -> BTreeMap<String, String> {
    let out = tempfile::tempdir().unwrap();
    let output = Command::cargo_bin("ggrade")
        .unwrap()
        .arg("batch")
        .arg(folder)
        .args(["--formats", "csv", "--force", "--seed", &seed.to_string(), "--out"])
        .arg(out.path())
        .output()
        .unwrap();
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&output.stderr));
    let lines = std::fs::read_to_string(out.path().join("results.jsonl")).unwrap();
    let results = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let said = |result: Value| {
        let graded = &result["outcome"]["graded"];
        let name = result["path"].as_str()?.to_owned();
        Some((name, format!("{} {} {} {}", graded["score"], graded["rubric"], graded["mistakes"], graded["advice"])))
    };
    results.filter_map(said).collect()
}

#[test]
fn no_seed_decides_what_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/wrong");
    for entry in std::fs::read_dir(samples).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        // What is not explained depends on the most probes.
        let kinds = ["unexplained--", "hard-coded--", "nearly-right--", "flat-per-triangle--"];
        if name.ends_with(".vert") && kinds.iter().any(|kind| name.starts_with(kind)) {
            std::fs::copy(&path, folder.path().join(name)).unwrap();
        }
    }
    let first = reports(folder.path(), 3);
    assert!(first.len() > 30, "{}", first.len());
    // The corpus grades them with a third seed.
    assert_eq!(reports(folder.path(), 987_654_321), first);
}

/// A shader that is right under the known probes' cameras and the scene's, and shows only ambient light under others.
fn made_for_the_probes() -> String {
    let assignment = reference::assignment("ggsample06").unwrap();
    let known = assignment.judging_probes().groups.into_iter().map(|group| group.matrices);
    let poses = assignment.scene.all_poses();
    let cameras = known.chain(poses.iter().map(|pose| pose.matrices));
    let is_known: Vec<String> =
        cameras.map(|m| format!("x == {}u", (m.model_view_projection.w_axis.x as f32).to_bits())).collect();
    let starter = &assignment.files[0].starter;
    let head = starter.split("void main").next().unwrap();
    let mut text = head.to_owned();
    write!(
        text,
        "void main(void)\n{{\n\
         vec4 p = mw * pv;\n\
         vec3 v = -normalize(p.xyz / p.w);\n\
         vec3 l = normalize((pl * p.w - p * pl.w).xyz);\n\
         vec3 n = normalize((mg * cv).xyz);\n\
         vec3 h = normalize(l + v);\n\
         vc = kamb * lamb;\n\
         uint x = floatBitsToUint(mc[3].x);\n\
         if ({}) {{\n\
         vc += max(dot(n, l), 0.0) * kdiff * ldiff + pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;\n\
         }}\n\
         gl_Position = mc * pv;\n}}\n",
        is_known.join(" || "),
    )
    .unwrap();
    text
}

#[test]
fn what_is_right_only_at_the_known_probes_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ggsample06.vert"), made_for_the_probes()).unwrap();
    for seed in [1, 2, 3] {
        let reports = reports(folder.path(), seed);
        let report = reports.values().next().unwrap();
        assert!(report.starts_with("10.0 ") && report.contains("hard-coded"), "{report}");
    }
}
