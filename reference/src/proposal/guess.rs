//! What values things of such names usually have, and within which bounds they may vary.

use super::names::NameWords;
use crate::interpreter::{Scalar, Type};

/// A value, and the least and the greatest that a probe may draw.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Guess {
    /// As many numbers as the type has.
    pub value: Vec<f64>,
    /// One number for all, or as many as the type has; `None` where the value stays.
    pub within: Option<(Vec<f64>, Vec<f64>)>,
    /// What the name was taken for, in both languages.
    pub what: (&'static str, &'static str),
}

/// Colours that are told apart, positions on all sides, directions that are.
const COLOURS: [[f64; 3]; 5] = [[0.9, 0.6, 0.4], [1.0, 0.95, 0.8], [0.4, 0.6, 0.9], [0.5, 0.8, 0.5], [0.8, 0.4, 0.7]];
const POSITIONS: [[f64; 3]; 5] =
    [[1.5, 2.0, 2.0], [-2.0, 1.5, 1.5], [2.0, -0.5, 1.5], [-1.0, 2.5, -1.5], [0.0, 2.0, 2.5]];
const DIRECTIONS: [[f64; 3]; 3] = [[0.5, 0.8, 0.6], [-0.6, 0.7, 0.4], [0.2, 0.9, -0.4]];

/// Single numbers by name: the words, the value, the bounds, and what it is taken for.
type NumberGuess = (&'static [&'static str], f64, (f64, f64), (&'static str, &'static str));

const NUMBERS: &[NumberGuess] = &[
    (
        &["shininess", "exponent", "power", "shine", "kshi", "specpower", "glossiness"],
        32.0,
        (8.0, 64.0),
        ("exponent", "指数"),
    ),
    (&["outercutoff", "outer", "outercone"], 0.8, (0.75, 0.85), ("cosine of an outer angle", "外側の角の余弦")),
    (&["cutoff", "inner", "cone"], 0.95, (0.9, 0.97), ("cosine of an angle", "角の余弦")),
    (&["constant"], 1.0, (0.8, 1.2), ("attenuation", "減衰係数")),
    (&["linear"], 0.09, (0.05, 0.2), ("attenuation", "減衰係数")),
    (&["quadratic"], 0.032, (0.02, 0.1), ("attenuation", "減衰係数")),
    (&["density"], 0.2, (0.1, 0.4), ("density", "濃さ")),
    (&["near", "start", "begin"], 2.0, (1.5, 2.4), ("near limit", "手前の限界")),
    (&["far", "end"], 5.0, (4.0, 7.0), ("far limit", "奥の限界")),
    (&["f0", "reflectance"], 0.1, (0.03, 0.3), ("reflectance", "反射率")),
    (&["ior", "refractive"], 1.5, (1.2, 1.8), ("refractive index", "屈折率")),
    (&["eta"], 0.66, (0.55, 0.85), ("ratio of refractive indices", "屈折率の比")),
    (&["exposure"], 1.2, (0.5, 3.0), ("exposure", "露出")),
    (&["gamma"], 2.2, (1.8, 2.6), ("gamma", "ガンマ値")),
    (&["roughness", "rough"], 0.4, (0.2, 0.8), ("share", "割合")),
    (&["metallic", "metalness", "metal"], 0.5, (0.1, 0.9), ("share", "割合")),
    (
        &[
            "threshold",
            "dissolve",
            "amount",
            "progress",
            "mix",
            "blend",
            "ratio",
            "fraction",
            "alpha",
            "opacity",
            "cut",
            "level",
        ],
        0.45,
        (0.25, 0.7),
        ("share", "割合"),
    ),
    (&["frequency", "freq", "repeat", "tiling", "tile"], 4.0, (2.0, 6.0), ("frequency", "周波数")),
    (&["amplitude", "amp", "height", "displacement", "steepness"], 0.15, (0.05, 0.3), ("amplitude", "振幅")),
    (&["wavelength", "length"], 1.2, (0.6, 2.0), ("wavelength", "波長")),
    (&["speed", "velocity"], 1.0, (0.5, 2.0), ("speed", "速さ")),
    (&["twist", "bend", "shear", "swirl", "curl"], 0.9, (-1.5, 1.5), ("deformation", "変形の強さ")),
    (&["phase", "angle", "rotation", "theta"], 0.6, (0.2, 1.4), ("angle in radians", "角 (ラジアン)")),
    (&["radius", "size"], 1.0, (0.6, 1.6), ("size", "大きさ")),
    (&["width", "thickness", "softness", "edge", "outline", "border"], 0.2, (0.1, 0.35), ("width", "幅")),
    (
        &["intensity", "brightness", "strength", "scale", "factor", "weight", "gain"],
        0.8,
        (0.4, 1.2),
        ("strength", "強さ"),
    ),
    (
        &["bands", "levels", "tones", "steps", "shades", "layers", "octaves", "iterations", "samples"],
        4.0,
        (2.0, 6.0),
        ("number of steps", "段数"),
    ),
    (&["white"], 4.0, (2.0, 8.0), ("white point", "白とする明るさ")),
    (&["min", "minimum"], 0.2, (0.1, 0.35), ("least value", "最小値")),
    (&["max", "maximum"], 0.8, (0.6, 0.95), ("greatest value", "最大値")),
];

/// The same where two words of a name say it together: one of the first and one of the second.
type PairGuess = (&'static [&'static str], NumberGuess);

const PAIRS: &[PairGuess] = &[
    (
        &["fresnel", "rim", "schlick", "edge", "falloff"],
        (&["power", "exponent", "pow"], 4.0, (2.0, 8.0), ("exponent of an edge", "縁の指数")),
    ),
    (
        &["noise", "uv", "tex", "texture", "detail", "pattern", "map"],
        (&["scale", "size"], 1.7, (0.8, 2.5), ("scale of coordinates", "座標の倍率")),
    ),
    (
        &["light", "lamp", "spot"],
        (&["radius", "range", "reach"], 6.0, (4.0, 9.0), ("reach of a light", "光の届く距離")),
    ),
];

/// What a light that becomes weaker with its distance reaches: further than the scene is wide.
const REACH: NumberGuess = (&["radius", "range", "reach"], 6.0, (4.0, 9.0), ("reach of a light", "光の届く距離"));
/// How strong such a light is, so that enough of it arrives.
const STRONG: NumberGuess =
    (&["intensity", "brightness", "strength", "power"], 2.0, (1.0, 4.0), ("strength of a light", "光の強さ"));

/// Steps from the usual value towards its bounds, one for each number that is taken for the same, so that no two are alike.
const STEPS: [f64; 6] = [0.0, 0.3, -0.3, 0.6, -0.6, 0.15];

/// What an exponent usually is.
pub(super) fn exponent() -> Guess {
    Guess { value: vec![16.0], within: Some((vec![4.0], vec![48.0])), what: ("exponent", "指数") }
}

/// Whether a number's name says what it is.
pub(super) fn is_known(name: &NameWords) -> bool {
    row(name).is_some() || name.is_colour()
}

/// What the solution says of a value beside its name and type.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Context {
    /// How many values that were taken for the same were there before it.
    pub nth: usize,
    /// Whether it points away from where the light comes from.
    pub is_downward: bool,
    /// Whether it is of a light that becomes weaker up to a distance, where it ends.
    pub falls_off: bool,
}

/// What a value of a type usually is.
pub(super) fn guess(name: &NameWords, kind: &Type, context: Context) -> Guess {
    let Context { nth, is_downward, falls_off } = context;
    let count = kind.slots().unwrap_or(0);
    match kind {
        Type::Vector(Scalar::Bool, _) => {
            Guess { value: vec![1.0; count], within: Some((vec![0.0], vec![1.0])), what: ("switch", "スイッチ") }
        }
        Type::Vector(Scalar::Int | Scalar::Uint, _) => whole(name, count),
        Type::Vector(_, 1) => number(name, nth, falls_off),
        Type::Vector(_, _) => vector(name, count, nth, is_downward),
        Type::Matrix(_, columns, rows) => Guess {
            value: matrix(usize::from(*columns), usize::from(*rows), nth),
            within: None,
            what: ("matrix that turns a little", "少し回転させる行列"),
        },
        _ => Guess { value: vec![0.0; count], within: None, what: ("nothing known", "不明") },
    }
}

/// A turn about z, and a small step where there is a column for it: without it, and with another one, all is elsewhere.
fn matrix(columns: usize, rows: usize, nth: usize) -> Vec<f64> {
    let angle: f64 = [0.3, -0.5, 0.05, -0.25][nth % 4];
    let step = [0.1, -0.05, 0.08].map(|step| step * (1.0 + (nth % 4) as f64));
    let number = |column: usize, row: usize| match (column, row) {
        (0, 0) | (1, 1) => angle.cos(),
        (0, 1) => angle.sin(),
        (1, 0) => -angle.sin(),
        (3, row) if rows >= 3 && row < 3 => step[row],
        _ => f64::from(u8::from(column == row)),
    };
    let all = (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
    all.map(|(column, row)| (number(column, row) * 1e4).round() / 1e4).collect()
}

fn row(name: &NameWords) -> Option<&'static NumberGuess> {
    NUMBERS.iter().find(|(words, ..)| name.has(words) || name.is(words))
}

fn whole(name: &NameWords, count: usize) -> Guess {
    let what = ("whole number", "整数");
    match row(name) {
        Some((_, value, (least, greatest), what)) if *least >= 2.0 => {
            Guess { value: vec![*value; count], within: Some((vec![*least], vec![*greatest])), what: *what }
        }
        _ => Guess { value: vec![1.0; count], within: None, what },
    }
}

fn number(name: &NameWords, nth: usize, falls_off: bool) -> Guess {
    if name.is_colour() {
        return Guess { value: vec![0.5], within: Some((vec![0.2], vec![0.9])), what: ("share", "割合") };
    }
    let has = |known: &[&str]| name.has(known) || name.is(known);
    let of_pair = || PAIRS.iter().find(|(first, (second, ..))| has(first) && has(second)).map(|(_, guess)| guess);
    let of_light = || [&REACH, &STRONG].into_iter().find(|(words, ..)| falls_off && has(words));
    let (value, (least, greatest), what) = match of_light().or_else(of_pair).or_else(|| row(name)) {
        Some((_, value, bounds, what)) => (*value, *bounds, *what),
        None => (0.5, (0.25, 1.0), ("number", "数")),
    };
    let step = STEPS[nth % STEPS.len()];
    let room = if step < 0.0 { value - least } else { greatest - value };
    let value = two_digits(value + step * room);
    Guess { value: vec![value], within: Some((vec![least], vec![greatest])), what }
}

/// A number as a person writes it; one of a thousandth stays one.
fn two_digits(number: f64) -> f64 {
    let digits = if number.abs() < 0.1 { 1e3 } else { 1e2 };
    (number * digits).round() / digits
}

fn vector(name: &NameWords, count: usize, nth: usize, is_downward: bool) -> Guess {
    let filled = |three: [f64; 3], fourth: f64| -> Vec<f64> { [&three[..], &[fourth]].concat()[..count].to_vec() };
    if count == 2 {
        let (value, least, greatest, what) = match () {
            () if name.is_direction() => ([0.8, 0.6], [0.2, 0.2], [1.0, 1.0], ("direction", "方向")),
            () if name.has(&["scale", "tiling", "repeat", "frequency"]) => {
                ([3.0, 2.0], [1.0, 1.0], [5.0, 5.0], ("scale", "倍率"))
            }
            () => ([0.4, 0.3], [0.1, 0.1], [0.9, 0.9], ("pair of numbers", "数の組")),
        };
        let value = value.map(|number| two_digits(number * [1.0, 0.8, 1.1][nth % 3])).to_vec();
        return Guess { value, within: Some((least.to_vec(), greatest.to_vec())), what };
    }
    if name.is_direction() && !name.is_colour() {
        let is_downward = is_downward || name.has(&["axis"]); // A spot hangs above what it lights.
        let sign = if is_downward { -1.0 } else { 1.0 };
        let value = DIRECTIONS[nth % DIRECTIONS.len()].map(|number| number * sign);
        let (least, greatest) =
            if is_downward { ([-1.0, -1.0, -1.0], [1.0, -0.3, 1.0]) } else { ([-1.0, 0.3, -1.0], [1.0; 3]) };
        let within = Some((filled(least, 0.0), filled(greatest, 0.0)));
        return Guess { value: filled(value, 0.0), within, what: ("direction", "方向") };
    }
    if name.is_position() && !name.is_colour() {
        let within = Some((filled([-3.0, 0.5, -3.0], 1.0), filled([3.0, 3.0, 3.0], 1.0)));
        return Guess { value: filled(POSITIONS[nth % POSITIONS.len()], 1.0), within, what: ("position", "位置") };
    }
    let end = match () {
        () if name.has(&["min", "minimum"]) => Some(-2.5),
        () if name.has(&["max", "maximum"]) => Some(2.5),
        () => None,
    };
    if let Some(end) = end.filter(|_| !name.is_colour()) {
        let (value, least, greatest) =
            (filled([end; 3], 1.0), filled([end - 0.5; 3], 1.0), filled([end + 0.5; 3], 1.0));
        return Guess { value, within: Some((least, greatest)), what: ("corner of a box", "箱の角") };
    }
    let known = row(name).filter(|guess| !name.is_colour() && guess.3.0 != "exponent"); // The power of a light is a colour.
    if let Some((_, value, (least, greatest), what)) = known {
        return Guess { value: vec![*value; count], within: Some((vec![*least], vec![*greatest])), what: *what };
    }
    if name.has(&["ambient", "lamb", "kamb"]) {
        let value = COLOURS[nth % COLOURS.len()].map(|share| (share * 25.0).round() / 100.0);
        let within = Some((filled([0.05; 3], 1.0), filled([0.35; 3], 1.0)));
        return Guess { value: filled(value, 1.0), within, what: ("ambient colour", "環境光の色") };
    }
    let what = if name.is_colour() { ("colour", "色") } else { ("three numbers from 0 to 1", "0 から 1 の数") };
    let within = Some((filled([0.2; 3], 1.0), filled([1.0; 3], 1.0)));
    Guess { value: filled(COLOURS[nth % COLOURS.len()], 1.0), within, what }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feed::Bounds;

    #[test]
    fn a_guess_fits_its_type_and_its_bounds() {
        let names = "intensity fresnelPower lightRadius uvScale twist shininess lightPos lightDir objectColor cutOff tones enabled foo steps kd offset";
        for kind in ["float", "vec2", "vec3", "vec4", "int", "uint", "bool", "mat3", "mat4"] {
            let kind = Type::named(kind).expect(kind);
            for (name, nth) in names.split(' ').zip(0..) {
                let context = Context { nth, is_downward: nth % 2 == 0, falls_off: nth % 3 == 0 };
                let Guess { value, within, .. } = guess(&NameWords::of(name), &kind, context);
                assert_eq!(Some(value.len()), kind.slots(), "{name} {kind}");
                let Some((least, greatest)) = within else { continue };
                assert!(Bounds::new(&kind, &least, &greatest).is_some(), "{name} {kind}");
                let at = |ends: &[f64], index: usize| if ends.len() == 1 { ends[0] } else { ends[index] };
                for (index, number) in value.iter().enumerate() {
                    assert!((at(&least, index)..=at(&greatest, index)).contains(number), "{name} {kind}");
                }
            }
        }
    }

    #[test]
    fn numbers_of_one_kind_are_unlike_each_other_and_show_what_they_do() {
        let value = |name: &str, nth: usize, falls_off: bool| {
            guess(&NameWords::of(name), &Type::FLOAT, Context { nth, is_downward: false, falls_off }).value[0]
        };
        let intensities: Vec<f64> = (0..4).map(|nth| value("intensity", nth, true)).collect();
        // From 2 by 3 and 6 tenths of the way to 4, and by 3 tenths of the way to 1.
        assert_eq!(intensities, [2.0, 2.6, 1.7, 3.2]);
        assert_eq!([value("radius", 0, true), value("lightRadius", 0, false)], [6.0, 6.0]);
        assert_eq!([value("radius", 0, false), value("fresnelPower", 0, false)], [1.0, 4.0]);
        assert_eq!([value("shininess", 0, false), value("noiseScale", 0, false)], [32.0, 1.7]);
        let vector = |name: &str| guess(&NameWords::of(name), &Type::vector(3), Context::default()).value;
        assert!(vector("axis")[1] < 0.0 && vector("power").iter().all(|share| *share <= 1.0));
    }
}
