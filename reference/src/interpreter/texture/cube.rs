//! The faces of a cube (OpenGL 4.1 core, table 3.18).

/// The face, from 0 (+x) to 5 (−z), and the coordinates on it.
pub fn face([x, y, z]: [f64; 3]) -> (usize, [f64; 2]) {
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    let (face, s, t, major) = if ax >= ay && ax >= az {
        if x >= 0.0 { (0, -z, -y, ax) } else { (1, z, -y, ax) }
    } else if ay >= az {
        if y >= 0.0 { (2, x, z, ay) } else { (3, x, -z, ay) }
    } else if z >= 0.0 {
        (4, x, -y, az)
    } else {
        (5, -x, -y, az)
    };
    (face, [(s / major + 1.0) / 2.0, (t / major + 1.0) / 2.0])
}

/// The coordinates of a direction on a given face, which a neighbour's derivative needs.
pub fn on_face(face: usize, [x, y, z]: [f64; 3]) -> [f64; 2] {
    let (s, t, major) = match face {
        0 => (-z, -y, x),
        1 => (z, -y, -x),
        2 => (x, z, y),
        3 => (x, -z, -y),
        4 => (x, -y, z),
        _ => (-x, -y, -z),
    };
    [(s / major + 1.0) / 2.0, (t / major + 1.0) / 2.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_face_has_its_middle_at_its_axis() {
        let axes =
            [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        for (number, axis) in axes.into_iter().enumerate() {
            assert_eq!(face(axis), (number, [0.5, 0.5]));
        }
        // On +x, s runs against z and t against y.
        assert_eq!(face([2.0, 1.0, -1.0]), (0, [0.75, 0.25]));
        assert_eq!(on_face(0, [2.0, 1.0, -1.0]), [0.75, 0.25]);
    }
}
