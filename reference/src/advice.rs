//! What a right answer is asked beyond the homework: where it would break, that is worth a word and costs nothing.

use crate::feed::Feed;
use crate::probes::{Probe, ProbeSet};
use crate::scene::Matrices;
use crate::{Assignment, Text, Value};
use glam::{DMat4, DVec3};

/// A circumstance that the homework does not have, and what to say of an answer that is right only without it.
#[derive(Clone, Debug)]
pub struct Advice {
    /// Its name in reports; stable.
    pub id: String,
    /// What is different from a probe of the homework.
    pub when: Circumstance,
    /// The definitions that are likely to be at fault, the likeliest first.
    pub about: Vec<String>,
    /// Whether it is said only if one of these definitions is what breaks.
    pub only_about: bool,
    /// What would break, and where to look, to be completed with [`Text::fill`]: `{line}`, `{name}`.
    pub message: Text,
}

/// What is different from a probe of the homework.
#[derive(Clone, Debug, Default)]
pub struct Circumstance {
    /// Vertex attributes by name, and what their components are multiplied by.
    pub scaled: Vec<(String, [f64; 4])>,
    /// By how much the model is stretched along its axes.
    pub stretched: Option<[f64; 3]>,
    /// Constants of the handed-out file with other values.
    pub constants: Vec<(String, Value)>,
}

/// A probe under a circumstance.
#[derive(Clone, Debug)]
pub struct Variation {
    /// The values of the uniforms, in the interface's order.
    pub uniforms: Vec<Value>,
    /// The probe, with other attributes.
    pub probe: Probe,
}

impl Assignment {
    /// `count` probes under a circumstance, spread over all that there are.
    pub fn variations(&self, when: &Circumstance, probes: &ProbeSet, count: usize) -> Vec<Variation> {
        let all = &probes.probes;
        (0..count.min(all.len())).map(|at| self.variation(when, probes, &all[at * all.len() / count])).collect()
    }

    fn variation(&self, when: &Circumstance, probes: &ProbeSet, probe: &Probe) -> Variation {
        let group = &probes.groups[probe.group];
        let mut uniforms = group.uniforms.clone();
        if let Some(by) = when.stretched {
            let moment = self.scene.moment(group.t, stretched(&group.matrices, by));
            for (uniform, value) in self.interface.uniforms.iter().zip(&mut uniforms) {
                if matches!(uniform.feed, Feed::Role(_)) {
                    *value = uniform.value(&moment);
                }
            }
        }
        let mut probe = probe.clone();
        for (input, value) in self.interface.inputs.iter().zip(&mut probe.attributes) {
            if let Some((_, by)) = when.scaled.iter().find(|(name, _)| *name == input.name) {
                *value = value.scaled(by);
            }
        }
        Variation { uniforms, probe }
    }
}

fn stretched(matrices: &Matrices, by: [f64; 3]) -> Matrices {
    let projection = matrices.model_view_projection * matrices.model_view.inverse();
    let stretch = DMat4::from_scale(DVec3::from_array(by));
    let stretched = Matrices::new(matrices.model_view * stretch, projection);
    Matrices { model: matrices.model * stretch, view: matrices.view, ..stretched }
}
