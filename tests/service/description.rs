//! The description of the API: it is OpenAPI, names every route, and has a page.

use crate::bench::Bench;
use crate::cluster::Database;
use axum::http::StatusCode;
use serde_json::Value;

#[tokio::test]
async fn the_description_names_every_route_and_is_served_with_a_page() {
    let bench = Bench::new(Database::sqlite()).await;
    let document: Value = bench.get("/api/v1/openapi.json").await.json();
    let version = document["openapi"].as_str().expect("a version");
    assert!(version.starts_with("3.1"), "{version}");
    let paths: Vec<&String> = document["paths"].as_object().expect("paths").keys().collect();
    for path in ["/api/v1/submissions", "/api/v1/submissions/{id}", "/healthz", "/metrics"] {
        assert!(paths.contains(&&path.to_owned()), "{path} is not among {paths:?}");
    }
    let page = bench.get("/api/docs/").await;
    assert_eq!(page.status, StatusCode::OK);
    let text = String::from_utf8_lossy(&page.body);
    // The page's policy allows no script in the page itself.
    let page = scraper::Html::parse_document(&text);
    for script in page.select(&scraper::Selector::parse("script").expect("a selector")) {
        assert!(script.value().attr("src").is_some(), "a script without a file: {text}");
    }
    bench.finish().await;
}

/// Every object below a value, with its JSON pointer.
fn objects(pointer: String, value: &Value) -> Vec<(String, &serde_json::Map<String, Value>)> {
    match value {
        Value::Object(map) => {
            let below = map.iter().flat_map(|(key, value)| {
                objects(format!("{pointer}/{}", key.replace('~', "~0").replace('/', "~1")), value)
            });
            std::iter::once((pointer.clone(), map)).chain(below).collect()
        }
        Value::Array(items) => {
            items.iter().enumerate().flat_map(|(index, item)| objects(format!("{pointer}/{index}"), item)).collect()
        }
        _ => Vec::new(),
    }
}

#[tokio::test]
async fn the_description_is_openapi() {
    let bench = Bench::new(Database::sqlite()).await;
    let document: Value = bench.get("/api/v1/openapi.json").await.json();
    // The specification's own schema; it leaves the schemas in a document to JSON Schema's.
    let schema = serde_json::from_str(include_str!("../schemas/openapi-3.1.json")).expect("JSON");
    let validator = jsonschema::validator_for(&schema).expect("a schema");
    let wrong: Vec<String> =
        validator.iter_errors(&document).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let all = objects(String::new(), &document);
    let schemas = all.iter().filter(|(pointer, _)| {
        pointer.starts_with("/components/schemas/") && pointer.matches('/').count() == 3 || pointer.ends_with("/schema")
    });
    let mut count = 0;
    for (pointer, schema) in schemas {
        let schema = Value::Object((*schema).clone());
        let checked = jsonschema::draft202012::meta::validate(&schema);
        assert!(checked.is_ok(), "{pointer}: {checked:?}");
        count += 1;
    }
    assert!(count > 30, "{count} schemas");

    // What the schema cannot say: names that are used once, and references that lead somewhere.
    let mut operations: Vec<&str> = all.iter().filter_map(|(_, object)| object.get("operationId")?.as_str()).collect();
    let methods = ["get", "put", "post", "delete", "patch"];
    let paths = document["paths"].as_object().expect("paths");
    let described: usize =
        paths.values().map(|path| methods.iter().filter(|method| path.get(**method).is_some()).count()).sum();
    assert_eq!(operations.len(), described, "every operation has an id");
    operations.sort_unstable();
    operations.dedup();
    assert_eq!(operations.len(), described, "an operationId is there twice: {operations:?}");
    let references: Vec<&str> = all.iter().filter_map(|(_, object)| object.get("$ref")?.as_str()).collect();
    assert!(!references.is_empty());
    for reference in references {
        let pointer = reference.strip_prefix('#').expect("a reference into the document");
        assert!(document.pointer(pointer).is_some(), "{reference} leads nowhere");
    }
    // Parameters in the address are those of the path; tags and schemes are declared.
    for (path, item) in paths {
        for (method, operation) in item.as_object().expect("operations") {
            let parameters = operation["parameters"].as_array().cloned().unwrap_or_default();
            let mut named: Vec<_> = parameters
                .iter()
                .filter(|parameter| parameter["in"] == "path")
                .map(|parameter| format!("{{{}}}", parameter["name"].as_str().expect("a name")))
                .collect();
            let mut used: Vec<_> = path.split('/').filter(|part| part.starts_with('{')).map(str::to_owned).collect();
            named.sort();
            used.sort();
            assert_eq!(named, used, "{method} {path}");
            for tag in operation["tags"].as_array().expect("tags") {
                assert!(document["tags"].as_array().expect("tags").iter().any(|known| known["name"] == *tag), "{tag}");
            }
            for scheme in operation["security"].as_array().into_iter().flatten().flat_map(|s| s.as_object()) {
                let known = &document["components"]["securitySchemes"];
                assert!(scheme.keys().all(|name| known.get(name).is_some()), "{method} {path}: {scheme:?}");
            }
        }
    }
    bench.finish().await;
}
