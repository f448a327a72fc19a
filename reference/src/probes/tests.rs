use super::*;
use crate::assignment;
use std::collections::HashMap;

fn ggsample06() -> &'static Assignment {
    assignment("ggsample06").expect("built in")
}

const SEEDS: [u64; 6] = [0, 1, 2, 3, 42, u64::MAX];

#[test]
fn the_same_seed_gives_the_same_probes_and_another_gives_others() {
    let vertices = |seed| -> Vec<Vertex> {
        let probes = ggsample06().probes(seed);
        probes.iter().map(|p| p.vertex).collect()
    };
    assert_eq!(vertices(7), vertices(7));
    let (a, b) = (vertices(7), vertices(8));
    assert!(a.iter().zip(&b).all(|(a, b)| a != b));
}

/// The name of the region in which a probe lies.
fn region(probe: &Probe) -> &'static str {
    probe.region.map_or("none", |region| &ggsample06().regions[region].id)
}

#[test]
fn every_region_is_well_populated() {
    for seed in SEEDS {
        let mut count: HashMap<&str, usize> = HashMap::new();
        for probe in &ggsample06().probes(seed) {
            *count.entry(region(probe)).or_default() += 1;
        }
        for region in ["ambient-only", "facing-away", "diffuse-only", "highlight", "highlight-behind"] {
            // Two designs of twenty in 28 groups, less a few that end up between regions.
            assert!(count.get(region).copied().unwrap_or(0) >= 40, "{region} for {seed}: {count:?}");
        }
    }
}

#[test]
fn regions_show_the_terms_that_they_promise() {
    let right = ggsample06().equation.right();
    for seed in SEEDS {
        let probes = ggsample06().probes(seed);
        for probe in &probes {
            let outcome = right.evaluate(probes.uniforms(probe), &probe.attributes);
            let shows = |name: &str| outcome.get(name).map_or(f64::NAN, |v| v.vec3().max_element());
            let (diffuse, specular) = (shows("diffuse"), shows("specular"));
            let ok = match region(probe) {
                "ambient-only" | "facing-away" => diffuse == 0.0 && specular < 1e-6,
                // 0.6 × 0.02 and 0.4 × 0.02: what the weakest diffuse light and highlight of their regions give.
                "diffuse-only" => diffuse > 0.012 && specular < 1e-6,
                "highlight" => diffuse > 0.012 && specular > 0.008,
                "highlight-behind" => diffuse == 0.0 && specular > 0.008,
                other => other == "between",
            };
            assert!(ok, "{}: {diffuse}, {specular}", region(probe));
        }
    }
}

#[test]
fn inputs_are_exact_in_f32_normals_are_unit_and_cameras_rigid() {
    let exact = |x: f64| x == f64::from(x as f32);
    for seed in SEEDS {
        let probes = ggsample06().probes(seed);
        for probe in &probes {
            let numbers = [probe.vertex.position, probe.vertex.normal];
            assert!(numbers.iter().all(|v| v.to_array().into_iter().all(exact)));
            // Three components rounded to 24 bits.
            assert!((probe.vertex.normal.truncate().length() - 1.0).abs() < 1e-7);
        }
        for group in &probes.groups {
            let m = &group.matrices;
            for matrix in [m.model_view, m.model_view_projection, m.normal] {
                assert!(matrix.to_cols_array().into_iter().all(exact));
            }
            // mat3(mw) is as good a normal matrix as mg: the course's mw never stretches.
            let apart = design_difference(m);
            assert!(apart < 1e-6, "{apart:e}");
            assert!(m.model_view.w_axis.truncate().length() > 2.9);
        }
    }
}

fn design_difference(m: &Matrices) -> f64 {
    let columns = [
        m.model_view.x_axis - m.normal.x_axis,
        m.model_view.y_axis - m.normal.y_axis,
        m.model_view.z_axis - m.normal.z_axis,
    ];
    columns.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max)
}

#[test]
fn groups_are_consecutive_and_equal_in_number() {
    let probes = ggsample06().probes(5);
    assert_eq!(probes.groups.len(), 28);
    assert_eq!(probes.probes.len(), 28 * 20);
    for (index, _) in probes.groups.iter().enumerate() {
        let group = probes.of_group(index);
        assert_eq!(group.len(), 20);
        assert!(group.iter().all(|p| p.group == index));
    }
    assert!(probes.of_group(28).is_empty());
}

#[test]
fn colours_over_one_and_points_behind_the_eye_occur() {
    let probes = ggsample06().probes(5);
    assert!(probes.iter().any(|p| p.colour.x > 1.05));
    assert!(probes.iter().any(|p| p.position.w < 0.0));
}

#[test]
fn the_last_groups_are_twins_that_differ_in_normals_or_in_everything() {
    let same = |a: glam::DVec4, b: glam::DVec4| (a - b).abs().max_element() < 1e-6;
    for seed in SEEDS {
        let probes = ggsample06().probes(seed);
        let [first, other] = probes.with_other_normals().expect("groups enough");
        let cameras = [first.start, other.start].map(|place| probes.groups[probes.probes[place].group].matrices);
        assert_eq!(cameras[0], cameras[1]);
        for (a, b) in first.zip(other) {
            let (a, b) = (&probes.probes[a].vertex, &probes.probes[b].vertex);
            assert!(same(a.position, b.position) && !same(a.normal, b.normal), "{a:?} {b:?}");
        }
        let [first, other] = probes.with_other_vertices().expect("groups enough");
        for (a, b) in first.zip(other) {
            let (a, b) = (&probes.probes[a].vertex, &probes.probes[b].vertex);
            assert!(!same(a.position, b.position) && !same(a.normal, b.normal), "{a:?} {b:?}");
        }
    }
}

/// A homework of the project's tests.
fn homework(name: &str) -> Assignment {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/homeworks").join(name);
    Assignment::load(crate::Folder::read(&folder).expect("a folder")).expect("an assignment")
}

#[test]
fn fragments_lie_in_front_of_the_eye_and_have_steady_colours() {
    for name in ["toon", "maps", "fog", "rings", "per-pixel", "bumps"] {
        let assignment = homework(name);
        let probes = assignment.judging_probes();
        assert_eq!(probes.probes.len(), 560, "{name}");
        for probe in &probes {
            let spot = probe.spot.as_deref().expect("a fragment");
            let sum: f64 = spot.weights.iter().sum();
            assert!((sum - 1.0).abs() < 1e-9 && spot.weights.iter().all(|weight| *weight >= -1e-9), "{name}: {spot:?}");
            assert!((0.0..=1.0).contains(&spot.place[2]) && spot.place[3] > 0.0, "{name}: {spot:?}");
            let is_seen = |channel: &f64| (0.0..=1.0).contains(channel);
            let colour = probe.colour.to_array();
            assert!(colour.iter().all(is_seen) || probe.colour == crate::equation::DISCARDED, "{name}: {colour:?}");
        }
        // The right program shows just this, also where varyings are not rounded between the stages.
        let shown = assignment.shown_at(&assignment.pipeline, &probes).expect("it runs");
        for (probe, shown) in probes.iter().zip(shown) {
            assert!((probe.colour - shown.colour).abs().max_element() < 1e-3, "{name}: {probe:?}, {shown:?}");
        }
        let fresh = assignment.fresh_probes(7);
        assert_eq!(fresh.probes.len(), 80, "{name}");
        assert!(fresh.probes[0].vertex != probes.probes[0].vertex, "{name}");
    }
}

#[test]
fn thrown_away_fragments_are_among_the_probes() {
    let probes = homework("rings").judging_probes();
    let gone = probes.iter().filter(|probe| probe.colour == crate::equation::DISCARDED).count();
    // The lowest tenth of the window is left out.
    assert!((20..140).contains(&gone), "{gone}");
}

#[test]
fn fragments_lie_in_the_window_that_the_program_is_told_of() {
    let assignment = homework("rings");
    let place = assignment.interface.uniforms.iter().position(|uniform| uniform.path == "iResolution").expect("there");
    let probes = assignment.judging_probes();
    for probe in &probes {
        let group = &probes.groups[probe.group];
        assert_eq!(group.uniforms[place].numbers()[..2], group.window);
        let spot = probe.spot.as_deref().expect("a fragment");
        let share = |axis: usize| spot.place[axis] / group.window[axis];
        // The vertex stage hands on which share of the window a pixel is at.
        let (_, handed) = spot.varyings.iter().find(|(name, _)| name == "share").expect("handed on");
        assert!((0..2).all(|axis| (handed.numbers()[axis] - share(axis)).abs() < 1e-6), "{spot:?} {:?}", group.window);
    }
    let widths: std::collections::HashSet<u64> = probes.groups.iter().map(|group| group.window[0] as u64).collect();
    assert!(widths.len() > 10 && widths.iter().all(|width| (200..=450).contains(width)), "{widths:?}");
}

#[test]
fn what_varies_is_seen_by_the_probes() {
    // Half of the cameras' uniforms are drawn at random: four tones are no more usual than any other number.
    let assignment = homework("toon");
    let place = assignment.interface.uniforms.iter().position(|uniform| uniform.path == "tones").expect("tones");
    let probes = assignment.judging_probes();
    let tones: std::collections::HashSet<i64> =
        probes.groups.iter().map(|group| group.uniforms[place].numbers()[0] as i64).collect();
    assert!(tones.len() >= 4, "{tones:?}");
}

#[test]
fn what_the_right_vertex_stage_hands_over_changes_with_the_uniforms() {
    let assignment = assignment("ggsample11-pcf").expect("built in");
    // With an expectation that does not follow the uniforms each of these would be called idle.
    assert_eq!(assignment.idle_uniforms(&assignment.judging_probes()), Vec::<&str>::new());
}
