//! `ggrade serve`.

use super::{ExitStatus, language};
use crate::choice;
use crate::cli::{LogFormat, ServeArguments};
use crate::fault::Fault;
use crate::language::Text;
use crate::service::identity::SHORTEST_PASSWORD;
use crate::service::{Config, server};
use reference::Assignment;
use std::io::{BufRead, IsTerminal, Write};
use std::sync::Arc;
use tracing_subscriber::EnvFilter;

/// Serves until it is told to end.
pub fn run(arguments: &ServeArguments) -> Result<ExitStatus, Fault> {
    let config = match Config::load(arguments) {
        Ok(config) => config,
        Err(fault) => {
            anstream::eprintln!("ggrade: {}", fault.message.get(language(None)));
            return Ok(ExitStatus::Usage);
        }
    };
    if arguments.healthcheck {
        return check_health(&config);
    }
    let runtime = runtime()?;
    let found = match choice::assignments(&config.assignment) {
        Ok(assignments) => match runtime.block_on(unknown_token(&config, &assignments))? {
            None => Ok(assignments),
            Some(text) => Err(text),
        },
        Err(text) => Err(text),
    };
    let assignments = match found {
        Ok(assignments) => assignments,
        Err(text) => {
            anstream::eprintln!("ggrade: {}", text.get(language(None)));
            return Ok(ExitStatus::Usage);
        }
    };
    if arguments.set_teacher_password {
        return set_password(&config, &runtime);
    }
    log(&config)?;
    runtime.block_on(async {
        let started = server::start(config, assignments).await?;
        welcome(&started);
        started.serve().await
    })?;
    Ok(ExitStatus::FullMarks)
}

fn runtime() -> Result<tokio::runtime::Runtime, Fault> {
    let built = tokio::runtime::Builder::new_multi_thread().enable_all().build();
    built.map_err(|error| Fault::new(Text::verbatim(format!("threads: {error}"))))
}

/// Asks the service of a configuration whether it takes uploads.
fn check_health(config: &Config) -> Result<ExitStatus, Fault> {
    let url = server::readiness_address(config.listen);
    runtime()?.block_on(server::ready(&url)).map_err(|failure| {
        Fault::new(Text::new(
            format!("the service does not take uploads: {failure}"),
            format!("サービスは提出を受け付けていません: {failure}"),
        ))
    })?;
    anstream::println!("{}", Text::new("ready", "提出を受け付けています").get(language(None)));
    Ok(ExitStatus::FullMarks)
}

/// What is wrong with the tokens of homeworks: each is for one that is named, or whose folder was uploaded to the first course.
async fn unknown_token(config: &Config, assignments: &[Arc<Assignment>]) -> Result<Option<Text>, Fault> {
    let mut known: Vec<String> = assignments.iter().map(|assignment| assignment.id.clone()).collect();
    let is_unknown = |known: &[String]| config.homework_tokens.keys().find(|name| !known.contains(name)).cloned();
    if is_unknown(&known).is_none() {
        return Ok(None);
    }
    for id in server::uploaded(config).await? {
        if !known.contains(&id) {
            known.push(id);
        }
    }
    Ok(is_unknown(&known).map(|name| {
        let served = known.join(", ");
        Text::new(
            format!("a token is for the homework `{name}`, which is not served. Served: {served}."),
            format!("トークンが指定された課題「{name}」は、このサービスにありません。ある課題: {served}。"),
        )
    }))
}

/// Says where the service is, for whoever started it.
fn welcome(started: &server::Started) {
    let address = &started.address;
    if !started.service.config.role.serves_pages() {
        anstream::eprintln!("Grader:    http://{address}/healthz");
        return;
    }
    let database = &started.service.config.location().map(|location| location.to_string()).unwrap_or_default();
    let public = started.service.config.public_url.clone().unwrap_or_else(|| format!("http://{address}"));
    let public = public.trim_end_matches('/');
    let text = Text::new(
        format!("Students:  {public}/\nTeachers:  {public}/teacher\nDatabase:  {database}"),
        format!("学生用:       {public}/\n教員用:       {public}/teacher\nデータベース: {database}"),
    );
    anstream::eprintln!("{}", text.get(language(None)));
    if let Some(token) = &started.one_time_token {
        let text = Text::new(
            format!(
                "Log in with the token {token}\n(new at each start, until somebody has an account: make yours at {public}/teacher/people)"
            ),
            format!(
                "トークン {token} でログインできます\n(アカウントを作成するまで、起動のたびに変わります。作成は {public}/teacher/people で行います)"
            ),
        );
        anstream::eprintln!("{}", text.get(language(None)));
    }
}

fn set_password(config: &Config, runtime: &tokio::runtime::Runtime) -> Result<ExitStatus, Fault> {
    let language = language(None);
    if std::io::stdin().is_terminal() {
        let prompt = Text::new(
            "New password of the teacher (it is shown while you type): ",
            "教員用の新しいパスワード (入力した文字は表示されます): ",
        );
        anstream::eprint!("{}", prompt.get(language));
        let _ = std::io::stderr().flush();
    }
    let mut line = String::new();
    let read = std::io::stdin().lock().read_line(&mut line);
    let password = line.trim_end_matches(['\r', '\n']);
    if read.is_err() || password.chars().count() < SHORTEST_PASSWORD {
        let text = Text::new(
            format!("a password has at least {SHORTEST_PASSWORD} characters; nothing was changed"),
            format!("パスワードは {SHORTEST_PASSWORD} 文字以上にしてください。変更していません"),
        );
        anstream::eprintln!("ggrade: {}", text.get(language));
        return Ok(ExitStatus::Usage);
    }
    runtime.block_on(server::set_teacher_password(config, password))?;
    let text = Text::new(
        "The password is set; every teacher has to log in again.",
        "パスワードを設定しました。ログイン中の教員は、ログインし直す必要があります。",
    );
    anstream::eprintln!("{}", text.get(language));
    Ok(ExitStatus::FullMarks)
}

/// Writes the log to standard error: never a byte of what a student wrote.
pub(super) fn log(config: &Config) -> Result<(), Fault> {
    let filter = EnvFilter::try_new(&config.log).map_err(|error| {
        Fault::new(Text::new(
            format!("--log {}: {error}", config.log),
            format!("--log {} が正しくありません: {error}", config.log),
        ))
    })?;
    let log = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal());
    match config.log_format {
        LogFormat::Text => log.init(),
        LogFormat::Json => log.json().init(),
    }
    Ok(())
}
