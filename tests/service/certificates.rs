//! A machine without the certificates of any authority: everything works but https, and who needs https is told.

use crate::cluster::Database;
use crate::process::{Server, command};
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
    let file = provider("near", &issuer.address) + &provider("far", "https://127.0.0.1:1");
    std::fs::write(folder.path().join("ggrade.toml"), file).expect("a file");
    let database = Database::sqlite();
    let mut command = command(&database);
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
    let said = server.said.lock().expect("a lock").clone();
    assert!(said.contains("https://127.0.0.1:1") && said.contains("apt-get install ca-certificates"), "{said}");
}
