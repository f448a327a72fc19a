//! Lecturers and assistants log in as themselves, may do what their role may, and are in the log.

use crate::bench::{Bench, Fake, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::identity::hash_password;
use scraper::{Html, Selector};
use std::sync::Arc;
use std::time::Duration;

on_both!(
    the_first_administrator_comes_in_by_the_password_of_the_service,
    each_role_does_what_it_may_and_is_in_the_log,
    accounts_are_closed_and_links_end,
);

const PASSWORD: &str = "the old shared password";
pub const OWN: &str = "my own long password";

/// A browser with its cookies.
pub struct Browser<'a> {
    bench: &'a Bench,
    cookies: Vec<(String, String)>,
    csrf: String,
}

impl<'a> Browser<'a> {
    pub fn new(bench: &'a Bench) -> Self {
        Self { bench, cookies: Vec::new(), csrf: String::new() }
    }

    /// Its cookies, as it sends them.
    pub fn cookie_line(&self) -> String {
        let pairs = self.cookies.iter().map(|(name, value)| format!("{name}={value}"));
        pairs.collect::<Vec<_>>().join("; ")
    }

    /// The token of the forms of the page that it opened last.
    pub fn csrf(&self) -> &str {
        &self.csrf
    }

    async fn send(&mut self, method: &str, address: &str, fields: &str) -> Reply {
        let mut request = Request::builder().method(method).uri(address).header(header::ACCEPT, "text/html");
        request = request.header(header::ACCEPT_LANGUAGE, "en").header(header::COOKIE, self.cookie_line());
        let body = if method == "GET" { String::new() } else { format!("csrf={}&{fields}", self.csrf) };
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let reply = self.bench.send(request.body(Body::from(body)).expect("a request")).await;
        for cookie in reply.headers.get_all(header::SET_COOKIE) {
            let pair = cookie.to_str().expect("text").split(';').next().expect("a cookie");
            let (name, value) = pair.split_once('=').expect("a pair");
            self.cookies.retain(|(known, _)| known != name);
            self.cookies.push((name.to_owned(), value.to_owned()));
        }
        if method == "GET" && reply.status == StatusCode::OK {
            let html = Html::parse_document(&reply.text());
            let field = Selector::parse("[name=csrf]").expect("a selector");
            if let Some(token) = html.select(&field).next().and_then(|field| field.value().attr("value")) {
                self.csrf = token.to_owned();
            }
        }
        reply
    }

    pub async fn get(&mut self, address: &str) -> Reply {
        self.send("GET", address, "").await
    }

    /// Opens a page, and sends one of its forms.
    pub async fn form(&mut self, page: &str, action: &str, fields: &str) -> Reply {
        self.get(page).await;
        self.send("POST", action, fields).await
    }

    pub async fn login(&mut self, login: &str, password: &str) -> Reply {
        let fields = format!("login={login}&password={}", password.replace(' ', "+"));
        self.form("/teacher/login", "/teacher/login", &fields).await
    }

    /// Lets somebody in, who chooses a password in a browser of their own.
    pub async fn let_in(&mut self, login: &str, role: &str) -> Browser<'a> {
        let page = self.form("/teacher/people", "/teacher/people", &format!("login={login}&name=N&role={role}")).await;
        assert_eq!(page.status, StatusCode::OK, "{}", page.text());
        let link = page.all(".link code")[0].clone();
        let address = &link[link.find("/teacher/welcome/").expect("a link")..];
        let mut browser = Browser::new(self.bench);
        let chosen = browser.form(address, address, &format!("password={}", OWN.replace(' ', "+"))).await;
        assert_eq!((chosen.status, chosen.header("location")), (StatusCode::SEE_OTHER, "/teacher"));
        browser
    }
}

pub async fn bench(database: Database, clock: Clock) -> Bench {
    let hash = hash_password(PASSWORD).expect("a hash");
    let config = Config { teacher_password_hash: Some(hash), ..config() };
    Bench::with(database, config, Arc::new(Fake(|| Ok(()))), clock).await
}

/// The first administrator, let in by the password of the service.
pub async fn administrator(bench: &Bench) -> Browser<'_> {
    let mut browser = Browser::new(bench);
    assert_eq!(browser.login("", PASSWORD).await.status, StatusCode::SEE_OTHER);
    let next = browser.form("/teacher/people", "/teacher/people", "login=Prof@Example.ac.jp&name=P&role=administrator");
    let next = next.await;
    let address = next.header("location").to_owned();
    assert!(address.starts_with("/teacher/welcome/"), "{next:?}");
    let short = browser.form(&address, &address, "password=short").await;
    assert_eq!(short.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(short.all("[role=alert]")[0].contains("at least 10"));
    let chosen = browser.form(&address, &address, &format!("password={}", OWN.replace(' ', "+"))).await;
    assert_eq!((chosen.status, chosen.header("location")), (StatusCode::SEE_OTHER, "/teacher"));
    assert_eq!(browser.get(&address).await.status, StatusCode::NOT_FOUND, "a link works once");
    browser
}

async fn the_first_administrator_comes_in_by_the_password_of_the_service(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = bench(database, clock.clone()).await;
    // Two come in by what the service has, and are told what to do.
    let (mut other, mut token) = (Browser::new(&bench), Browser::new(&bench));
    assert_eq!(other.login("", PASSWORD).await.status, StatusCode::SEE_OTHER);
    assert_eq!(token.login("", TEACHER).await.status, StatusCode::SEE_OTHER);
    let page = other.get("/teacher").await;
    assert!(page.all(".shared-login")[0].contains("Make an account for yourself"), "{}", page.text());
    let refused = other.form("/teacher/people", "/teacher/people", "login=a&role=lecturer").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(refused.all("[role=alert]")[0].contains("first account is an administrator's"));

    clock.advance(Duration::from_secs(600));
    let mut first = administrator(&bench).await;
    let page = first.get("/teacher").await;
    assert!(page.all(".shared-login").is_empty());
    assert_eq!(page.all("nav .who"), ["Logged in: P"]);
    // From now on everybody is themselves: secrets of the service open no page, and those that were open are closed.
    for browser in [&mut other, &mut token] {
        assert_eq!(browser.get("/teacher").await.header("location"), "/teacher/login");
    }
    clock.advance(Duration::from_secs(600));
    for secret in [PASSWORD, TEACHER] {
        assert_eq!(other.login("", secret).await.status, StatusCode::FORBIDDEN, "{secret}");
    }
    assert_eq!(other.login("nobody", OWN).await.status, StatusCode::FORBIDDEN);
    assert_eq!(other.login("prof@example.ac.jp", PASSWORD).await.status, StatusCode::FORBIDDEN);
    assert_eq!(other.login(" PROF@example.ac.jp", OWN).await.status, StatusCode::SEE_OTHER);
    // A program keeps its token.
    let request = Request::get("/teacher").header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    assert_eq!(bench.send(request.body(Body::empty()).expect("a request")).await.status, StatusCode::OK);
    bench.finish().await;
}

async fn each_role_does_what_it_may_and_is_in_the_log(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let handed_in = bench.hand_in("", "x").await.id();
    let mut first = administrator(&bench).await;
    let mut lecturer = first.let_in("hanako", "lecturer").await;
    let mut assistant = lecturer.let_in("taro", "assistant").await;
    // A lecturer lets assistants in, and nobody else.
    let refused = lecturer.form("/teacher/people", "/teacher/people", "login=x&role=lecturer").await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN);

    // An assistant sees the class and its files, and changes nothing.
    for page in ["/teacher", "/teacher/batches", "/api/v1/class/files/csv"] {
        assert_eq!(assistant.get(page).await.status, StatusCode::OK, "{page}");
    }
    let links = assistant.get("/teacher").await.all(".top nav a");
    let expected = [
        "Class",
        "Requests",
        "Insights",
        "Likeness",
        "Archives",
        "Gradebook",
        "All courses",
        "Student's page",
        "Tokens",
    ];
    assert_eq!(links, expected);
    let delete = format!("/teacher/delete?submission={handed_in}");
    for page in
        ["/teacher/settings", "/teacher/people", "/teacher/codes", "/teacher/codes/file", "/teacher/log", &delete]
    {
        let refused = assistant.get(page).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{page}");
    }
    assistant.get("/teacher").await;
    let forms = [
        ("/teacher/settings", "attempts=1&hints=none&audience=open".to_owned()),
        ("/teacher/course", "zone=UTC&language=en".to_owned()),
        ("/teacher/settings/link", String::new()),
        ("/teacher/roster", String::new()),
        ("/teacher/batches", String::new()),
        ("/teacher/regradings", String::new()),
        ("/teacher/delete", format!("submission={handed_in}")),
        ("/teacher/people", "login=friend&role=assistant".to_owned()),
        ("/teacher/codes", "student=x".to_owned()),
    ];
    for (address, fields) in &forms {
        let refused = assistant.send("POST", address, fields).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{address}");
    }
    let delete = format!("/api/v1/submissions/{handed_in}");
    let request = Request::delete(&delete).header(header::COOKIE, assistant.cookie_line());
    let request = request.header("x-ggrade-csrf", assistant.csrf());
    let refused = bench.send(request.body(Body::empty()).expect("a request")).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::FORBIDDEN, "role"));
    assert_eq!(bench.get(&format!("/r/{handed_in}")).await.status, StatusCode::OK, "nothing is gone");

    // What a lecturer does is in the log, by whom and what changed.
    let saved =
        lecturer.form("/teacher/settings", "/teacher/settings", "attempts=3&hints=full&audience=open&practice=on");
    assert_eq!(saved.await.status, StatusCode::SEE_OTHER);
    assert_eq!(
        lecturer.form("/teacher/settings", "/teacher/delete", &format!("submission={handed_in}")).await.status,
        303
    );
    let log = lecturer.get("/teacher/log").await;
    let rows = log.all(".people tbody tr");
    assert!(rows[0].contains("hanako") && rows[0].contains("Deleted") && rows[0].contains("submission: 1"), "{rows:?}");
    assert!(rows[1].contains("hanako") && rows[1].contains("attempts: – → 3"), "{rows:?}");
    assert!(rows.iter().any(|row| row.contains("taro assistant") && row.contains("Let somebody in")), "{rows:?}");
    assert!(rows.iter().any(|row| row.contains("by a secret of the service")), "{rows:?}");
    // What was refused did not happen, and is not in it.
    assert!(!rows.iter().any(|row| row.contains("friend") || row.contains("hints: full → none")), "{rows:?}");
    // A program's acts are there as well, with the student whom they were about.
    let by_token = Request::post("/api/v1/submissions?student=s77").header(header::CONTENT_TYPE, "text/plain");
    let by_token = by_token.header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    assert_eq!(bench.send(by_token.body(Body::from("y")).expect("a request")).await.status, StatusCode::CREATED);
    let rows = lecturer.get("/teacher/log").await.all(".people tbody tr");
    assert!(rows[0].contains("a program, by a token") && rows[0].contains("S77"), "{rows:?}");
    // Nothing of a student who is deleted stays in it.
    let gone = Request::delete("/api/v1/students/s77").header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    assert_eq!(bench.send(gone.body(Body::empty()).expect("a request")).await.status, StatusCode::OK);
    assert!(!lecturer.get("/teacher/log").await.text().contains("S77"));
    bench.finish().await;
}

async fn accounts_are_closed_and_links_end(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = bench(database, clock.clone()).await;
    let mut first = administrator(&bench).await;
    let mut lecturer = first.let_in("hanako", "lecturer").await;
    // Logging in is slow for who guesses, and these are many in no time.
    let minute = Duration::from_secs(60);
    clock.advance(minute);
    let staff = bench.state.store.staff().await.expect("staff");
    let id = |login: &str| staff.iter().find(|member| member.login == login).expect("a member").id.clone();
    let change = |login: &str| format!("/teacher/people/{}", id(login));
    // The last administrator stays one.
    for wish in ["change=close", "change=assistant"] {
        let refused = first.form("/teacher/people", &change("prof@example.ac.jp"), wish).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY, "{wish}");
        assert!(refused.all("[role=alert]")[0].contains("only administrator"));
    }
    // A lecturer changes no lecturer, and nothing of an administrator's.
    for login in ["prof@example.ac.jp", "hanako"] {
        let refused = lecturer.form("/teacher/people", &change(login), "change=link").await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{login}");
    }
    assert_eq!(first.form("/teacher/people", &change("hanako"), "change=close").await.status, StatusCode::SEE_OTHER);
    assert_eq!(lecturer.get("/teacher").await.header("location"), "/teacher/login", "the session ends at once");
    assert_eq!(lecturer.login("hanako", OWN).await.status, StatusCode::FORBIDDEN);
    assert_eq!(first.form("/teacher/people", &change("hanako"), "change=open").await.status, StatusCode::SEE_OTHER);
    assert_eq!(lecturer.login("hanako", OWN).await.status, StatusCode::SEE_OTHER);
    clock.advance(minute);
    // A forgotten password: a new link, which is good for a week; a newer one ends it.
    let link = async |browser: &mut Browser<'_>| {
        let page = browser.form("/teacher/people", &change("hanako"), "change=link").await;
        let link = page.all(".link code")[0].clone();
        link[link.find("/teacher/welcome/").expect("a link")..].to_owned()
    };
    let old = link(&mut first).await;
    let new = link(&mut first).await;
    assert_eq!(first.get(&old).await.status, StatusCode::NOT_FOUND);
    assert_eq!(first.get(&new).await.status, StatusCode::OK);
    clock.advance(Duration::from_secs(7 * 24 * 3600));
    assert_eq!(first.get(&new).await.status, StatusCode::NOT_FOUND);
    // A login is one person's.
    assert_eq!(first.login("prof@example.ac.jp", OWN).await.status, StatusCode::SEE_OTHER);
    let taken = first.form("/teacher/people", "/teacher/people", "login=HANAKO&role=assistant").await;
    assert_eq!(taken.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(taken.all("[role=alert]")[0].contains("an account hanako already"), "{:?}", taken.all("[role=alert]"));
    bench.finish().await;
}
