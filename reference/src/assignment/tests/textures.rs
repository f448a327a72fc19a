//! What is said of textures that cannot be read, or that nothing reads.

mod samplers;

use super::{homework, refused};
use crate::Folder;
use crate::assignment::{Assignment, MANIFEST};
use crate::interpreter::{Dimension, Filter, Texels, Wrap};

/// A homework with every kind of texture: a folder of the project's tests.
fn carpet() -> Folder {
    homework("carpet")
}

/// The same with a text of a file replaced.
fn changed(file: &str, from: &str, to: &str) -> Folder {
    super::changed(carpet(), file, from, to)
}

/// The line of the manifest on which a text stands.
fn line_of(text: &str) -> usize {
    carpet().text(MANIFEST).expect("a text").lines().position(|line| line.contains(text)).expect(text) + 1
}

#[test]
fn a_texture_is_as_its_entry_says() {
    let assignment = Assignment::load(carpet()).expect("an assignment");
    let [weave, label, dust, knots, lamps, sky] = &assignment.textures[..] else { panic!("six textures") };
    // The upper left corner of the file is red, the lower left blue; the picture stands upright.
    let corners = [0, 11 * 20].map(|place| weave.levels[0].texels.at(place));
    assert_eq!(
        corners,
        [[30, 50, 240, 255], [230, 30, 20, 255]].map(|texel| texel.map(|byte: u8| f64::from(byte) / 255.0))
    );
    assert_eq!((weave.magnify, weave.wrap[..2].to_vec()), (Filter::Linear, vec![Wrap::MirroredRepeat, Wrap::Repeat]));
    assert_eq!(
        (label.magnify, label.minify, label.border),
        (Filter::Nearest, Filter::Nearest, [0.2, 0.4, 0.6, 1.0].map(|x: f64| f64::from(x as f32)))
    );
    assert!(matches!(label.levels[0].texels, Texels::Srgb(_)) && matches!(lamps.levels[0].texels, Texels::Numbers(_)));
    assert_eq!([dust, knots].map(|texture| texture.levels[0].size), [[60, 40, 1], [96, 64, 1]]);
    assert_eq!(lamps.levels[0].texels.at(7), [4.0, 2.0, 1.0, 1.0]);
    assert_eq!((sky.dimension, sky.levels[0].size), (Dimension::Cube, [32, 32, 6]));
}

#[test]
fn pictures_are_layers_or_slices_and_a_line_has_one_coordinate() {
    let read = |lines: &str| {
        let manifest = changed(MANIFEST, "file = \"weave.png\"", lines);
        let text = manifest.text(MANIFEST).expect("a text").to_owned();
        let wrong = refused(manifest);
        // The folder has a sampler2D for it; what it would be read by is said.
        wrong
            .en
            .split("is read by a ")
            .nth(1)
            .unwrap_or_else(|| panic!("{text}: {}", wrong.en))
            .split(':')
            .next()
            .map(str::to_owned)
    };
    for (lines, kind) in [
        ("layers = [\"weave.png\", \"weave.png\"]", "sampler2DArray"),
        ("slices = [{ checker = {} }, { noise = {} }]\nsize = [4, 4]", "sampler3D"),
        ("generate = { checker = {} }\nsize = 8", "sampler1D"),
        ("generate = { checker = {} }\nformat = \"rgba32i\"\nfilter = \"nearest\"", "isampler2D"),
        ("layers = [\"weave.png\"]\nformat = \"rgba32ui\"", "usampler2DArray"),
    ] {
        assert_eq!(read(lines).as_deref(), Some(kind), "{lines}");
    }
}

/// A square PNG whose rows are given from above; a pixel's red is its number.
fn png(numbers: [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().expect("a header").write_image_data(&numbers).expect("rows");
    bytes
}

#[test]
fn a_cube_has_its_faces_in_order_and_the_rows_as_they_stand() {
    let faces = |flip: &str| {
        let names: Vec<_> = (0..6).map(|face| format!("\"{face}.png\"")).collect();
        let sky = "generate = { sky = {} }\nsize = [32, 32]";
        let mut folder = changed(MANIFEST, sky, &format!("cube = [{}]\n{flip}", names.join(", ")));
        for face in 0..6 {
            folder.files.insert(format!("{face}.png"), png([0, 1, 2, 3].map(|pixel| 10 * face + pixel)));
        }
        let assignment = Assignment::load(folder).expect("an assignment");
        let Texels::Bytes(texels) = &assignment.textures[5].levels[0].texels else { panic!("bytes") };
        assert_eq!(
            (assignment.textures[5].dimension, assignment.textures[5].levels[0].size),
            (Dimension::Cube, [2, 2, 6])
        );
        texels.iter().map(|texel| texel[0]).collect::<Vec<u8>>()
    };
    let rows = |order: [u8; 4]| (0..6).flat_map(|face| order.map(|pixel| 10 * face + pixel)).collect::<Vec<u8>>();
    assert_eq!(faces(""), rows([0, 1, 2, 3]));
    assert_eq!(faces("flip = true"), rows([2, 3, 0, 1]));
}

#[test]
fn an_entry_that_makes_no_texture_is_named_with_what_to_try() {
    let size = "size = [60, 40]";
    for (name, from, to, en, ja) in [
        (
            "weave",
            "file = \"weave.png\"\n",
            "",
            "write one of `file`, `cube`, `generate`, `layers` and `slices`",
            "のうち 1 つだけ",
        ),
        (
            "weave",
            "file = \"weave.png\"",
            "file = \"weave.png\"\nsize = [8, 8]",
            "`size` belongs to `generate`",
            "ファイルでは使わない",
        ),
        (
            "weave",
            "file = \"weave.png\"",
            "file = \"weave.png\"\nborder = [0, 0, 0]",
            "seen with `wrap = \"clamp-to-border\"` only",
            "それも書くか",
        ),
        ("label", "border = [0.2,", "border = [1.2,", "`border` has a colour beyond 0 to 1", "範囲を超える色"),
        ("dust", size, "size = [0, 40]", "each at least 1", "1 以上"),
        ("dust", size, "size = [4000, 4000]", "4000 × 4000 pixels are too many", "大きすぎます"),
        ("dust", size, "size = [100000, 1]", "a side has at most 8192", "一辺は 8192 画素以下"),
        ("dust", size, "flip = true", "`flip` belongs to files", "ファイルのためのもの"),
        ("dust", size, "format = \"rgba32i\"\nfilter = \"linear\"", "whole numbers are not mixed", "補間できません"),
        (
            "dust",
            size,
            "format = \"rgba32ui\"\nwrap = \"clamp-to-border\"\nborder = [0, 0, 0]",
            "have no border",
            "`border` はありません",
        ),
        (
            "weave",
            "file = \"weave.png\"",
            "layers = [\"weave.png\", { checker = {} }]",
            "pictures of 20 × 12 and of 256 × 256",
            "同じ大きさ",
        ),
        ("weave", "file = \"weave.png\"", "slices = []", "1 to 256 pictures", "256 枚"),
        ("weave", "file = \"weave.png\"", "layers = [{ sky = {} }]", "a sky is a cube", "キューブマップ"),
        (
            "weave",
            "file = \"weave.png\"",
            "layers = [{ checker = {} }]\nsize = 8",
            "one number is for `generate` alone",
            "`generate` のとき",
        ),
        ("dust", "cells = [5, 3]", "cells = [0, 3]", "`cells` has to be 1 to 512", "`cells` は 1 以上"),
        (
            "lamps",
            "format = \"rgba32f\"",
            "format = \"rgba32f\"\nsrgb = true",
            "`srgb` decodes bytes",
            "8 ビットの値を変換",
        ),
        ("lamps", "format = \"rgba32f\"", "", "or write `format = \"rgba32f\"`", "範囲を超える色"),
        ("sky", "size = [32, 32]", "size = [32, 16]", "the faces of a sky are squares", "正方形です"),
        (
            "sky",
            "size = [32, 32]",
            "wrap = \"repeat\"",
            "a cube ends at the edges of its faces",
            "\"clamp-to-edge\" だけ",
        ),
    ] {
        let text = refused(changed(MANIFEST, from, to));
        let line = line_of(&format!("name = \"{name}\""));
        let [place, ort] = [
            format!("{MANIFEST}, line {line}, texture `{name}`: "),
            format!("{MANIFEST} の {line} 行目、texture `{name}`: "),
        ];
        assert!(text.en.starts_with(&place) && text.en.contains(en), "{to}: {}", text.en);
        assert!(text.ja.starts_with(&ort) && text.ja.contains(ja), "{to}: {}", text.ja);
    }
    let twice = refused(changed(MANIFEST, "name = \"dust\"", "name = \"weave\""));
    assert!(twice.en.contains("texture `weave`: stands twice"), "{}", twice.en);
    let many = "[[texture]]\nname = \"x\"\ngenerate = { checker = {} }\n".repeat(20);
    let many = refused(changed(MANIFEST, "[[input]]", &format!("{many}[[input]]")));
    assert!(many.en.contains("there are 26: use at most 16"), "{}", many.en);
    // What the reader of TOML says has the line as well.
    for (from, to, en) in [
        ("filter = \"nearest\"", "filter = \"cubic\"", "`cubic` is not known here: possible are `nearest`, `linear`"),
        ("wrap = \"clamp-to-border\"", "wrap = \"clamp\"", "write \"repeat\", \"mirrored-repeat\", \"clamp-to-edge\""),
        ("border = [0.2, 0.4, 0.6, 1.0]", "border = [0.2, 0.4]", "a colour is three or four numbers"),
        ("generate = { noise = {", "generate = { clouds = {", "`clouds` is not known here: possible are `checker`"),
        ("file = \"weave.png\"", "cube = [\"weave.png\"]", "invalid length 1, expected an array of length 6"),
    ] {
        let text = refused(changed(MANIFEST, from, to));
        assert!(text.en.starts_with(&format!("{MANIFEST}, line {}: ", line_of(from))), "{}", text.en);
        assert!(text.en.contains(en), "{}", text.en);
    }
}

#[test]
fn a_file_that_is_no_picture_is_named() {
    let with = |bytes: &[u8]| {
        let mut folder = carpet();
        folder.files.insert("weave.png".into(), bytes.to_vec());
        refused(folder)
    };
    let whole = carpet().files["weave.png"].clone();
    for (bytes, en, ja) in [
        (&b"\xff\xd8\xff\xe0JFIF"[..], "is a JPEG file: save it as PNG", "PNG として保存してください"),
        (b"version https://git-lfs.github.com/spec/v1", "is a Git LFS pointer", "Git LFS"),
        (b"", "is no PNG, or damaged", "壊れています"),
        (&whole[..whole.len() / 2], "save it as PNG again", "保存し直してください"),
    ] {
        let text = with(bytes);
        assert!(text.en.starts_with("weave.png, texture `weave`: ") && text.en.contains(en), "{}", text.en);
        assert!(text.ja.starts_with("weave.png、texture `weave`: ") && text.ja.contains(ja), "{}", text.ja);
    }
    let mut folder = carpet();
    folder.files.remove("pictures/label.png");
    let text = refused(folder);
    assert!(
        text.en.starts_with("assignment.toml, line 20, texture `label`, `pictures/label.png`: is not in the folder"),
        "{}",
        text.en
    );
    let outside = refused(changed(MANIFEST, "pictures/label.png", "../waves/assignment.toml"));
    assert!(
        outside.en.starts_with("assignment.toml, line 20, texture `label`, `../waves/assignment.toml`: is not in"),
        "{}",
        outside.en
    );
    let cube = "cube = [\"weave.png\", \"weave.png\", \"weave.png\", \"weave.png\", \"weave.png\", \"weave.png\"]";
    let text = refused(changed(MANIFEST, "file = \"weave.png\"", cube));
    assert!(text.en.contains("has 20 × 12 pixels: the six faces of a cube are squares of one size"), "{}", text.en);
}
