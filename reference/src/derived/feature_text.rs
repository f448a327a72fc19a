//! The texts of features: what the program without one has in another way.

use crate::Assignment;
use crate::accepted::AcceptedAnswer;
use crate::assignment::RubricItem;
use crate::feature::Feature;
use crate::interpreter::outline;

impl Assignment {
    /// The only line in the text of whose feature a text stands, which is more than a name or a number.
    pub fn only_line_with(&self, text: &str) -> Option<&RubricItem> {
        /// An operator and what stands on both of its sides.
        const LEAST_WORDS: usize = 3;
        let is_long = outline::words(text).len() >= LEAST_WORDS;
        let has = |feature: &Option<Feature>| matches!(feature, Some(Feature::Program(own)) if stands_in(text, own));
        let mut own = self.rubric.iter().zip(&self.features).filter(|(_, feature)| is_long && has(feature));
        let (line, _) = own.next()?;
        own.next().is_none().then_some(line)
    }
}

/// Whether a text stands in what is another one without a feature.
pub(super) fn stands_in(text: &str, feature: &AcceptedAnswer) -> bool {
    // Brackets and numbers are written otherwise.
    let words = |text: &str| -> Vec<String> {
        let words = outline::words(text).into_iter().map(|word| word.text);
        let words = words.filter(|word| !matches!(word.as_str(), "(" | ")" | ";"));
        words.map(|word| word.parse::<f64>().map_or(word, |number| number.to_string())).collect()
    };
    let own = words(text);
    feature.replaced.iter().any(|[around, _]| words(around).windows(own.len().max(1)).any(|part| part == own))
}
