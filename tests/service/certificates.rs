//! A machine without the certificates of any authority: everything works but https, and who needs https is told.

use crate::cluster::Database;
use crate::process::{Server, command, command_at};
use crate::sign_in::issuer::Issuer;
use std::path::Path;
use std::process::Command;

/// Takes the machine's authorities away from a process.
fn without_authorities(command: &mut Command, folder: &Path) {
    std::fs::write(folder.join("none.pem"), "").expect("a file");
    std::fs::create_dir_all(folder.join("none")).expect("a folder");
    command.env("SSL_CERT_FILE", folder.join("none.pem")).env("SSL_CERT_DIR", folder.join("none"));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn only_https_needs_certificates() {
    let issuer = Issuer::start().await;
    let folder = tempfile::tempdir().expect("a folder");
    let provider = |id: &str, address: &str| {
        format!("[[sign_in]]\nid = \"{id}\"\nname = \"{id}\"\nissuer = \"{address}\"\nclient_id = \"ggrade\"\n")
    };
    // Nobody listens at the second one, which a client with certificates would say.
    let free =
        std::net::TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("an address").to_string();
    let file = format!("public_url = \"http://{free}\"\n")
        + &provider("near", &issuer.address)
        + &provider("far", "https://127.0.0.1:1");
    std::fs::write(folder.path().join("ggrade.toml"), file).expect("a file");
    let database = Database::sqlite();
    let mut command = command_at(&database, &free);
    command.arg("--config").arg(folder.path().join("ggrade.toml"));
    without_authorities(&mut command, folder.path());
    let server = tokio::task::spawn_blocking(move || Server::of(&mut command)).await.expect("a server");

    let client = reqwest::Client::builder().redirect(reqwest::redirect::Policy::none()).tls_certs_only([]);
    let client = client.build().expect("a client");
    let status = async |path: &str| {
        let answer = client.get(format!("{}{path}", server.address)).send().await.expect("an answer");
        answer.status().as_u16()
    };
    assert_eq!(status("/readyz").await, 200);
    assert_eq!(status("/sign-in/near").await, 303);
    assert_eq!(status("/sign-in/far").await, 502);
    let said = server.everything_said();
    assert!(said.contains("https://127.0.0.1:1") && said.contains("apt-get install ca-certificates"), "{said}");
}

/// Whoever vouches for people sends them back to an address, which nobody may choose by a `Host` header.
#[test]
fn who_signs_people_in_says_where_the_service_is() {
    let database = Database::sqlite();
    let folder = tempfile::tempdir().expect("a folder");
    let sign_in = "[[sign_in]]\nid = \"a\"\nname = \"A\"\nissuer = \"https://a.example\"\nclient_id = \"ggrade\"\n";
    let proxied = "identity_header = \"X-Remote-User\"\nidentity_proxies = [\"127.0.0.1\"]\n";
    for (file, said) in [
        (sign_in, "sign_in needs public_url"),
        (proxied, "identity_header needs public_url"),
        ("public_url = \"ggrade.example\"\n", "public_url takes an address without a path"),
        ("public_url = \"https://ggrade.example/course\"\n", "public_url takes an address without a path"),
    ] {
        std::fs::write(folder.path().join("ggrade.toml"), file).expect("a file");
        let output =
            command(&database).arg("--config").arg(folder.path().join("ggrade.toml")).output().expect("an end");
        let stderr = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{file}: {stderr}");
        assert!(stderr.contains(said), "{file}: {stderr}");
    }
}

/// A container or an orchestrator asks in this way.
#[test]
fn the_health_check_says_whether_uploads_are_taken() {
    let database = Database::sqlite();
    let server = Server::start(&database);
    let folder = tempfile::tempdir().expect("a folder");
    let address = server.socket().to_owned();
    let check = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ggrade"));
        command
            .args(["serve", "--healthcheck"])
            .env("GGRADE_LISTEN", &address)
            .env("LANG", "C")
            .env_remove("GGRADE_LANG");
        without_authorities(&mut command, folder.path());
        // A proxy of the machine's has no part in it.
        let output = command.env("http_proxy", "http://127.0.0.1:1").output().expect("an end");
        let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("text"));
        (output.status.code(), said.concat())
    };
    assert_eq!(check(), (Some(0), "ready\n".to_owned()));
    assert!(server.terminate().success());
    let (code, said) = check();
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("does not take uploads") && said.contains(&address), "{said}");
}
