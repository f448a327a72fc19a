//! Each way of signing in, as a student and as somebody who teaches: the button of an OpenID issuer, a trusted header, a personal
//! code, and a learning platform in a frame and in a new window.

use crate::chromium::Browser;
use crate::chromium::server::{Server, TOKEN};
use issuer::{CLIENT, Issuer, SECRET};
use platform::{DEPLOYMENT, Platform};
use reqwest::{Method, RequestBuilder};
use serde_json::{Value, json};

#[path = "../service/sign_in/issuer.rs"]
#[allow(dead_code, reason = "the tests of the service ask it for more")]
mod issuer;

#[path = "../service/lti/platform.rs"]
#[allow(dead_code, reason = "the tests of the service ask it for more")]
mod platform;

/// What the issuer takes from beside it.
mod lti {
    pub(in crate::sign_in) use super::platform;
}

/// The service, at an address that is known before it starts, and an issuer that it trusts.
async fn start() -> (Server, Issuer, String) {
    let port = std::net::TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("an address").port();
    let public = format!("http://localhost:{port}");
    let issuer = Issuer::sending_to(&format!("{public}/signed-in")).await;
    let configuration = tempfile::NamedTempFile::new().expect("a file");
    let text = format!(
        "listen = \"127.0.0.1:{port}\"\npublic_url = {public:?}\nidentity_header = \"X-Remote-User\"\n\
         identity_proxies = [\"127.0.0.1\"]\n\n[[sign_in]]\nid = \"university\"\nname = \"Example University\"\n\
         issuer = {:?}\nclient_id = {CLIENT:?}\nclient_secret = {SECRET:?}\nclaim = \"email\"\ndomain = \"example.ac.jp\"\n\n\
         [limits]\nrequest_timeout = 60.0\n",
        issuer.address
    );
    std::fs::write(configuration.path(), text).expect("written");
    let server = Server::configured(configuration.path());
    assert_eq!(server.address, public);
    (server, issuer, public)
}

/// Asks the API as the teacher's program.
async fn api(server: &Server, method: Method, path: &str, change: impl Fn(RequestBuilder) -> RequestBuilder) -> Value {
    let request = reqwest::Client::new().request(method, server.at(path)).bearer_auth(TOKEN);
    let answer = change(request).send().await.expect("an answer");
    assert!(answer.status().is_success(), "{path}: {answer:?}");
    answer.json().await.expect("JSON")
}

/// A class of two, and an administrator with an account.
async fn class(server: &Server, browser: &Browser) {
    let roster = "number,name\nS1,Wada\nS2,Ito\n";
    let csv = |request: RequestBuilder| request.header("content-type", "text/csv").body(roster);
    api(server, Method::PUT, "/api/v1/roster", csv).await;
    browser.open(&server.at("/teacher/login")).await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    browser.open(&server.at("/teacher/people")).await;
    browser.keys("#login", "prof").await;
    browser.click("main .primary").await;
    browser.until("location.pathname.startsWith('/teacher/welcome/')").await;
    browser.keys("[type=password]", "a long password").await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
}

async fn forget(browser: &Browser) {
    browser.devtools("Network.clearBrowserCookies", json!({})).await;
}

/// Waits until the student's page is there as this student's.
async fn is_student(browser: &Browser, number: &str) {
    browser
        .until(&format!(
            "document.querySelector('.desk') && document.querySelector('.top .who bdi')?.textContent === {number:?}"
        ))
        .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_issuer_a_proxy_and_a_code_let_in_whom_they_vouch_for() {
    let ((server, _issuer, public), browser) = (start().await, Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    class(&server, &browser).await;
    forget(&browser).await;

    // The button of the issuer, on the student's page and on the teachers'.
    let button = "a[href^='/sign-in/university']";
    browser.open(&public).await;
    assert_eq!(browser.text(button).await, "Log in with Example University");
    browser.check("sign-in-student").await;
    browser.click(button).await;
    browser.click("#s1").await;
    is_student(&browser, "S1").await;
    assert!(!browser.has(button).await, "who is known signs in no more");
    crate::choose(&browser, &crate::sample(crate::RIGHT), "full").await;
    crate::hand_in(&browser).await;
    // Somebody else at the same browser finds nothing of theirs.
    browser.open(&format!("{public}/sign-in/university")).await;
    browser.click("#s2").await;
    is_student(&browser, "S2").await;
    assert!(!browser.has(".attempts").await, "another one's attempts");
    forget(&browser).await;
    for (width, height) in [(390, 844), (1280, 900)] {
        browser.size(width, height).await;
        browser.open(&format!("{public}/teacher/login")).await;
        browser.check(&format!("sign-in-teacher-{width}")).await;
    }
    browser.click(button).await;
    browser.click("#prof").await;
    browser.until("location.pathname === '/teacher' && document.querySelector('.overview')").await;

    // The word of a proxy.
    forget(&browser).await;
    let headers = |name: &str| json!({ "headers": { "Accept-Language": "en", "X-Remote-User": name } });
    browser.devtools("Network.setExtraHTTPHeaders", headers("s1")).await;
    browser.open(&public).await;
    is_student(&browser, "S1").await;
    assert!(browser.has(".attempts").await, "what was handed in from elsewhere");
    browser.devtools("Network.setExtraHTTPHeaders", headers("prof")).await;
    browser.open(&format!("{public}/teacher/login")).await;
    browser.until("location.pathname === '/teacher' && document.querySelector('.overview')").await;
    browser.languages("en").await;

    // A personal code; another one's number needs another one's code.
    forget(&browser).await;
    let codes = api(&server, Method::GET, "/api/v1/codes", |request| request).await;
    let code = |place: usize| codes["codes"][place]["code"].as_str().expect("a code").to_owned();
    let link = api(&server, Method::GET, "/api/v1/course", |request| request).await["link"].clone();
    browser.open(link.as_str().expect("a link")).await;
    assert!(browser.has(button).await, "the course link has the button as well");
    browser.keys("#number", "S2").await;
    browser.keys("#code", &code(0)).await;
    browser.click("main .primary").await;
    browser.until("document.querySelector('#wrong')").await;
    // A refused form is answered with 403, which the browser notes.
    browser.complaints().await;
    browser.check("sign-in-code-wrong").await;
    browser.js("document.querySelector('#code').value = ''").await;
    browser.keys("#code", &code(1)).await;
    browser.click("main .primary").await;
    is_student(&browser, "S2").await;
    browser.end().await;
}

/// Makes the service and a platform known to each other.
async fn add(server: &Server, platform: &Platform) {
    let at = |path: &str| format!("{}/{path}", platform.issuer);
    let wish = json!({
        "name": "Moodle", "issuer": platform.issuer, "client_id": platform::CLIENT, "deployment": DEPLOYMENT,
        "auth_url": at("auth"), "token_url": at("token"), "keys_url": at("jwks"),
    });
    api(server, Method::POST, "/api/v1/platforms", |request| request.json(&wish)).await;
    // Scores go to it while people come and go.
    let keys = api(server, Method::GET, "/lti/jwks.json", |request| request).await;
    platform.seen().tools_keys = Some(serde_json::from_value(keys).expect("keys"));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_platform_lets_people_in_within_its_page_and_in_a_new_window() {
    let ((server, _issuer, public), browser) = (start().await, Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    // One platform is of the same site as the service, so that cookies come along in its frame; to the other one the service is
    // another site.
    let (near, far) = (Platform::called("localhost").await, Platform::start().await);
    for platform in [&near, &far] {
        add(&server, platform).await;
    }
    let way = |platform: &Platform, page: &str, who: &str, role: &str| {
        format!("{}/{page}?tool={public}&who={who}&role={role}", platform.issuer)
    };
    browser.open(&way(&near, "course", "s1", "Learner")).await;
    browser.look_into_frame("iframe").await;
    is_student(&browser, "S1").await;
    crate::choose(&browser, &crate::sample(crate::RIGHT), "full").await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('.receipt .permalink')").await;
    browser.open(&way(&near, "course", "teacher", "Instructor")).await;
    browser.look_into_frame("iframe").await;
    browser.until("document.querySelector('.overview')?.textContent.includes('1')").await;
    assert!(browser.text(".people tbody th").await.contains("S1"), "{}", browser.text(".people").await);

    // The window that the platform opens itself.
    for (who, role, is_there) in [
        ("s2", "Learner", "document.querySelector('.top .who bdi')?.textContent === 'S2'"),
        ("teacher", "Instructor", "document.querySelector('.overview')"),
    ] {
        forget(&browser).await;
        browser.open(&way(&near, "come", who, role)).await;
        browser.until(is_there).await;
        assert!(browser.address().await.starts_with(&public));
    }

    // A browser that keeps no cookies in the frame is shown a window of its own, in which the platform is asked for the first
    // time. (What comes back to it from another site needs https, as `tests/service/lti.rs` has it.)
    forget(&browser).await;
    let before = browser.tab().await;
    browser.open(&way(&far, "course", "s2", "Learner")).await;
    browser.look_into_frame("iframe").await;
    browser.until("document.querySelector('h1')?.textContent === 'Open it in a new window'").await;
    assert_eq!(far.seen().hints.len(), 1, "the platform was not asked yet");
    browser.click(".actions .button").await;
    browser.to_other_tab(&before).await;
    browser.until("location.pathname === '/lti/launch'").await;
    assert_eq!(far.seen().hints.len(), 0);
    browser.end().await;
}

/// A service that is told that it is behind https. Chromium keeps cookies of localhost as if that were so.
fn behind_https() -> Server {
    let port = std::net::TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("an address").port();
    let configuration = tempfile::NamedTempFile::new().expect("a file");
    let text = format!("listen = \"127.0.0.1:{port}\"\npublic_url = \"https://localhost:{port}\"\n");
    std::fs::write(configuration.path(), text).expect("written");
    let mut server = Server::configured(configuration.path());
    server.address = format!("http://localhost:{port}");
    server
}

#[tokio::test(flavor = "multi_thread")]
async fn within_another_sites_page_cookies_are_that_pages() {
    let (server, browser, far) = (behind_https(), Browser::start().await, Platform::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    add(&server, &far).await;
    let come = async |who: &str, role: &str| {
        let address = format!("{}/course?tool={}&who={who}&role={role}", far.issuer, server.address);
        browser.open(&address).await;
        browser.look_into_frame("iframe").await;
    };
    come("s1", "Learner").await;
    is_student(&browser, "S1").await;
    crate::choose(&browser, &crate::sample(crate::RIGHT), "full").await;
    browser.click("form.work .primary").await;
    browser.until("document.querySelector('.receipt .permalink')").await;
    come("teacher", "Instructor").await;
    browser.until("document.querySelector('.overview')?.textContent.includes('1')").await;
    browser.click("nav a[href$='/settings']").await;
    browser.until("location.pathname.endsWith('/settings')").await;
    browser.click("main form .primary").await;
    browser.until("document.querySelector('.notice')?.textContent.includes('Saved')").await;
    // A student comes after whoever taught at the same browser, and is nobody else.
    come("s2", "Learner").await;
    is_student(&browser, "S2").await;
    assert!(!browser.has(".attempts").await, "another one's attempts");
    browser.js("location.href = '/teacher'").await;
    browser.until("location.pathname === '/teacher/login'").await;
    // Outside of the platform's page the browser is nobody's.
    browser.open(&server.at("/")).await;
    browser.until("document.querySelector('.desk')").await;
    assert!(!browser.has(".top .who bdi").await, "a cookie of the frame");
    browser.end().await;
}
