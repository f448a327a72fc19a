//! Assignments in folders: graded as a built-in one, and named by file and line where they are broken.

use super::{ggrade, sample_like};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

pub const MANIFEST: &str = "assignment.toml";

/// A copy of a homework's folder, the built-in one's where nothing is said, in a folder called `toon`.
pub struct Copy {
    /// What the copy stands in, beside what is not part of it.
    pub around: TempDir,
}

impl Copy {
    pub fn new() -> Self {
        Self::of("reference/assignments/ggsample06")
    }

    pub fn of(original: &str) -> Self {
        let copy = Self { around: tempfile::tempdir().unwrap() };
        fs::create_dir(copy.folder()).unwrap();
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join(original);
        for entry in fs::read_dir(original).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), copy.folder().join(entry.file_name())).unwrap();
        }
        copy
    }

    pub fn folder(&self) -> PathBuf {
        self.around.path().join("toon")
    }

    pub fn path(&self, file: &str) -> PathBuf {
        self.folder().join(file)
    }

    /// Replaces a text of a file, which has to be there.
    pub fn replace(self, file: &str, from: &str, to: &str) -> Self {
        let text = fs::read_to_string(self.path(file)).unwrap();
        assert!(text.contains(from), "{file} has no {from}");
        fs::write(self.path(file), text.replacen(from, to, 1)).unwrap();
        self
    }

    /// The line on which a text of a file stands.
    fn line(&self, file: &str, text: &str) -> usize {
        let content = fs::read_to_string(self.path(file)).unwrap();
        content.lines().position(|line| line.contains(text)).unwrap() + 1
    }

    /// What `ggrade grade` says of the broken folder, in a language.
    fn said(&self, language: &str) -> String {
        let output = ggrade()
            .arg("grade")
            .arg(sample_like("accepted/answers", "plain-int-zero"))
            .arg("--assignment")
            .arg(self.folder())
            .args(["--lang", language])
            .output()
            .unwrap();
        assert!(output.stdout.is_empty(), "no report");
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        said
    }

    /// Holds what is said of the broken folder against its place and a part of the message, in both languages.
    fn is_refused(&self, file: &str, line: Option<usize>, en: &str, ja: &str) {
        let place = |english: bool| match (line, english) {
            (Some(line), true) => format!("{file}, line {line}"),
            (Some(line), false) => format!("{file} の {line} 行目"),
            (None, _) => file.to_owned(),
        };
        for (language, part) in [("en", en), ("ja", ja)] {
            let said = self.said(language);
            assert!(
                said.contains(&place(language == "en")) && said.contains(part),
                "{place} in {said}",
                place = place(true)
            );
            assert!(said.contains("toon"), "the folder is named: {said}");
        }
    }
}

#[test]
fn a_folder_is_graded_as_the_built_in_assignment() {
    let copy = Copy::new().replace(MANIFEST, "points = 10", "points = 60");
    let file = sample_like("accepted/answers", "plain-int-zero");
    let report = |assignment: &Path| -> serde_json::Value {
        let output =
            ggrade().arg("grade").arg(&file).arg("--assignment").arg(assignment).args(["--format", "json"]).output();
        serde_json::from_slice(&output.unwrap().stdout).unwrap()
    };
    let (ours, theirs) = (report(Path::new("ggsample06")), report(&copy.folder()));
    assert_eq!((&ours["verdict"], &ours["score"]), (&"correct".into(), &100.into()));
    assert_eq!((&theirs["verdict"], &theirs["score"]), (&"correct".into(), &150.into()));
    assert_eq!(ours["assignment"], theirs["assignment"]);
    let digest = |report: &serde_json::Value| report["assignment_digest"].as_str().unwrap().to_owned();
    assert_eq!(digest(&ours).len(), 64);
    assert_ne!(digest(&ours), digest(&theirs), "a changed folder is another assignment");
}

#[test]
fn a_missing_file_is_named() {
    let copy = Copy::new();
    fs::remove_file(copy.path("starter.vert")).unwrap();
    let line = copy.line(MANIFEST, "\"starter.vert\"");
    copy.is_refused(MANIFEST, Some(line), "`starter.vert`: is not in the folder, which has", "フォルダにありません");
    fs::remove_file(copy.path(MANIFEST)).unwrap();
    copy.is_refused(MANIFEST, None, "every assignment has one", "どの課題にも必要");
}

#[test]
fn a_description_that_is_not_toml_is_named_by_its_line() {
    let copy = Copy::new().replace(MANIFEST, "[scene]", "[scene");
    copy.is_refused(MANIFEST, Some(copy.line(MANIFEST, "[scene")), "", "");
}

#[test]
fn an_unknown_key_is_named_with_those_that_there_are() {
    let copy = Copy::new().replace(MANIFEST, "background =", "backgrund =");
    let line = Some(copy.line(MANIFEST, "backgrund"));
    let (en, ja) =
        ("there is no key `backgrund`: write `background`", "`backgrund` というキーはありません。`background` と");
    copy.is_refused(MANIFEST, line, en, ja);
}

#[test]
fn a_definition_that_the_solution_lacks_is_named_with_those_that_it_has() {
    let copy = Copy::new().replace(MANIFEST, "{ facing = \"nh\" }", "{ facings = \"nh\" }");
    copy.is_refused(
        MANIFEST,
        Some(copy.line(MANIFEST, "facings")),
        "there is no definition `facings` in solution.vert, which has `p`",
        "solution.vert に定義 `facings` はありません",
    );
}

#[test]
fn a_solution_that_does_not_compile_is_named_by_its_line() {
    let copy = Copy::new().replace("solution.vert", "normalize(l + v)", "normalize(l + vv)");
    let line = copy.line("solution.vert", "(l + vv)");
    copy.is_refused("solution.vert", Some(line), "there is no variable `vv`", "変数 `vv` がありません");
}

#[test]
fn a_solution_of_undefined_values_is_refused() {
    let copy = Copy::new().replace("solution.vert", "float lambert = max(nl, 0.0);", "float lambert = pow(nl, 2.0);");
    let line = copy.line("solution.vert", "pow(nl, 2.0)");
    copy.is_refused(
        "solution.vert",
        Some(line),
        "is undefined, or no number: GLSL gives `pow` no value",
        "未定義か、数になりません",
    );
}

#[test]
fn what_is_no_text_is_named_by_its_line() {
    let copy = Copy::new();
    let mut bytes = fs::read(copy.path("fixed.frag")).unwrap();
    let line = bytes.iter().filter(|byte| **byte == b'\n').count() + 1;
    bytes.extend([b'/', b'/', 0xff]);
    fs::write(copy.path("fixed.frag"), &bytes).unwrap();
    copy.is_refused("fixed.frag", Some(line), "is not UTF-8", "UTF-8 ではありません");
    *bytes.last_mut().unwrap() = 0;
    fs::write(copy.path("fixed.frag"), &bytes).unwrap();
    copy.is_refused("fixed.frag", Some(line), "has a NUL", "NUL 文字があります");
}

#[test]
fn pictures_and_meshes_that_are_none_are_named_by_their_files() {
    let texture = "[[texture]]\nname = \"wood\"\nfile = \"fixed.frag\"\n\n[scene]";
    let copy = Copy::new().replace(MANIFEST, "[scene]", texture);
    copy.is_refused("fixed.frag", None, "is no PNG, or damaged", "PNG ではないか、壊れています");
    let triangle = "triangle = [[-1, -0.8660254, 0], [1, -0.8660254, 0], [0, 0.8660254, 0]]";
    let copy = Copy::new().replace(MANIFEST, triangle, "mesh = { file = \"a.obj\" }");
    fs::write(copy.path("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n").unwrap();
    copy.is_refused("a.obj", Some(3), "is not what OBJ has", "OBJ として正しくありません");
}

#[test]
fn a_link_out_of_the_folder_is_refused() {
    let copy = Copy::new();
    fs::write(copy.around.path().join("secret.txt"), "secret").unwrap();
    std::os::unix::fs::symlink("../secret.txt", copy.path("notes.txt")).unwrap();
    copy.is_refused("notes.txt", None, "leads out of the folder", "フォルダの外を指すリンク");
    // Within the folder a link is as good as the file.
    fs::remove_file(copy.path("notes.txt")).unwrap();
    std::os::unix::fs::symlink("solution.vert", copy.path("notes.txt")).unwrap();
    ggrade()
        .arg("grade")
        .arg(sample_like("accepted/answers", "plain-int-zero"))
        .arg("--assignment")
        .arg(copy.folder())
        .assert()
        .code(0);
}

#[test]
fn what_contradicts_itself_is_named_by_its_entry() {
    let copy = Copy::new().replace(MANIFEST, "keeps = { ambient = 0.5 }", "keeps = { ambient = 1.5 }");
    let line = copy.line(MANIFEST, "id = \"ambient-added\"");
    copy.is_refused(MANIFEST, Some(line), "mistake `ambient-added`: keeps 1.5", "0 から 1 の数");
}

#[test]
fn a_variant_that_cannot_be_made_is_named_with_its_line() {
    let toon = || Copy::of("tests/homeworks/toon");
    let outline = "\"< 0.3)\", \"< -2.0)\"";
    let line = toon().line(MANIFEST, outline);
    let refused = |from: &str, to: &str, en: &str, ja: &str| {
        toon().replace(MANIFEST, from, to).is_refused(MANIFEST, Some(line), en, ja);
    };
    refused(outline, "\"float\", \"int\"", "`float` stands 3 times in `solution.frag`", "3 回あります");
    refused(outline, "\"sparkle\", \"\"", "`sparkle` stands 0 times", "0 回あります");
    refused("replace = [[\"< 0.3)\", \"< -2.0)\"]]", "", "changes nothing: write `define`", "変わるものがありません");
    refused(outline, "\"< 0.3)\", \"< none)\"", "there is no variable `none`", "変数 `none` がありません");
    // A name of a definition where the solution's are not told apart says why they are not.
    let copy = toon().replace(MANIFEST, "id = \"outline\"\n", "id = \"outline\"\njudges = \"lit\"\n");
    let line = copy.line("solution.frag", "lit = floor");
    copy.is_refused("solution.frag", Some(line), "`lit` has a value already", "`lit` を使っています");
}

/// Without `--assignment` the names of the files say which homework it is; a folder on the way to a sample does as well.
#[test]
fn the_homework_is_found_by_the_names_of_the_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/assignments");
    let folder = tempfile::tempdir().unwrap();
    let graded = |files: &[&Path]| {
        let output = ggrade().arg("grade").args(files).args(["--format", "json"]).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap_or_default(), said)
    };
    let put = |name: &str, from: &str| {
        let path = folder.path().join(name);
        fs::copy(root.join(from), &path).unwrap();
        path
    };
    let (report, said) = graded(&[&put("Schlick.vert", "schlick/solution.vert")]);
    assert_eq!((&report["assignment"], report["score"].as_f64()), (&"schlick".into(), Some(100.0)), "{said}");
    assert_eq!(said, "");
    let both = [put("flat.vert", "flat/solution.vert"), put("flat.frag", "flat/solution.frag")];
    let (report, said) = graded(&[&both[0], &both[1]]);
    assert_eq!((&report["assignment"], report["score"].as_f64()), (&"flat".into(), Some(100.0)), "{said}");
    // Any other name is the first homework's, and that is said.
    let (report, said) = graded(&[&put("mine.vert", "ggsample06/solution.vert")]);
    assert_eq!((&report["assignment"], report["score"].as_f64()), (&"ggsample06".into(), Some(100.0)), "{said}");
    assert!(said.contains("graded as ggsample06 (Gouraud shading)") && said.contains("--assignment NAME"), "{said}");
    // Files of two homeworks are of none.
    let output = ggrade().arg("grade").arg(&both[0]).arg(folder.path().join("Schlick.vert")).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("Files of these names are handed in for flat, schlick."), "{said}");
    // A folder says it by the files in it, and a fragment shader of another name says nothing.
    let own = folder.path().join("mine");
    fs::create_dir(&own).unwrap();
    both.iter().for_each(|file| _ = fs::copy(file, own.join(file.file_name().unwrap())).unwrap());
    let (report, said) = graded(&[&own]);
    assert_eq!((&report["assignment"], report["score"].as_f64()), (&"flat".into(), Some(100.0)), "{said}");
    let (_, said) = graded(&[&put("mine.frag", "flat/solution.frag")]);
    assert!(said.contains("Built in: blinn (blinn.vert),"), "{said}");
    // What a homework extends is handed in for it as well.
    let three = [
        put("ggsample11.vert", "ggsample11-map/solution.vert"),
        put("ggsample11.frag", "ggsample11-map/solution.frag"),
    ];
    let (_, said) = graded(&[&three[0], &three[1]]);
    assert!(said.contains("handed in for ggsample11-map, ggsample11-pcf, ggsample11-vsm."), "{said}");
}

#[test]
fn every_command_says_what_is_wrong_with_a_folder() {
    let copy = Copy::new();
    fs::remove_file(copy.path("solution.vert")).unwrap();
    let file = sample_like("accepted/answers", "plain-int-zero");
    let out = copy.around.path().join("out");
    for arguments in [
        vec!["batch".into(), file.clone().into_os_string(), "--out".into(), out.into()],
        vec!["watch".into(), file.clone().into_os_string()],
        vec!["corpus".into(), "submissions/ggsample06/accepted".into()],
        vec!["serve".into(), "--listen".into(), "127.0.0.1:0".into()],
    ] {
        let output = ggrade().args(&arguments).arg("--assignment").arg(copy.folder()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains("solution.vert"), "{arguments:?}: {said}");
    }
}
