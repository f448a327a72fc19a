//! What is known of a change by which something becomes right.

use crate::diagnose::Evidence;
use crate::diagnose::locate::Located;
use crate::report;
use reference::mistake::Mistake;

/// A change by which something becomes right.
#[derive(Clone, Debug)]
pub(in crate::diagnose) struct Repaired {
    /// The mistake that it undoes.
    pub mistake: Mistake,
    /// Where it is.
    pub located: Located,
    /// What is written there, and what belongs there.
    pub texts: [String; 2],
    /// The variables of the right answer that are wrong with the mistake: the one that it is in, and those computed from it.
    pub touches: Vec<String>,
}

impl Repaired {
    /// Whether nothing is left of what an earlier change put there.
    pub(super) fn undoes(&self, earlier: &Self) -> bool {
        let [before, after] = &self.texts;
        let added = &earlier.texts[1];
        let is_same_place = self.located.stage == earlier.located.stage && self.located.line == earlier.located.line;
        is_same_place && !added.is_empty() && before.contains(added.as_str()) && !after.contains(added.as_str())
    }

    /// What a teacher is shown of it.
    pub fn shown(&self, evidence: &Evidence<'_>) -> report::Repair {
        let [written, right] = self.texts.clone();
        let file = evidence.text(self.located.stage).0.facts.name.clone();
        report::Repair { mistake: self.mistake.id.clone(), file, line: self.located.line, written, right }
    }
}
