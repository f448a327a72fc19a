//! The manifests in `deploy/kubernetes/`, held against the schemas that a cluster holds them against.

use super::repository;
use serde::Deserialize;
use serde_json::{Value, json};

/// Kubernetes' own types, and that of KEDA's that is used.
fn schema(kind: &str) -> Value {
    let name = match kind {
        "Deployment" => "io.k8s.api.apps.v1.Deployment",
        "Job" => "io.k8s.api.batch.v1.Job",
        "Service" => "io.k8s.api.core.v1.Service",
        "ScaledObject" => {
            return serde_json::from_str(include_str!("../schemas/keda-scaledobject.schema.json")).unwrap();
        }
        _ => panic!("no schema of a {kind}"),
    };
    let mut schema: Value = serde_json::from_str(include_str!("../schemas/kubernetes-1.33.json")).unwrap();
    schema["$ref"] = json!(format!("#/$defs/{name}"));
    schema
}

fn mistakes(object: &Value) -> Vec<String> {
    let validator = jsonschema::validator_for(&schema(object["kind"].as_str().expect("a kind"))).unwrap();
    validator.iter_errors(object).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn objects(file: &str) -> Vec<Value> {
    let path = repository().join("deploy/kubernetes").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_yaml_ng::Deserializer::from_str(&text).map(|object| Value::deserialize(object).unwrap()).collect()
}

#[test]
fn every_manifest_is_what_a_cluster_takes() {
    let folder = std::fs::read_dir(repository().join("deploy/kubernetes")).unwrap();
    let mut kinds = Vec::new();
    for entry in folder {
        let name = entry.unwrap().file_name().into_string().unwrap();
        for object in objects(&name) {
            assert_eq!(mistakes(&object), Vec::<String>::new(), "{name}");
            kinds.push(object["kind"].as_str().unwrap().to_owned());
        }
    }
    kinds.sort();
    assert_eq!(kinds, ["Deployment", "Deployment", "Job", "Job", "ScaledObject", "Service"]);
}

#[test]
fn a_wrong_manifest_is_found() {
    let mut job = objects("class.yaml").remove(0);
    job["spec"]["template"]["spec"]["containers"][0]["image"] = json!(7);
    assert!(!mistakes(&job).is_empty());
    let mut job = objects("class.yaml").remove(0);
    job["spec"]["template"]["spec"]["restart"] = json!("Never");
    assert!(!mistakes(&job).is_empty());
}

/// The options of a pod's program are options of ggrade, and its probes are addresses of the service.
#[test]
fn what_the_pods_run_is_there() {
    let all = objects("service.yaml");
    let deployments: Vec<&Value> = all.iter().filter(|object| object["kind"] == "Deployment").collect();
    assert_eq!(deployments.len(), 2);
    for deployment in deployments {
        let container = &deployment["spec"]["template"]["spec"]["containers"][0];
        let words: Vec<&str> =
            container["args"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
        // The command line is taken; what is refused is only that a role has no PostgreSQL here.
        let output = super::ggrade().args(&words).env("GGRADE_DATABASE", "/nowhere.db").output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("PostgreSQL"), "{said}");
        for probe in ["readinessProbe", "livenessProbe"] {
            let path = container[probe]["httpGet"]["path"].as_str().unwrap();
            assert!(["/healthz", "/readyz"].contains(&path), "{path}");
        }
    }
}
