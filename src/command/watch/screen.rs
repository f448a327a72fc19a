//! Where the reports of a session appear: in place at a terminal, one behind the other elsewhere.

use crate::language::{Language, Text};
use std::io::{IsTerminal, Write};

/// Clears what is on the screen and begins at its top; what scrolled off before stays there.
const CLEAR: &str = "\x1b[2J\x1b[H";

/// Standard output.
pub(super) struct WatchScreen {
    language: Language,
    name: String,
    is_terminal: bool,
    reports: u32,
    is_closed: bool,
}

impl WatchScreen {
    pub fn new(name: &str, language: Language) -> Self {
        let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let name = name.chars().filter(|c| !c.is_control()).collect();
        Self { language, name, is_terminal: std::io::stdout().is_terminal() && !is_dumb, reports: 0, is_closed: false }
    }

    /// Shows a report, and what it changed since the one before.
    pub fn report(&mut self, document: &str, change: Option<&str>) {
        self.reports += 1;
        let time = jiff::Zoned::now().strftime("%H:%M:%S");
        let (name, number) = (&self.name, self.reports);
        let mut text = String::new();
        if self.is_terminal {
            text.push_str(CLEAR);
        } else {
            text.push_str(&format!("──── #{number} · {time} · {name} ────\n"));
        }
        text.push_str(document);
        text.push('\n');
        if let Some(change) = change {
            text.push_str(&format!("{change}\n"));
        }
        if self.is_terminal {
            let watching = Text::new(
                format!("#{number} · {time} · watching {name} · Ctrl-C ends"),
                format!("#{number} · {time} · {name} の保存を待っています · Ctrl-C で終了"),
            );
            text.push_str(&format!("{}\n", watching.get(self.language)));
        }
        self.write(&text);
    }

    /// Says something between two reports.
    pub fn note(&mut self, note: &Text) {
        let note: String = note.get(self.language).chars().filter(|c| !c.is_control()).collect();
        self.write(&format!("{note}\n"));
    }

    /// Leaves the terminal as the next command expects it: behind the `^C` that it shows.
    pub fn end(&mut self) {
        if self.is_terminal {
            self.write("\n");
        }
    }

    /// Whether nobody reads any more.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    fn write(&mut self, text: &str) {
        let mut output = std::io::stdout().lock();
        self.is_closed = output.write_all(text.as_bytes()).and_then(|()| output.flush()).is_err();
    }
}
