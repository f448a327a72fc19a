use super::*;
use crate::Assignment;

/// A folder that extends the first homework, with a line of its own at the end of the solution.
fn laid_over(manifest: &str) -> Result<Assignment, AssignmentError> {
    let text = format!("id = \"own\"\nextends = \"ggsample06\"\n{manifest}");
    Folder::of([(MANIFEST, text)]).with_bases(None).and_then(Assignment::load)
}

fn refused(manifest: &str) -> String {
    laid_over(manifest).expect_err("refused").to_string()
}

#[test]
fn what_is_not_written_is_that_of_the_base() {
    let base = crate::assignment("ggsample06").expect("built in");
    let own = laid_over("title = { en = \"Own\", ja = \"自作\" }").expect("an assignment");
    assert_eq!((own.id.as_str(), own.title.en.as_str()), ("own", "Own"));
    assert_eq!(own.rubric.len(), base.rubric.len());
    assert_eq!(own.mistakes.len(), base.mistakes.len());
    assert_eq!(own.files[0].solution.text, base.files[0].solution.text);
    assert_ne!(own.digest, base.digest);
    // A worker gets the files alone.
    let again = Folder::of(own.folder.files.clone());
    assert_eq!(Assignment::load(again).expect("an assignment").digest, own.digest);
}

#[test]
fn elements_are_matched_by_what_identifies_them() {
    let own = laid_over(
        "leave_out = [\"unchanged\", \"gama\"]\n[[rubric]]\nid = \"ambient\"\npoints = 25\n[[file]]\nstage = \"vertex\"\nname = \"own.vert\"",
    );
    let said = own.expect_err("a name that is not there").to_string();
    assert!(
        said.starts_with(
            "assignment.toml, line 3, column 28: what is extended has no `gama` to leave out: write `gamma`"
        ),
        "{said}"
    );
    let own = laid_over(
        "leave_out = [\"unchanged\"]\n[[rubric]]\nid = \"ambient\"\npoints = 25\n[[file]]\nstage = \"vertex\"\nname = \"own.vert\"\n\
         [[mistake]]\nid = \"ambient-missing\"\ntitle = { en = \"None\", ja = \"なし\" }",
    )
    .expect("an assignment");
    let points: Vec<f64> = own.rubric.iter().map(|line| line.points).collect();
    assert_eq!(points, [10.0, 25.0, 30.0, 40.0]);
    assert_eq!((own.files.len(), own.files[0].name.as_str()), (1, "own.vert"));
    assert!(own.mistake("unchanged").is_none());
    let mistake = own.mistake("ambient-missing").expect("inherited");
    assert_eq!((mistake.title.en.as_str(), mistake.forms.len()), ("None", 1));
}

#[test]
fn what_is_left_out_is_forgotten_by_the_rest() {
    let own = laid_over(
        "leave_out = [\"specular\", \"highlight\", \"facing\"]\n[[region]]\nid = \"between\"\nwhen = \"false\"\n[probes]\ndesign = []\n[[file]]\n\
         stage = \"vertex\"\nstarter = \"starter.vert\"",
    );
    let own = own.expect("an assignment");
    let lines: Vec<&str> = own.rubric.iter().map(|line| line.id.as_str()).collect();
    assert_eq!(lines, ["shape", "ambient", "diffuse"]);
    assert!(own.mistake("specular-missing").is_none(), "it cost the specular term alone");
    assert!(own.mistake("specular-wrong-exponent").is_none(), "it replaces what is left out");
    assert!(own.mistake("normal-unnormalized").is_some(), "it costs the diffuse term as well");
    let terms = &own.typeset.as_ref().expect("an equation").terms;
    assert_eq!(terms.iter().map(|term| term.line.as_str()).collect::<Vec<_>>(), ["ambient", "diffuse"]);
}

#[test]
fn a_second_scene_is_added_to_the_first() {
    let scene = "[[scene]]\nposes = 3\n[[scene]]\nmesh = { sphere = { radius = 1 } }\nturn = 1\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n\
                 fovy = 0.5\nnear = 1\nfar = 15\nposes = 2\n";
    let own = laid_over(scene).expect("an assignment");
    assert_eq!(own.scene.all_poses().len(), 5);
    // What is drawn is one thing: another takes the place of the base's triangle.
    let other = laid_over("[scene]\nmesh = { sphere = { radius = 1 } }").expect("an assignment");
    assert!(other.scene.all_poses().len() == 25);
}

#[test]
fn errors_name_the_manifest_in_which_they_stand() {
    let said = refused("[[rubric]]\nid = \"ambient\"\npoints = \"many\"");
    assert!(said.starts_with("assignment.toml, line 5, column 10: this is a string"), "{said}");
    // A definition that this solution does not have is named where it is used.
    let other = "#version 410 core\nin vec4 pv;\nin vec4 cv;\nuniform mat4 mw;\nuniform mat4 mc;\nuniform mat4 mg;\nout vec4 vc;\n\
                 void main()\n{\n    vec4 colour = cv;\n    vec4 position = mc * pv;\n    vc = colour;\n    gl_Position = position;\n}\n";
    let manifest = "id = \"own\"\nextends = \"ggsample06\"\nleave_out = [\"constant\", \"region\", \"probes\", \"definition\", \"advice\", \"equation\"]\n";
    let folder = Folder::of([(MANIFEST, manifest), ("solution.vert", other)]).with_bases(None).expect("a folder");
    let said = Assignment::load(folder).expect_err("refused").to_string();
    assert!(said.starts_with("../ggsample06/assignment.toml, line "), "{said}");
    assert!(said.contains("leave_out = [\""), "{said}");
}

#[test]
fn what_extends_nothing_or_itself_is_refused() {
    let folder = |base: &str| {
        let text = format!("# a comment\nid = \"own\"\nextends = \"{base}\"\n");
        Folder::of([(MANIFEST, text)])
    };
    for nowhere in ["nothing", "", "../ggsample06"] {
        let said = folder(nowhere).with_bases(None).expect_err("refused").to_string();
        assert!(said.starts_with("assignment.toml, line 3: there is no folder"), "{said}");
        assert!(
            said.contains("built in are ggsample06") || said.contains("ggsample06,") || said.contains(", ggsample06"),
            "{said}"
        );
    }
    let mut circle = folder("a");
    circle.files.insert("../a/assignment.toml".into(), b"extends = \"a\"\n".to_vec());
    let said = circle.with_bases(None).and_then(Assignment::load).expect_err("refused").to_string();
    assert!(said.contains("extends this folder in turn"), "{said}");
}
