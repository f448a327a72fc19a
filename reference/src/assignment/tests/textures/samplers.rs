//! Every sampler reads a texture that fits.

use super::{changed, line_of};
use crate::assignment::MANIFEST;
use crate::assignment::tests::refused;

#[test]
fn every_sampler_reads_a_texture_that_fits() {
    let uniform = |path: &str, from: &str, to: &str, en: &str, ja: &str| {
        let text = refused(changed(MANIFEST, from, to));
        let line = line_of(&format!("name = \"{path}\""));
        assert!(text.en.starts_with(&format!("{MANIFEST}, line {line}, uniform `{path}`: ")), "{}", text.en);
        assert!(text.en.contains(en) && text.ja.contains(ja), "{} {}", text.en, text.ja);
    };
    let label = "name = \"label\"\ntexture = \"label\"";
    let put = |what: &str| format!("name = \"label\"\n{what}");
    let path = "material.weave";
    uniform(
        path,
        "texture = \"weave\"",
        "texture = \"wave\"",
        "there is no texture `wave` (there is `weave`, `label`",
        "あるもの: `weave`",
    );
    uniform(
        path,
        "texture = \"weave\"",
        "value = 1",
        "it is a sampler2D: write `texture = \"…\"`",
        "[[texture]] の名前だけ",
    );
    uniform(
        path,
        "texture = \"weave\"",
        "texture = \"weave\"\nprobe = { within = [0, 1] }",
        "and nothing else",
        "だけを書いて",
    );
    uniform(path, "texture = \"weave\"", "texture = 1", "write it between quotation marks", "引用符で囲んで");
    uniform(
        path,
        "texture = \"weave\"",
        "texture = \"sky\"",
        "`sky` is read by a samplerCube",
        "`sky` を読むのは samplerCube",
    );
    uniform("material.maps", "[\"knots\", \"dust\"]", "[\"knots\"]", "there is no element 1", "");
    uniform("material.gloss", "value = 0.25", "texture = \"weave\"", "is a float in the shader", "float です");
    // What the shader declares is named in the shader.
    for (kind, en) in [
        (
            "uniform isampler2D label; uniform sampler2D lamps;",
            "it is a isampler2D in the shader, and `label` is read by a sampler2D",
        ),
        ("uniform sampler2DShadow label; uniform sampler2D lamps;", "it is a sampler2DShadow in the shader"),
    ] {
        let folder = changed("fixed.frag", "uniform sampler2D label, lamps;", kind);
        let text =
            folder.text("fixed.frag").expect("a text").replace("texture(label, place.xy * 1.5 - 0.25)", "vec4(1.0)");
        let mut folder = folder;
        folder.files.insert("fixed.frag".into(), text.into());
        let text = refused(folder);
        assert!(text.en.contains(en), "{}", text.en);
    }
    let lacking = refused(changed(MANIFEST, &format!("[[uniform]]\n{label}"), ""));
    assert!(
        lacking.en.starts_with("fixed.frag, line 7: the sampler2D `label` has no texture: write [[uniform]]"),
        "{}",
        lacking.en
    );
    assert!(
        lacking.ja.contains("fixed.frag の 7 行目") && lacking.ja.contains("テクスチャがありません"),
        "{}",
        lacking.ja
    );
    let unread = refused(changed(MANIFEST, label, &put("texture = \"lamps\"")));
    let line = line_of("name = \"label\"");
    assert!(
        unread.en.starts_with(&format!("{MANIFEST}, line {line}, texture `label`: no uniform reads it")),
        "{}",
        unread.en
    );
    assert!(unread.ja.contains("どの uniform からも読まれません"), "{}", unread.ja);
}
