//! Homeworks in folders: what ggrade draws and what the reference draws, against a real OpenGL driver.

use super::opengl::{OpenGl, Version};
use ggrade::opengl::{disagreeing, frames, texts};
use ggrade::render::{AdapterKind, Device, RenderScene, Renderer};
use ggrade::source;
use ggrade::translate::{HomeworkProgram, LinkedInterface, Stage};
use reference::interpreter::Texels;
use reference::rasteriser::{Coverage, Frame};
use reference::{Assignment, Folder, assignment};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest difference of a channel between the drivers, in 1/255.
const DRIVER_TOLERANCE: u8 = 1;
/// One of so many pixels may differ more between the drivers: those at which the nearest texel depends on a last bit.
const DOUBTFUL: usize = 500;

/// Pixels of all frames: how many are painted, how many differ between the drivers, and how many of those that are no
/// silhouette differ between OpenGL and the reference.
#[derive(Debug, Default)]
struct Counts {
    pixels: usize,
    painted: usize,
    drivers: usize,
    judged: usize,
    reference: usize,
}

fn differs(from: &[u8], from_opengl: [u8; 4], by: u8) -> bool {
    (0..3).any(|axis| from[axis].abs_diff(from_opengl[axis]) > by)
}

fn compared(gl: &OpenGl, assignment: &Assignment) -> Counts {
    let texts = texts(assignment, |file| &file.solution.text);
    let own = assignment.fixed.first().map(|fixed| (fixed.stage, fixed.text.as_str()));
    let program = HomeworkProgram::new(LinkedInterface::of(assignment).unwrap(), own).unwrap();
    let read = |file: &assignment::HandedIn| {
        let stage = file.stage;
        (stage, source::read_stage(stage, &file.solution.name, file.solution.text.as_bytes()).expect("a text"))
    };
    let sources: Vec<_> = assignment.files.iter().map(read).collect();
    let given: Vec<_> = sources.iter().map(|(stage, source)| (*stage, source)).collect();
    let linked = program.translate(&given).unwrap_or_else(|refusal| panic!("{refusal:?}"));
    let device = Device::open(AdapterKind::Software).unwrap_or_else(|fault| panic!("{fault}"));
    let mut renderer = Renderer::new(device, None).unwrap();
    let scene = RenderScene::of(assignment, &[]);
    let ours = renderer.render_program(&linked, &scene).unwrap_or_else(|fault| panic!("{fault}")).frames;
    let mut counts = Counts::default();
    let which = of_each_view(assignment);
    let drawn = frames(gl.driver(), assignment, &scene, texts, &which);
    let drawn = drawn.unwrap_or_else(|rejection| panic!("{rejection:?}"));
    let poses = assignment.scene.all_poses();
    for (index, drawn) in which.into_iter().zip(drawn) {
        let right = assignment.right_frame(&poses[index]);
        let ours = ours.picture(index as u32);
        counts.pixels += drawn.len();
        counts.painted += drawn.iter().filter(|pixel| differs(&scene.background, **pixel, 0)).count();
        let ours = ours.rgba.chunks_exact(4).zip(&drawn);
        counts.drivers += ours.filter(|(ours, pixel)| differs(ours, **pixel, DRIVER_TOLERANCE)).count();
        counts.judged += right.coverage.iter().filter(|coverage| **coverage != Coverage::Silhouette).count();
        counts.reference += disagreeing(&right, &drawn);
    }
    counts
}

/// One of so many frames of a view is looked at, its first among them: between two of them only time and camera have gone on.
const FRAMES_OF_A_VIEW: usize = 4;

/// The numbers of these frames.
fn of_each_view(assignment: &Assignment) -> Vec<usize> {
    let poses = assignment.scene.all_poses();
    let views = poses.chunk_by(|a, b| a.view == b.view);
    let mut first = 0;
    let some = views.flat_map(|view| {
        first += view.len();
        (first - view.len()..first).step_by(FRAMES_OF_A_VIEW)
    });
    some.collect()
}

/// Every homework that is built in or in `tests/homeworks` is what real OpenGL draws of it, textures included.
#[test]
fn homeworks_are_what_opengl_draws() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let folder = |path: PathBuf| {
        Arc::new(Folder::read(&path).and_then(Assignment::load).unwrap_or_else(|error| panic!("{error}")))
    };
    let in_folders = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks")).unwrap();
    let in_folders = in_folders.map(|entry| folder(entry.unwrap().path()));
    let mut names = Vec::new();
    for assignment in reference::assignments().cloned().chain(in_folders) {
        let counts = compared(&gl, &assignment);
        let name = &assignment.id;
        println!("{name}: {counts:?}");
        assert!(counts.painted > counts.pixels / 20 && counts.judged > counts.pixels / 2, "{name}: {counts:?}");
        assert!(counts.drivers <= counts.pixels / DOUBTFUL, "{name}: {counts:?}");
        assert_eq!(counts.reference, 0, "{name}: {counts:?}");
        names.push(assignment.id.clone());
    }
    assert!(["carpet", "falloff-pixar", "phong-shading"].iter().all(|known| names.iter().any(|name| name == known)));
}

/// One of so many frames of a right sample is drawn by OpenGL.
const SOME_FRAMES: usize = 11;

/// What the samples say is right is what real OpenGL draws of them: the solution's pictures, or those of what is accepted.
#[test]
fn right_samples_of_the_built_in_homeworks_are_what_opengl_draws() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let submissions = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions");
    let (mut count, mut wrong) = (0, Vec::new());
    // The first homework has 447 of them, and tests of its own.
    for assignment in reference::assignments().filter(|assignment| assignment.id != "ggsample06") {
        let scene = RenderScene::of(assignment, &[]);
        let mut right_frames: BTreeMap<usize, Vec<Frame>> = BTreeMap::new();
        for (index, pose) in assignment.scene.all_poses().iter().enumerate().step_by(SOME_FRAMES) {
            let accepted = assignment.accepted().map(|answer| assignment.frame_of(answer, pose));
            right_frames.insert(index, std::iter::once(assignment.right_frame(pose)).chain(accepted).collect());
        }
        for sample in samples(&submissions.join(&assignment.id).join("accepted")) {
            let read = |file: &assignment::HandedIn| {
                let is_it = |path: &PathBuf| path.extension() == Path::new(&file.name).extension();
                let name =
                    if sample.is_dir() { samples(&sample).into_iter().find(is_it) } else { Some(sample.clone()) };
                let name = name.unwrap_or_else(|| panic!("{} has no {}", sample.display(), file.name));
                let bytes = std::fs::read(&name).unwrap_or_else(|error| panic!("{}: {error}", name.display()));
                match &file.program {
                    Some(program) => {
                        source::read_program(&program.array, &file.name, &bytes).expect("a program").source
                    }
                    None => source::read_stage(file.stage, &file.name, &bytes).expect("a text"),
                }
                .text
            };
            let handed_in: Vec<(Stage, String)> =
                assignment.files.iter().map(|file| (file.stage, read(file))).collect();
            let own = |file: &assignment::HandedIn| -> &str {
                handed_in.iter().find(|(stage, _)| *stage == file.stage).map_or("", |(_, text)| text)
            };
            let [mut vertex, mut fragment] = texts(assignment, |file| file.starter_shader());
            for file in &assignment.files {
                match file.stage {
                    Stage::Vertex => vertex = own(file),
                    Stage::Fragment => fragment = own(file),
                }
            }
            count += 1;
            let extended = extended(assignment, [vertex, fragment]);
            let extended_scene = extended.as_ref().map(|extended| RenderScene::of(extended, &[]));
            let scene = extended_scene.as_ref().unwrap_or(&scene);
            let which: Vec<usize> = right_frames.keys().copied().collect();
            let drawn = match frames(gl.driver(), assignment, scene, [vertex, fragment], &which) {
                Ok(drawn) => drawn,
                Err(rejection) => {
                    wrong.push(format!("{}: {rejection:?}", sample.display()));
                    continue;
                }
            };
            for ((index, right), drawn) in right_frames.iter().zip(&drawn) {
                let off = right.iter().map(|right| disagreeing(right, drawn)).min().unwrap_or_default();
                if off > 0 {
                    wrong.push(format!("{}, frame {index}: {off} pixels", sample.display()));
                }
            }
        }
    }
    assert!(count > 150, "{count} samples");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The homework with the uniforms that a student adds, where there are such; of two with one name only the student's.
fn extended(assignment: &Assignment, texts: [&str; 2]) -> Option<Assignment> {
    if assignment.free.is_empty() {
        return None;
    }
    let texts = [(Stage::Vertex, texts[0]), (Stage::Fragment, texts[1])];
    let taken = assignment.taken(&texts, &assignment.judging_probes());
    let mut extended = assignment.with(&taken);
    let all = extended.interface.uniforms.clone();
    let is_last = |place: usize| all[place + 1..].iter().all(|other| other.path != all[place].path);
    let mut place = 0..;
    extended.interface.uniforms.retain(|_| place.next().is_some_and(is_last));
    Some(extended)
}

/// The samples of a folder: files, and folders that have their expectation beside them.
fn samples(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths.filter(|path| path.extension().is_none_or(|extension| extension != "json")).collect();
    found.sort();
    found
}

/// A picture's rows are uploaded as a host program does it: turned over where the folder does not say otherwise.
#[test]
fn pictures_stand_as_a_host_program_loads_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/carpet");
    let assignment = Folder::read(&folder).and_then(Assignment::load).unwrap_or_else(|error| panic!("{error}"));
    for (number, file, flip) in [(0, "weave.png", true), (1, "pictures/label.png", false)] {
        let picture = image::open(folder.join(file)).unwrap();
        let picture = if flip { picture.flipv() } else { picture }.to_rgba8();
        let texture = &assignment.textures[number].levels[0];
        assert_eq!(texture.size, [picture.width() as usize, picture.height() as usize, 1]);
        let (Texels::Bytes(texels) | Texels::Srgb(texels)) = &texture.texels else { panic!("{file} has bytes") };
        assert_eq!(texels.as_flattened(), picture.as_raw(), "{file}");
    }
}
