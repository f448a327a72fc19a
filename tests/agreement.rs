//! What ggrade draws and captures, and what the CPU reference computes, against a real OpenGL driver.

#[path = "agreement/cameras.rs"]
mod cameras;
#[path = "agreement/fragments.rs"]
mod fragments;
#[path = "agreement/homeworks.rs"]
mod homeworks;
#[path = "agreement/hostile.rs"]
mod hostile;
mod opengl;
#[path = "agreement/programs.rs"]
mod programs;
#[path = "agreement/scenes.rs"]
mod scenes;

use cameras::{poses, with_cameras};
use ggrade::render::{AdapterKind, Device, Frames, RenderScene, Renderer, Rendering, Sample};
use ggrade::report::Opinion;
use ggrade::source::{self, Source};
use ggrade::translate::{self, LinkedInterface, Shader};
use glam::DMat4;
use opengl::{Canvas, Matrix, Mesh, OpenGl, Picture, Program, Version};
use reference::Assignment;
use reference::rasteriser::{Coverage, Frame};
use reference::scene::{Matrices, Pose};
use std::path::{Path, PathBuf};

/// Largest difference of an interior pixel's channel between the two drivers, in 1/255: rounding at .5.
const DRIVER_PIXEL_TOLERANCE: u8 = 1;
/// The same between a driver in f32 and the reference in f64.
const REFERENCE_PIXEL_TOLERANCE: u8 = 2;
/// Largest difference of a captured colour: x^80 in f32 loses five of seven digits at worst.
const CAPTURE_TOLERANCE: f32 = 1e-3;

/// Random cameras beside the course's own.
const CAMERAS: u32 = 120;

/// Both drivers on one machine, and the homework.
struct Bench {
    gl: OpenGl,
    renderer: Renderer,
    interface: LinkedInterface,
    assignment: Assignment,
}

impl Bench {
    fn new() -> Self {
        let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
        let assignment = with_cameras(reference::assignment("ggsample06").unwrap(), CAMERAS);
        let interface = ggrade::translate::LinkedInterface::of(&assignment).unwrap();
        let fixed = translate::fixed_stage(&interface, assignment.files[0].starter_shader()).unwrap();
        let device = Device::open(AdapterKind::Software).unwrap_or_else(|fault| panic!("{fault}"));
        let renderer = Renderer::new(device, Some(&fixed)).unwrap();
        Self { gl, renderer, interface, assignment }
    }

    fn shader(&self, source: &Source) -> Shader {
        let translation = translate::translate(source, &self.interface);
        translation.unwrap_or_else(|refusal| panic!("{}: {refusal:?}", source.facts.name)).shader
    }

    fn scene(&self, poses: &[Pose]) -> RenderScene {
        let scene = &self.assignment.scene;
        let batch = |pose: &Pose| {
            let uniforms = self.assignment.uniform_values(&scene.moment(pose.t, pose.matrices));
            ggrade::render::DrawCall::of(&self.assignment, &uniforms, &scene.triangle(pose))
        };
        RenderScene {
            width: scene.width,
            height: scene.height,
            background: scene.background,
            frames: poses.iter().map(|pose| vec![batch(pose)]).collect(),
            probes: Vec::new(),
            ..RenderScene::default()
        }
    }

    /// Renders with wgpu, as many poses at once as a grading has.
    fn render(&mut self, shader: &Shader, poses: &[Pose]) -> Vec<Rendering> {
        poses.chunks(25).map(|some| self.renderer.render(shader, &self.scene(some)).unwrap()).collect()
    }

    fn program(&self, source: &Source) -> Result<Program<'_>, opengl::Rejection> {
        self.gl.compile(source.text.as_bytes(), &self.assignment.fixed[0].text)
    }

    /// Draws and captures with OpenGL.
    fn draw(&self, program: &Program<'_>, poses: &[Pose]) -> Vec<(Picture, Result<Vec<opengl::Vertex>, String>)> {
        let scene = &self.assignment.scene;
        let triangle = scene.triangle(&scene.pose(0.0));
        let positions = triangle.map(|vertex| vertex.position.as_vec4().truncate().to_array());
        let normals = triangle.map(|vertex| vertex.normal.as_vec4().truncate().to_array());
        let mesh = Mesh { positions: &positions, normals: &normals };
        let background = scene.background.map(|channel| f32::from(channel) / 255.0);
        let canvas = Canvas { width: scene.width, height: scene.height, background };
        poses
            .iter()
            .map(|pose| {
                let matrix = |m: DMat4| -> Matrix { m.as_mat4().to_cols_array() };
                let Matrices { model_view, model_view_projection, normal, .. } = pose.matrices;
                let uniforms =
                    [("mw", matrix(model_view)), ("mc", matrix(model_view_projection)), ("mg", matrix(normal))];
                let picture = self.gl.draw(program, &uniforms, mesh, canvas);
                (picture, self.gl.capture(program, &uniforms, mesh))
            })
            .collect()
    }
}

fn read(path: &Path) -> Source {
    let bytes = std::fs::read(path).unwrap();
    let name = path.file_name().unwrap().to_string_lossy();
    source::read(&name, &bytes).unwrap_or_else(|refusal| panic!("{}: {:?}", path.display(), refusal.diagnostics))
}

fn samples(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(folder);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "vert"));
    paths.sort();
    assert!(!paths.is_empty(), "no sample in {}", folder.display());
    paths
}

/// Largest difference of a channel over the pixels that are neither near an edge nor unpainted; red, green, blue.
fn largest_difference(coverage: impl Fn(usize) -> Coverage, a: &[u8], b: &[u8]) -> u8 {
    let interior = |(index, _): &(usize, (&[u8], &[u8]))| coverage(*index) != Coverage::Silhouette;
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4)).enumerate().filter(interior);
    pixels.map(|(_, (a, b))| (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap()).max().unwrap_or(0)
}

/// Where a picture of OpenGL's has edges: painted pixels beside unpainted ones.
fn coverage_of(picture: &Picture, background: [u8; 4]) -> Vec<Coverage> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let painted: Vec<bool> = picture.pixels.chunks_exact(4).map(|pixel| pixel != background).collect();
    (0..width * height)
        .map(|index| {
            let (x, y) = (index % width, index / width);
            let mut around = (y.saturating_sub(1)..(y + 2).min(height))
                .flat_map(|y| (x.saturating_sub(1)..(x + 2).min(width)).map(move |x| y * width + x));
            match (painted[index], around.all(|other| painted[other] == painted[index])) {
                (_, false) => Coverage::Silhouette,
                (true, true) => Coverage::Interior,
                (false, true) => Coverage::Outside,
            }
        })
        .collect()
}

fn capture_difference(gl: &[opengl::Vertex], wgpu: &[Sample]) -> f32 {
    assert_eq!(gl.len(), wgpu.len());
    let difference = |(gl, wgpu): (&opengl::Vertex, &Sample)| {
        let colour = gl.vc.iter().zip(&wgpu.colour).map(|(a, b)| (a - b).abs() / a.abs().max(1.0));
        let position = gl.position.iter().zip(&wgpu.position).map(|(a, b)| (a - b).abs() / a.abs().max(1.0));
        colour.chain(position).fold(0.0, f32::max)
    };
    gl.iter().zip(wgpu).map(difference).fold(0.0, f32::max)
}

fn all_frames(renderings: &[Rendering]) -> Vec<(&Frames, u32, &[Sample])> {
    let of_one = |rendering| {
        let Rendering { frames, frame_samples, .. }: &Rendering = rendering;
        (0..frames.count).map(move |index| (frames, index, frame_samples[index as usize].as_slice()))
    };
    renderings.iter().flat_map(of_one).collect()
}

/// A right answer under 220 cameras, near and far clipping included: wgpu, OpenGL and the reference draw the same.
#[test]
fn a_right_answer_looks_the_same_everywhere() {
    let mut bench = Bench::new();
    let text = &bench.assignment.files[0].solution.text;
    let source = source::read("right.vert", text.as_bytes()).unwrap();
    let shader = bench.shader(&source);
    let poses = poses(&bench.assignment, 100, 120);
    let renderings = bench.render(&shader, &poses);
    let program = bench.program(&source).unwrap_or_else(|rejection| panic!("{rejection:?}"));
    let right = bench.assignment.equation.right();
    let (mut interior, mut clipped) = (0, 0);
    for ((pose, (picture, captured)), (frames, index, samples)) in
        poses.iter().zip(bench.draw(&program, &poses)).zip(all_frames(&renderings))
    {
        let frame: Frame = bench.assignment.frame(pose, &right);
        let wgpu = frames.picture(index).rgba;
        let coverage = |pixel: usize| frame.coverage[pixel];
        let drivers = largest_difference(coverage, &picture.pixels, &wgpu);
        assert!(drivers <= DRIVER_PIXEL_TOLERANCE, "wgpu and OpenGL differ by {drivers}/255 at {pose:?}");
        let reference = largest_difference(coverage, &picture.pixels, &frame.pixels.concat());
        assert!(reference <= REFERENCE_PIXEL_TOLERANCE, "the reference differs by {reference}/255 at {pose:?}");
        let captured = capture_difference(&captured.unwrap(), samples);
        assert!(captured <= CAPTURE_TOLERANCE, "captured values differ by {captured} at {pose:?}");
        interior += frame.coverage.iter().filter(|coverage| **coverage == Coverage::Interior).count();
        clipped += usize::from(samples.iter().any(|s| s.position[2].abs() > s.position[3]));
    }
    // What is held against each other is there: a twentieth of all pixels, and the clip planes at work.
    assert!(interior > poses.len() * 640 * 480 / 20, "only {interior} interior pixels");
    assert!(clipped >= 40, "only {clipped} poses are cut by the near or far plane");
}

/// Samples that Mesa's OpenGL draws otherwise than OpenGL asks: it clips by planes that are not enabled, and reads a
/// varying that has a location on one side only from nowhere.
const DRAWN_OTHERWISE: [&str; 2] = ["clip-distance-negative", "output-location-410"];

/// Every accepted sample, whatever language features it is written with, draws on wgpu what OpenGL draws.
#[test]
fn accepted_samples_look_as_on_opengl() {
    let mut bench = Bench::new();
    let poses = poses(&bench.assignment, 3, 2);
    let mut compared = 0;
    for folder in ["accepted/answers", "accepted/language", "accepted/translate", "accepted/disputed"] {
        for path in samples(folder) {
            if DRAWN_OTHERWISE.iter().any(|name| path.to_string_lossy().contains(name)) {
                continue;
            }
            let source = read(&path);
            // A disputed file is one that some real driver refuses; it may be this one.
            let may_refuse = folder.ends_with("disputed");
            compared += usize::from(agrees_with_opengl(&mut bench, &path, &source, &poses, may_refuse));
        }
    }
    assert!(compared > 380, "only {compared} samples were compared");
}

/// Wrong answers are wrong in the same way: a translation must not mend or worsen them.
#[test]
fn wrong_samples_look_as_on_opengl() {
    let mut bench = Bench::new();
    let poses = poses(&bench.assignment, 4, 2);
    let mut compared = 0;
    for path in samples("wrong") {
        let source = read(&path);
        // One declares a uniform with another type than the program sets, which ggrade's own interface check refuses;
        // one makes a picture of the last bits of a sine, which no two drivers have alike.
        if ["mat3-uniform", "noise"].iter().any(|odd| path.to_string_lossy().contains(odd)) {
            continue;
        }
        compared += usize::from(agrees_with_opengl(&mut bench, &path, &source, &poses, false));
    }
    assert!(compared > 100, "only {compared} samples were compared");
}

/// Whether OpenGL takes the shader; where it does, its pictures and captured values must be those of wgpu.
fn agrees_with_opengl(bench: &mut Bench, path: &Path, source: &Source, poses: &[Pose], may_refuse: bool) -> bool {
    let shader = bench.shader(source);
    let renderings = bench.render(&shader, poses);
    let program = match bench.program(source) {
        Ok(program) => program,
        Err(_) if may_refuse => return false,
        Err(rejection) => panic!("{}: OpenGL refuses it: {rejection:?}", path.display()),
    };
    let background = bench.assignment.scene.background;
    let drawn = bench.draw(&program, poses);
    if let Ok(captured) = drawn.iter().map(|(_, captured)| captured.clone()).collect::<Result<Vec<_>, _>>() {
        let checked = programs::interpreted(source, &bench.scene(poses).frames.concat(), &captured);
        assert_eq!(checked.opinion, Opinion::Agrees, "{}: {checked:?}", path.display());
    }
    for ((picture, captured), (frames, index, samples)) in drawn.into_iter().zip(all_frames(&renderings)) {
        // Values that are not numbers are drawn as the driver likes.
        if samples.iter().any(|sample| sample.colour.iter().chain(&sample.position).any(|x| !x.is_finite())) {
            continue;
        }
        let ours = frames.picture(index).rgba;
        // Mostly it is the same to the last bit, and then it does not matter where edges are.
        let coverage = if picture.pixels == ours { Vec::new() } else { coverage_of(&picture, background) };
        let of_pixel = |pixel: usize| coverage.get(pixel).copied().unwrap_or(Coverage::Silhouette);
        let pixels = largest_difference(of_pixel, &picture.pixels, &ours);
        assert!(pixels <= DRIVER_PIXEL_TOLERANCE, "{}: frame {index} differs by {pixels}/255", path.display());
        if let Ok(captured) = captured {
            let difference = capture_difference(&captured, samples);
            assert!(difference <= CAPTURE_TOLERANCE, "{}: captured values differ by {difference}", path.display());
        }
    }
    true
}
