//! The mouse and the keyboard, and the editor of the student's page as a person sees and uses it.

use super::Browser;
use serde_json::json;

impl Browser {
    /// Presses and releases the mouse at a point of the window.
    pub async fn click_at(&self, x: f64, y: f64) {
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.devtools("Input.dispatchMouseEvent", event).await;
        }
    }

    /// Types where the focus is.
    pub async fn type_text(&self, text: &str) {
        for letter in text.chars() {
            for kind in ["keyDown", "keyUp"] {
                let event = json!({ "type": kind, "key": letter.to_string(), "text": letter.to_string() });
                self.devtools("Input.dispatchKeyEvent", event).await;
            }
        }
    }

    /// Presses and releases a key by its name and its Windows key code, where the focus is. Modifiers: 1 Alt, 2 Control,
    /// 4 Meta, 8 Shift.
    pub async fn press(&self, key: &str, code: u32, modifiers: u32) {
        for kind in ["rawKeyDown", "keyUp"] {
            let event =
                json!({ "type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code, "modifiers": modifiers });
            self.devtools("Input.dispatchKeyEvent", event).await;
        }
    }

    /// The text in the editor of the student's page.
    pub async fn editor_text(&self) -> String {
        let text = self.js("return document.querySelector('#code').value").await;
        text.as_str().expect("a text").to_owned()
    }

    /// Waits until the page has drawn what it was told so far.
    pub async fn drawn(&self) {
        let script = "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done(true)))";
        self.client.execute_async(script, Vec::new()).await.expect("a frame");
    }

    /// Puts the cursor of the editor before the first `mark` of the lines in sight, by the mouse.
    pub async fn cursor_to(&self, mark: &str) {
        self.cursor_into(mark, 0).await;
    }

    /// The same, so many characters behind the beginning of the mark.
    pub async fn cursor_into(&self, mark: &str, after: usize) {
        self.client
            .execute(
                "[...document.querySelectorAll('.cm-line')].find(l => l.textContent.includes(arguments[0])) \
                   .scrollIntoView({ block: 'nearest' }); \
                 document.querySelector('.cm-scroller').scrollLeft = 0",
                vec![mark.into()],
            )
            .await
            .unwrap_or_else(|error| panic!("{mark}: {error}"));
        self.drawn().await;
        let at = self.painted(mark, after).await;
        self.click_at(at.0, at.1).await;
        self.until("document.activeElement?.matches('.cm-content')").await;
    }

    /// Where the character that stands `after` characters behind the beginning of the first `mark` is painted: its left
    /// edge, half way down.
    pub async fn painted(&self, mark: &str, after: usize) -> (f64, f64) {
        let found = self
            .client
            .execute(
                "const [mark, after] = arguments; \
                 const line = [...document.querySelectorAll('.cm-line')].find(l => l.textContent.includes(mark)); \
                 let left = line.textContent.indexOf(mark) + after; \
                 const walker = document.createTreeWalker(line, NodeFilter.SHOW_TEXT); \
                 for (let node; (node = walker.nextNode()); left -= node.length) { \
                   if (left >= node.length) continue; \
                   const range = document.createRange(); \
                   range.setStart(node, left); range.setEnd(node, left + 1); \
                   const box = range.getBoundingClientRect(); \
                   return [box.left, (box.top + box.bottom) / 2]; \
                 }",
                vec![mark.into(), after.into()],
            )
            .await
            .unwrap_or_else(|error| panic!("{mark}: {error}"));
        let number = |index: usize| found[index].as_f64().unwrap_or_else(|| panic!("{mark} is not painted: {found}"));
        (number(0), number(1))
    }
}
