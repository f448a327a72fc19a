//! What pages load besides themselves, over HTTP: compressed for who offers to take that, and the same for who does not.

use crate::cluster::Database;
use crate::process::Server;
use reqwest::{Client, Response, header};
use std::io::Read;

async fn get(client: &Client, address: &str, accepted: &str) -> Response {
    let request = client.get(address).header(header::ACCEPT_ENCODING, accepted);
    request.send().await.expect("an answer")
}

fn header(response: &Response, name: header::HeaderName) -> &str {
    response.headers().get(name).map(|value| value.to_str().expect("text")).unwrap_or_default()
}

#[tokio::test]
async fn styles_and_scripts_come_compressed_and_pictures_as_they_are() {
    let database = Database::sqlite();
    let server = Server::start(&database);
    let client = Client::new();
    let page = client.get(&server.address).send().await.expect("an answer");
    let status = page.status();
    let page = page.text().await.expect("text");
    assert!(status.is_success(), "{status} {page} {}", server.said.lock().expect("a lock"));
    let html = scraper::Html::parse_document(&page);
    let selector = scraper::Selector::parse("script[src], link[href]").expect("a selector");
    let of_page =
        html.select(&selector).filter_map(|element| element.value().attr("src").or(element.value().attr("href")));
    let mut files: Vec<String> = of_page.filter(|file| file.starts_with("/assets/")).map(str::to_owned).collect();
    files.extend(["/api/docs/swagger-ui-bundle.js".to_owned(), "/api/v1/openapi.json".to_owned()]);
    drop(html);
    assert!(files.len() > 4, "{files:?}");
    let (mut plain, mut compressed) = (0, 0);
    for file in &files {
        let address = format!("{}{file}", server.address);
        let as_it_is = get(&client, &address, "identity").await;
        assert_eq!(header(&as_it_is, header::CONTENT_ENCODING), "", "{file}");
        let as_it_is = as_it_is.bytes().await.expect("a file");
        let small = get(&client, &address, "br;q=0.5, gzip, deflate").await;
        assert_eq!(header(&small, header::CONTENT_ENCODING), "gzip", "{file}");
        assert!(header(&small, header::VARY).to_ascii_lowercase().contains("accept-encoding"), "{file}");
        if file.starts_with("/assets/") {
            assert!(header(&small, header::CACHE_CONTROL).contains("immutable"), "{file}");
        }
        let small = small.bytes().await.expect("a file");
        let mut unpacked = Vec::new();
        flate2::read::GzDecoder::new(&small[..]).read_to_end(&mut unpacked).expect("gzip");
        assert_eq!(unpacked, as_it_is, "{file}");
        plain += as_it_is.len();
        compressed += small.len();
    }
    assert!(compressed * 5 < plain * 2, "{plain} bytes are {compressed} compressed");
    // A PNG is compressed as it is; a page has secrets beside what others write.
    let sheet = format!("{}{}", server.address, ggrade_sheet(&page));
    for address in [sheet.as_str(), server.address.as_str()] {
        let response = get(&client, address, "gzip").await;
        assert!(response.status().is_success(), "{address}");
        assert_eq!(header(&response, header::CONTENT_ENCODING), "", "{address}");
    }
}

/// The sheet of the right pictures that a page shows.
fn ggrade_sheet(page: &str) -> &str {
    let start = page.find("/assets/expected-").expect("the right pictures");
    page[start..].split(['"', '\'', ')']).next().unwrap_or_default()
}
