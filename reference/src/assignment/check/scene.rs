//! The scenes of an assignment.

use super::CheckResult;
use super::expression::expression;
use super::meshes::Meshes;
use crate::Folder;
use crate::Text;
use crate::assignment::{AssignmentError, error};
use crate::feed::FeedExpression;
use crate::interpreter::Type;
use crate::manifest::{self, Depth, Poses};
use crate::scene::{Draw, Mesh, Model, Point, Scene, Vertex, View};
use crate::text::both;
use glam::DVec3;
use std::sync::Arc;
use toml::Spanned;

/// More poses than this are refused.
const MOST_POSES: usize = 10_000;
/// More vertices than this in all frames are refused. A grading draws them all within 2 s, of which the student's own shader needs a
/// part: 430,000 of four attributes took 1.5 s on two busy cores.
const MOST_DRAWN: usize = 300_000;
/// More things than this are refused.
const MOST_INSTANCES: u32 = 1_000;
/// The longest side of a window, in pixels.
const LONGEST_SIDE: u32 = 8_192;

/// All scenes as one. `place_at`: where a byte of the manifest stands.
pub(super) fn scene(
    scenes: &manifest::Scenes,
    folder: &Folder,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Scene> {
    let meshes = Meshes::new(folder, place_at);
    let [first, ..] = &scenes.0[..] else {
        return Err(error("scene", both("there is none: write [scene]", "ありません。[scene] を書いてください")));
    };
    let [width, height] = first.window.ok_or_else(|| missing("window"))?;
    if !(1..=LONGEST_SIDE).contains(&width) || !(1..=LONGEST_SIDE).contains(&height) {
        return Err(error(
            "scene",
            both(
                format!("the window has to be 1 to {LONGEST_SIDE} pixels wide and high"),
                format!("ウィンドウの幅と高さは 1 画素以上 {LONGEST_SIDE} 画素以下にしてください"),
            ),
        ));
    }
    for other in &scenes.0[1..] {
        if other.window.is_some() || other.background.is_some() || other.cycle.is_some() {
            return Err(error(
                "scene",
                both(
                    "`window`, `background` and `cycle` are those of the first scene: remove them",
                    "`window`、`background`、`cycle` は最初の scene のものを使います。取り除いてください",
                ),
            ));
        }
    }
    let views = scenes
        .0
        .iter()
        .map(|own| SceneReader { own, first, meshes: &meshes, place_at }.view())
        .collect::<CheckResult<Vec<_>>>()?;
    let scene = Scene {
        width,
        height,
        // Nobody sees its alpha. At 0 what is painted in the background's colour is told from what is not painted.
        background: first.background.map(|[r, g, b, _]| [r, g, b, 0]).ok_or_else(|| missing("background"))?,
        cycle: first.cycle.unwrap_or(5.0),
        views,
        // It is read when it is known what its program may be given.
        pass: None,
    };
    let sum: usize = scene.views.iter().map(|view| view.times.len()).sum();
    if sum > MOST_POSES {
        return Err(error(
            "scene",
            both(
                format!("there are {sum} poses: use at most {MOST_POSES}"),
                format!("ポーズが {sum} 個あります。{MOST_POSES} 個以下にしてください"),
            ),
        ));
    }
    let drawn = drawn(&scene);
    if drawn > MOST_DRAWN {
        return Err(error(
            "scene",
            both(
                format!(
                    "all frames together draw {drawn} vertices: use at most {MOST_DRAWN}, by fewer poses or coarser meshes"
                ),
                format!(
                    "全フレームで描く頂点が合わせて {drawn} 個あります。ポーズを減らすかメッシュを粗くして {MOST_DRAWN} 個以下にしてください"
                ),
            ),
        ));
    }
    for pose in scene.all_poses() {
        let is_seen = |matrix: glam::DMat4| matrix.is_finite();
        if !scene.instances(&pose).iter().all(|instance| is_seen(instance.moment.matrices.model_view_projection)) {
            let message = both(
                "the camera or a model has no matrix there: look at `eye`, `target`, `up` and `model`",
                "カメラまたはモデルの行列を作れません。`eye`、`target`、`up`、`model` を確かめてください",
            );
            return Err(error(format!("scene, at t = {}", pose.t), message));
        }
    }
    Ok(scene)
}

fn missing(key: &str) -> AssignmentError {
    error("scene", both(format!("`{key}` is missing: write it"), format!("`{key}` がありません。書いてください")))
}

/// The vertices of all frames.
fn drawn(scene: &Scene) -> usize {
    let of_frame = |view: &View| -> usize {
        view.draws.iter().map(|draw| draw.mesh.vertices.len() * draw.instances as usize).sum()
    };
    scene.views.iter().map(|view| of_frame(view) * view.times.len()).sum()
}

/// A scene beside the first one, which says what it does not.
struct SceneReader<'a> {
    own: &'a manifest::SceneEntry,
    first: &'a manifest::SceneEntry,
    meshes: &'a Meshes<'a>,
    place_at: &'a dyn Fn(usize) -> String,
}

impl<'a> SceneReader<'a> {
    fn get<T>(&self, key: &str, of: impl Fn(&'a manifest::SceneEntry) -> Option<T>) -> CheckResult<T> {
        of(self.own).or_else(|| of(self.first)).ok_or_else(|| missing(key))
    }

    fn view(&self) -> CheckResult<View> {
        let point = |key, of: fn(&'a manifest::SceneEntry) -> Option<&'a manifest::PointEntry>| -> CheckResult<Point> {
            match self.get(key, of)? {
                manifest::PointEntry::Numbers(point) => Ok(Point::Fixed(DVec3::from_array(*point))),
                manifest::PointEntry::Expression(text) => {
                    let expression = FeedExpression::compile(text, &Type::vector(3));
                    let wrong = |what: &Text| {
                        let message = both(
                            format!("{}: write three numbers, or a vec3 of `t`", what.en),
                            format!("{}。3 つの数、または `t` の vec3 の式を書いてください", what.ja),
                        );
                        error(format!("scene, `{key}`"), message)
                    };
                    expression.map(Point::Moving).map_err(|refusal| wrong(refusal.what()))
                }
            }
        };
        let view = View {
            draws: self.draws()?,
            eye: point("eye", |scene| scene.eye.as_ref())?,
            target: point("target", |scene| scene.target.as_ref())?,
            up: DVec3::from_array(self.get("up", |scene| scene.up)?),
            fovy: self.get("fovy", |scene| scene.fovy)?,
            near: self.get("near", |scene| scene.near)?,
            far: self.get("far", |scene| scene.far)?,
            times: self.get("poses", |scene| scene.poses.as_ref().map(times))?,
        };
        makes_pictures(&view)?;
        Ok(view)
    }

    fn draws(&self) -> CheckResult<Vec<Draw>> {
        let shows =
            |scene: &manifest::SceneEntry| scene.draw.is_some() || scene.mesh.is_some() || scene.triangle.is_some();
        let scene = if shows(self.own) { self.own } else { self.first };
        let said = [scene.draw.is_some(), scene.mesh.is_some(), scene.triangle.is_some()];
        match said.iter().filter(|said| **said).count() {
            0 => {
                return Err(error(
                    "scene",
                    both(
                        "nothing is drawn: write `mesh = { torus = {} }`, or [[scene.draw]]",
                        "描くものがありません。`mesh = { torus = {} }` または [[scene.draw]] を書いてください",
                    ),
                ));
            }
            1 => {}
            _ => {
                return Err(error(
                    "scene",
                    both(
                        "write one of `draw`, `mesh` and `triangle`",
                        "`draw`、`mesh`、`triangle` のうち 1 つだけを書いてください",
                    ),
                ));
            }
        }
        let draws = match (&scene.draw, &scene.mesh, &scene.triangle) {
            (Some(draws), ..) => draws.iter().map(|draw| self.draw(draw)).collect::<CheckResult<Vec<_>>>()?,
            (None, Some(shape), _) => vec![self.with(self.meshes.mesh(shape)?, Some(Depth::Less))?],
            (None, None, triangle) => {
                let triangle = triangle.unwrap_or_default();
                let normals = scene.normals.unwrap_or([[0.0, 0.0, 1.0]; 3]);
                let vertex = |at: usize| Vertex::new(triangle[at].into(), normals[at].into());
                let mesh = Mesh::new(vec![vertex(0), vertex(1), vertex(2)], vec![[0, 1, 2]]);
                let mesh = mesh.map_err(|wrong| error("scene, `triangle`", wrong.message))?;
                vec![self.with(Arc::new(mesh), None)?]
            }
        };
        let count: u32 = draws.iter().map(|draw| draw.instances.min(MOST_INSTANCES + 1)).sum();
        if count == 0 || count > MOST_INSTANCES {
            return Err(error(
                "scene",
                both(
                    format!("{count} things are drawn: draw 1 to {MOST_INSTANCES}"),
                    format!("描くものが {count} 個あります。1 個以上 {MOST_INSTANCES} 個以下にしてください"),
                ),
            ));
        }
        Ok(draws)
    }

    /// What a scene says of its only draw.
    fn with(&self, mesh: Arc<Mesh>, depth: Option<Depth>) -> CheckResult<Draw> {
        let said = |scene: &manifest::SceneEntry| scene.depth_test;
        let depth = said(self.own).or_else(|| said(self.first)).or(depth);
        Ok(Draw {
            name: None,
            mesh,
            model: self.model(None, None)?,
            instances: self.own.instances.or(self.first.instances).unwrap_or(1),
            depth_test: depth.and_then(Depth::test),
            cull: self.own.cull.or(self.first.cull).unwrap_or_default(),
        })
    }

    fn draw(&self, draw: &manifest::DrawEntry) -> CheckResult<Draw> {
        let like = self.with(self.meshes.mesh(&draw.mesh)?, Some(Depth::Less))?;
        Ok(Draw {
            name: draw.name.clone(),
            model: self.model(draw.model.as_ref(), draw.turn)?,
            instances: draw.instances.unwrap_or(like.instances),
            depth_test: draw.depth_test.map_or(like.depth_test, Depth::test),
            cull: draw.cull.unwrap_or(like.cull),
            ..like
        })
    }

    /// The nearest that says how something stands: a draw, its scene, the first scene.
    fn model(&self, model: Option<&Spanned<String>>, turn: Option<f64>) -> CheckResult<Model> {
        let said =
            [(model, turn), (self.own.model.as_ref(), self.own.turn), (self.first.model.as_ref(), self.first.turn)];
        match said.into_iter().find(|(model, turn)| model.is_some() || turn.is_some()) {
            Some((Some(_), Some(_))) => Err(error(
                "scene",
                both("write one of `model` and `turn`", "`model` と `turn` は、どちらか一方だけを書いてください"),
            )),
            Some((Some(text), None)) => {
                expression(text, &Type::MAT4, "scene, `model`", self.place_at).map(Model::Expression)
            }
            Some((None, turn)) => Ok(Model::Turn(turn.unwrap_or_default())),
            None => Ok(Model::Turn(0.0)),
        }
    }
}

/// A camera that sees nothing, and a number of poses that nobody waits for.
fn makes_pictures(view: &View) -> CheckResult<()> {
    let View { near, far, fovy, times, .. } = view;
    let wrong = if !(*near > 0.0 && far > near) {
        both(
            "`near` is above 0, and `far` is above `near`: anything else makes no picture",
            "`near` は 0 より大きく、`far` は `near` より大きくしてください。そうでないと絵になりません",
        )
    } else if !(*fovy > 0.0 && *fovy < std::f64::consts::PI) {
        both(
            "`fovy` is an angle in radians above 0 and below 3.14: 0.52 is 30 degrees",
            "`fovy` は 0 より大きく 3.14 より小さい角度 (ラジアン) です。30 度は 0.52 です",
        )
    } else if !(1..=MOST_POSES).contains(&times.len()) {
        both(
            format!("`poses` is a number from 1 to {MOST_POSES}, or a list of as many times"),
            format!("`poses` は 1 から {MOST_POSES} までの数か、その個数以内の時刻の並びです"),
        )
    } else if !times.iter().all(|t| (0.0..1.0).contains(t)) {
        both(
            "the times in `poses` are parts of the cycle: from 0 on, below 1",
            "`poses` の時刻は 1 周期を 1 とする値です。0 以上 1 未満にしてください",
        )
    } else {
        return Ok(());
    };
    Err(error("scene", wrong))
}

fn times(poses: &Poses) -> Vec<f64> {
    match poses {
        // One too many is refused like any more.
        Poses::Count(count) => {
            (0..(*count).min(MOST_POSES as u32 + 1)).map(|k| f64::from(k) / f64::from(*count)).collect()
        }
        Poses::Times(times) => times.clone(),
    }
}
