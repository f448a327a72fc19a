//! What is drawn, from where, and how it moves.
//!
//! Angles are in radians, lengths in world units, times are fractions of the cycle.

mod matrices;
mod mesh;
mod pass;
mod vertex;

pub use matrices::{Matrices, look_at, normal_matrix, perspective, rotate_y};
pub use mesh::{Mesh, MeshError, Shape};
pub use pass::{DepthPass, Pass};
pub use vertex::Vertex;

use crate::Value;
use crate::feed::FeedExpression;
use glam::{DMat4, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// All pictures of a homework.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Width of the window, in pixels.
    pub width: u32,
    /// Height of the window, in pixels.
    pub height: u32,
    /// What the window is cleared to, RGBA.
    pub background: [u8; 4],
    /// Duration of one cycle, in seconds.
    pub cycle: f64,
    /// What is shown: the first is the course's own, others reveal what that one hides.
    pub views: Vec<View>,
    /// What is drawn into a texture before each picture.
    pub pass: Option<Pass>,
}

/// Some things in front of a camera.
#[derive(Clone, Debug)]
pub struct View {
    /// What is drawn, in this order.
    pub draws: Vec<Draw>,
    /// Where the eye is, in world space.
    pub eye: Point,
    /// What it looks at, in world space.
    pub target: Point,
    /// Which way is up, in world space.
    pub up: DVec3,
    /// Vertical field of view.
    pub fovy: f64,
    /// Distance of the near clipping plane.
    pub near: f64,
    /// Distance of the far clipping plane.
    pub far: f64,
    /// The moments that are looked at.
    pub times: Vec<f64>,
}

/// A place that may move.
#[derive(Clone, Debug)]
pub enum Point {
    /// It stays.
    Fixed(DVec3),
    /// It is computed.
    Moving(FeedExpression),
}

/// A mesh, where it stands, and what decides which of its pixels are seen.
#[derive(Clone, Debug)]
pub struct Draw {
    /// Its name, by which a pass speaks of it.
    pub name: Option<String>,
    /// Its vertices and triangles, in object space.
    pub mesh: Arc<Mesh>,
    /// From object space to world space.
    pub model: Model,
    /// How many times it is drawn: each has its own number `i`, which goes on from draw to draw.
    pub instances: u32,
    /// Which pixels are drawn over others; none draws each over what is there.
    pub depth_test: Option<DepthTest>,
    /// Which triangles are left out.
    pub cull: Cull,
}

impl Draw {
    /// Its instances as draws of one instance each, whose vertices know its number: `gl_InstanceID` is read.
    fn numbered(self) -> Vec<Self> {
        let one = |number: u32| {
            let mut mesh = Mesh::clone(&self.mesh);
            mesh.vertices.iter_mut().for_each(|vertex| vertex.instance = number);
            Self { instances: 1, mesh: Arc::new(mesh), ..self.clone() }
        };
        (0..self.instances).map(one).collect()
    }
}

/// How an object stands in the world.
#[derive(Clone, Debug)]
pub enum Model {
    /// It turns about the y axis: by so much in a cycle.
    Turn(f64),
    /// A matrix that is computed.
    Expression(FeedExpression),
}

/// A pixel is drawn where its depth is this to the depth that is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DepthTest {
    /// Nearer: OpenGL's own.
    Less,
    /// Nearer, or as near.
    LessEqual,
}

/// Which triangles are left out; the front is where the vertices run against the clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Cull {
    /// None.
    #[default]
    None,
    /// Those that are seen from behind.
    Back,
    /// Those that are seen from the front.
    Front,
}

/// One moment of one view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Which view.
    pub view: usize,
    /// Fraction of the cycle, in [0, 1).
    pub t: f64,
    /// The matrices of what is drawn first.
    pub matrices: Matrices,
}

/// What the values of uniforms depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Fraction of the cycle.
    pub t: f64,
    /// The number of what is drawn, through all draws of a view.
    pub i: u32,
    /// Which view.
    pub scene: u32,
    /// Which picture, among those of all poses; none at probes.
    pub picture: Option<usize>,
    /// View and projection of the pass; the identity where there is none.
    pub pass: [DMat4; 2],
    /// Width and height of the window, in pixels.
    pub resolution: [f64; 2],
    /// The matrices.
    pub matrices: Matrices,
}

/// A draw at a moment.
#[derive(Clone, Copy, Debug)]
pub struct Instance<'a> {
    /// What is drawn.
    pub draw: &'a Draw,
    /// When and where.
    pub moment: Moment,
}

impl Scene {
    /// Lets vertices know the number of their instance.
    pub(crate) fn number_instances(&mut self) {
        for view in &mut self.views {
            view.draws = std::mem::take(&mut view.draws).into_iter().flat_map(Draw::numbered).collect();
        }
    }

    /// The pose of the course's own view at fraction `t` of the cycle.
    pub fn pose(&self, t: f64) -> Pose {
        self.pose_of(0, t)
    }

    fn pose_of(&self, view: usize, t: f64) -> Pose {
        let first = self.instances_at(view, t).into_iter().next();
        let none = Matrices::new(DMat4::IDENTITY, DMat4::IDENTITY);
        Pose { view, t, matrices: first.map_or(none, |instance| instance.moment.matrices) }
    }

    /// The poses that are looked at, view after view.
    pub fn all_poses(&self) -> Vec<Pose> {
        let views = self.views.iter().enumerate();
        views.flat_map(|(view, one)| one.times.iter().map(move |t| self.pose_of(view, *t))).collect()
    }

    /// What is drawn at a pose, in this order.
    pub fn instances(&self, pose: &Pose) -> Vec<Instance<'_>> {
        self.instances_at(pose.view, pose.t)
    }

    fn instances_at(&self, number: usize, t: f64) -> Vec<Instance<'_>> {
        let Some(view) = self.views.get(number) else { return Vec::new() };
        let mut moment = self.moment_of(number, t, Matrices::new(DMat4::IDENTITY, DMat4::IDENTITY));
        moment.picture = self.picture_at(number, t);
        let eye = view.eye.at(&moment);
        let seen = look_at(eye, view.target.at(&moment), view.up);
        let aspect = f64::from(self.width) / f64::from(self.height);
        let projection = perspective(view.fovy, aspect, view.near, view.far);
        let mut instances = Vec::new();
        for draw in &view.draws {
            for _ in 0..draw.instances {
                let model = draw.model.at(&moment);
                let matrices = Matrices::seen(model, seen, projection);
                instances.push(Instance { draw, moment: Moment { matrices, ..moment } });
                moment.i += 1;
            }
        }
        instances
    }

    /// The first triangle of a pose.
    pub fn triangle(&self, pose: &Pose) -> [Vertex; 3] {
        let mesh = &self.views[pose.view].draws[0].mesh;
        mesh.triangles[0].map(|vertex| mesh.vertices[vertex as usize])
    }

    /// A moment of this window, of what is drawn first.
    pub fn moment(&self, t: f64, matrices: Matrices) -> Moment {
        self.moment_of(0, t, matrices)
    }

    /// The same of what is drawn with this number.
    pub(crate) fn moment_of_draw(&self, i: u32, t: f64, matrices: Matrices) -> Moment {
        Moment { i, ..self.moment(t, matrices) }
    }

    /// How much the first view draws, each instance by itself.
    pub(crate) fn count_of_draws(&self) -> u32 {
        self.views.first().map_or(0, |view| view.draws.iter().map(|draw| draw.instances).sum())
    }

    /// What is drawn with this number in the first view.
    pub(crate) fn drawn(&self, i: u32) -> Option<&Draw> {
        let mut draws = self.views.first()?.draws.iter().flat_map(|draw| (0..draw.instances).map(move |_| draw));
        draws.nth(i as usize)
    }

    fn moment_of(&self, view: usize, t: f64, matrices: Matrices) -> Moment {
        let resolution = [f64::from(self.width), f64::from(self.height)];
        let pass = [DMat4::IDENTITY; 2];
        let moment = Moment { t, i: 0, scene: view as u32, picture: None, pass, resolution, matrices };
        let pass = self.pass.as_ref().map_or(pass, |pass| pass.matrices(&moment));
        Moment { pass, ..moment }
    }

    /// The number of the picture of a view that is nearest to a time.
    fn picture_at(&self, view: usize, t: f64) -> Option<usize> {
        let before: usize = self.views[..view].iter().map(|view| view.times.len()).sum();
        let far = |time: &f64| (time - t).abs();
        let times = self.views[view].times.iter().enumerate();
        times.min_by(|(_, a), (_, b)| far(a).total_cmp(&far(b))).map(|(place, _)| before + place)
    }
}

impl Point {
    fn at(&self, moment: &Moment) -> DVec3 {
        match self {
            Self::Fixed(point) => *point,
            Self::Moving(expression) => expression.value(moment).map_or(DVec3::NAN, |value| value.vec3()),
        }
    }
}

impl Model {
    /// The matrix at a moment.
    pub fn at(&self, moment: &Moment) -> DMat4 {
        match self {
            Self::Turn(angle) => rotate_y(angle * moment.t),
            Self::Expression(expression) => expression.value(moment).map_or(DMat4::NAN, |value| matrix(&value)),
        }
    }
}

fn matrix(value: &Value) -> DMat4 {
    <[f64; 16]>::try_from(value.numbers()).map_or(DMat4::NAN, |numbers| DMat4::from_cols_array(&numbers))
}
