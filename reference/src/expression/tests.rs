use super::*;
use glam::DVec2;

fn scope() -> Scope {
    let mut scope = Scope::default();
    for (name, kind) in [("x", Type::Float), ("a", Type::Vec3), ("b", Type::Vec4), ("m", Type::Mat4)] {
        scope.declare(name, kind).expect("a fresh name");
    }
    scope
}

/// x = 2, a = (3, 4, 0), b = (1, 2, 3, 4), m = translation by (10, 20, 30).
fn value(text: &str) -> Value {
    let expression = Expression::parse(text, &scope()).expect(text);
    let value = expression.evaluate(&|slot| match slot {
        0 => Value::Float(2.0),
        1 => Value::Vec3(DVec3::new(3.0, 4.0, 0.0)),
        2 => Value::Vec4(DVec4::new(1.0, 2.0, 3.0, 4.0)),
        _ => Value::Mat4(Box::new(DMat4::from_translation(DVec3::new(10.0, 20.0, 30.0)))),
    });
    assert_eq!(value.kind(), expression.kind(), "{text}");
    value
}

fn number(text: &str) -> f64 {
    value(text).float()
}

fn refused(text: &str) -> ExpressionError {
    Expression::parse(text, &scope()).expect_err(text)
}

#[test]
fn operators_bind_as_in_glsl() {
    assert_eq!(number("1 + 2 * x"), 5.0);
    assert_eq!(number("(1 + 2) * x"), 6.0);
    assert_eq!(number("8.0 / x / 2"), 2.0);
    assert_eq!(number("1 - 2 - 3"), -4.0);
    assert_eq!(number("-x * -x"), 4.0);
    assert_eq!(number("x > 1.0 ? 5.0 : x < 1.0 ? 6.0 : 7.0"), 5.0);
    assert_eq!(number("x <= 1.5e0 ? 5.0 : 6.0"), 6.0);
}

#[test]
fn vectors_work_component_by_component_and_with_floats() {
    assert_eq!(value("a * x"), Value::Vec3(DVec3::new(6.0, 8.0, 0.0)));
    assert_eq!(value("1 - a"), Value::Vec3(DVec3::new(-2.0, -3.0, 1.0)));
    assert_eq!(value("b * b"), Value::Vec4(DVec4::new(1.0, 4.0, 9.0, 16.0)));
    assert_eq!(value("b.wz"), Value::Vec2(DVec2::new(4.0, 3.0)));
    assert_eq!(value("b.rgb.y"), Value::Float(2.0));
    assert_eq!(value("vec4(a.xy, 7.0, x)"), Value::Vec4(DVec4::new(3.0, 4.0, 7.0, 2.0)));
    assert_eq!(value("vec3(b)"), Value::Vec3(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(value("vec3(x)"), Value::Vec3(DVec3::splat(2.0)));
}

#[test]
fn a_matrix_times_a_vector_is_the_linear_map() {
    // The translation is weighted by w = 4.
    assert_eq!(value("m * b"), Value::Vec4(DVec4::new(41.0, 82.0, 123.0, 4.0)));
    // From the left the vector meets the columns: the last is (10, 20, 30, 1), so w = 10 + 40 + 90 + 4.
    assert_eq!(value("b * m"), Value::Vec4(DVec4::new(1.0, 2.0, 3.0, 144.0)));
    assert_eq!(value("transpose(m) * b"), value("b * m"));
    assert_eq!(value("inverse(m) * (m * b)"), value("b"));
    assert_eq!(value("mat3(m) * a"), value("a"));
}

#[test]
fn functions_are_those_of_glsl() {
    assert_eq!(number("length(a)"), 5.0);
    assert_eq!(number("dot(a, normalize(a))"), 5.0);
    assert_eq!(number("max(-x, 0)"), 0.0);
    assert_eq!(number("clamp(x, 0.0, 1.0)"), 1.0);
    assert_eq!(number("pow(x, 10)"), 1024.0);
    assert_eq!(number("mix(1.0, 3.0, 0.25)"), 1.5);
    assert_eq!(number("step(x, 2.0) + step(x, 1.0)"), 1.0);
    // Reflected at the ground (normal y), (1, -1, 0) goes up again.
    assert_eq!(value("reflect(vec3(1.0, -1.0, 0.0), vec3(0.0, 1.0, 0.0))"), Value::Vec3(DVec3::new(1.0, 1.0, 0.0)));
    assert_eq!(value("cross(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0))"), Value::Vec3(DVec3::Z));
}

#[test]
fn what_glsl_leaves_undefined_is_nan_and_stays_nan() {
    assert!(number("pow(-x, 2.0)").is_nan());
    assert!(number("pow(0.0, 0.0)").is_nan());
    assert!(number("max(pow(-x, 2.0), 0.0)").is_nan());
    assert!(number("length(normalize(vec3(0.0)))").is_nan());
    assert_eq!(number("pow(0.0, 80.0)"), 0.0);
}

#[test]
fn type_errors_are_found_with_their_place() {
    assert_eq!(refused("x + nowhere").column, 5);
    assert_eq!(refused("a + b").column, 3);
    assert_eq!(refused("dot(a, b)").column, 1);
    assert_eq!(refused("x * a.w").column, 7);
    assert_eq!(refused("vec4(a)").column, 1);
    assert_eq!(refused("x ? 1.0 : 2.0").column, 1);
    assert_eq!(refused("x > 1.0 ? a : b").column, 1);
    assert_eq!(refused("(x").column, 3);
    assert_eq!(refused("x x").column, 3);
    assert_eq!(refused("").column, 1);
    assert_eq!(refused("1 / 2 * x").column, 3);
    assert_eq!(refused("a > x").column, 3);
}

#[test]
fn deep_nesting_is_refused() {
    let text = format!("{}x{}", "(".repeat(10_000), ")".repeat(10_000));
    assert_eq!(refused(&text).message, "nested too deeply");
}

#[test]
fn names_of_glsl_and_names_twice_cannot_be_declared() {
    let mut scope = scope();
    for name in ["x", "dot", "vec3", "2x", "a-b", ""] {
        assert_eq!(scope.declare(name, Type::Float), None, "{name}");
    }
}
