//! A headless Chromium as the tests of the pages drive it, and the service that it looks at.

mod checks;
mod editor;
mod pictures;
pub mod processes;
pub mod server;

use self::processes::Processes;
use axum::http::Method;
use fantoccini::error::CmdError;
use fantoccini::wd::{Capabilities, WebDriverCompatibleCommand, WindowHandle};
use fantoccini::{Client, ClientBuilder, Locator};
use reqwest::Url;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::{Duration, Instant};

/// Longest wait for a condition: the machine may be busy with other tests.
const PATIENCE: Duration = Duration::from_secs(30);
/// Pause between two looks at a condition.
const LOOK: Duration = Duration::from_millis(25);

/// A browser.
pub struct Browser {
    client: Client,
    processes: Processes,
}

/// A command of the browser's own protocol, through its WebDriver.
#[derive(Debug)]
struct Devtools {
    path: &'static str,
    body: Value,
}

impl WebDriverCompatibleCommand for Devtools {
    fn endpoint(&self, base: &Url, session: Option<&str>) -> Result<Url, <Url as FromStr>::Err> {
        base.join(&format!("session/{}/{}", session.unwrap_or_default(), self.path))
    }

    fn method_and_body(&self, _request: &Url) -> (Method, Option<String>) {
        (Method::POST, Some(self.body.to_string()))
    }
}

impl Browser {
    /// Starts a driver on a free port, and a browser with an empty profile.
    pub async fn start() -> Self {
        let (processes, port) = Processes::start();
        let arguments = [
            "--headless=new",
            // The tests may run as root, where the browser's own sandbox does not start; it meets pages of ours only.
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-dev-shm-usage",
            "--force-color-profile=srgb",
            &format!("--user-data-dir={}", processes.profile.path().display()),
        ];
        let mut capabilities = Capabilities::new();
        capabilities.insert("goog:chromeOptions".into(), json!({ "args": arguments }));
        capabilities.insert("goog:loggingPrefs".into(), json!({ "browser": "ALL" }));
        let client = ClientBuilder::new(hyper_util::client::legacy::connect::HttpConnector::new())
            .capabilities(capabilities)
            .connect(&format!("http://127.0.0.1:{port}"))
            .await
            .expect("a browser");
        Self { client, processes }
    }

    /// Ends browser and driver.
    pub async fn end(self) {
        let _ = self.client.clone().close().await;
    }

    /// The folder of its profile.
    pub fn profile(&self) -> PathBuf {
        self.processes.profile.path().to_owned()
    }

    /// Goes to an address.
    pub async fn open(&self, address: &str) {
        self.client.goto(address).await.unwrap_or_else(|error| panic!("{address}: {error}"));
    }

    /// Where it is.
    pub async fn address(&self) -> String {
        self.client.current_url().await.expect("an address").into()
    }

    /// What a script gives.
    pub async fn js(&self, script: &str) -> Value {
        self.client.execute(script, Vec::new()).await.unwrap_or_else(|error| panic!("{script}: {error}"))
    }

    /// The text that a reader sees in the first element.
    pub async fn text(&self, css: &str) -> String {
        let element = self.client.find(Locator::Css(css)).await.unwrap_or_else(|error| panic!("{css}: {error}"));
        element.text().await.expect("a text")
    }

    /// What an address of the page's own service answers, as text.
    pub async fn fetch(&self, path: &str) -> String {
        let script =
            "const done = arguments[1]; fetch(arguments[0]).then(a => a.text()).then(done, e => done(String(e)))";
        let answer = self.client.execute_async(script, vec![path.into()]).await;
        answer.unwrap_or_else(|error| panic!("{path}: {error}")).as_str().unwrap_or_default().to_owned()
    }

    /// Whether there is such an element.
    pub async fn has(&self, css: &str) -> bool {
        !self.client.find_all(Locator::Css(css)).await.expect("an answer").is_empty()
    }

    /// How many such elements there are. Works without scripts.
    pub async fn count(&self, css: &str) -> usize {
        self.client.find_all(Locator::Css(css)).await.expect("an answer").len()
    }

    /// Waits until an expression of the page is true.
    pub async fn until(&self, condition: &str) {
        let start = Instant::now();
        let script = format!("return Boolean({condition})");
        loop {
            // Between two pages there may be nothing to ask.
            let now = self.client.execute(&script, Vec::new()).await;
            if matches!(now, Ok(Value::Bool(true))) {
                return;
            }
            assert!(start.elapsed() < PATIENCE, "waited in vain for {condition} at {}: {now:?}", self.address().await);
            tokio::time::sleep(LOOK).await;
        }
    }

    /// Waits until such an element is there, without asking a script: pages may have scripts disabled.
    pub async fn until_there(&self, css: &str) {
        let found = self.client.wait().at_most(PATIENCE).every(LOOK).for_element(Locator::Css(css)).await;
        found.unwrap_or_else(|error| panic!("waited in vain for {css}: {error}"));
    }

    /// Clicks the first element as a person does: when neither it nor the page moves any more, and nothing covers it.
    /// Works without scripts.
    pub async fn click(&self, css: &str) {
        let start = Instant::now();
        let mut before = None;
        loop {
            let element = self.client.find(Locator::Css(css)).await.unwrap_or_else(|error| panic!("{css}: {error}"));
            let now = (element.rectangle().await.ok(), self.scrolled().await);
            let clicked = if before.as_ref() == Some(&now) { Some(element.click().await) } else { None };
            match clicked {
                Some(Ok(())) => return,
                // The click itself may have scrolled to the element: look again.
                Some(Err(error)) => assert!(start.elapsed() < PATIENCE, "{css}: {error}"),
                None => assert!(start.elapsed() < PATIENCE, "{css} never comes to rest: {before:?}, then {now:?}"),
            }
            before = Some(now);
            tokio::time::sleep(LOOK).await;
        }
    }

    /// How far the page is scrolled.
    async fn scrolled(&self) -> (Value, Value) {
        let metrics = self.devtools("Page.getLayoutMetrics", json!({})).await;
        let view = &metrics["cssVisualViewport"];
        (view["pageX"].clone(), view["pageY"].clone())
    }

    /// Opens a tab, and looks at it.
    pub async fn new_tab(&self) -> WindowHandle {
        let handle = self.client.new_window(true).await.expect("a tab").handle;
        self.client.switch_to_window(handle.clone()).await.expect("the tab");
        handle
    }

    /// The tab that is looked at.
    pub async fn tab(&self) -> WindowHandle {
        self.client.window().await.expect("a tab")
    }

    /// Looks at a tab.
    pub async fn to_tab(&self, handle: &WindowHandle) {
        self.client.switch_to_window(handle.clone()).await.expect("the tab");
    }

    /// Looks at the other tab, as soon as there is one.
    pub async fn to_other_tab(&self, this: &WindowHandle) {
        let start = Instant::now();
        loop {
            let handles = self.client.windows().await.expect("tabs");
            if let Some(other) = handles.into_iter().find(|handle| handle != this) {
                return self.to_tab(&other).await;
            }
            assert!(start.elapsed() < PATIENCE, "no other tab");
            tokio::time::sleep(LOOK).await;
        }
    }

    /// Looks into a frame of the page.
    pub async fn look_into_frame(&self, css: &str) {
        let frame = self.client.find(Locator::Css(css)).await.unwrap_or_else(|error| panic!("{css}: {error}"));
        frame.enter_frame().await.expect("a frame");
    }

    /// Goes back to the page before.
    pub async fn back(&self) {
        self.client.back().await.expect("a page");
    }

    /// Types into an element, or gives a file field its file.
    pub async fn keys(&self, css: &str, keys: &str) {
        let element = self.client.find(Locator::Css(css)).await.unwrap_or_else(|error| panic!("{css}: {error}"));
        element.send_keys(keys).await.unwrap_or_else(|error| panic!("{css}: {error}"));
    }

    /// A command of the browser's own protocol.
    pub async fn devtools(&self, command: &str, parameters: Value) -> Value {
        let body = json!({ "cmd": command, "params": parameters });
        let answer: Result<Value, CmdError> = self.client.issue_cmd(Devtools { path: "goog/cdp/execute", body }).await;
        answer.unwrap_or_else(|error| panic!("{command}: {error}"))
    }

    /// The size of the page's window in CSS pixels.
    pub async fn size(&self, width: u32, height: u32) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500 });
        self.devtools("Emulation.setDeviceMetricsOverride", metrics).await;
    }

    /// Dark or light, as the system of a reader is set.
    pub async fn scheme(&self, scheme: &str) {
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        self.devtools("Emulation.setEmulatedMedia", json!({ "features": features })).await;
    }

    /// Whether pages may run scripts.
    pub async fn scripts(&self, on: bool) {
        self.devtools("Emulation.setScriptExecutionDisabled", json!({ "value": !on })).await;
    }

    /// The languages that it asks for.
    pub async fn languages(&self, accept: &str) {
        self.devtools("Network.enable", json!({})).await;
        self.devtools("Network.setExtraHTTPHeaders", json!({ "headers": { "Accept-Language": accept } })).await;
    }
}

/// The project's folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The place of a sample.
pub fn sample(path: &str) -> String {
    let path = root().join("submissions/ggsample06").join(path);
    assert!(path.is_file(), "{}", path.display());
    path.to_string_lossy().into_owned()
}
