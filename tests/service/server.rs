//! The server over HTTP: slow clients, large bodies, its end, its configuration.

use crate::cluster::Database;
use crate::process::{Server, command, hand_in, look_up};
use crate::{on_both, right_and_new};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};

on_both!(what_is_under_way_is_finished_before_the_end);

async fn what_is_under_way_is_finished_before_the_end(database: Database) {
    let server = Server::start(&database);
    let client = reqwest::Client::new();
    let mut uploads = tokio::task::JoinSet::new();
    for _ in 0..12 {
        let (client, address) = (client.clone(), server.address.clone());
        uploads.spawn(async move { hand_in(&client, &address, right_and_new()).await });
    }
    // Some are stored, and fewer are graded.
    let first = uploads.join_next().await.expect("an upload").expect("a task");
    let ended = tokio::task::spawn_blocking(move || server.terminate());
    let mut told: Vec<_> = first.into_iter().collect();
    while let Some(upload) = uploads.join_next().await {
        told.extend(upload.expect("a task"));
    }
    assert!(ended.await.expect("a thread").success());
    assert!(told.iter().all(|(status, _)| matches!(status, 201 | 202 | 503)), "{told:?}");
    let server = Server::start(&database);
    for (_, json) in told.iter().filter(|(status, _)| *status != 503) {
        let id = json["id"].as_str().expect("an id");
        let mut state = json["state"].clone();
        for _ in 0..300 {
            if state == "graded" {
                break;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
            state = look_up(&client, &server.address, id).await["state"].clone();
        }
        assert_eq!(state, "graded", "{id}");
    }
}

/// A server that has little patience.
fn impatient(database: &Database) -> Server {
    let mut command = command(database);
    for (name, seconds) in [("HEADER_TIMEOUT", "1"), ("REQUEST_TIMEOUT", "2"), ("WRITE_TIMEOUT", "1")] {
        command.env(format!("GGRADE_LIMITS_{name}"), seconds);
    }
    Server::of(command.env("GGRADE_WAIT", "1"))
}

/// Reads until the other side ends the connection; nothing where it never does.
fn read_to_end(mut stream: &TcpStream) -> Option<String> {
    stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a timeout");
    let mut bytes = Vec::new();
    match stream.read_to_end(&mut bytes) {
        Ok(_) => Some(String::from_utf8_lossy(&bytes).into_owned()),
        Err(error) if error.kind() == std::io::ErrorKind::ConnectionReset => Some(String::new()),
        Err(_) => None,
    }
}

#[test]
fn who_is_slow_is_cut_off_and_keeps_nobody_waiting() {
    let database = Database::sqlite();
    let server = impatient(&database);
    let connect = || TcpStream::connect(server.socket()).expect("a connection");
    let start = "POST /api/v1/submissions HTTP/1.1\r\nHost: x\r\nContent-Type: text/plain\r\n";
    // One says nothing, one half a head, one a head and half a body; one has been answered and goes on in silence.
    let (silent, half, body, idle) = (connect(), connect(), connect(), connect());
    (&half).write_all(start.as_bytes()).expect("sent");
    (&body).write_all(format!("{start}Content-Length: 1000\r\n\r\nhalf").as_bytes()).expect("sent");
    (&idle).write_all(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n").expect("sent");
    // One asks for much and takes nothing.
    let deaf = connect();
    let asking = deaf.try_clone().expect("a connection");
    let asks = std::thread::spawn(move || {
        let request = b"GET /api/docs/swagger-ui-bundle.js HTTP/1.1\r\nHost: x\r\n\r\n".repeat(40);
        (&asking).write_all(&request).is_ok()
    });
    // Meanwhile the others are served.
    let answer = connect();
    (&answer).write_all(b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n").expect("sent");
    assert!(read_to_end(&answer).expect("an end").starts_with("HTTP/1.1 200"));

    for stream in [&silent, &half] {
        let end = read_to_end(stream).expect("the connection ends");
        assert!(end.is_empty() || end.starts_with("HTTP/1.1 4"), "{end}");
    }
    let end = read_to_end(&body).expect("the connection ends");
    assert!(end.starts_with("HTTP/1.1 408") && end.contains("application/problem+json"), "{end}");
    assert!(read_to_end(&idle).expect("the connection ends").starts_with("HTTP/1.1 200"));
    asks.join().expect("a thread");
    std::thread::sleep(Duration::from_secs(3));
    // What lay in the kernel's buffers comes, and then the end: not all of what was asked for.
    deaf.set_read_timeout(Some(Duration::from_secs(30))).expect("a timeout");
    let mut taken = 0;
    let mut buffer = vec![0; 1 << 16];
    while let Ok(count) = (&deaf).read(&mut buffer) {
        if count == 0 {
            break;
        }
        taken += count;
    }
    assert!(taken < 40 * 1_000_000, "{taken} bytes");
}

/// Asks over a connection that stays open; whether there is an answer, and not the end.
fn is_answered(mut stream: &TcpStream) -> bool {
    stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a timeout");
    // The other side may have ended it before the question.
    let asked = stream.write_all(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n");
    let mut start = [0; 12];
    asked.is_ok() && stream.read_exact(&mut start).is_ok() && start == *b"HTTP/1.1 200"
}

#[test]
fn one_address_cannot_take_every_connection() {
    let database = Database::sqlite();
    let mut command = command(&database);
    // Nobody is cut off for being slow, however busy the machine is.
    let server = Server::of(
        command.env("GGRADE_LIMITS_CONNECTIONS_PER_ADDRESS", "40").env("GGRADE_LIMITS_HEADER_TIMEOUT", "600"),
    );
    let open: Vec<TcpStream> = (0..60).map(|_| TcpStream::connect(server.socket()).expect("a connection")).collect();
    assert_eq!(open.iter().filter(|stream| is_answered(stream)).count(), 40);
    // Afterwards there is room again, as soon as the server has seen the ends.
    drop(open);
    let give_up = Instant::now() + Duration::from_secs(60);
    while !is_answered(&TcpStream::connect(server.socket()).expect("a connection")) {
        assert!(Instant::now() < give_up, "nobody is let in any more");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn heads_and_bodies_have_their_size() {
    let database = Database::sqlite();
    let server = impatient(&database);
    let send = |head: &str, body: &[u8]| {
        let stream = TcpStream::connect(server.socket()).expect("a connection");
        // The server may have answered and gone before everything is sent.
        let _ = (&stream).write_all(head.as_bytes()).and_then(|()| (&stream).write_all(body));
        read_to_end(&stream).expect("an end")
    };
    let long = "x".repeat(100_000);
    let end = send(&format!("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Long: {long}\r\n\r\n"), b"");
    assert!(end.is_empty() || end.starts_with("HTTP/1.1 4"), "{end}");
    let head = "POST /api/v1/submissions HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Type: text/plain\r\n";
    let end = send(&format!("{head}Content-Length: 2000000\r\n\r\n"), &vec![b'x'; 1_100_000]);
    assert!(end.is_empty() || end.starts_with("HTTP/1.1 413"), "{end}");
    let end = send(&format!("{head}Transfer-Encoding: chunked\r\n\r\nnonsense\r\n"), b"");
    assert!(end.is_empty() || end.starts_with("HTTP/1.1 4"), "{end}");
    assert!(send("GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n", b"").starts_with("HTTP/1.1 200"));
}

fn output(command: &mut std::process::Command) -> (Option<i32>, String) {
    let Output { status, stderr, .. } = command.stdin(Stdio::null()).stdout(Stdio::null()).output().expect("a process");
    (status.code(), String::from_utf8_lossy(&stderr).into_owned())
}

#[test]
fn a_file_is_served_by_one_process() {
    let database = Database::sqlite();
    let _server = Server::start(&database);
    let (code, said) = output(&mut command(&database));
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("another ggrade serve"), "{said}");
}

#[test]
fn a_database_that_does_not_answer_is_named_without_its_password() {
    let url = "postgres://ta:SECRET@127.0.0.1:1/course";
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ggrade"));
    let (code, said) = output(command.args(["serve", "--listen", "127.0.0.1:0", "--database", url]).env("LANG", "C"));
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("postgres://127.0.0.1:1/course") && said.contains("refused"), "{said}");
    assert!(!said.contains("SECRET"), "{said}");
}

#[test]
fn flags_go_before_the_environment_and_the_environment_before_the_file() {
    let database = Database::sqlite();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ggrade.toml");
    let text = "listen = '127.0.0.9:0'\nwait = 'soon'\nqueue = 9\nteacher_token = '0123456789012345678'\n";
    std::fs::write(&file, text).expect("a file");
    let mut command = command(&database);
    command.arg("--config").arg(&file);
    // The file alone would be refused: wait is no number. The environment's goes before, and the flag for the address.
    let server = Server::of(command.env("GGRADE_METRICS_TOKEN", "12345678901234567890"));
    assert!(server.socket().starts_with("127.0.0.1:"), "{}", server.address);
    drop(server);
    for (line, name) in [("queu = 9", "queu"), ("deadline = -1", "deadline"), ("[limits]\nleese = 1", "leese")] {
        std::fs::write(&file, line).expect("a file");
        let mut plain = std::process::Command::new(env!("CARGO_BIN_EXE_ggrade"));
        let (code, said) = output(plain.args(["serve", "--listen", "127.0.0.1:0", "--config"]).arg(&file));
        assert_eq!(code, Some(2), "{line}: {said}");
        assert!(said.contains(name), "{said}");
    }
}

#[test]
fn a_password_is_set_on_standard_input_and_never_shown() {
    let database = Database::sqlite();
    let mut command = command(&database);
    command.arg("--set-teacher-password").stdin(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("a process");
    child.stdin.take().expect("a pipe").write_all("ひみつの-password\n".as_bytes()).expect("written");
    let output = child.wait_with_output().expect("an end");
    assert!(output.status.success());
    assert!(!String::from_utf8_lossy(&output.stderr).contains("password-"));
    let bytes = std::fs::read(&database.location).expect("a file");
    let wal = std::fs::read(format!("{}-wal", database.location)).unwrap_or_default();
    let contains = |needle: &[u8]| [&bytes, &wal].iter().any(|b| b.windows(needle.len()).any(|w| w == needle));
    assert!(contains(b"$argon2id$"));
    assert!(!contains("ひみつの".as_bytes()));
}

#[test]
fn the_log_has_nothing_that_a_student_wrote() {
    let database = Database::sqlite();
    let mut command = command(&database);
    let server = Server::of(command.args(["--log-format", "json", "--log", "debug"]));
    let address = server.address.clone();
    let runtime = tokio::runtime::Runtime::new().expect("threads");
    runtime.block_on(async {
        let client = reqwest::Client::new();
        let url = format!("{address}/api/v1/submissions?name=SECRETNAME.vert");
        let body = "#version 410\nSECRETCODE\n";
        let reply = client.post(url).header("content-type", "text/plain").body(body).send().await.expect("an answer");
        assert_eq!(reply.status(), 201);
        let text = reply.text().await.expect("text");
        assert!(text.contains("SECRETNAME"));
        let _ = client.get(format!("{address}/SECRETPATH")).send().await;
    });
    let said = std::sync::Arc::clone(&server.said);
    assert!(server.terminate().success());
    let said = said.lock().expect("a lock").clone();
    let lines = said.lines().filter(|line| line.starts_with('{'));
    let routes: Vec<String> = lines
        .map(|line| serde_json::from_str::<serde_json::Value>(line).expect("JSON"))
        .filter_map(|line| line["fields"]["route"].as_str().map(str::to_owned))
        .collect();
    assert!(routes.contains(&"/api/v1/submissions".to_owned()), "{said}");
    assert!(!said.contains("SECRET"), "{said}");
}
