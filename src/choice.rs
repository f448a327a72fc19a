//! Which assignment is meant: one that is built in, by its name, or one in a folder.

use crate::language::Text;
use crate::sandbox::MOST_ASSIGNMENTS;
use reference::assignment::HandedIn;
use reference::{Assignment, Folder};
use std::path::Path;
use std::sync::Arc;

/// The assignment that `--assignment` names; without it, the built-in one whose files these are, as far as they are known.
///
/// # Errors
/// What to tell who asked: there is no such assignment, or its folder is broken.
pub fn assignment(asked: Option<&str>, files: &[&str]) -> Result<Arc<Assignment>, Text> {
    match asked {
        Some(asked) => named(asked),
        None => fitting(files),
    }
}

/// The assignments of a service: those that are named, or else all that are built in. What is named twice is there once.
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
        all.extend(reference::assignments().cloned());
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

/// The built-in assignment that these files are for: by their names, or else by their stages. The only one there is takes
/// any file: what is wrong with it is said in its report.
fn fitting(files: &[&str]) -> Result<Arc<Assignment>, Text> {
    let is_named = |slot: &HandedIn| files.contains(&slot.name.as_str());
    let is_of_stage = |slot: &HandedIn| files.iter().any(|file| extension(file) == extension(&slot.name));
    let fit = |fits: &dyn Fn(&HandedIn) -> bool| {
        let mut fitting = reference::assignments().filter(|assignment| assignment.files.iter().any(fits));
        fitting.next().filter(|_| fitting.next().is_none())
    };
    let only = || fit(&|_| true);
    fit(&is_named).or_else(only).or_else(|| fit(&is_of_stage)).cloned().ok_or_else(|| {
        let list = list();
        Text::new(
            format!("which assignment is it? Say so with --assignment NAME or --assignment FOLDER. {}", list.en),
            format!(
                "課題を特定できません。--assignment 名前 または --assignment フォルダ で指定してください。{}",
                list.ja
            ),
        )
    })
}

fn extension(name: &str) -> Option<&str> {
    Path::new(name).extension()?.to_str()
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
