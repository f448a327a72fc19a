//! What contradicts itself in a manifest is refused, with its place and what to write.

use super::*;

#[test]
fn what_contradicts_itself_is_refused_with_its_place() {
    assert!(broken("cycle = 5", "cycles = 5").contains("there is no key `cycles`: write `cycle`;"));
    for id in ["a b", "", ".hidden", "課題6", "{x}"] {
        let said = broken("id = \"ggsample06\"", &format!("id = \"{id}\""));
        let place = format!(
            "assignment.toml, line {}: the id `{id}` cannot stand in an address",
            line_of("id = \"ggsample06\"")
        );
        assert!(said.starts_with(&place), "{said}");
    }
    assert_eq!(
        broken("keeps = { ambient = 0.5 }", "keeps = { ambient = 1.5 }"),
        format!("{}: keeps 1.5 of `ambient`: write a fraction, 0 to 1", entry("mistake", "ambient-added"))
    );
    assert!(broken("title = { en = \"No ambient term\", ", "title = { ").contains("`en` is missing: write `en = …`"));
    assert_eq!(
        broken("ja = \"環境光の項がない\"", "ja = \" \""),
        format!("{}: the title needs 1 to 60 characters in each language", entry("mistake", "ambient-missing"))
    );
    assert_eq!(
        broken("en = \"No ambient term\"", "en = \"Handed in unchanged\""),
        format!(
            "{}: another mistake has the same title: lists name it by the title alone",
            entry("mistake", "ambient-missing")
        )
    );
    assert_eq!(
        broken("name = \"kshi\"", "name = \"shininess\""),
        format!(
            "assignment.toml, line {}, constant `shininess`: solution.vert has no `const type shininess = …;`: write it there, or \
             correct the name",
            line_of("name = \"kshi\"")
        )
    );
    assert_eq!(
        broken("id = \"ambient-added\"", "id = \"ambient-missing\""),
        format!("{}: stands twice: give one another name", entry("mistake", "ambient-missing"))
    );
    assert_eq!(
        broken("far = 15", "far = 0.5"),
        format!(
            "assignment.toml, line {}, scene: `near` is above 0, and `far` is above `near`: anything else makes no picture",
            line_of("[scene]")
        )
    );
    assert_eq!(
        broken("starter = \"starter.vert\"", "starter = \"other.vert\""),
        format!(
            "assignment.toml, line {}, `other.vert`: is not in the folder, which has assignment.toml, fixed.frag, \
             solution.vert, starter.vert: add it, or correct the name",
            line_of("starter = \"starter.vert\"")
        )
    );
}

#[test]
fn an_expression_of_a_mistake_is_refused_with_its_line_and_what_to_write() {
    let (form, place) = ("forms = [{ ambient = \"kamb + lamb\" }]", "mistake `ambient-added`, form 0, `ambient`");
    let error = |expression: &str| broken(form, &format!("forms = [{{ ambient = \"{expression}\" }}]"));
    let start = format!("assignment.toml, line {}, {place}: ", line_of(form));
    let known = "`pl`, `lamb`, `ldiff`, `lspec`, `kamb`, `kdiff`, `kspec`, `kshi`, `mw`, `mc`, `mg`, `pv`, `cv`, `p`, \
                 `v`, `l`, `n`, `h`, `nl`, `lambert`, `nh`, `facing`, `highlight`";
    let wanted = format!("write an expression of type vec4 with {known}");
    assert_eq!(error("kamb + lam"), format!("{start}there is no variable `lam`: {wanted}"));
    assert_eq!(error("nl"), format!("{start}float is not vec4: {wanted}"));
    assert_eq!(error("kamb +"), format!("{start}an expression is expected before the end of the file: {wanted}"));
    assert_eq!(error("kamb; lamb"), format!("{start}the end of the expression is expected before `;`: {wanted}"));
    assert_eq!(error("specular"), format!("{start}uses `specular`, which is defined later: use only {known}"));
    let changed = error("(p = lamb)");
    assert!(changed.starts_with(&format!("{start}this changes `p`, which has a value already")), "{changed}");
    let unknown = broken("{ facing = \"nh\" }", "{ facings = \"nh\" }");
    let line = line_of("{ facing = \"nh\" }");
    let start = format!("assignment.toml, line {line}, mistake `specular-unclamped`, form 0, `facings`: there is no");
    assert!(
        unknown.starts_with(&format!("{start} definition `facings` in solution.vert, which has `p`, ")),
        "{unknown}"
    );
    let taken = broken("fit = { name = \"x\", from = 0.1, to = 5", "fit = { name = \"nl\", from = 0.1, to = 5");
    assert!(taken.ends_with("`nl` is taken, means something in GLSL, or is not a name"), "{taken}");
}

#[test]
fn regions_and_designs_speak_of_the_solution() {
    let says = |from: &str, to: &str, message: &str| {
        let found = broken(from, to);
        assert!(found.starts_with("assignment.toml, line ") && found.ends_with(message), "{found}");
    };
    let line = line_of("when = \"nl < -0.02 && highlight < 1e-6\"");
    let found = broken("nl < -0.02 && highlight < 1e-6", "nl < -0.02 && shine < 1e-6");
    let start = format!("assignment.toml, line {line}, region `ambient-only`: there is no variable `shine`");
    assert!(found.starts_with(&start), "{found}");
    let found = broken("nl < -0.02 && highlight < 1e-6", "nl");
    assert!(found.contains("write an expression of type bool with `pl`, `lamb`"), "{found}");
    says(
        "alone_in = [\"ambient-only\"]",
        "alone_in = [\"dusk\"]",
        "rubric `ambient`: there is no region `dusk`, only `facing-away`, `ambient-only`, `diffuse-only`, \
         `highlight`, `highlight-behind`, `between`",
    );
    says("axis = \"l\"", "axis = \"L\"", "probes: there is no definition `L`: write `l`");
    says("axis = \"l\"", "axis = \"nl\"", "probes: `nl` is a float, and has to be a vec3");
    says(
        "lobe = \"h\"",
        "lobe = \"n\"",
        "probes: the lobe depends on the normal by `n`: name a direction that does not",
    );
    says("power = \"kshi\"", "power = \"pl\"", "probes: there is no float constant `pl`: `raised` needs it as `power`");
    says("angle = [2, 25]", "angle = [2, 250]", "probes, design 1: [2, 250] is no range within [0, 180]");
    says("raised = [0.85, 1], ", "", "probes, design 1: write one of `cosine` and `raised`: how the normal stands");
    let found = broken("within = { nl =", "within = { nl2 =");
    assert!(found.contains("probes, design 1: there is no definition `nl2`"), "{found}");
}

#[test]
fn what_is_wrong_with_an_interface_is_said_in_both_languages() {
    let folder = Folder::clone(&waves().folder);
    for (from, to) in [
        ("value = 0.15", "value = [1, 2]"),
        ("value = 0.15", "value = \"a lot\""),
        ("value = 0.15", "value = 1e60"),
        ("value = 0.15\n", "\n"),
        ("value = 0.15", "value = 0.15\ncarries = \"model\""),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.05] }"),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.4, 0.05] }"),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.05, 0.4], also = 1 }"),
        ("probe = { within = [0.05, 0.4] }", "probe = 0.4"),
        ("probe = { within = [0.05, 0.4] }", "probe = { from = 1 }"),
        ("name = \"time\"", "name = \"hour\""),
        ("name = \"time\"", "name = \"time\"\ntype = \"clock\""),
        ("name = \"time\"", "name = \"time\"\ntype = \"vec2\""),
        ("is = \"t * 6.2831853\"", "is = \"t *\""),
        ("name = \"time\"\nis = \"t * 6.2831853\"", "name = \"time\"\ncarries = \"model\""),
        ("name = \"waves[1].length\"", "name = \"waves[0].length\""),
        ("[[uniform]]\nname = \"time\"\nis = \"t * 6.2831853\"\n", ""),
        ("name = \"position\"\ncarries = \"position\"", "name = \"place\"\ncarries = \"position\""),
        ("name = \"position\"\ncarries = \"position\"", "name = \"position\"\nvalues = [1, 2, 3]"),
        ("name = \"position\"\ncarries = \"position\"", "name = \"position\""),
        (
            "[[uniform]]\nname = \"model\"",
            "[[input]]\nname = \"position\"\ncarries = \"position\"\n\n[[uniform]]\nname = \"model\"",
        ),
        ("eye = [0, 2, 4]", "eye = \"t t\""),
    ] {
        let mut folder = folder.clone();
        let manifest = folder.text(MANIFEST).expect("text");
        assert!(manifest.contains(from), "{from}");
        folder.files.insert(MANIFEST.into(), manifest.replacen(from, to, 1).into());
        let Text { en, ja } = Assignment::load(folder).expect_err(to).message;
        assert!(en.is_ascii() || en.contains('…'), "{to}: {en}");
        assert!(ja.contains(|c| ('ぁ'..='ん').contains(&c)), "{to}: {ja}");
    }
}
