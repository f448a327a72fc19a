//! Tables in the documentation are what the program says. `BLESS=1` writes them anew, and is red.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;

fn mistakes() -> String {
    let assignment = reference::assignment("ggsample06").unwrap();
    let lines: Vec<_> = assignment.rubric.iter().map(|line| line.id.as_str()).collect();
    let mut table = format!("| mistake | {} |\n|{}\n", lines.join(" | "), " --- |".repeat(lines.len() + 1));
    for mistake in &assignment.mistakes {
        let kept: Vec<_> = lines
            .iter()
            .map(|line| match mistake.keeps(line) {
                1.0 => String::new(),
                kept => format!("{:.0} %", kept * 100.0),
            })
            .collect();
        writeln!(table, "| `{}` | {} |", mistake.id, kept.join(" | ")).unwrap();
    }
    table
}

fn advice() -> String {
    let assignment = reference::assignment("ggsample06").unwrap();
    let mut table = "| advice | what is said |\n| --- | --- |\n".to_owned();
    for advice in &assignment.advice {
        writeln!(table, "| `{}` | {} |", advice.id, advice.message.fill(&[]).en).unwrap();
    }
    table
}

fn derived() -> String {
    let mut table = "| mistake | what it is | kept |\n| --- | --- | --- |\n".to_owned();
    for (id, title, keeps) in reference::derived::costs() {
        writeln!(table, "| `{id}-…` | {} | {:.0} % |", title.en, keeps * 100.0).unwrap();
    }
    table
}

/// Holds the table called `name` in `docs/scoring.md` against what is expected.
fn check_table(name: &str, expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scoring.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let start = format!("<!-- table: {name} -->\n");
    let (before, rest) = text.split_once(&start).expect("the table's place");
    let (found, after) = rest.split_once("<!-- end of table -->").expect("the table's end");
    if found != expected && std::env::var_os("BLESS").is_some() && std::env::var_os("CI").is_none() {
        std::fs::write(&path, format!("{before}{start}{expected}<!-- end of table -->{after}")).unwrap();
    }
    assert_eq!(found, expected, "docs/scoring.md is not what the assignment says");
}

#[test]
fn the_tables_of_mistakes_and_advice_are_the_programs_own() {
    check_table("mistakes", &mistakes());
    check_table("advice", &advice());
    check_table("derived", &derived());
}

#[test]
fn every_piece_of_advice_has_two_samples() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/accepted/advice");
    let names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    let assignment = reference::assignment("ggsample06").unwrap();
    for advice in &assignment.advice {
        let samples =
            names.iter().filter(|name| name.starts_with(&format!("{}--", advice.id)) && name.ends_with(".vert"));
        assert!(samples.count() >= 2, "fewer than two samples of {}", advice.id);
    }
}

#[test]
fn every_mistake_of_the_table_has_two_samples() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/wrong");
    let names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".vert"))
        .collect();
    let assignment = reference::assignment("ggsample06").unwrap();
    let samples = |id: &str| {
        let has = |name: &&String| name.split_once("--").is_some_and(|(ids, _)| ids.split('+').any(|i| i == id));
        names.iter().filter(has).count()
    };
    let few: Vec<_> = assignment.mistakes.iter().filter(|m| samples(&m.id) < 2).map(|m| m.id.as_str()).collect();
    assert!(few.is_empty(), "fewer than two samples of {few:?}");
    for name in &names {
        for id in name.split_once("--").map_or("", |(ids, _)| ids).split('+') {
            assert!(assignment.mistake(id).is_some(), "{name}: there is no mistake {id}");
        }
    }
}

/// The rooms of the pipeline, in the order in which they may know one another. Finding the slot of a file reads it as text.
const PIPELINE: [&str; 7] = ["hand_in", "source", "slots", "translate", "render", "compare", "diagnose"];

/// Who calls the pipeline.
const ABOVE: [&str; 11] = [
    "grade",
    "sandbox",
    "intake",
    "class",
    "batch",
    "service",
    "corpus",
    "command",
    "cli",
    "report::html",
    "report::json",
];

/// Rooms, each with those that it must not know: the surfaces are siblings, and what they share knows none of them.
const STRANGERS: [(&str, &[&str]); 5] = [
    ("intake", &["class", "batch", "service", "corpus", "command", "cli"]),
    ("class", &["batch", "service", "corpus", "command", "cli"]),
    ("likeness", &["class", "batch", "service", "corpus", "command", "cli"]),
    ("batch", &["service", "corpus", "command", "cli"]),
    ("service", &["batch", "corpus", "command"]),
];

/// Stages that `batch`, `class` and `service` leave to `grade`.
const STAGES: [&str; 5] = ["translate", "render", "compare", "diagnose", "cross_check"];

/// What the code of a room imports: the paths behind `crate::`, comments and tests left out.
fn imports(room: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = vec![root.join(room).with_extension("rs"), root.join(room)];
    assert!(paths[0].is_file(), "there is no {room}");
    let mut imports = Vec::new();
    while let Some(path) = paths.pop() {
        if path.is_dir() {
            paths.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|extension| extension == "rs") && !path.ends_with("tests.rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            imports.extend(lines.flat_map(|line| line.split("crate::").skip(1).flat_map(listed)));
        }
    }
    imports
}

/// Each path of `a::b` or `{a, b::c}`.
fn listed(path: &str) -> Vec<String> {
    match path.strip_prefix('{') {
        Some(list) => list.split(['}', ',']).map(|path| path.trim().to_owned()).collect(),
        None => vec![path.to_owned()],
    }
}

fn assert_unknown<'o>(room: &str, others: impl IntoIterator<Item = &'o &'o str>) {
    let imports = imports(room);
    for other in others {
        let known = imports.iter().find(|path| {
            path.strip_prefix(other).is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        });
        assert_eq!(known, None, "{room} knows {other}");
    }
}

/// `docs/architecture.md`, "Who may know whom".
#[test]
fn a_room_knows_only_what_stands_before_it() {
    for (place, room) in PIPELINE.iter().enumerate() {
        assert_unknown(room, PIPELINE[place + 1..].iter().chain(&ABOVE));
    }
    for (room, strangers) in STRANGERS {
        assert_unknown(room, strangers);
    }
    for room in ["batch", "class", "service"] {
        assert_unknown(room, &STAGES);
    }
}

/// The tables of `docs/assignment-toml.md`, by the type of the schema that each is of: key, default, meaning.
fn reference_tables() -> BTreeMap<String, Vec<[String; 3]>> {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/assignment-toml.md")).unwrap();
    let mut tables = BTreeMap::new();
    for part in text.split("<!-- schema: ").skip(1) {
        let (name, part) = part.split_once(" -->").unwrap();
        let rows = part.lines().filter(|line| line.starts_with("| `"));
        let row = |line: &str| {
            // A bar within backticks is no border of a cell.
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            let [key, _, default, meaning] = cells[..] else { panic!("{line}") };
            [key.trim_matches('`').to_owned(), default.to_owned(), meaning.to_owned()]
        };
        assert!(tables.insert(name.to_owned(), rows.map(row).collect()).is_none(), "{name} stands twice");
    }
    tables
}

#[test]
fn the_reference_of_the_manifest_has_each_key_and_no_other() {
    let schema = reference::schema::schema().to_value();
    let definitions = schema["definitions"].as_object().unwrap();
    let mut types: BTreeMap<String, &serde_json::Value> = BTreeMap::new();
    for (name, definition) in definitions {
        let variants = definition["anyOf"].as_array().into_iter().flatten();
        let with_keys = std::iter::once(definition).chain(variants).find(|one| one["properties"].is_object());
        types.extend(with_keys.map(|found| (name.clone(), found)));
    }
    let tables = reference_tables();
    let names = |of: &mut dyn Iterator<Item = &String>| of.cloned().collect::<BTreeSet<_>>();
    let mut known = names(&mut types.keys());
    // It has no keys: there is nothing to list but that.
    known.insert("Nothing".to_owned());
    assert_eq!(names(&mut tables.keys()), known, "each type that has keys has a table, and no other");
    for (name, definition) in types {
        let keys = names(&mut definition["properties"].as_object().unwrap().keys());
        let listed: BTreeSet<String> = tables[&name].iter().map(|[key, ..]| key.clone()).collect();
        assert_eq!(listed, keys, "the keys of {name}");
        for [key, default, meaning] in &tables[&name] {
            assert!(!meaning.is_empty(), "{name}.{key} says nothing");
            let is_required = definition["required"].as_array().into_iter().flatten().any(|one| one == key);
            assert!(!is_required || default == "required", "{name}.{key} is required");
            let own = &definition["properties"][key]["default"];
            let is_empty = own.is_null() || *own == serde_json::json!("") || *own == serde_json::json!([]);
            if !is_required && !is_empty && *own != serde_json::json!({}) {
                let said = format!("`{}`", own.to_string().replace(',', ", "));
                assert_eq!(*default, said, "the default of {name}.{key}");
            }
        }
    }
}

/// Each folder of this project, and each that `ggrade assignment new` is tried with, is what the schema says.
#[test]
fn all_folders_are_what_the_schema_says() {
    let schema = jsonschema::validator_for(&reference::schema::schema().to_value()).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["tests/homeworks", "reference/assignments"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path().join("assignment.toml");
            let text = std::fs::read_to_string(&path).unwrap();
            let value: serde_json::Value = toml::from_str(&text).unwrap();
            let wrong: Vec<String> = schema.iter_errors(&value).map(|error| error.to_string()).collect();
            assert!(wrong.is_empty(), "{}: {wrong:?}", path.display());
            count += 1;
        }
    }
    assert!(count >= 10, "{count} folders");
    let misspelt = serde_json::json!({ "id": "x", "title": { "en": "", "ja": "" }, "files": [] });
    assert!(!schema.is_valid(&misspelt));
}
