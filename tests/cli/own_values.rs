//! What a wrong answer computes on its way, line by line.

use super::{json, sample};
use serde_json::Value;

/// The lines of which a value is known to be wrong at the first place, with the variable.
fn wrong(values: &Value) -> Vec<(u64, &str)> {
    let lines = values["lines"].as_array().unwrap().iter();
    let wrong = lines.filter(|line| line["values"][0]["agrees"] == Value::Bool(false));
    wrong.map(|line| (line["line"].as_u64().unwrap(), line["name"].as_str().unwrap())).collect()
}

fn line<'v>(values: &'v Value, name: &str) -> &'v Value {
    values["lines"].as_array().unwrap().iter().find(|line| line["name"] == name).unwrap()
}

#[test]
fn a_wrong_answer_is_followed_to_the_first_value_that_is_not_right() {
    let report = json(&sample("wrong/specular-half-unnormalized--average.vert"), &["--seed", "1"]);
    let values = &report["own_values"];
    // `vec3 h = (l + v) / 2.0;` on line 33, and what is computed from it.
    assert_eq!(wrong(values), [(33, "h"), (36, "ispec"), (37, "vc")]);
    assert_eq!(report["rubric"][3]["line"], 33);
    let h = line(values, "h");
    assert_eq!(h["means"], "the half vector");
    let [own, right] = ["value", "right"].map(|of| {
        let numbers = h["values"][0][of].as_array().unwrap().iter().map(|number| number.as_f64().unwrap());
        numbers.collect::<Vec<_>>()
    });
    // The right one is a unit vector, in the same direction.
    let length = |all: &[f64]| all.iter().map(|number| number * number).sum::<f64>().sqrt();
    assert!((length(&right) - 1.0).abs() < 1e-5 && length(&own) < 0.999, "{own:?} {right:?}");
    let size = length(&own);
    assert!(own.iter().zip(&right).all(|(own, right)| (own / size - right).abs() < 1e-5));
    // What is right before it is known to be.
    for name in ["p", "v", "l", "n", "idiff", "gl_Position"] {
        assert_eq!(line(values, name)["values"][0]["agrees"], true, "{name}");
    }
    let places = values["places"].as_array().unwrap();
    let agree: Vec<bool> = places.iter().map(|place| place["agrees"].as_bool().unwrap()).collect();
    assert!(agree.len() > 1 && agree.iter().rev().skip(1).all(|agrees| !agrees) && agree[agree.len() - 1]);
    assert!(places.iter().all(|place| place["frame"] == 0 && place["at"].is_array()));
}

#[test]
fn hints_decide_whether_right_values_are_told_and_right_answers_are_not_followed() {
    let file = sample("wrong/specular-half-unnormalized--average.vert");
    for hints in ["none", "gentle"] {
        let values = &json(&file, &["--seed", "1", "--hints", hints])["own_values"];
        let lines = values["lines"].as_array().unwrap();
        let all = || lines.iter().flat_map(|line| line["values"].as_array().unwrap());
        assert!(lines.len() > 8 && lines.iter().all(|line| line["means"].is_null()));
        assert!(all().all(|value| value.get("right").is_none() && value.get("agrees").is_none()), "{hints}");
    }
    let right = json(&super::sample_like("accepted/answers", "plain-int-zero"), &[]);
    assert!(right.get("own_values").is_none());
    // What stands for a program in C++ is not the student's own text.
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample11-projection/wrong");
    let program = json(&folder.join("height-missing--both.cpp"), &["--assignment", "ggsample11-projection"]);
    assert_eq!((&program["verdict"], program.get("own_values")), (&"wrong".into(), None));
}

#[test]
fn a_pixel_is_followed_through_both_stages() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("submissions/ggsample11-map/wrong/bias-too-large--twentieth");
    let report = json(&folder, &["--assignment", "ggsample11-map"]);
    let values = &report["own_values"];
    let files: Vec<&str> =
        values["lines"].as_array().unwrap().iter().map(|line| line["file"].as_str().unwrap()).collect();
    assert_eq!([files[0], files[files.len() - 1]], ["ggsample11.vert", "ggsample11.frag"]);
    assert!(values["places"].as_array().unwrap().iter().all(|place| place["pixel"].is_array()), "{values}");
    assert!(wrong(values).iter().any(|(_, name)| *name == "fc"), "{values}");
}
