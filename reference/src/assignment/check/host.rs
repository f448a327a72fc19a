//! Programs that are handed in instead of shaders: they are read as shaders before anything else.

use super::{CheckResult, solution};
use crate::AssignmentError;
use crate::assignment::{HandedIn, HostProgram, MANIFEST, Solution, error};
use crate::host::{HostArray, Notice, UnreadableProgram};
use crate::interpreter::Stage;
use crate::manifest;
use crate::text::both;

/// The solution as a shader, and how what is handed in becomes one, where the file is a program.
pub(super) fn program(
    file: &manifest::File,
    files: usize,
    written: Solution,
    read: &dyn Fn(&str) -> CheckResult<String>,
) -> CheckResult<(Solution, Option<HostProgram>)> {
    let Some(entry) = &file.array else { return Ok((written, None)) };
    if file.stage != Stage::Vertex || files > 1 {
        let message = both(
            "of a program only a vertex stage is made, and nothing else is handed in beside it",
            "プログラムから作れるのは頂点シェーダだけで、ほかのファイルとは一緒に提出できません",
        );
        return Err(error(format!("{MANIFEST}, file.array"), message));
    }
    let mut array = HostArray::new(&entry.name, &entry.used_by, entry.count);
    array.given.clone_from(&entry.given);
    array.written_in.clone_from(&entry.written_in);
    array.notices = entry.notice.iter().map(notice).collect();
    let array = array.with_shader(&read(&entry.shader)?).map_err(|what| error(&entry.shader, what))?;
    let as_shader = |name: &str, text: &str| {
        let wrong = |what: UnreadableProgram| error(solution::place(name, what.line.unwrap_or_default()), what.message);
        array.read(text).map(|listing| listing.shader).map_err(wrong)
    };
    let starter = as_shader(&file.starter, &read(&file.starter)?)?;
    let text = as_shader(&written.name, &written.text)?;
    let shader = Solution { text, name: written.name };
    Ok((shader, Some(HostProgram { array, solution: written.text, starter })))
}

fn notice(entry: &manifest::NoticeEntry) -> Notice {
    Notice { code: entry.code.clone(), is_absent: entry.absent, message: entry.message.clone() }
}

/// Whether a program is judged by definitions of its shader: only then it is known which uniforms its numbers stand for.
/// `why`: why the solution is no list of definitions, where it is none.
pub(super) fn is_known(files: &[HandedIn], why: Option<&AssignmentError>) -> CheckResult<()> {
    let file = files.iter().find(|file| file.program.is_some());
    let (Some(_), Some(why)) = (file, why) else { return Ok(()) };
    let message = both(
        format!("{}; `main` of the shader of `array` has to be a list of definitions", why.message.en),
        format!("{} (`array` のシェーダの `main` は、定義を並べた形にしてください)", why.message.ja),
    );
    Err(AssignmentError { message, ..why.clone() })
}
