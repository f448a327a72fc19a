//! Who a reverse proxy says that somebody is, and who else may say so: nobody.

use crate::bench::{Bench, Fake, Reply, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::http::{HeaderValue, Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::identity::add_staff;
use ggrade::service::limits::Peer;
use ggrade::service::store::{RosterLine, StaffRole, TeacherSession};
use std::net::SocketAddr;
use std::sync::Arc;

on_both!(
    students_and_staff_come_in_by_the_proxys_word,
    a_session_is_over_when_the_proxy_names_somebody_else,
    nobody_else_is_believed,
    without_a_header_in_the_configuration_nobody_is,
);

const PROXY: &str = "192.0.2.1";

async fn bench(database: Database, header: Option<&str>) -> Bench {
    let config =
        Config { identity_header: header.map(str::to_owned), identity_proxies: vec![PROXY.to_owned()], ..config() };
    let bench = Bench::with(database, config, Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    let line = |number: &str| RosterLine { number: number.into(), ..RosterLine::default() };
    bench.state.store.set_roster(&[line("S1"), line("S2")], 0).await.expect("a roster");
    bench
}

/// A browser that keeps its cookies.
#[derive(Default)]
struct Browser(Vec<String>);

impl Browser {
    /// Sends a request from an address, with what is said of who sends it.
    async fn send(&mut self, bench: &Bench, method: &str, address: &str, (peer, names): (&str, &[&str])) -> Reply {
        let mut request = Request::builder().method(method).uri(address);
        for name in names {
            request = request.header("x-remote-user", HeaderValue::from_bytes(name.as_bytes()).expect("a value"));
        }
        let request = request.header(header::COOKIE, self.0.join("; ")).header("sec-fetch-site", "same-origin");
        let request = request.header(header::ACCEPT, "text/html").header(header::ACCEPT_LANGUAGE, "en");
        let body = Body::from(if method == "POST" { "void main() {}" } else { "" });
        let mut request = request.header(header::CONTENT_TYPE, "text/plain").body(body).expect("a request");
        let peer: SocketAddr = format!("{peer}:50000").parse().expect("an address");
        request.extensions_mut().insert(Peer(peer));
        let reply = bench.send(request).await;
        for cookie in reply.headers.get_all(header::SET_COOKIE) {
            let pair = cookie.to_str().expect("text").split(';').next().expect("a pair").to_owned();
            let name = pair.split('=').next().expect("a name").to_owned() + "=";
            self.0.retain(|kept| !kept.starts_with(&name));
            self.0.push(pair);
        }
        reply
    }

    /// Who the student's page takes them for.
    async fn known_as(&mut self, bench: &Bench, said: (&str, &[&str])) -> Vec<String> {
        let page = self.send(bench, "GET", "/", said).await;
        assert_eq!(page.status, StatusCode::OK, "{page:?}");
        page.all(".top .who bdi")
    }
}

/// The numbers under which files stand in the class.
async fn class(bench: &Bench) -> Vec<String> {
    let rows = bench.state.store.class("ggsample06", None).await.expect("a class");
    rows.into_iter().filter_map(|row| row.number).collect()
}

async fn students_and_staff_come_in_by_the_proxys_word(database: Database) {
    let bench = bench(database, Some("X-Remote-User")).await;
    let mut browser = Browser::default();
    assert_eq!(browser.known_as(&bench, (PROXY, &["s1"])).await, ["S1"]);
    let handed_in = browser.send(&bench, "POST", "/api/v1/submissions", (PROXY, &["s1"])).await;
    assert_eq!(handed_in.status, StatusCode::CREATED, "{handed_in:?}");
    assert_eq!(class(&bench).await, ["S1"]);
    // Another one sits down at the same browser: nothing of the first is theirs.
    let page = browser.send(&bench, "GET", "/", (PROXY, &["S2"])).await;
    assert_eq!(page.all(".top .who bdi"), ["S2"]);
    assert!(page.all(".attempts li").is_empty());
    // So it is for who comes by the API first, with a cookie of somebody else.
    let mut first = Browser::default();
    first.known_as(&bench, (PROXY, &["S1"])).await;
    first.send(&bench, "POST", "/api/v1/submissions", (PROXY, &["S2"])).await;
    assert_eq!(
        class(&bench).await.iter().filter(|number| *number == "S1").count(),
        1,
        "nothing in the first one's name"
    );
    // Whoever is no student of the course is nobody, and so is whose name cannot be read: nothing of who sat there before is theirs.
    let long = "x".repeat(300);
    for names in [&["S9"][..], &["jürgen"], &[long.as_str()], &["S2", "S2"], &["S1, S2"], &["a/b"]] {
        assert_eq!(browser.known_as(&bench, (PROXY, &["S2"])).await, ["S2"]);
        assert!(browser.known_as(&bench, (PROXY, names)).await.is_empty(), "{names:?}");
        assert!(browser.known_as(&bench, (PROXY, &[])).await.is_empty(), "{names:?}: the cookie is another one");
    }

    // Who teaches has an account by that login, and comes in without a password.
    add_staff(&bench.state, "prof@example.ac.jp", "P", StaffRole::Administrator).await.expect("an account");
    let mut teacher = Browser::default();
    let login = teacher.send(&bench, "GET", "/teacher/login", (PROXY, &["Prof@example.ac.jp"])).await;
    assert_eq!((login.status, login.header("location")), (StatusCode::SEE_OTHER, "/teacher"));
    let page = teacher.send(&bench, "GET", "/teacher", (PROXY, &["Prof@example.ac.jp"])).await;
    assert_eq!(page.all("nav .who"), ["Logged in: P"]);
    let login = Browser::default().send(&bench, "GET", "/teacher/login", (PROXY, &["S1"])).await;
    assert_eq!(login.status, StatusCode::OK, "a student is shown the form");
    bench.finish().await;
}

async fn a_session_is_over_when_the_proxy_names_somebody_else(database: Database) {
    let bench = bench(database, Some("X-Remote-User")).await;
    for login in ["boss", "prof"] {
        add_staff(&bench.state, login, login, StaffRole::Administrator).await.expect("an account");
    }
    const PAGES: [&str; 3] = ["/teacher", "/teacher/settings", "/api/v1/roster"];
    let open = async |browser: &mut Browser, names: &[&str]| {
        let mut open = Vec::new();
        for page in PAGES {
            open.push(browser.send(&bench, "GET", page, (PROXY, names)).await.status == StatusCode::OK);
        }
        assert!(open.iter().all(|is| *is == open[0]), "{names:?}: {open:?}");
        open[0]
    };
    for others in [&["S1"][..], &["boss"], &["nobody"], &["jürgen"], &["prof", "prof"]] {
        let mut browser = Browser::default();
        browser.send(&bench, "GET", "/teacher/login", (PROXY, &["prof"])).await;
        assert!(open(&mut browser, &["Prof"]).await, "however the proxy writes it");
        // Pages that the proxy lets everybody ask for come without a name: nothing is shown there, and nothing ends.
        assert!(!open(&mut browser, &[]).await);
        assert!(open(&mut browser, &["prof"]).await);
        assert!(!open(&mut browser, others).await, "{others:?}");
        assert!(!open(&mut browser, &["prof"]).await, "{others:?}: it has ended");
    }
    // Whoever logs in by another way is not whom the proxy names, and stays until somebody else sits there.
    for (before, stays, ends) in [(None, &[][..], &["S1"][..]), (Some("S1"), &["S1"], &["S2"])] {
        let token = ggrade::service::identity::new_token();
        let session = TeacherSession { proxied_name: before.map(str::to_owned), ..TeacherSession::default() };
        let hash = ggrade::service::identity::token_hash(&token);
        bench.state.store.open_session(&hash, &session, 0, i64::MAX).await.expect("a session");
        let mut browser = Browser(vec!["other=1".to_owned(), format!("ggrade_teacher={token}")]);
        assert!(open(&mut browser, stays).await && !open(&mut browser, ends).await && !open(&mut browser, stays).await);
    }
    bench.finish().await;
}

async fn nobody_else_is_believed(database: Database) {
    let bench = bench(database, Some("X-Remote-User")).await;
    for said in [
        // Another machine.
        ("192.0.2.2", &["S1"][..]),
        ("127.0.0.1", &["S1"]),
        // The proxy left what the client wrote.
        (PROXY, &["S1", "S2"]),
        (PROXY, &[""]),
        (PROXY, &["S1, S2"]),
        (PROXY, &["../S1"]),
    ] {
        assert!(Browser::default().known_as(&bench, said).await.is_empty(), "{said:?}");
    }
    add_staff(&bench.state, "prof", "P", StaffRole::Administrator).await.expect("an account");
    let refused = Browser::default().send(&bench, "GET", "/teacher/login", ("192.0.2.2", &["prof"])).await;
    assert_eq!(refused.status, StatusCode::OK, "the form");
    bench.finish().await;
}

async fn without_a_header_in_the_configuration_nobody_is(database: Database) {
    let bench = bench(database, None).await;
    assert!(Browser::default().known_as(&bench, (PROXY, &["S1"])).await.is_empty());
    bench.finish().await;
}
