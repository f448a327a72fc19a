//! Homeworks in folders: what ggrade draws and what the reference draws, against a real OpenGL driver.

use super::opengl::{Draw, Kind, OpenGl, Version, Window};
use ggrade::render::{AdapterKind, Batch, Device, Renderer};
use ggrade::source;
use ggrade::translate::{Interface, Program, Stage};
use reference::interpreter::{Scalar, Texels, Texture, Type};
use reference::rasteriser::Coverage;
use reference::scene::{Cull, DepthTest};
use reference::{Assignment, Folder, Value, assignment};
use std::path::Path;

/// Largest difference of a channel between the drivers, in 1/255, and between a driver in f32 and the reference in f64.
const DRIVER_TOLERANCE: u8 = 1;
const REFERENCE_TOLERANCE: u8 = 2;
/// One of so many pixels may differ more between the drivers: those at which the nearest texel hangs on a last bit.
const DOUBTFUL: usize = 500;

fn kind(kind: &Type) -> Kind {
    match kind {
        Type::Vector(Scalar::Float, size) => Kind::Float(*size),
        Type::Vector(Scalar::Uint, size) => Kind::Uint(*size),
        Type::Vector(Scalar::Bool, size) => Kind::Bool(*size),
        Type::Vector(_, size) => Kind::Int(*size),
        Type::Matrix(_, columns, rows) => Kind::Matrix(*columns, *rows),
        // The number of a texture is that of its unit.
        Type::Sampler(_) => Kind::Int(1),
        other => panic!("no uniform or attribute is a {other}"),
    }
}

fn draw(batch: &Batch) -> Draw {
    let uniform = |(path, value): &(String, Value)| (path.clone(), kind(value.kind()), value.numbers().to_vec());
    Draw {
        uniforms: batch.uniforms.iter().map(uniform).collect(),
        attributes: batch
            .attributes
            .iter()
            .map(|(name, values)| (name.clone(), kind(&values.kind), values.numbers.clone()))
            .collect(),
        triangles: batch.triangles.clone(),
        tests_depth: batch.state.depth_test == Some(DepthTest::Less),
        culls_back: batch.state.cull == Cull::Back,
    }
}

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

fn compared(gl: &OpenGl, assignment: &Assignment) -> Counts {
    let of = |wanted: assignment::Stage| {
        let handed_in = assignment.files.iter().map(|file| (file.stage, &file.solution.text));
        let fixed = assignment.fixed.iter().map(|fixed| (fixed.stage, &fixed.text));
        handed_in.chain(fixed).find(|(stage, _)| *stage == wanted).map(|(_, text)| text.as_str()).expect("a stage")
    };
    let texts = [of(assignment::Stage::Vertex), of(assignment::Stage::Fragment)];
    let own = assignment.fixed.first().map(|fixed| (Stage::from(fixed.stage), fixed.text.as_str()));
    let program = Program::new(Interface::of(assignment).unwrap(), own).unwrap();
    let read = |file: &assignment::HandedIn| {
        let stage = Stage::from(file.stage);
        (stage, source::read_stage(stage, &file.solution.name, file.solution.text.as_bytes()).expect("a text"))
    };
    let sources: Vec<_> = assignment.files.iter().map(read).collect();
    let given: Vec<_> = sources.iter().map(|(stage, source)| (*stage, source)).collect();
    let linked = program.translate(&given).unwrap_or_else(|refusal| panic!("{refusal:?}"));
    let device = Device::open(AdapterKind::Software).unwrap_or_else(|fault| panic!("{fault}"));
    let mut renderer = Renderer::new(device, None).unwrap();
    let scene = ggrade::render::Scene::of(assignment, &[]);
    let ours = renderer.render_program(&linked, &scene).unwrap_or_else(|fault| panic!("{fault}")).frames;
    let (width, height) = (scene.width as usize, scene.height as usize);
    let background = scene.background.map(|channel| f32::from(channel) / 255.0);
    let window = Window { width, height, background, is_float: false };
    let textures: Vec<(&str, Texture)> = assignment.textures.iter().map(|texture| ("", texture.clone())).collect();
    let mut counts = Counts::default();
    for (index, (batches, right)) in scene.frames.iter().zip(assignment.frames()).enumerate() {
        let draws: Vec<Draw> = batches.iter().map(draw).collect();
        let theirs = gl.scene(texts, &draws, &textures, window, 1);
        let theirs = theirs.unwrap_or_else(|rejection| panic!("{rejection:?}")).remove(0);
        let ours = ours.picture(index as u32);
        for pixel in 0..width * height {
            let (x, y) = (pixel % width, pixel / width);
            let gl = theirs[(height - 1 - y) * width + x].map(|channel| (channel * 255.0).round() as u8);
            let differs = |from: &[u8], by: u8| (0..3).any(|axis| from[axis].abs_diff(gl[axis]) > by);
            let is_judged = right.coverage[pixel] != Coverage::Silhouette;
            counts.pixels += 1;
            counts.painted += usize::from(differs(&scene.background, 0));
            counts.drivers += usize::from(differs(&ours.rgba[4 * pixel..], DRIVER_TOLERANCE));
            counts.judged += usize::from(is_judged);
            counts.reference += usize::from(is_judged && differs(&right.pixels[pixel], REFERENCE_TOLERANCE));
        }
    }
    counts
}

/// Every homework in `tests/homeworks` is what real OpenGL draws of it, textures included.
#[test]
fn homeworks_in_folders_are_what_opengl_draws() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let mut names = Vec::new();
    for entry in std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks")).unwrap() {
        let path = entry.unwrap().path();
        let assignment = Folder::read(&path).and_then(Assignment::load).unwrap_or_else(|error| panic!("{error}"));
        let counts = compared(&gl, &assignment);
        println!("{}: {counts:?}", assignment.id);
        assert!(counts.painted > counts.pixels / 20 && counts.judged > counts.pixels / 2, "{path:?}: {counts:?}");
        assert!(counts.drivers <= counts.pixels / DOUBTFUL, "{path:?}: {counts:?}");
        assert_eq!(counts.reference, 0, "{path:?}: {counts:?}");
        names.push(assignment.id);
    }
    assert!(names.iter().any(|name| name == "carpet"), "{names:?}");
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
