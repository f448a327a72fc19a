//! Which assignment is meant: one that is built in, by its name, or one in a folder.

use crate::intake::{self, HandInPart, IntakeOptions};
use crate::language::Text;
use crate::sandbox::MOST_ASSIGNMENTS;
use crate::slots;
use reference::interpreter::Stage;
use reference::{Assignment, Folder};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The homework that is meant where nothing says which: the one that this program began with.
const DEFAULT: &str = "ggsample06";

/// The assignment that was found for a command line.
pub struct Choice {
    /// It.
    pub assignment: Arc<Assignment>,
    /// What to tell who asked, where neither an option nor the names of the files say that it is this one.
    pub notice: Option<Text>,
}

/// The assignment that `--assignment` names; without it, the built-in one whose files these are.
///
/// # Errors
/// What to tell who asked: there is no such assignment, its folder is broken, or the files are of several homeworks.
pub fn assignment(asked: Option<&str>, files: &[PathBuf]) -> Result<Choice, Text> {
    match asked {
        Some(asked) => Ok(Choice { assignment: named(asked)?, notice: None }),
        None => fitting(files),
    }
}

/// The homework that is meant where nothing says which.
pub fn default() -> &'static Arc<Assignment> {
    reference::assignment(DEFAULT).unwrap_or_else(|| unreachable!("{DEFAULT} is built in"))
}

/// The assignments of a service: those that are named, or else the one that is meant where nothing says which. What is named
/// twice is there once.
///
/// # Errors
/// What to tell who asked: one of them is no assignment, two that differ have one id, or there are too many.
pub fn assignments(asked: &[String]) -> Result<Vec<Arc<Assignment>>, Text> {
    let mut all: Vec<Arc<Assignment>> = Vec::new();
    for asked in asked {
        let assignment = named(asked)?;
        match all.iter().find(|known| known.id == assignment.id) {
            None => all.push(assignment),
            Some(known) if known.digest == assignment.digest => {}
            Some(_) => return Err(same_id(asked, &assignment.id)),
        }
    }
    if asked.is_empty() {
        all.push(Arc::clone(default()));
    }
    if all.len() > MOST_ASSIGNMENTS {
        return Err(Text::new(
            format!("{} assignments: one service serves at most {MOST_ASSIGNMENTS}. Start another one.", all.len()),
            format!(
                "課題が {} 個あります。1 つのサービスで扱えるのは {MOST_ASSIGNMENTS} 個までです。サービスを分けてください。",
                all.len()
            ),
        ));
    }
    Ok(all)
}

/// The refusal of an assignment whose id another one has.
fn same_id(asked: &str, id: &str) -> Text {
    Text::new(
        format!(
            "--assignment {asked}: another assignment has the same id, `{id}`, and other content. Give one of them another \
             `id` in its assignment.toml, or leave one out."
        ),
        format!(
            "--assignment {asked}: 別の内容の課題が、同じ id「{id}」を使っています。一方の assignment.toml の `id` を変えるか、\
             一方だけを指定してください。"
        ),
    )
}

fn named(asked: &str) -> Result<Arc<Assignment>, Text> {
    // A name goes first: `./NAME` is the folder of that name.
    if let Some(built_in) = reference::assignment(asked) {
        return Ok(Arc::clone(built_in));
    }
    let path = Path::new(asked);
    if !path.is_dir() {
        let list = list();
        return Err(Text::new(
            format!("--assignment {asked}: there is no built-in assignment and no folder of this name. {}", list.en),
            format!("--assignment {asked}: この名前の課題は組み込まれておらず、フォルダもありません。{}", list.ja),
        ));
    }
    folder(path)
}

/// The assignment in a folder.
///
/// # Errors
/// What to tell its teacher: what is wrong in which file, and what to try.
pub fn folder(path: &Path) -> Result<Arc<Assignment>, Text> {
    let loaded = Folder::read(path).and_then(Assignment::load);
    loaded.map(Arc::new).map_err(|error| {
        let (shown, why) = (path.display(), error.text());
        Text::new(
            format!("the folder {shown} is not an assignment: {}", why.en),
            format!("フォルダ {shown} は課題として使えません: {}", why.ja),
        )
    })
}

/// The built-in assignment that these files are for: by their names, by a folder on the way to them, or else the usual one,
/// which takes one vertex shader of any name: what is wrong with it is said in its report.
fn fitting(paths: &[PathBuf]) -> Result<Choice, Text> {
    let names: Vec<String> = paths.iter().flat_map(|path| names(path)).collect();
    let fitting = reference::built_in::handing_in(&names);
    let chosen = |name: &str| reference::assignment(name).cloned();
    if let Some(assignment) = Some(&fitting).filter(|fitting| fitting.len() == 1).and_then(|fitting| chosen(fitting[0]))
    {
        return Ok(Choice { assignment, notice: None });
    }
    let folders = paths.iter().filter_map(|path| path.parent()).flat_map(|folder| folder.iter().rev());
    let on_the_way = folders.filter_map(|folder| folder.to_str()).find_map(chosen);
    if let Some(assignment) = on_the_way {
        return Ok(Choice { assignment, notice: None });
    }
    if fitting.is_empty() && !names.iter().any(|name| slots::tells(name, Stage::Fragment)) {
        let assignment = Arc::clone(default());
        let Assignment { id, title, .. } = &*assignment;
        let notice = names.first().map(|name| {
            Text::new(
                format!("no homework has a file `{name}`: it is graded as {id} ({}). Another one: --assignment NAME", title.en),
                format!("`{name}` というファイルの課題はないので、{id}（{}）として採点します。ほかの課題: --assignment 名前", title.ja),
            )
        });
        return Ok(Choice { assignment, notice });
    }
    let list = if fitting.is_empty() { list() } else { candidates(&fitting) };
    Err(Text::new(
        format!("which assignment is it? Say so with --assignment NAME or --assignment FOLDER. {}", list.en),
        format!("課題を特定できません。--assignment 名前 または --assignment フォルダ で指定してください。{}", list.ja),
    ))
}

/// The names of the files that a path stands for: its own, or those in the folder or archive that it is.
fn names(path: &Path) -> Vec<String> {
    if path.is_dir() || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("zip")) {
        return intake::names(vec![HandInPart::Path(path.into())], &IntakeOptions::new(default()));
    }
    path.file_name().map(|name| name.to_string_lossy().into_owned()).into_iter().collect()
}

/// Several built-in assignments whose files have these names, in one sentence.
fn candidates(names: &[&str]) -> Text {
    let names = names.join(", ");
    Text::new(
        format!("Files of these names are handed in for {names}."),
        format!("同じ名前のファイルを提出する課題: {names}。"),
    )
}

/// The built-in assignments, each with its files, in one sentence.
fn list() -> Text {
    let each = reference::assignments().map(|assignment| {
        let files: Vec<_> = assignment.files.iter().map(|file| file.name.as_str()).collect();
        format!("{} ({})", assignment.id, files.join(", "))
    });
    let all = each.collect::<Vec<_>>().join(", ");
    Text::new(format!("Built in: {all}."), format!("組み込みの課題: {all}。"))
}
