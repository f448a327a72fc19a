//! The container image and the compose file: what they name is there, and what they start starts. No image is built here.

use super::repository;
use super::service::{Running, ready};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// An instruction of the Containerfile and its words, lines that go on joined.
fn instructions() -> Vec<(String, String)> {
    let text = fs::read_to_string(repository().join("deploy/container/Containerfile")).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect::<String>();
    let joined = lines.replace("\\\n", " ");
    let lines = joined.lines().filter(|line| !line.trim().is_empty());
    let pairs = lines.map(|line| line.split_once(' ').unwrap_or_else(|| panic!("{line}")));
    pairs.map(|(word, rest)| (word.to_owned(), rest.split_whitespace().collect::<Vec<_>>().join(" "))).collect()
}

/// What an instruction of the last stage says.
fn last(word: &str) -> String {
    let all = instructions();
    let stage = all.iter().rposition(|(word, _)| word == "FROM").unwrap();
    let found = all[stage..].iter().rev().find(|(found, _)| found == word);
    found.unwrap_or_else(|| panic!("no {word}")).1.clone()
}

fn words(json: &str) -> Vec<String> {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{error}: {json}"))
}

/// Holds the names of variables against what ggrade reads.
fn assert_read<'a>(names: impl Iterator<Item = &'a str>) {
    let known = serde_json::to_value(ggrade::service::Config::default()).unwrap();
    for name in names {
        let option = name.strip_prefix("GGRADE_").unwrap_or_else(|| panic!("{name} is no variable of ggrade's"));
        // The cache is not the service's alone, so it is no option of it (README.md).
        let is_known = option == "CACHE" || known.get(option.to_lowercase()).is_some();
        assert!(is_known, "ggrade reads no {name}");
    }
}

#[test]
fn the_image_is_made_of_what_is_there() {
    let all = instructions();
    let known =
        ["FROM", "RUN", "WORKDIR", "COPY", "ENV", "USER", "VOLUME", "EXPOSE", "HEALTHCHECK", "ENTRYPOINT", "CMD"];
    assert!(all.iter().all(|(word, _)| known.contains(&word.as_str())), "{all:?}");
    let bases = all.iter().filter(|(word, _)| word == "FROM");
    let stages: Vec<&str> = bases.filter_map(|(_, rest)| Some(rest.rsplit_once(" AS ")?.1)).collect();
    assert_eq!(stages, ["build"]);
    assert!(last("COPY").starts_with("--from=build /src/target/release/ggrade /usr/bin/ggrade"));
    // Nothing that is copied into the builder is missing, and nothing that the build reads is held back.
    let ignored = fs::read_to_string(repository().join(".dockerignore")).unwrap();
    let sent: Vec<&str> = ignored.lines().filter_map(|line| line.strip_prefix('!')).collect();
    for name in &sent {
        assert!(repository().join(name).exists(), "{name}");
    }
    for name in ["Cargo.toml", "Cargo.lock", "askama.toml", "src", "reference", "benches"] {
        assert!(sent.contains(&name), "{name} is not sent to the builder");
    }
    // What the Debian package depends on is in the image.
    let manifest: toml::Table = toml::from_str(&fs::read_to_string(repository().join("Cargo.toml")).unwrap()).unwrap();
    let package = &manifest["package"]["metadata"]["deb"];
    let packages = ["depends", "recommends"].map(|key| package[key].as_str().unwrap()).join(", ");
    let installed: String =
        all.iter().filter(|(_, rest)| rest.contains("apt-get install")).map(|(_, r)| r.clone()).collect();
    for name in packages.split(", ").filter(|name| *name != "$auto") {
        assert!(installed.split(' ').any(|word| word == name), "{name} is not installed");
    }
    // The user of the pods, who is not root, and the mark by which `ggrade doctor` knows the image.
    assert_eq!(last("USER"), "10001");
    assert!(
        fs::read_to_string(repository().join("deploy/kubernetes/class.yaml")).unwrap().contains("runAsUser: 10001")
    );
    assert!(last("RUN").contains("touch /usr/share/ggrade/image"));
}

#[test]
fn the_image_starts_the_service_and_checks_its_health() {
    let environment = last("ENV");
    let environment: Vec<(&str, &str)> = environment.split(' ').map(|pair| pair.split_once('=').unwrap()).collect();
    assert_read(environment.iter().map(|(name, _)| *name));
    let port =
        environment.iter().find(|(name, _)| *name == "GGRADE_LISTEN").unwrap().1.strip_prefix("0.0.0.0:").unwrap();
    assert_eq!(port, last("EXPOSE"));
    for (name, value) in &environment {
        assert!(!value.starts_with('/') || value.starts_with(&format!("{}/", last("VOLUME"))), "{name} is not kept");
    }
    let entry = words(&last("ENTRYPOINT"));
    assert_eq!(entry, ["ggrade"]);
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ggrade"));
    command.args(words(&last("CMD"))).env("GGRADE_DATABASE", folder.path().join("ggrade.db"));
    let running = Running::start(&mut command);
    let (_, check) = last("HEALTHCHECK").split_once("CMD ").map(|(a, b)| (a.to_owned(), words(b))).unwrap();
    assert_eq!(check, ["ggrade", "serve", "--healthcheck"]);
    assert!(ready(env!("CARGO_BIN_EXE_ggrade"), &running.address));
    let address = running.address.clone();
    drop(running);
    assert!(!ready(env!("CARGO_BIN_EXE_ggrade"), &address));
}

fn compose() -> Value {
    let text = fs::read_to_string(repository().join("deploy/container/compose.yaml")).unwrap();
    serde_yaml_ng::from_str(&text).unwrap()
}

/// The value of a variable: `${NAME}`, `${NAME:-default}` and `${NAME:?why}` in their order, filled in as compose does.
fn filled(text: &str) -> String {
    let mut rest = text;
    let mut out = String::new();
    while let Some((before, after)) = rest.split_once("${") {
        let (variable, after) = after.split_once('}').unwrap();
        out += before;
        out += match variable.split_once(":-") {
            Some((_, default)) => default,
            None if variable.starts_with("GGRADE_TEACHER_TOKEN") => "0123456789abcdef",
            None if variable.starts_with("POSTGRES_PASSWORD") => "password",
            None => panic!("nobody sets {variable}"),
        };
        rest = after;
    }
    out + rest
}

#[test]
fn the_services_of_the_compose_file_belong_together() {
    let compose = compose();
    let services = compose["services"].as_object().unwrap();
    assert_eq!(services.keys().collect::<Vec<_>>(), ["database", "web", "grader", "proxy"]);
    let build = &services["web"]["build"];
    let context = repository().join("deploy/container").join(build["context"].as_str().unwrap());
    assert!(context.join(build["dockerfile"].as_str().unwrap()).is_file());
    assert_eq!(services["web"]["image"], services["grader"]["image"]);
    for (name, service) in services {
        for (other, condition) in service["depends_on"].as_object().into_iter().flatten() {
            // The image of ggrade has a health check of its own.
            let has_check = services[other]["healthcheck"].is_object() || services[other]["build"].is_object();
            assert!(condition["condition"] == "service_healthy" && has_check, "{name} waits for {other}");
        }
        for volume in service["volumes"].as_array().into_iter().flatten() {
            let from = volume.as_str().unwrap().split(':').next().unwrap();
            let is_there = match from.strip_prefix("./") {
                Some(file) => repository().join("deploy/container").join(file).is_file(),
                None => compose["volumes"].as_object().unwrap().contains_key(from),
            };
            assert!(is_there, "{name}: {from}");
        }
    }
    // The address that is trusted is the proxy's, which leads to the pages, at the port of the image.
    let proxy = &services["proxy"]["networks"]["inside"]["ipv4_address"];
    let trusted: Vec<String> = words(services["web"]["environment"]["GGRADE_TRUSTED_PROXIES"].as_str().unwrap());
    assert_eq!(trusted, [proxy.as_str().unwrap()]);
    let caddyfile = fs::read_to_string(repository().join("deploy/container/Caddyfile")).unwrap();
    assert!(caddyfile.contains(&format!("reverse_proxy web:{}", last("EXPOSE"))), "{caddyfile}");
}

/// The configuration is taken; what fails is only that there is no database.
#[test]
fn the_processes_of_the_compose_file_take_their_variables() {
    let compose = compose();
    for name in ["web", "grader"] {
        let service = &compose["services"][name];
        let environment: BTreeMap<&str, String> = service["environment"]
            .as_object()
            .unwrap()
            .iter()
            .map(|(name, value)| (name.as_str(), filled(value.as_str().unwrap())))
            .collect();
        assert_read(environment.keys().copied());
        assert_eq!(environment["GGRADE_DATABASE"], "postgres://ggrade:password@database/ggrade");
        let command = service["command"].as_array().unwrap().iter().map(|word| word.as_str().unwrap());
        let output = Command::new(env!("CARGO_BIN_EXE_ggrade"))
            .args(command)
            .envs(&environment)
            .env("GGRADE_DATABASE", "postgres://ggrade:password@127.0.0.1:1/ggrade")
            .env("LANG", "C")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{name}: {said}");
        assert!(said.contains("the database postgres://127.0.0.1:1/ggrade cannot be opened"), "{name}: {said}");
    }
}
