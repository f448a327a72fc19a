//! `ggrade assignment new`: the folder of a homework, written from a solution.

use super::super::{ExitStatus, file_fault, writing};
use crate::cli::NewArguments;
use crate::fault::Fault;
use crate::language::{Language, Text};
use reference::proposal::{self, Given, Proposal, ProposalRemark, RemarkKind, SCHEMA};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes the folder, and says what was read and guessed.
pub fn run(arguments: &NewArguments, language: Language) -> Result<ExitStatus, Fault> {
    let refused = |text: &Text| {
        anstream::eprintln!("ggrade: {}", text.get(language));
        Ok(ExitStatus::Usage)
    };
    let folder = &arguments.folder;
    if let Err(text) = is_free(folder) {
        return refused(&text);
    }
    if arguments.from.is_empty() {
        return refused(&nothing_given(folder));
    }
    let given = match arguments.from.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>() {
        Ok(given) => given,
        Err(text) => return refused(&text),
    };
    let name = folder.file_name().map_or_else(|| "homework".into(), |name| name.to_string_lossy());
    let proposal = match proposal::propose(&proposal::id_of(&name), &given) {
        Ok(proposal) => proposal,
        Err(error) => {
            let text = error.text();
            return refused(&text.into());
        }
    };
    write(folder, &proposal).map_err(|(path, error)| file_fault(&writing(), &path, &error))?;
    proposal.remarks.iter().for_each(|remark| tell(remark, language));
    Ok(finish(folder, &proposal, language))
}

/// Nothing may be overwritten.
fn is_free(folder: &Path) -> Result<(), Text> {
    match fs::read_dir(folder).map(|mut entries| entries.next().is_none()) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Ok(true) => Ok(()),
        _ => Err(Text::new(
            format!("{} exists and is not an empty folder: name another one; nothing was written", folder.display()),
            format!(
                "{} はすでにあり、空のフォルダではありません。別の名前を指定してください。何も書き込んでいません",
                folder.display()
            ),
        )),
    }
}

fn nothing_given(folder: &Path) -> Text {
    let shown = folder.display();
    let example = format!("ggrade assignment new {shown} --from solution.frag");
    Text::new(
        format!(
            "from which solution? `{example}` takes a fragment shader, `--from solution.vert` a vertex shader, both together a \
             homework of two files, and `--from NAME.shader_test` a test of piglit"
        ),
        format!(
            "解答を指定してください。`{example}` のように、フラグメントシェーダ、頂点シェーダ (`--from solution.vert`)、その両方、\
             または piglit のテスト (`--from 名前.shader_test`) から作ります"
        ),
    )
}

fn read(path: &Path) -> Result<Given, Text> {
    let shown = path.display();
    let bytes = fs::read(path).map_err(|error| {
        Text::new(
            format!("--from {shown}: cannot be read: {error}"),
            format!("--from {shown}: 読み込めません: {error}"),
        )
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
        Text::new(
            format!("--from {shown}, line {line}: is not UTF-8: save the file in that encoding"),
            format!("--from {shown} の {line} 行目: UTF-8 ではありません。UTF-8 で保存してください"),
        )
    })?;
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    Ok(Given { name, text })
}

fn write(folder: &Path, proposal: &Proposal) -> Result<(), (PathBuf, io::Error)> {
    let at = |path: &Path| {
        let path = path.to_owned();
        move |error| (path, error)
    };
    fs::create_dir_all(folder).map_err(at(folder))?;
    let schema = reference::schema::text();
    let files = proposal.folder.files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
    for (name, bytes) in files.chain([(SCHEMA, schema.as_bytes())]) {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(at(&path))?;
    }
    Ok(())
}

fn tell(remark: &ProposalRemark, language: Language) {
    let word = match remark.kind {
        RemarkKind::Read => Text::new("read ", "読取"),
        RemarkKind::Guessed => Text::new("guess", "推測"),
        RemarkKind::Attention => Text::new("look ", "確認"),
    };
    let text = Text::new(&remark.text.en, &remark.text.ja);
    anstream::println!("{} {}", word.get(language), text.get(language));
}

/// Says what is next.
fn finish(folder: &Path, proposal: &Proposal, language: Language) -> ExitStatus {
    let shown = folder.display();
    if let Some(trouble) = &proposal.trouble {
        let why = trouble.text();
        let text = Text::new(
            format!("{shown} is written, and does not grade yet: {}", why.en),
            format!("{shown} を書きましたが、まだ採点できません: {}", why.ja),
        );
        anstream::eprintln!("ggrade: {}", text.get(language));
        return ExitStatus::Usage;
    }
    let text = Text::new(
        format!(
            "wrote {shown}. Next:\n  ggrade assignment check {shown}      does it grade?\n  ggrade assignment preview {shown}    \
             the page that students see\n  {shown}/assignment.toml             title, task, values, points, mistakes"
        ),
        format!(
            "{shown} を書きました。次にすること:\n  ggrade assignment check {shown}      採点できるか確かめる\n  \
             ggrade assignment preview {shown}    学生の見るページを開く\n  {shown}/assignment.toml             \
             題名、課題文、値、配点、誤りを直す"
        ),
    );
    anstream::println!("{}", text.get(language));
    ExitStatus::FullMarks
}
