//! A class that no cache has seen: the samples of `submissions/ggsample06/`, each with a number of its own in its code.

use std::path::{Path, PathBuf};

/// A file handed in.
#[derive(Clone, Debug)]
pub struct Submission {
    pub name: String,
    pub text: String,
}

/// So many right answers, no two alike.
pub fn right_answers(count: usize) -> Vec<Submission> {
    distinct(&samples("accepted/answers"), count, 0)
}

/// So many submissions: of ten, seven are right, two wrong and one does not compile.
pub fn submissions(count: usize) -> Vec<Submission> {
    let [right, wrong, rejected] = [("accepted/answers", 7), ("wrong", 2), ("rejected", 1)]
        .map(|(folder, share)| distinct(&samples(folder), (count * share).div_ceil(10), 1_000_000));
    let (mut right, mut wrong, mut rejected) = (right.into_iter(), wrong.into_iter(), rejected.into_iter());
    (0..count)
        .filter_map(|index| match index % 10 {
            3 | 7 => wrong.next(),
            9 => rejected.next(),
            _ => right.next(),
        })
        .collect()
}

/// Texts of the samples in a folder, in order of name.
fn samples(folder: &str) -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06").join(folder);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "vert"));
    files.sort();
    let text =
        |file: &PathBuf| Some((file.file_stem()?.to_string_lossy().into_owned(), std::fs::read_to_string(file).ok()?));
    // A class has the version of its hand-out; the compiler makes and keeps tables of its own for each other one.
    files
        .iter()
        .filter_map(text)
        .filter(|(_, text)| text.contains("#version 410") && changed(text, 0).is_some())
        .collect()
}

fn distinct(samples: &[(String, String)], count: usize, first: usize) -> Vec<Submission> {
    assert!(samples.len() > 10, "only {} samples", samples.len());
    (0..count)
        .filter_map(|index| {
            let (name, text) = &samples[index % samples.len()];
            Some(Submission { name: format!("{name}-{index}.vert"), text: changed(text, first + index)? })
        })
        .collect()
}

/// The text with a number that decides nothing, in a branch that no compiler can leave out.
fn changed(text: &str, number: usize) -> Option<String> {
    let end = text.rfind('}')?;
    let main = text.find("main")?;
    let reads = main < end && text.contains("pv") && text.contains("vc");
    reads.then(|| format!("{}  if (pv.w < -{number}.5) vc *= 0.5;\n{}", &text[..end], &text[end..]))
}
