//! Nobody hands in as somebody else: personal codes bind browsers.

use crate::bench::{Bench, Fake, Reply, config};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{file, form, get};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use ggrade::service::identity::{course_secret, personal_code};
use ggrade::service::store::Proof;
use scraper::{Html, Selector};
use std::sync::{Arc, Mutex};

on_both!(
    whoever_sits_there_can_leave_from_every_page,
    with_a_roster_a_number_needs_its_code,
    without_a_roster_the_first_browser_has_the_number,
    browsers_of_old_must_prove_whose_they_are,
);

/// A browser on the page of the course link.
pub struct Guest {
    pub address: String,
    cookie: Mutex<String>,
}

impl Guest {
    pub async fn new(bench: &Bench) -> Self {
        let address = format!("/join/{}", course_secret(&bench.state).await.expect("a secret"));
        let page = bench.get(&address).await;
        let guest = Self { address, cookie: Mutex::default() };
        guest.keep(&page);
        guest
    }

    pub fn cookie(&self) -> String {
        self.cookie.lock().expect("a cookie").clone()
    }

    /// Keeps the cookie that an answer sets, as a browser does.
    fn keep(&self, reply: &Reply) {
        if let Some(cookie) = reply.header("set-cookie").split(';').next().filter(|cookie| !cookie.is_empty()) {
            *self.cookie.lock().expect("a cookie") = cookie.to_owned();
        }
    }

    pub fn request(&self, method: &str, address: &str) -> axum::http::request::Builder {
        let request = Request::builder().method(method).uri(address).header(header::COOKIE, self.cookie());
        request.header(header::ACCEPT_LANGUAGE, "en").header("sec-fetch-site", "same-origin")
    }

    /// The token of the forms on its pages.
    pub async fn csrf(&self, bench: &Bench) -> String {
        let html = Html::parse_document(&self.get(bench, &self.address).await.text());
        let field = Selector::parse("[name=csrf]").expect("a selector");
        let value = html.select(&field).next().and_then(|field| field.value().attr("value"));
        value.expect("a token").to_owned()
    }

    pub async fn join(&self, bench: &Bench, number: &str, code: &str) -> Reply {
        let csrf = self.csrf(bench).await;
        let request = self.request("POST", &self.address).header(header::ACCEPT, "text/html");
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let body = format!("csrf={csrf}&number={number}&code={code}");
        let reply = bench.send(request.body(Body::from(body)).expect("a request")).await;
        self.keep(&reply);
        reply
    }

    /// Leaves the browser, whose page is in a window or in a frame.
    async fn leave(&self, bench: &Bench, place: &str) -> Reply {
        let body = format!("csrf={}", self.csrf(bench).await);
        let request =
            self.request("POST", "/leave").header("sec-fetch-dest", place).header(header::ACCEPT, "text/html");
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let reply = bench.send(request.body(Body::from(body)).expect("a request")).await;
        self.keep(&reply);
        reply
    }

    pub async fn hand_in(&self, bench: &Bench, text: &'static str) -> Reply {
        let request = self.request("POST", "/api/v1/submissions").header(header::CONTENT_TYPE, "text/plain");
        bench.send(request.body(Body::from(text)).expect("a request")).await
    }

    pub async fn get(&self, bench: &Bench, address: &str) -> Reply {
        bench.send(self.request("GET", address).body(Body::empty()).expect("a request")).await
    }
}

async fn roster(bench: &Bench, csv: &str) {
    assert_eq!(file(bench, "/teacher/roster", "roster", "r.csv", csv.as_bytes()).await.status, StatusCode::SEE_OTHER);
}

async fn code_of(bench: &Bench, number: &str) -> String {
    let student = bench.state.store.student_by_number(number).await.expect("a store").expect("a student");
    personal_code(&bench.state, &student)
}

/// The numbers under which files stand in the class.
async fn class(bench: &Bench) -> Vec<String> {
    let rows = bench.state.store.class("ggsample06", None).await.expect("a class");
    rows.into_iter().filter_map(|row| row.number).collect()
}

async fn whoever_sits_there_can_leave_from_every_page(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    roster(&bench, "S1,A\n").await;
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let guest = Guest::new(&bench).await;
    guest.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    let report = guest.hand_in(&bench, "mine").await.id();
    for page in ["/".to_owned(), "/a/ggsample06".to_owned(), format!("/r/{report}"), "/privacy".to_owned()] {
        let shown = guest.get(&bench, &page).await;
        assert_eq!(shown.all(".top .who bdi"), ["S1"], "{page}");
        assert_eq!(shown.all(".top form[action='/leave'] button"), ["Not you? Leave this computer"], "{page}");
        let japanese = guest.get(&bench, &format!("{page}?lang=ja")).await;
        assert_eq!(japanese.all(".top form button"), ["あなたではない場合: この端末を離れる"], "{page}");
    }
    let left = guest.leave(&bench, "document").await;
    assert_eq!((left.status, left.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"));
    let desk = guest.get(&bench, "/a/ggsample06").await;
    assert!(desk.all(".top .who").is_empty() && desk.all(".attempts").is_empty(), "{desk:?}");
    // In a frame as well.
    guest.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    assert_eq!(guest.leave(&bench, "iframe").await.status, StatusCode::SEE_OTHER);
    assert!(guest.get(&bench, "/").await.all(".top .who").is_empty());
    bench.finish().await;
}

async fn with_a_roster_a_number_needs_its_code(database: Database) {
    let bench = Bench::new(database).await;
    roster(&bench, "S1,和田 花子\nS2,=cmd()\n").await;
    form(&bench, "/teacher/settings", "attempts=1&hints=full&audience=number").await;
    let (mine, theirs) = (Guest::new(&bench).await, Guest::new(&bench).await);
    let (code, of_another) = (code_of(&bench, "S1").await, code_of(&bench, "S2").await);
    assert_ne!(code, of_another);
    for (given, said) in [("", "needs its personal code"), (&*of_another, "not the personal code of S1")] {
        let refused = theirs.join(&bench, "S1", given).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN);
        assert!(refused.all("[role=alert]")[0].contains(said), "{:?}", refused.all("[role=alert]"));
        assert!(refused.text().contains("value=\"S1\""), "what was typed stays");
    }
    assert_eq!(theirs.hand_in(&bench, "x").await.problem(), "no-number");
    // Neither by the API, with all that the course link tells.
    let secret = course_secret(&bench.state).await.expect("a secret");
    let by_api = async |code: &str| bench.hand_in(&format!("?student=S1&course={secret}{code}"), "by a program").await;
    assert_eq!(by_api("").await.problem(), "code-needed");
    assert_eq!(by_api(&format!("&code={of_another}")).await.problem(), "wrong-code");

    // Whoever sat there before and noted the cookie is not them once they have proved who they are.
    let before = Guest { address: mine.address.clone(), cookie: Mutex::new(mine.cookie()) };
    // A link of their own fills the form in; it is they who send it.
    let filled = mine.get(&bench, &format!("{}?number=S1&code={code}", mine.address)).await;
    assert!(filled.text().contains(&format!("value=\"{code}\"")) && filled.text().contains("value=\"S1\""));
    let joined = mine.join(&bench, "s1", &code.to_lowercase().replace('-', "+")).await;
    assert_eq!((joined.status, joined.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"));
    assert!(mine.get(&bench, &mine.address).await.all(".personal-code").is_empty(), "a code of paper stays there");
    assert_eq!(mine.hand_in(&bench, "mine").await.status, StatusCode::CREATED);
    assert_eq!(class(&bench).await, ["S1"]);
    assert_eq!(before.hand_in(&bench, "in their name").await.problem(), "no-number");
    // The attempt is used up, by them and by nobody else.
    assert_eq!(by_api(&format!("&code={code}")).await.problem(), "attempts");

    // A lost code is replaced: what the old one bound is theirs no more.
    let page = get(&bench, "/teacher/codes").await;
    assert_eq!(page.all(".people tbody code"), [code.clone(), of_another]);
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let renewed = form(&bench, "/teacher/codes", &format!("student={}", student.id)).await;
    assert_eq!(renewed.header("location"), "/teacher/codes?renewed=S1");
    let new = code_of(&bench, "S1").await;
    assert_ne!(new, code);
    assert_eq!(mine.hand_in(&bench, "mine again").await.problem(), "code-needed");
    let desk = mine.get(&bench, "/").await;
    assert!(desk.all("[role=alert]")[0].contains("S1 needs its personal code"), "{:?}", desk.all("[role=alert]"));
    assert_eq!(theirs.join(&bench, "S1", &code).await.status, StatusCode::FORBIDDEN);
    assert_eq!(mine.join(&bench, "S1", &new).await.status, StatusCode::SEE_OTHER);

    let csv = get(&bench, "/teacher/codes/file").await.text();
    let lines: Vec<&str> = csv.trim_start_matches('\u{feff}').lines().collect();
    assert_eq!(lines[0], "Student number,Name,Personal code,Link");
    assert!(
        lines[1].starts_with(&format!("S1,和田 花子,{new},http")) && lines[1].contains("?number=S1&code="),
        "{csv}"
    );
    assert!(lines[2].starts_with("S2,'=cmd(),"), "no cell is a formula: {csv}");
    bench.finish().await;
}

async fn without_a_roster_the_first_browser_has_the_number(database: Database) {
    let bench = Bench::new(database).await;
    let (mine, theirs) = (Guest::new(&bench).await, Guest::new(&bench).await);
    let joined = mine.join(&bench, "s1", "").await;
    assert_eq!(joined.header("location"), mine.address, "to the page that shows the code");
    let shown = mine.get(&bench, &mine.address).await.all(".personal-code");
    assert_eq!(shown, [code_of(&bench, "S1").await]);
    assert_eq!(theirs.join(&bench, "s1", "").await.status, StatusCode::FORBIDDEN);
    assert_eq!(theirs.hand_in(&bench, "under no number").await.status, StatusCode::CREATED);
    assert_eq!(class(&bench).await, [] as [String; 0]);
    assert_eq!(theirs.join(&bench, "s1", &shown[0]).await.status, StatusCode::SEE_OTHER);
    // Whoever came first by a wrong number has it until the teacher takes it from them.
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    form(&bench, "/teacher/codes", &format!("student={}", student.id)).await;
    assert_eq!(mine.hand_in(&bench, "x").await.problem(), "code-needed");
    // The roster knows them: being first proves nothing any more.
    assert_eq!(mine.join(&bench, "s1", "").await.status, StatusCode::SEE_OTHER);
    roster(&bench, "S1,和田 花子\n").await;
    assert_eq!(mine.hand_in(&bench, "x").await.problem(), "code-needed");
    let code = code_of(&bench, "S1").await;
    assert_eq!(mine.join(&bench, "s1", &code).await.status, StatusCode::SEE_OTHER);
    assert_eq!(mine.hand_in(&bench, "x").await.status, StatusCode::CREATED);
    bench.finish().await;
}

async fn browsers_of_old_must_prove_whose_they_are(database: Database) {
    let bench = Bench::new(database).await;
    let (one, other) = (Guest::new(&bench).await, Guest::new(&bench).await);
    // Two browsers that race for one number: one of them gets it.
    let (first, second) = tokio::join!(one.join(&bench, "s1", ""), other.join(&bench, "s1", ""));
    let mut statuses = [first.status, second.status];
    statuses.sort();
    assert_eq!(statuses, [StatusCode::SEE_OTHER, StatusCode::FORBIDDEN]);
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let cookie = one.cookie();
    let token = cookie.split_once('=').expect("a cookie").1;
    let hash = ggrade::service::identity::token_hash(token);
    let owner = bench.state.store.owner_or_new(&hash, 0).await.expect("an owner");
    let bound = bench.state.store.bind_owner((&owner.id, &hash), &student, Proof::Code).await.expect("a store");
    assert!(bound.expect("bound").proves(&student));
    // Another generation, or another student, is not proved by it.
    bench.state.store.renew_code(&student.id).await.expect("a store");
    let renewed = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let owner = bench.state.store.owner(&hash).await.expect("a store").expect("an owner");
    assert!(owner.proves(&student) && !owner.proves(&renewed));
    bench.finish().await;
}
