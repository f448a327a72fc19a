//! Nobody's name is anywhere.

use crate::class::{Place, REJECTED, RIGHT, WRONG, sample};
use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;

const NAMES: [&str; 4] = ["佐藤 花子", "yamadataro", "Müller", "secretclub"];

fn place() -> Place {
    let place = Place::of(&[(NAMES[0], &sample(RIGHT)), (NAMES[1], &sample(WRONG)), (NAMES[2], &sample(REJECTED))]);
    // File names, folders and refused members name people too.
    fs::rename(place.at("class/yamadataro/ggsample06.vert"), place.at("class/yamadataro/yamadataro.vert")).unwrap();
    fs::create_dir(place.at("class/secretclub")).unwrap();
    fs::write(place.at("class/secretclub/secretclub.docx"), "PK").unwrap();
    fs::write(place.at("class/secretclub/secretclub.zip"), "PK broken").unwrap();
    place
}

/// Everything that is written anywhere below a folder: names of files, their bytes, and what is in archives.
fn everything(place: &Place, out: &str) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for (name, bytes) in place.files(out) {
        if name.extension().is_some_and(|extension| extension == "zip") {
            let mut archive = zip::ZipArchive::new(fs::File::open(place.at(out).join(&name)).unwrap()).unwrap();
            for index in 0..archive.len() {
                let mut member = archive.by_index(index).unwrap();
                let mut bytes = Vec::new();
                member.read_to_end(&mut bytes).unwrap();
                found.push((member.name().unwrap().into_owned(), bytes));
            }
        }
        found.push((name.to_string_lossy().into_owned(), bytes));
    }
    found
}

fn names_in(text: &[u8]) -> Vec<&'static str> {
    NAMES.into_iter().filter(|name| text.windows(name.len()).any(|window| window == name.as_bytes())).collect()
}

#[test]
fn no_name_is_anywhere() {
    let place = place();
    let output = place.batch("out").args(["--anonymous", "--json-lines", "--lang", "ja"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    for text in [&output.stdout, &output.stderr] {
        assert_eq!(names_in(text), [] as [&str; 0], "{}", String::from_utf8_lossy(text));
    }
    let files = everything(&place, "out");
    assert!(files.len() > 15, "{files:?}");
    for (name, bytes) in &files {
        assert_eq!(names_in(name.as_bytes()), [] as [&str; 0], "{name}");
        assert_eq!(names_in(bytes), [] as [&str; 0], "{name}");
    }
    // The search would find one.
    place.batch("named").assert().code(1);
    let named: BTreeSet<_> = everything(&place, "named").iter().flat_map(|(_, bytes)| names_in(bytes)).collect();
    assert_eq!(named.len(), NAMES.len(), "{named:?}");
}

#[test]
fn a_folder_has_its_pseudonyms_and_only_who_asks_learns_whose_they_are() {
    let place = place();
    let keys = |out: &str| place.scores(out).into_keys().collect::<Vec<_>>();
    place.batch("out").args(["--anonymous", "--names", "names.csv", "--formats", "csv"]).assert().code(1);
    let first = keys("out");
    place.batch("out").args(["--anonymous", "--force", "--formats", "csv"]).assert().code(1);
    assert_eq!(keys("out"), first);
    place.batch("other").args(["--anonymous", "--formats", "csv"]).assert().code(1);
    assert_ne!(keys("other"), first);

    let mode = fs::metadata(place.at("out/pseudonyms.key")).unwrap().permissions().mode();
    assert_eq!(mode & 0o077, 0, "{mode:o}");
    let names = fs::read_to_string(place.at("names.csv")).unwrap();
    for name in NAMES {
        assert!(names.contains(name), "{names}");
    }
    for key in first {
        let pseudonym = format!("{}-{}", &key[..4], &key[4..]).to_uppercase();
        assert!(names.contains(&pseudonym), "{pseudonym} in {names}");
    }
}
