//! Whatever is done to an archive's bytes, reading it ends, within the limits.

use super::builder::{ZipMember, archive};
use super::*;

/// A generator of numbers, so that a failure can be repeated (Numerical Recipes' linear congruence).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % limit
    }
}

fn sample() -> Vec<u8> {
    let text = "void main() { gl_Position = mc * pv; }\n".repeat(20);
    let inner = archive(&[ZipMember::deflated("x/ggsample06.vert", text.as_bytes()), ZipMember::stored("y.txt", "y")]);
    archive(&[
        ZipMember::deflated("山田 太郎_12_assignsubmission_file_/ggsample06.vert", text.as_bytes()).utf8(),
        ZipMember::stored(b"\x8e\x52\x93\x63_13_assignsubmission_file_/\x95\x5c.vert", &text),
        ZipMember::stored("Ann_14_assignsubmission_file_/hw.zip", inner),
        ZipMember::stored("Ann_15_assignsubmission_file_x.vert", "x"),
    ])
}

fn holds(bytes: &[u8], seed: u64) {
    let limits = within(1 << 20, 1000);
    let intake = take_archive_within(bytes, limits);
    let kept: usize = intake
        .hand_ins
        .iter()
        .map(|hand_in| match &hand_in.content {
            HandInContent::Files { hand_in, .. } => hand_in.concatenated().len(),
            HandInContent::Nothing(_) => 0,
        })
        .sum();
    assert!(kept as u64 <= limits.total.bytes, "seed {seed}");
    let keys: std::collections::HashSet<_> = intake.hand_ins.iter().map(|hand_in| &hand_in.student.key).collect();
    assert_eq!(keys.len(), intake.hand_ins.len(), "seed {seed}");
}

#[test]
fn flipped_bytes_do_no_harm() {
    let sample = sample();
    for seed in 0..1500 {
        let mut numbers = Numbers(seed);
        let mut bytes = sample.clone();
        for _ in 0..=numbers.below(6) {
            let at = numbers.below(bytes.len());
            bytes[at] = match numbers.below(3) {
                0 => 0xFF,
                1 => 0,
                _ => numbers.below(256) as u8,
            };
        }
        holds(&bytes, seed);
    }
}

#[test]
fn missing_and_doubled_parts_do_no_harm() {
    let sample = sample();
    for seed in 0..500 {
        let mut numbers = Numbers(seed);
        let mut bytes = sample.clone();
        let (from, to) = (numbers.below(bytes.len()), numbers.below(bytes.len()));
        let part = bytes[from.min(to)..from.max(to)].to_vec();
        match numbers.below(3) {
            0 => bytes.truncate(from),
            1 => drop(bytes.drain(from.min(to)..from.max(to))),
            _ => drop(bytes.splice(to..to, part)),
        }
        holds(&bytes, seed);
    }
}

#[test]
fn a_flip_in_one_members_data_costs_that_member_only() {
    let sample = sample();
    // The first member's data begin behind its name, which is `…06.vert`.
    let data = sample.windows(7).position(|window| window == b"06.vert").unwrap() + 7;
    for at in data..data + 20 {
        let mut bytes = sample.clone();
        bytes[at] ^= 0x55;
        let intake = take_archive(&bytes);
        assert_eq!(intake.refused.len(), 1, "{at}: {:?}", intake.refused);
        assert_eq!(names(&intake).len(), 4);
        assert!(everyone(&intake)[0].1.is_err());
        assert!(everyone(&intake)[1..].iter().all(|(_, content)| content.is_ok()));
    }
}
