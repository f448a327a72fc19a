//! What holds for all pages: accessible, no wider than the window, read from top to bottom by the keyboard, no complaint of the browser.

use super::{Browser, Devtools, root};
use serde_json::{Value, json};
use std::path::PathBuf;

impl Browser {
    /// What the browser complained about since it was last asked: errors of scripts, refused loads, violations of the
    /// content security policy.
    pub async fn complaints(&self) -> Vec<String> {
        let log: Value = self
            .client
            .issue_cmd(Devtools { path: "se/log", body: json!({ "type": "browser" }) })
            .await
            .expect("the browser's log");
        let entries = log.as_array().cloned().unwrap_or_default();
        entries.iter().map(|entry| entry["message"].as_str().unwrap_or_default().to_owned()).collect()
    }

    /// Holds a page to what holds for all: accessible by the rules of axe-core in light and in dark, no wider than the
    /// window, in the order of the keyboard, no complaint of the browser. A picture of each is kept.
    pub async fn check(&self, name: &str) {
        for scheme in ["light", "dark"] {
            self.scheme(scheme).await;
            let violations = self.axe().await;
            assert!(violations.is_empty(), "{name} in {scheme}:\n{}", violations.join("\n"));
            self.shot(&format!("{name}-{scheme}")).await;
        }
        self.scheme("light").await;
        self.narrow_enough(name).await;
        self.in_keyboard_order(name).await;
        let complaints = self.complaints().await;
        assert!(complaints.is_empty(), "{name}:\n{}", complaints.join("\n"));
    }

    /// Nothing makes the page wider than its window.
    pub async fn narrow_enough(&self, name: &str) {
        let overflow = self
            .js("const wide = document.documentElement.clientWidth; \
                 if (document.documentElement.scrollWidth <= wide) return []; \
                 return [...document.querySelectorAll('body *')].filter(e => e.getBoundingClientRect().right > wide + 1) \
                   .slice(0, 5).map(e => `${e.tagName}.${e.getAttribute('class')}`)")
            .await;
        assert_eq!(overflow, json!([]), "{name} scrolls sideways");
    }

    /// On a phone, where a page is one column, the keyboard never goes to something above.
    async fn in_keyboard_order(&self, name: &str) {
        let backwards = self
            .js("if (innerWidth > 480) return []; \
                 const all = [...(document.querySelector('dialog[open]') ?? document).querySelectorAll('a[href], button, input, select, textarea, summary')] \
                   .filter(e => e.tabIndex >= 0 && !e.disabled && e.checkVisibility() && e.offsetHeight > 1); \
                 const place = e => e.getBoundingClientRect(); \
                 return all.slice(1).map((e, i) => [all[i], e]) \
                   .filter(([one, next]) => place(next).bottom <= place(one).top + 1) \
                   .map(pair => pair.map(e => e.outerHTML.slice(0, 100)).join(' → '))")
            .await;
        assert_eq!(backwards, json!([]), "{name}: the keyboard goes up");
    }

    async fn axe(&self) -> Vec<String> {
        let library = std::fs::read_to_string(axe()).expect("axe-core: run script/bootstrap --test");
        if self.js("return typeof window.axe").await == "undefined" {
            self.client.execute(&format!("{library}; window.axe = axe;"), Vec::new()).await.expect("axe");
        }
        let script = "const done = arguments[arguments.length - 1]; \
                      axe.run(document, { resultTypes: ['violations'] }).then(r => done(r.violations.map(v => \
                      `${v.id} (${v.impact}): ${v.help}: ${v.nodes.slice(0, 4).map(n => n.html.slice(0, 200) + ' ' + \
                      (n.any[0]?.message ?? '')).join(' | ')}`)), e => done([String(e)]))";
        let found = self.client.execute_async(script, Vec::new()).await.expect("axe's answer");
        let found = found.as_array().cloned().unwrap_or_default();
        found.iter().map(|violation| violation.as_str().unwrap_or_default().to_owned()).collect()
    }
}

fn axe() -> PathBuf {
    let folder = root().join("target/axe-core");
    let files = std::fs::read_dir(&folder).expect("target/axe-core: run script/bootstrap --test");
    let mut files: Vec<_> = files.filter_map(Result::ok).map(|file| file.path()).collect();
    files.sort();
    files.pop().expect("axe-core: run script/bootstrap --test")
}
