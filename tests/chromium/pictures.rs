//! Pictures of pages, for people to look at.

use super::{Browser, root};
use serde_json::{Value, json};

impl Browser {
    /// Writes a picture of the whole page to `target/screenshots/`.
    pub async fn shot(&self, name: &str) {
        let metrics = self.devtools("Page.getLayoutMetrics", json!({})).await;
        let size = &metrics["cssContentSize"];
        let clip = json!({ "x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1 });
        self.picture(name, json!({ "format": "png", "captureBeyondViewport": true, "clip": clip })).await;
    }

    /// The same of what the window shows of the page.
    pub async fn window(&self, name: &str) {
        self.drawn().await;
        self.picture(name, json!({ "format": "png" })).await;
    }

    async fn picture(&self, name: &str, options: Value) {
        let picture = self.devtools("Page.captureScreenshot", options).await;
        let bytes = base64::Engine::decode(
            &base64::engine::general_purpose::STANDARD,
            picture["data"].as_str().expect("a picture"),
        );
        let folder = root().join("target/screenshots");
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join(format!("{name}.png")), bytes.expect("base64")).expect("a file");
    }
}
