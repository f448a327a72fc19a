//! Which assignment is meant: one that is built in, by its name, or one in a folder.

use crate::language::Text;
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

fn named(asked: &str) -> Result<Arc<Assignment>, Text> {
    // A name goes first: `./NAME` is the folder of that name.
    if let Some(built_in) = reference::assignment(asked) {
        return Ok(Arc::clone(built_in));
    }
    let folder = Path::new(asked);
    if !folder.is_dir() {
        let list = list();
        return Err(Text::new(
            format!("--assignment {asked}: there is no built-in assignment and no folder of this name. {}", list.en),
            format!("--assignment {asked}: この名前の課題は組み込まれておらず、フォルダもありません。{}", list.ja),
        ));
    }
    let loaded = Folder::read(folder).and_then(Assignment::load);
    loaded.map(Arc::new).map_err(|error| {
        let (shown, why) = (folder.display(), error.text());
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
