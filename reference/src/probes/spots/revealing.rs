//! Probes that show the difference between the solution and a variant which no random fragment shows.

use super::ProbeOutput;
use crate::Assignment;
use crate::probes::{Probe, ProbeGroup, Random};

/// So many cameras look for fragments that reveal a variant, each among so many fragments, and each keeps so many of them. Another
/// depth by 0.005 shows at one of five hundred fragments: some six are found.
const REVEALING_GROUPS: usize = 8;
const REVEALING_ROUNDS: usize = 8;
const TRIANGLES_TO_REVEAL: usize = 60;
const MOST_REVEALED: usize = 3;

/// A colour that differs by so much is seen to be another one: ten times what is tolerated.
const REVEALED: f64 = 2e-2;

impl Assignment {
    /// Puts probes at which a variant that is to be revealed shows something else in the place of the last ones.
    pub(super) fn reveal(&self, random: &mut Random, group: usize, drawn: &ProbeGroup, probes: &mut Vec<Probe>) {
        if group >= REVEALING_GROUPS {
            return;
        }
        let count = probes.len();
        for other in &self.revealed {
            let mut found = Vec::new();
            for _ in 0..REVEALING_ROUNDS {
                let some = (0..TRIANGLES_TO_REVEAL).map(|_| self.triangle(random)).collect();
                let some = self.probed(group, drawn, some, self.usual_sides()).unwrap_or_default();
                let Some(shown) = self.shown_of_group(&other.pipeline, &drawn.uniforms, &some) else { continue };
                let differs = |(probe, shown): &(Probe, ProbeOutput)| {
                    (probe.colour - shown.colour).abs().max_element() > REVEALED
                };
                found.extend(some.into_iter().zip(shown).filter(differs).map(|(probe, _)| probe));
                if found.len() >= MOST_REVEALED {
                    break;
                }
            }
            found.truncate(MOST_REVEALED);
            probes.truncate(count.saturating_sub(found.len()));
            probes.splice(0..0, found);
        }
    }
}
