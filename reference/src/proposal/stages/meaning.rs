//! What an input of a fragment solution is taken for, by its name and type.

use crate::interpreter::{ProgramVariable, Scalar, Type};
use crate::proposal::names::{self, NameWords, Space};

/// What an input of a fragment solution is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum InputMeaning {
    Position(Space),
    Normal(Space),
    Tangent(Space),
    Bitangent(Space),
    Frame(Space),
    ToEye(Space),
    ToLight,
    /// A place, in the frame of tangent, bitangent and normal where that is so.
    KnownPoint(KnownPoint, bool),
    Clip,
    Coordinates,
    Colour,
    Depth,
    Height,
    Nothing,
}

/// A place that a vertex stage hands over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KnownPoint {
    Fragment,
    Eye,
    Light,
}

/// What a name says of a place that is no plain position of the fragment.
fn place(name: &NameWords) -> Option<InputMeaning> {
    let is_framed = name.is_tangent();
    let place = match () {
        () if !name.is_position() => return None,
        () if name.has(&["light", "lamp"]) => KnownPoint::Light,
        () if name.is_eye() || (is_framed && name.has(&["view", "eye", "camera"])) => KnownPoint::Eye,
        () if is_framed => KnownPoint::Fragment,
        () => return None,
    };
    // What is seen from the eye is in its space.
    (is_framed
        || place == KnownPoint::Light
        || name.is(&["viewpos", "eyepos", "camerapos", "campos", "cameraposition"]))
    .then_some(InputMeaning::KnownPoint(place, is_framed))
}

pub(super) fn meaning(input: &ProgramVariable, usual: Space) -> InputMeaning {
    let name = NameWords::of(&input.name);
    let space = names::space_of(&name, usual);
    let floats = match input.kind {
        Type::Vector(Scalar::Float, count) => count,
        Type::Matrix(Scalar::Float, 3, 3) => return InputMeaning::Frame(space),
        _ => return InputMeaning::Nothing,
    };
    if let Some(meaning) = place(&name).filter(|_| floats >= 3) {
        return meaning;
    }
    match floats {
        1 if name.has(&["depth", "distance", "dist", "fog", "range"]) || name.is(&["z", "viewz"]) => {
            InputMeaning::Depth
        }
        1 if name.has(&["height", "elevation", "altitude"]) => InputMeaning::Height,
        1 => InputMeaning::Height,
        2 => InputMeaning::Coordinates,
        _ if name.has(&["clip", "clipspace", "ndc", "screen", "proj"]) => InputMeaning::Clip,
        _ if name.is_bitangent() => InputMeaning::Bitangent(space),
        _ if name.is_tangent() => InputMeaning::Tangent(space),
        _ if name.is_normal() => InputMeaning::Normal(space),
        _ if name.is_colour() => InputMeaning::Colour,
        _ if name.is_coordinates() => InputMeaning::Coordinates,
        _ if name.is(&["v", "viewdir", "viewdirection", "toeye", "tocamera", "eyedir", "view"]) => {
            InputMeaning::ToEye(usual)
        }
        _ if name.is(&["l", "lightdir", "lightdirection", "tolight", "lightvec"]) => InputMeaning::ToLight,
        _ if floats == 4 && !name.is_position() => InputMeaning::Colour,
        _ => InputMeaning::Position(space),
    }
}

pub(super) fn said(meaning: InputMeaning) -> (&'static str, &'static str) {
    use Space::{Eye, World};
    match meaning {
        InputMeaning::Position(World) => ("the position in world space", "ワールド座標の位置"),
        InputMeaning::Position(Eye) => ("the position in eye space", "視点座標の位置"),
        InputMeaning::Normal(World) => ("the normal in world space", "ワールド座標の法線"),
        InputMeaning::Normal(Eye) => ("the normal in eye space", "視点座標の法線"),
        InputMeaning::Tangent(_) => ("the tangent", "接ベクトル"),
        InputMeaning::Bitangent(_) => ("the bitangent", "従接ベクトル"),
        InputMeaning::Frame(_) => {
            ("the frame of tangent, bitangent and normal", "接ベクトル・従接ベクトル・法線の行列")
        }
        InputMeaning::ToEye(_) => ("the vector to the eye", "視点へのベクトル"),
        InputMeaning::ToLight => ("the vector to a light", "光源へのベクトル"),
        InputMeaning::KnownPoint(KnownPoint::Fragment, _) => {
            ("the position in the frame of the tangent", "接空間の位置")
        }
        InputMeaning::KnownPoint(KnownPoint::Eye, false) => ("the place of the eye", "視点の位置"),
        InputMeaning::KnownPoint(KnownPoint::Eye, true) => {
            ("the place of the eye in the frame of the tangent", "接空間の視点の位置")
        }
        InputMeaning::KnownPoint(KnownPoint::Light, false) => ("the place of a light", "光源の位置"),
        InputMeaning::KnownPoint(KnownPoint::Light, true) => {
            ("the place of a light in the frame of the tangent", "接空間の光源の位置")
        }
        InputMeaning::Clip => ("the position in clip space", "クリップ座標の位置"),
        InputMeaning::Coordinates => ("the texture coordinates", "テクスチャ座標"),
        InputMeaning::Colour => ("a colour from the position", "位置から作った色"),
        InputMeaning::Depth => ("the distance along the view", "視線方向の距離"),
        InputMeaning::Height => ("the height in world space", "ワールド座標の高さ"),
        InputMeaning::Nothing => ("1", "1"),
    }
}
