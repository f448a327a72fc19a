use super::*;

fn loaded(change: impl Fn(&str) -> String) -> Result<Assignment, AssignmentError> {
    Assignment::load(|name| {
        let file = BUILT_IN[0].iter().find(|(n, _)| *n == name);
        let (_, text) = file.ok_or("is not in the folder")?;
        Ok(if name == MANIFEST { change(text) } else { (*text).to_owned() })
    })
}

/// The error that replacing `from` by `to` in `assignment.toml` leads to.
fn broken(from: &str, to: &str) -> String {
    let change = |text: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    loaded(change).expect_err(to).to_string()
}

#[test]
fn the_built_in_assignment_is_what_the_homework_says() {
    let a = assignment("ggsample06").expect("built in");
    assert_eq!(a.max_score(), 100.0);
    let points: Vec<_> = a.rubric.iter().map(|l| (l.id.as_str(), l.points)).collect();
    assert_eq!(points, [("shape", 10.0), ("ambient", 20.0), ("diffuse", 30.0), ("specular", 40.0)]);
    assert!(a.files[0].starter.contains("vc = cv;"));
    assert!(assignment("ggsample07").is_none());
}

#[test]
fn constants_of_the_starter_are_those_of_the_manifest() {
    let a = assignment("ggsample06").expect("built in");
    let starter = &a.files[0].starter;
    for constant in &a.constants {
        let start = format!("const {} {} = ", constant.kind.glsl(), constant.name);
        let line = starter.lines().find_map(|l| l.strip_prefix(&start));
        let text = line.expect(&constant.name).split(';').next().expect("value");
        let numbers: Vec<f64> = text
            .trim_start_matches("vec4(")
            .trim_end_matches(')')
            .split(',')
            .map(|n| n.trim().parse().expect("a number"))
            .collect();
        assert_eq!(numbers, constant.value.numbers(), "{}", constant.name);
    }
}

#[test]
fn a_folder_loads_as_the_built_in_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assignments/ggsample06");
    let loaded = Assignment::from_folder(&folder).expect("the same files");
    assert_eq!(loaded.id, "ggsample06");
    let error = Assignment::from_folder(Path::new("/nonexistent")).expect_err("no folder");
    assert_eq!(error.place, MANIFEST);
}

#[test]
fn what_contradicts_itself_is_refused_with_its_place() {
    assert!(broken("cycle = 5", "cycles = 5").contains("unknown field `cycles`"));
    assert_eq!(
        broken("is = \"normalize(l + v)\"", "is = \"normalize(l + vv)\""),
        "definition `h`: column 15: `vv` is not known here"
    );
    assert_eq!(broken("is = \"total\"", "is = \"total.rgb\""), "definition `colour`: is missing or not a vec4");
    assert_eq!(
        broken("forms = [{ ambient = \"kamb + lamb\" }]", "forms = [{ ambient = \"specular\" }]"),
        "mistake `ambient-added`, form 0, `ambient`: uses `specular`, which is defined later"
    );
    assert_eq!(
        broken("{ facing = \"nh\" }", "{ facings = \"nh\" }"),
        "mistake `specular-unclamped`, form 0, `facings`: there is no definition `facings`"
    );
    assert_eq!(
        broken("keeps = { ambient = 0.5 }", "keeps = { ambient = 1.5 }"),
        "mistake `ambient-added`: keeps 1.5 of `ambient`: not a fraction"
    );
    assert!(broken("title = { en = \"No ambient term\", ", "title = { ").contains("missing field `en`"));
    assert_eq!(
        broken("ja = \"環境光の項がない\"", "ja = \" \""),
        "mistake `ambient-missing`: the title needs 1 to 60 characters in each language"
    );
    assert_eq!(
        broken("en = \"No ambient term\"", "en = \"Handed in unchanged\""),
        "mistake `ambient-missing`: another mistake has the same title"
    );
    assert_eq!(broken("value = [80]", "value = [80, 1]"), "constant `kshi`: a float has 1 numbers");
    assert_eq!(broken("id = \"ambient-added\"", "id = \"ambient-missing\""), "mistake `ambient-missing`: stands twice");
    assert_eq!(
        broken("far = 15", "far = 0.5"),
        "scene: the camera, the window or the number of poses makes no picture"
    );
    assert_eq!(broken("starter = \"starter.vert\"", "starter = \"other.vert\""), "other.vert: is not in the folder");
}

#[test]
fn a_changed_constant_changes_the_equation() {
    let a = assignment("ggsample06").expect("built in");
    let changed = a.with_constants(&[("kshi", Value::Float(20.0))]).expect("a constant");
    let probes = a.probes(1);
    let differs = probes.iter().any(|p| {
        let outcome = changed.equation.right().evaluate(probes.uniforms(p), &p.attributes);
        (outcome.colour() - p.colour).abs().max_element() > 0.05
    });
    assert!(differs);
    assert!(a.with_constants(&[("kshi", Value::Bool(true))]).is_err());
    assert!(a.with_constants(&[("shininess", Value::Float(1.0))]).is_err());
}

/// What is said must be said in both languages, and a placeholder must not be left over when its value is not known.
#[test]
fn every_text_stands_in_both_languages_and_can_do_without_values() {
    let a = assignment("ggsample06").expect("built in");
    // A definition is always known, by the student's name or by its symbol.
    let definitions = a.equation.definitions().iter();
    let names: Vec<(&str, &str)> =
        definitions.filter_map(|one| Some((one.name.as_str(), one.symbol.as_deref()?))).collect();
    for mistake in &a.mistakes {
        for text in [&mistake.seen, &mistake.equation, &mistake.look] {
            let bare = text.fill(&names);
            for wording in [&bare.en, &bare.ja] {
                assert!(!wording.trim().is_empty(), "{}", mistake.id);
                assert!(!wording.contains(['{', '⟨', '⟩']) && !wording.contains("  "), "{}: {wording}", mistake.id);
            }
            assert!(bare.en.is_ascii() || !bare.en.contains(['。', '、']));
            assert!(bare.ja.contains(['。', '?']), "{}: {}", mistake.id, bare.ja);
            let places = [("line", "7"), ("name", "h"), ("expected", "1"), ("found", "2"), ("frames", "25")];
            let full = text.fill(&[&places[..], &names].concat());
            assert!(!full.en.contains('{') && !full.ja.contains('{'));
        }
    }
}

#[test]
fn the_mistakes_of_the_contract_are_there() {
    let a = assignment("ggsample06").expect("built in");
    for id in [
        "unchanged",
        "ambient-missing",
        "ambient-added",
        "diffuse-missing",
        "diffuse-unclamped",
        "diffuse-abs",
        "diffuse-factor-missing",
        "specular-missing",
        "specular-phong",
        "specular-half-unnormalized",
        "specular-no-exponent",
        "specular-wrong-exponent",
        "specular-unclamped",
        "specular-view-reversed",
        "specular-uses-diffuse-colour",
        "specular-gated",
        "normal-not-transformed",
        "normal-wrong-transform",
        "position-changed",
        "constants-changed",
        "hard-coded",
        "flat-per-triangle",
        "gamma",
        "clamped-early",
        "unexplained",
    ] {
        let mistake = a.mistake(id).expect(id);
        assert!(mistake.keeps.iter().any(|(_, kept)| *kept < 1.0), "{id} costs nothing");
    }
    for line in &a.rubric {
        assert_eq!(a.mistake("unchanged").expect("there").keeps(&line.id), 0.0);
    }
}
