//! The student's page over HTTP: deadlines, receipts, the pictures of single terms.

use crate::bench::{Bench, Fake, Reply, config};
use crate::cluster::Database;
use crate::{on_both, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use std::sync::Arc;
use std::time::Duration;

on_both!(after_the_deadline_what_is_typed_is_practice, a_receipt_says_what_came, pages_show_the_terms_one_by_one);

/// A browser that has opened the page.
struct Visit {
    cookie: String,
    csrf: String,
}

fn text(reply: &Reply) -> String {
    String::from_utf8(reply.body.clone()).expect("text")
}

async fn get(bench: &Bench, cookie: &str, address: &str) -> Reply {
    let request = Request::get(address).header(header::COOKIE, cookie).header(header::ACCEPT_LANGUAGE, "en");
    bench.send(request.body(Body::empty()).expect("a request")).await
}

async fn visit(bench: &Bench) -> Visit {
    let reply = get(bench, "", "/").await;
    let cookie = reply.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    let page = text(&reply);
    let (_, rest) = page.split_once("name=\"csrf\" value=\"").expect("a token");
    Visit { cookie, csrf: rest.split('"').next().expect("a value").to_owned() }
}

impl Visit {
    async fn page(&self, bench: &Bench) -> String {
        text(&get(bench, &self.cookie, "/a/ggsample06").await)
    }

    /// Sends the form as the page's script does.
    async fn send(&self, bench: &Bench, path: &str, shader: &str) -> Reply {
        let field = |name: &str, value: &str| {
            format!("--limit\r\nContent-Disposition: form-data; name=\"{name}\"\r\n\r\n{value}\r\n")
        };
        let body = field("csrf", &self.csrf) + &field("text", shader) + "--limit--\r\n";
        let request = Request::post(path)
            .header(header::COOKIE, &self.cookie)
            .header(header::ACCEPT, "text/html")
            .header(header::ACCEPT_LANGUAGE, "en")
            .header(header::CONTENT_TYPE, "multipart/form-data; boundary=limit")
            .header("x-part", "1");
        bench.send(request.body(Body::from(body)).expect("a request")).await
    }

    async fn draft(&self, bench: &Bench) -> StatusCode {
        self.send(bench, "/a/ggsample06/draft", "void main() {}").await.status
    }
}

async fn after_the_deadline_what_is_typed_is_practice(database: Database) {
    let clock = Clock::fixed(1_000_000);
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), clock.clone()).await;
    let store = &bench.state.store;
    let mut settings = store.assignment("ggsample06").await.expect("settings");
    assert!(settings.practice, "unless a teacher says otherwise");
    settings.closes_at = Some(1_020_000);
    settings.attempts = Some(3);
    store.set_assignment(&settings).await.expect("set");
    let visit = visit(&bench).await;

    // Attempts are counted: nothing is graded before the end but what is handed in.
    let page = visit.page(&bench).await;
    assert!(page.contains("20 seconds left") && page.contains("data-until=\"1020000\""), "{page}");
    assert!(page.contains(">Hand in<") && !page.contains("data-draft="), "{page}");
    assert_eq!(visit.draft(&bench).await, StatusCode::FORBIDDEN);
    settings.attempts = None;
    store.set_assignment(&settings).await.expect("set");
    assert!(visit.page(&bench).await.contains("Hand in when you are content."));

    settings.attempts = Some(3);
    store.set_assignment(&settings).await.expect("set");
    clock.advance(Duration::from_secs(30));
    let page = visit.page(&bench).await;
    assert!(page.contains("Closed since") && page.contains("Handing in is over. What you type is still graded"));
    assert!(!page.contains(">Hand in<") && !page.contains("when you are content"), "{page}");
    assert!(page.contains("data-draft=") && page.contains("practice, not handed in"), "{page}");
    assert_eq!(visit.draft(&bench).await, StatusCode::OK);
    let reply = visit.send(&bench, "/a/ggsample06", "void main() {}").await;
    assert_eq!(reply.status, StatusCode::FORBIDDEN);
    assert!(text(&reply).contains("Handing in is over."));

    settings.practice = false;
    store.set_assignment(&settings).await.expect("set");
    assert!(!store.assignment("ggsample06").await.expect("settings").practice);
    let page = visit.page(&bench).await;
    assert!(!page.contains("data-draft=") && !page.contains("is still graded"), "{page}");
    assert_eq!(visit.draft(&bench).await, StatusCode::FORBIDDEN);
    bench.finish().await;
}

async fn a_receipt_says_what_came(database: Database) {
    // 2026-11-21T13:05:09Z.
    let clock = Clock::fixed(1_795_266_309_000);
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), clock.clone()).await;
    let mut settings = bench.state.store.assignment("ggsample06").await.expect("settings");
    settings.attempts = Some(2);
    bench.state.store.set_assignment(&settings).await.expect("set");
    let visit = visit(&bench).await;
    // printf 'void main() {}' | sha256sum
    let digest = "340c8ac2b0e649293267ee27410a6ec6904b9e6244717604f851f1191dab59c5";
    let mut links = Vec::new();
    for (attempt, time) in [("1 of 2", "2026-11-21T13:05:09Z"), ("2 of 2", "2026-11-21T14:05:09Z")] {
        let reply = visit.send(&bench, "/a/ggsample06", "void main() {}").await;
        assert_eq!(reply.status, StatusCode::OK);
        let receipt = text(&reply);
        let (receipt, report) = receipt.split_once("</section>").expect("a receipt and a report");
        for said in ["Handed in", time, ":05:09 ", "ggsample06.vert", digest, attempt] {
            assert!(receipt.contains(said), "{said}: {receipt}");
        }
        assert!(receipt.contains("0 / 100") && report.contains("<article class=\"report\""), "{report}");
        let (_, link) = receipt.split_once("class=\"permalink\" href=\"").expect("a link");
        links.push(link.split('"').next().expect("an address").to_owned());
        clock.advance(Duration::from_mins(60));
    }
    assert_ne!(links[0], links[1]);
    // The page of the report has the same receipt, however late it is looked at.
    let page = text(&get(&bench, "", &links[0]).await);
    assert!(page.contains("1 of 2") && page.contains("datetime=\"2026-11-21T13:05:09Z\""), "{page}");
    assert_eq!(text(&get(&bench, "", &format!("{}/receipt", links[1])).await).matches("2 of 2").count(), 1);
    assert_eq!(visit.send(&bench, "/a/ggsample06", "void main() {}").await.status, StatusCode::FORBIDDEN);
    bench.finish().await;
}

async fn pages_show_the_terms_one_by_one(database: Database) {
    let bench = Bench::new(database).await;
    let picture = async |id: &str, name: &str| {
        let reply = bench.get(&format!("/r/{id}/terms/{name}.png")).await;
        (reply.status == StatusCode::OK).then_some(reply.body)
    };
    let id = bench.hand_in("", sample("wrong/specular-missing--ambient-and-diffuse.vert")).await.id();
    let page = text(&get(&bench, "", &format!("/r/{id}")).await);
    for term in ["ambient", "diffuse", "specular"] {
        for whose in ["yours", "expected"] {
            assert!(page.contains(&format!("src=\"/r/{id}/terms/{term}-{whose}.png?of=")), "{term} {whose}");
        }
        let (yours, expected) =
            (picture(&id, &format!("{term}-yours")).await, picture(&id, &format!("{term}-expected")).await);
        let image = image::load_from_memory(&expected.clone().expect("a picture")).expect("a PNG");
        assert_eq!((image.width(), image.height()), (640, 480));
        assert_eq!(yours == expected, term != "specular", "{term}");
    }
    assert_eq!(picture(&id, "shape-yours").await, None);
    assert_eq!(picture(&id, "diffuse").await, None);
    // A file that was not drawn has none.
    let id = bench.hand_in("", sample("rejected/undeclared-capital-max.vert")).await.id();
    assert_eq!(picture(&id, "ambient-expected").await, None);
    assert!(!text(&get(&bench, "", &format!("/r/{id}")).await).contains("/terms/"));
    bench.finish().await;
}
