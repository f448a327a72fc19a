//! What a grading writes: pictures, the animation, and the page.

use super::{ggrade, sample_like};
use predicates::prelude::*;

#[test]
fn pictures_and_the_animation_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let frames = folder.path().join("pictures");
    ggrade().arg("grade").arg(sample_like("wrong", "specular-missing--")).arg("--frames").arg(&frames).assert().code(1);
    for name in ["yours-00.png", "expected-24.png", "difference-12.png"] {
        let picture = image::open(frames.join(name)).unwrap();
        assert_eq!((picture.width(), picture.height()), (640, 480), "{name}");
    }
    let animation = std::fs::File::open(frames.join("animation.png")).unwrap();
    let reader = png::Decoder::new(std::io::BufReader::new(animation)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 25);
}

#[test]
fn the_page_stands_alone() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("report.html");
    ggrade()
        .arg("grade")
        .arg(sample_like("wrong", "specular-phong--"))
        .args(["--format", "html", "--lang", "ja", "--output"])
        .arg(&page)
        .assert()
        .code(1)
        .stdout("");
    let text = std::fs::read_to_string(page).unwrap();
    assert!(text.contains("data:image/png;base64,") && text.contains("鏡面反射光"));
    assert!(!text.contains("src=\"http") && !text.contains("href=\"http"));
}

#[test]
fn an_unwritable_folder_ends_with_3_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let occupied = folder.path().join("occupied");
    std::fs::write(&occupied, "a file").unwrap();
    ggrade()
        .arg("grade")
        .arg(sample_like("accepted/answers", "plain-int-zero"))
        .arg("--frames")
        .arg(&occupied)
        .assert()
        .code(3)
        .stderr(predicate::str::contains("occupied"));
}

#[test]
fn a_frame_that_agrees_has_nothing_in_its_difference_picture() {
    let folder = tempfile::tempdir().unwrap();
    let half = sample_like("wrong", "specular-half-unnormalized--average");
    for (file, differing) in [(sample_like("accepted/answers", ""), 0), (half, 1)] {
        ggrade().arg("grade").arg(&file).arg("--frames").arg(folder.path()).assert().code(differing);
        // What agrees is drawn in greys.
        let is_coloured = |frame: &usize| {
            let path = folder.path().join(format!("difference-{frame:02}.png"));
            let picture = image::open(path).unwrap().to_rgb8();
            picture.pixels().any(|pixel| pixel.0[0] != pixel.0[1] || pixel.0[1] != pixel.0[2])
        };
        assert_eq!((0..25).filter(is_coloured).count(), usize::from(differing == 1), "{}", file.display());
    }
}
