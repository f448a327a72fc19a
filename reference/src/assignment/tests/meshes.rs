//! What is said of meshes that cannot be read.

use super::{homework, refused};
use crate::Folder;
use crate::assignment::{Assignment, MANIFEST};
use std::sync::Arc;

/// A homework with meshes from files: a folder of the project's tests.
fn furniture() -> Folder {
    homework("furniture")
}

/// The same with a text of a file replaced.
fn changed(file: &str, from: &str, to: &str) -> Folder {
    super::changed(furniture(), file, from, to)
}

#[test]
fn a_mesh_that_cannot_be_read_is_named_by_its_file() {
    for (file, from, to, en, ja) in [
        (
            MANIFEST,
            "models/stool.obj",
            "models/chair.obj",
            "assignment.toml, line 67, `models/chair.obj`: is not in the folder, which has assignment.toml",
            "assignment.toml の 67 行目、`models/chair.obj`: フォルダにありません",
        ),
        (
            MANIFEST,
            "models/stool.obj",
            "fixed.frag",
            "fixed.frag: is not a mesh that can be read: export it as OBJ",
            "fixed.frag: 読み込めるメッシュではありません",
        ),
        (
            "models/stool.obj",
            "vt 1 0",
            "vt 1",
            "models/stool.obj, line 13: is not what OBJ has (texcoord parse error): export the mesh again",
            "models/stool.obj の 13 行目: OBJ として正しくありません",
        ),
        (
            "models/stool.obj",
            "f 1/1 2/2",
            "f 1/1 0/2",
            "models/stool.obj, line 17: `0/2` names what is not there",
            "models/stool.obj の 17 行目: `0/2` の番号のものはありません",
        ),
        (
            "models/vase.gltf",
            "vase%20data.bin",
            "../../secret.bin",
            "models/vase.gltf: reads `../secret.bin`, which is not in the folder: add it",
            "models/vase.gltf: `../secret.bin` を読みますが、フォルダにありません",
        ),
        (
            "models/vase.gltf",
            "\"asset\"",
            "\"asset",
            "models/vase.gltf: is no glTF 2.0, or damaged (",
            "models/vase.gltf: glTF 2.0 ではないか、壊れています",
        ),
    ] {
        let text = refused(changed(file, from, to));
        assert!(text.en.starts_with(en), "{}", text.en);
        assert!(text.ja.starts_with(ja), "{}", text.ja);
    }
}

#[test]
fn a_built_in_mesh_is_named_by_its_line() {
    let said = |to: &str| refused(changed(MANIFEST, "{ file = \"models/stool.obj\" }", to));
    let line = 1 + furniture()
        .text(MANIFEST)
        .expect("a text")
        .lines()
        .position(|line| line.contains("stool.obj"))
        .expect("it");
    let text = said("{ sphere = { radius = -1 } }");
    assert_eq!(text.en, format!("{MANIFEST}, line {line}, scene, `mesh`: its sizes have to be greater than 0"));
    assert_eq!(text.ja, format!("{MANIFEST} の {line} 行目、scene, `mesh`: 大きさは 0 より大きくしてください"));
    let grid = "{ grid = { segments = [300, 300] } }";
    let many: String = (0..5).map(|_| format!("\n[[scene.draw]]\nmesh = {grid}")).collect();
    let text = said(&format!("{grid}{many}\n"));
    assert!(text.en.contains("all meshes up to this one have 453005 vertices: use at most 400000"), "{}", text.en);
    assert!(said("{ torus = { radios = 1 } }").en.contains("there is no key `radios`: write `radius`;"));
}

#[test]
fn what_no_grading_could_draw_in_time_is_refused() {
    // 72 vertices of the stool for each pose, and more of the others.
    let text = refused(changed(MANIFEST, "poses = 4", "poses = 4000"));
    assert!(
        text.en.contains("scene: all frames together draw ") && text.en.contains("use at most 300000"),
        "{}",
        text.en
    );
    assert!(text.ja.contains("全フレームで描く頂点"), "{}", text.ja);
    assert!(Assignment::load(changed(MANIFEST, "poses = 4", "poses = 40")).is_ok());
}

#[test]
fn a_file_that_is_drawn_twice_is_read_once() {
    let assignment = Assignment::load(changed(MANIFEST, "models/leaf.glb", "models/stool.obj")).expect("an assignment");
    let draws = &assignment.scene.views[0].draws;
    assert!(Arc::ptr_eq(&draws[0].mesh, &draws[2].mesh) && !Arc::ptr_eq(&draws[0].mesh, &draws[1].mesh));
}
