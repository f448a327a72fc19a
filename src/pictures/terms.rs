//! Each term of the equation on its own: as a right answer computes it, and as a submission does where that is explained.

use super::{DrawnOnce, picture};
use crate::diagnose::constants;
use crate::report::{Hypothesis, Picture, TermPictures};
use crate::source::Source;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::mistake::FoundMistake;
use reference::rasteriser::ClipVertex;
use reference::scene::Pose;
use std::sync::Arc;

/// The terms of a submission.
#[derive(Debug)]
pub struct Terms<'a> {
    assignment: &'a Assignment,
    /// The assignment with the submission's constants, where its equation is known.
    theirs: Option<Assignment>,
    found: Vec<FoundMistake>,
    is_right: bool,
}

/// What there is to see of one term: the pose at which the submission is furthest from a right answer.
#[derive(Clone, Copy, Debug)]
pub struct TermScene<'a> {
    line: &'a RubricItem,
    pose: Pose,
    /// Whether the submission computes the term as a right answer does, where it is known how it computes it.
    is_same: Option<bool>,
}

impl TermScene<'_> {
    /// Id of the rubric line that judges the term.
    pub fn id(&self) -> &str {
        &self.line.id
    }

    /// Fraction of the animation cycle, in [0, 1).
    pub fn t(&self) -> f64 {
        self.pose.t
    }

    /// Whether it is known how the submission computes the term.
    pub fn is_explained(&self) -> bool {
        self.is_same.is_some()
    }
}

impl<'a> Terms<'a> {
    /// The terms as the explanation of a report has them. `source` is where changed constants are read from.
    pub fn of(assignment: &'a Assignment, explanation: Option<&[Hypothesis]>, source: Option<&Source>) -> Self {
        let own = source.map(|source| (assignment.files[0].stage, source));
        let changed = constants::changed(own.into_iter(), assignment);
        let values: Vec<_> = changed.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
        let found = |h: &Hypothesis| FoundMistake { id: h.id.clone(), form: h.form, parameter: h.parameter };
        Self {
            assignment,
            theirs: explanation.and_then(|_| assignment.with_constants(&values).ok()),
            found: explanation.unwrap_or_default().iter().map(found).collect(),
            is_right: values.is_empty() && explanation.is_some_and(<[_]>::is_empty),
        }
    }

    /// What there is to see, term by term, without drawing it.
    pub fn scenes(&self) -> Vec<TermScene<'a>> {
        let terms = self.assignment.rubric.iter().filter(|line| !line.alone_in.is_empty());
        terms.filter_map(|line| self.scene(line)).collect()
    }

    fn scene(&self, line: &'a RubricItem) -> Option<TermScene<'a>> {
        let assignment = self.assignment;
        let right = assignment.equation.right();
        let variant = self.theirs.as_ref().and_then(|theirs| Some((theirs, theirs.variant(&self.found)?)));
        let corners = |pose: &Pose| {
            let right = assignment.term_corners(pose, &right, &line.judges);
            let theirs =
                variant.as_ref().and_then(|(theirs, variant)| theirs.term_corners(pose, variant, &line.judges));
            right.zip(theirs)
        };
        let difference =
            |pose: &&Pose| corners(pose).map_or(0.0, |(right, theirs)| visible_difference(&right, &theirs));
        let poses = assignment.scene.all_poses();
        // Of equals the first pose: the one that the course's window opens with.
        let pose = poses.iter().rev().max_by(|a, b| difference(a).total_cmp(&difference(b)))?;
        Some(TermScene { line, pose: *pose, is_same: corners(pose).map(|(right, theirs)| right == theirs) })
    }

    /// A term as a right answer computes it.
    pub fn expected(&self, scene: &TermScene<'_>) -> Option<Picture> {
        let TermScene { line, pose, .. } = scene;
        self.assignment.term_frame(pose, &self.assignment.equation.right(), &line.judges).map(|frame| picture(&frame))
    }

    /// A term as the submission computes it; `None` where that is not known.
    pub fn yours(&self, scene: &TermScene<'_>) -> Option<Picture> {
        let TermScene { line, pose, is_same } = scene;
        if (*is_same)? {
            return self.expected(scene);
        }
        let theirs = self.theirs.as_ref()?;
        theirs.term_frame(pose, &theirs.variant(&self.found)?, &line.judges).map(|frame| picture(&frame))
    }

    /// All of them, drawn. Those of right answers are drawn once a process.
    pub fn pictures(&self) -> Arc<[TermPictures]> {
        static RIGHT: DrawnOnce<TermPictures> = DrawnOnce::empty();
        if self.is_right {
            return RIGHT.of(self.assignment, || self.drawn(&[]));
        }
        let right = || Terms::of(self.assignment, Some(&[]), None).drawn(&[]);
        self.drawn(&RIGHT.of(self.assignment, right))
    }

    /// All of them; what `known` shows at the same pose is taken from there, for most wrong answers compute most terms as they should.
    fn drawn(&self, known: &[TermPictures]) -> Arc<[TermPictures]> {
        let pictures = |scene: TermScene<'_>| {
            let known = known.iter().find(|term| term.id == scene.id() && term.t == scene.t());
            let expected = match known {
                Some(term) => Arc::clone(&term.expected),
                None => Arc::new(self.expected(&scene)?),
            };
            let yours = match scene.is_same {
                Some(true) => Some(Arc::clone(&expected)),
                _ => self.yours(&scene).map(Arc::new),
            };
            Some(TermPictures { id: scene.id().to_owned(), t: scene.t(), yours, expected })
        };
        self.scenes().into_iter().filter_map(pictures).collect()
    }
}

/// Each term of the equation on its own, right and as the explanation has it, at the pose where the two differ most.
///
/// `source` is where changed constants are read from.
pub fn term_pictures(
    assignment: &Assignment,
    explanation: Option<&[Hypothesis]>,
    source: Option<&Source>,
) -> Arc<[TermPictures]> {
    Terms::of(assignment, explanation, source).pictures()
}

/// How much two colourings of the same triangles differ in a picture: by the area of each there, and at its corners.
fn visible_difference(right: &[[ClipVertex; 3]], theirs: &[[ClipVertex; 3]]) -> f64 {
    right.iter().zip(theirs).map(|(right, theirs)| difference(right, theirs)).sum()
}

fn difference(right: &[ClipVertex; 3], theirs: &[ClipVertex; 3]) -> f64 {
    let [a, b, c] = right.map(|corner| corner.position.truncate().truncate() / corner.position.w);
    let area = (b - a).perp_dot(c - a).abs();
    let shown = |colour: glam::DVec3| colour.clamp(glam::DVec3::ZERO, glam::DVec3::ONE);
    let apart = |(right, theirs): (&ClipVertex, &ClipVertex)| {
        let apart = (shown(right.colour) - shown(theirs.colour)).abs().element_sum();
        // What is not a number is drawn as anything at all.
        if apart.is_finite() { apart } else { 3.0 }
    };
    area * right.iter().zip(theirs).map(apart).sum::<f64>()
}
