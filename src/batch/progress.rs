//! What a person sees while a class is graded: a bar with rate, remaining time and the verdicts so far.

use crate::class::ClassEntry;
use crate::class::standing::{Standing, StandingCounts};
use crate::language::{Language, Text};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// The bar. It draws on standard error, and only where that is a terminal.
#[derive(Debug)]
pub struct ClassProgress {
    bar: ProgressBar,
    counts: Mutex<StandingCounts>,
}

/// How often the bar is drawn: what comes faster is not seen, and costs.
const PER_SECOND: u8 = 10;

impl ClassProgress {
    /// A bar for so many entries, of which these are done already.
    pub fn new<'a>(total: usize, done: impl Iterator<Item = &'a ClassEntry>, language: Language) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::stderr_with_hz(PER_SECOND));
        let template = Text::new(
            "{bar:30.green/dim} {pos}/{len}  {msg}  {rate:.dim}  {eta} left",
            "{bar:30.green/dim} {pos}/{len}  {msg}  {rate:.dim}  残り {eta}",
        );
        if let Ok(style) = ProgressStyle::with_template(template.get(language)) {
            let rate = |state: &ProgressState, out: &mut dyn Write| {
                // Nothing can be done about a terminal that is gone.
                let _ = write!(out, "{:.1}/s", state.per_sec());
            };
            bar.set_style(style.progress_chars("━━─").with_key("rate", rate));
        }
        let counts = Standing::count(done);
        bar.set_position(counts.iter().sum::<usize>() as u64);
        bar.reset_eta();
        bar.set_message(shown(&counts));
        bar.enable_steady_tick(Duration::from_millis(500));
        Self { bar, counts: Mutex::new(counts) }
    }

    /// One more is done.
    pub fn finished(&self, entry: &ClassEntry) {
        let mut counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        counts[Standing::of(&entry.outcome) as usize] += 1;
        if !self.bar.is_hidden() {
            self.bar.set_message(shown(&counts));
        }
        drop(counts);
        self.bar.inc(1);
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// The bar, for a line to be written above it from elsewhere.
    pub fn bar(&self) -> ProgressBar {
        self.bar.clone()
    }
}

fn shown(counts: &StandingCounts) -> String {
    let standings = Standing::ALL.iter().zip(counts).filter(|(_, count)| **count > 0);
    standings.map(|(standing, count)| format!("{} {count}", standing.sign())).collect::<Vec<_>>().join("  ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_there_is_is_counted_out() {
        assert_eq!(shown(&[12, 3, 0, 0, 0, 1]), "✓ 12  △ 3  ! 1");
        assert_eq!(shown(&StandingCounts::default()), "");
    }
}
