//! Everyone's picture, each different one in the page once.

use crate::class::Class;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::collections::HashMap;
use std::fmt::Write as _;

/// The pictures of a page as style rules. The expected one has the class `e`, the others `p0`, `p1` and so on.
pub(super) struct PortraitStyles<'a> {
    classes: HashMap<&'a [u8], String>,
    /// The rules, in the order of the class.
    pub style: String,
}

impl<'a> PortraitStyles<'a> {
    pub fn of(class: &'a Class) -> Self {
        let (width, height) = size(&class.expected_portrait).unwrap_or((4, 3));
        let mut portraits =
            Self { classes: HashMap::new(), style: format!(":root {{ --shape: {width} / {height}; }}\n") };
        portraits.add(&class.expected_portrait, "e".into());
        for portrait in class.entries.iter().filter_map(|entry| entry.portrait.as_deref()) {
            let name = format!("p{}", portraits.classes.len() - 1);
            portraits.add(portrait, name);
        }
        portraits
    }

    fn add(&mut self, png: &'a [u8], class: String) {
        if self.classes.contains_key(png) {
            return;
        }
        if !png.is_empty() {
            let data = STANDARD.encode(png);
            // Writing into a string cannot fail.
            let _ = writeln!(self.style, ".{class} {{ background-image: url(data:image/png;base64,{data}); }}");
        }
        self.classes.insert(png, class);
    }

    /// The style class of a picture; `None` where there is no picture.
    pub fn class(&self, png: Option<&[u8]>) -> Option<String> {
        png.filter(|png| !png.is_empty()).and_then(|png| self.classes.get(png)).cloned()
    }
}

/// Width and height from a PNG's first chunk.
fn size(png: &[u8]) -> Option<(u32, u32)> {
    let number = |at: usize| Some(u32::from_be_bytes(png.get(at..at + 4)?.try_into().ok()?));
    let is_header = png.get(12..16) == Some(b"IHDR");
    Some((number(16)?, number(20)?)).filter(|(width, height)| is_header && *width > 0 && *height > 0)
}
