//! Where the homework is seen from: the course's own camera, and random ones.

use glam::DVec3;
use reference::Assignment;
use reference::scene::{Point, Pose, View};

/// Poses of the course's own view, finer than it is graded, and of the first of the other cameras.
pub fn poses(assignment: &Assignment, of_the_course: u32, of_cameras: usize) -> Vec<Pose> {
    let scene = &assignment.scene;
    let others = scene.all_poses().into_iter().filter(|pose| pose.view > 0);
    let own = (0..of_the_course).map(|k| scene.pose(f64::from(k) / f64::from(of_the_course)));
    own.chain(others.take(of_cameras)).collect()
}

/// The homework with so many cameras anywhere, each a view of its own: the triangle is cut by the near plane, the far plane and
/// the window, seen from behind, or not in sight.
pub fn with_cameras(assignment: &Assignment, count: u32) -> Assignment {
    let mut assignment = assignment.clone();
    let own = assignment.scene.views[0].clone();
    let mut state = 1_u64;
    let mut random = |low: f64, high: f64| {
        // Knuth's MMIX generator: any will do, and it is the same on every machine.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    for index in 0..count {
        let eye = DVec3::new(random(-3.0, 3.0), random(-3.0, 3.0), random(-4.0, 4.0));
        let target = DVec3::new(random(-0.6, 0.6), random(-0.6, 0.6), random(-0.3, 0.3));
        let up = DVec3::new(random(-0.3, 0.3), 1.0, 0.0);
        let distance = (eye - target).length();
        let (near, far) = match index % 4 {
            0 => (0.1, 20.0),
            1 => (distance * random(0.8, 1.05), 20.0),
            2 => (0.1, distance * random(0.95, 1.2)),
            _ => (distance * random(0.7, 1.0), distance * random(1.0, 1.3)),
        };
        let fovy = random(0.3, 1.4);
        let (eye, target) = (Point::Fixed(eye), Point::Fixed(target));
        assignment.scene.views.push(View { eye, target, up, fovy, near, far, times: vec![0.0], ..own.clone() });
    }
    assignment
}
