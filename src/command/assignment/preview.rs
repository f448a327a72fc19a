//! `ggrade assignment preview FOLDER`: the page that students will see, as the folder is while its teacher writes it.

use super::check::scored;
use crate::choice;
use crate::cli::{LogFormat, PreviewArguments as Arguments};
use crate::command::end_signals::EndSignals;
use crate::command::saves::{Save, Saves};
use crate::command::{ExitStatus, deadline, report_fault, serve};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::service::Config;
use crate::service::config::Timeouts;
use crate::service::identity::new_token;
use crate::service::preview::{OwnFiles, Preview};
use crate::service::submit::Receipt;
use std::path::Path;
use std::process::{Command, Stdio};

/// Shows the folder until it is interrupted; then nothing of the preview is left.
pub fn run(arguments: &Arguments, language: Language) -> Result<ExitStatus, Fault> {
    if !arguments.folder.is_dir() {
        let shown = arguments.folder.display();
        let text = Text::new(
            format!("{shown} is no folder; `ggrade assignment preview` takes the folder of an assignment"),
            format!("{shown} はフォルダではありません。ggrade assignment preview には課題のフォルダを指定してください"),
        );
        anstream::eprintln!("ggrade: {}", text.get(language));
        return Ok(ExitStatus::Usage);
    }
    if deadline(arguments.deadline, language).is_none() {
        return Ok(ExitStatus::Usage);
    }
    let place = tempfile::tempdir().map_err(|error| broken(&error))?;
    let config = config(arguments, place.path());
    serve::log(&config)?;
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().map_err(|error| broken(&error))?;
    let outcome = runtime.block_on(preview(arguments, config, language));
    // A version that is being made ready ends with this process.
    runtime.shutdown_background();
    outcome.map(|()| ExitStatus::FullMarks)
}

/// A service for one person at this machine.
fn config(arguments: &Arguments, place: &Path) -> Config {
    Config {
        listen: arguments.listen,
        database: place.join("preview.db").to_string_lossy().into_owned(),
        sandbox: arguments.sandbox,
        deadline: arguments.deadline,
        workers: 1,
        wait: 60.0,
        cross_check: false,
        teacher_token: Some(new_token()),
        log: "error".into(),
        log_format: LogFormat::Text,
        limits: Timeouts { drain_timeout: 1.0, request_timeout: 60.0, ..Timeouts::default() },
        ..Config::default()
    }
}

async fn preview(arguments: &Arguments, config: Config, language: Language) -> Result<(), Fault> {
    let mut ends = EndSignals::listen().map_err(|error| broken(&error))?;
    let mut preview = Preview::start(config).await?;
    let address = format!("http://{}/", preview.address);
    let said = Text::new(
        format!("{address}  shows {}; Ctrl-C ends it", arguments.folder.display()),
        format!("{address}  で {} を表示しています（終了は Ctrl-C）", arguments.folder.display()),
    );
    anstream::println!("{}", said.get(language));
    if !arguments.no_open {
        open_browser(&address);
    }
    let mut saves = Saves::below(&arguments.folder);
    loop {
        tokio::select! {
            () = ends.any() => break,
            () = next(&mut preview, &mut saves, &arguments.folder, language) => {}
        }
    }
    preview.end().await;
    Ok(())
}

/// Waits for the next save, and shows what the folder is then.
async fn next(preview: &mut Preview, saves: &mut Saves, folder: &Path, language: Language) {
    let loaded = match saves.next().await {
        Save::Unreadable(reason) => Err(reason),
        Save::Content(_) | Save::Gone => {
            let folder = folder.to_owned();
            let loaded = tokio::task::spawn_blocking(move || choice::folder(&folder)).await;
            loaded.unwrap_or_else(|panic| Err(Text::verbatim(panic.to_string())))
        }
    };
    // The next save is shown in a moment.
    if saves.is_outdated() {
        return;
    }
    let why = loaded.as_ref().err().cloned();
    match preview.show(loaded).await {
        Ok(Some(own)) => say(&own, language),
        Ok(None) => {}
        Err(fault) => {
            report_fault(&fault);
            let _ = preview.show(Err(fault.message)).await;
        }
    }
    if let Some(why) = why {
        anstream::println!("{}", why.get(language));
    }
}

/// Says what the folder's own files score.
fn say(own: &OwnFiles, language: Language) {
    let scored = |en, ja, receipt: &Receipt| match (receipt.report(), receipt.fault()) {
        (Some(report), _) => Some(scored(en, ja, report)),
        (None, fault) => {
            fault.map(|fault| Text::new(format!("{en}: {}", fault.message.en), format!("{ja}: {}", fault.message.ja)))
        }
    };
    let solution = scored("the solution", "解答", &own.solution);
    let starter = scored("what is handed out", "配布ファイル", &own.starter);
    for text in [solution, starter].into_iter().flatten() {
        anstream::println!("{}", text.get(language));
    }
}

/// Asks the desktop for a browser; without one, the address has been said.
fn open_browser(address: &str) {
    if ["DISPLAY", "WAYLAND_DISPLAY"].into_iter().all(|name| std::env::var_os(name).is_none()) {
        return;
    }
    let mut command = Command::new("xdg-open");
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Ok(mut browser) = command.spawn() {
        std::thread::spawn(move || browser.wait());
    }
}

fn broken(error: &dyn std::error::Error) -> Fault {
    Fault::new(Text::new(format!("cannot preview: {error}"), format!("プレビューできません: {error}")))
}
