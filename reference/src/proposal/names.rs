//! What names usually mean.

use crate::interpreter::{Scalar, Type};

/// A name, taken apart: `u_lightPos[2]` is `light`, `pos`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NameWords {
    pub words: Vec<String>,
}

/// Letters before a name that say where it comes from.
const PREFIXES: [&str; 12] = ["u", "a", "v", "f", "m", "g", "i", "in", "vs", "fs", "frag", "vertex"];

/// Short words that stand at the end of longer ones: `lightpos`, `lightdir`, `lightcol`.
const SHORT_ENDS: [&str; 3] = ["pos", "dir", "col"];

/// Words that say that something is a matrix.
const MATRIX_WORDS: [&str; 6] = ["matrix", "mat", "mtx", "transform", "xform", "to"];

impl NameWords {
    /// Of the last part of a path.
    pub fn of(path: &str) -> Self {
        let last = path.rsplit('.').next().unwrap_or(path);
        let last = last.split('[').next().unwrap_or(last);
        let mut words: Vec<String> = last.split('_').flat_map(camel).collect();
        let is_prefix = |word: &String| PREFIXES.contains(&word.as_str());
        // `vertexColor` is a colour, and `position` of `vertex_position` is what is meant.
        while words.len() > 1 && words.first().is_some_and(is_prefix) {
            words.remove(0);
        }
        Self { words }
    }

    /// In one piece.
    pub fn joined(&self) -> String {
        self.words.concat()
    }

    /// Whether one of these words is in it, by itself or at the beginning or end of a longer one; a short one only at the end.
    pub fn has(&self, known: &[&str]) -> bool {
        let fits = |word: &String, known: &&str| {
            word == known
                || (known.len() > 3 && (word.starts_with(known) || word.ends_with(known)))
                || (SHORT_ENDS.contains(known) && word.ends_with(known))
        };
        self.words.iter().any(|word| known.iter().any(|known| fits(word, known)))
    }

    /// Whether it is one of these, in one piece.
    pub fn is(&self, known: &[&str]) -> bool {
        known.contains(&self.joined().as_str())
    }

    /// Whether it speaks of the space of the eye.
    fn is_of_eye(&self) -> bool {
        self.has(&["view", "eye", "camera", "cam", "viewspace", "eyespace"])
    }

    pub fn is_colour(&self) -> bool {
        self.has(&[
            "color", "colour", "col", "albedo", "diffuse", "ambient", "specular", "tint", "emission", "emissive",
        ]) || self.has(&["rgb", "paint", "ink"])
            || self.is(&[
                "ka", "kd", "ks", "kamb", "kdiff", "kspec", "lamb", "ldiff", "lspec", "la", "ld", "ls", "vc", "base",
            ])
    }

    pub fn is_position(&self) -> bool {
        self.has(&["position", "pos", "location", "point", "centre", "center", "origin"])
            || self.is(&["pl", "p", "at", "pv", "place", "lamp", "light"])
    }

    pub fn is_normal(&self) -> bool {
        self.has(&["normal", "nrm", "facing"]) || self.is(&["n", "nv", "cv", "norm"])
    }

    pub fn is_tangent(&self) -> bool {
        self.has(&["tangent", "tang"]) && !self.is_bitangent() && !self.has(&["view", "eye", "camera", "light"])
    }

    pub fn is_bitangent(&self) -> bool {
        self.has(&["bitangent", "binormal"])
    }

    /// Whether it is a number or a colour for itself, and no place or direction.
    pub fn is_a_value(&self) -> bool {
        self.has(&["color", "colour", "offset", "weight", "weights"])
    }

    pub fn is_coordinates(&self) -> bool {
        self.has(&[
            "uv",
            "uv0",
            "texcoord",
            "texcoords",
            "texture",
            "coord",
            "coords",
            "coordinate",
            "coordinates",
            "tex",
        ]) || self.is(&["st", "tc", "t0", "texuv"])
    }

    pub fn is_time(&self) -> bool {
        self.has(&["time", "seconds", "elapsed", "clock"]) || self.is(&["t"])
    }

    pub fn is_resolution(&self) -> bool {
        self.has(&["resolution", "viewport", "screensize", "windowsize"])
            || (self.has(&["screen", "window", "canvas"]) && self.has(&["size", "dimensions"]))
    }

    pub fn is_eye(&self) -> bool {
        let is_place = self.has(&["position", "pos", "point", "origin", "location", "world"]);
        (self.is_of_eye() && is_place) || self.is(&["eye", "camera", "cam", "viewer", "camerapos", "ve", "pe"])
    }

    pub fn is_direction(&self) -> bool {
        self.has(&["direction", "dir", "axis", "sun", "up", "wind"])
    }
}

fn camel(part: &str) -> Vec<String> {
    let characters: Vec<char> = part.chars().collect();
    let mut words = Vec::new();
    let mut word = String::new();
    for (at, character) in characters.iter().enumerate() {
        let before = at.checked_sub(1).map(|before| characters[before]);
        let starts = before.is_some_and(|before| {
            let next_is_lower = characters.get(at + 1).is_some_and(char::is_ascii_lowercase);
            character.is_uppercase() && (before.is_lowercase() || before.is_ascii_digit() || next_is_lower)
        });
        if starts && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        word.extend(character.to_lowercase());
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

/// The space in which a solution computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Space {
    /// That of the scene.
    World,
    /// That of the eye.
    Eye,
}

/// The space that a name speaks of, or else the usual one of its solution.
pub(super) fn space_of(name: &NameWords, usual: Space) -> Space {
    match () {
        () if name.has(&["world"]) => Space::World,
        () if name.is_of_eye() => Space::Eye,
        () => usual,
    }
}

/// What `assignment.toml` says of a matrix with such a name: the key, and its value.
pub(super) fn matrix(name: &NameWords, kind: &Type, usual: Space) -> Option<(&'static str, &'static str)> {
    if !matches!(kind, Type::Matrix(Scalar::Float, 4, 4) | Type::Matrix(Scalar::Float, 3, 3)) {
        return None;
    }
    let words: Vec<&str> = name.words.iter().map(String::as_str).collect();
    let has = |known: &[&str]| words.iter().any(|word| known.contains(word));
    let bare: String = words.iter().filter(|word| !MATRIX_WORDS.contains(word)).copied().collect();
    let bare = bare.trim_end_matches("matrix").trim_end_matches("mat");
    let is_inverse = has(&["inverse", "inv"]) || bare.starts_with("inv");
    let bare = bare.replace("inverse", "").replace("inv", "").replace("transpose", "");
    if is_inverse && has(&["transpose"]) {
        let role = if bare.contains("view") { "normal-matrix" } else { "world-normal-matrix" };
        return Some(("carries", role));
    }
    let role = match bare.as_str() {
        "model" | "m" | "world" | "object" | "objectworld" | "modelworld" | "localworld" | "obj" => "model",
        "view" | "v" | "camera" | "worldview" | "lookat" | "cam" if bare != "worldview" || has(&["to"]) => "view",
        "projection" | "proj" | "p" | "perspective" | "prj" | "viewclip" | "mp" | "persp" => "projection",
        "modelview" | "mv" | "mw" | "worldview" | "modeleye" | "objecteye" => "model-view",
        "viewprojection" | "viewproj" | "vp" | "projectionview" | "projview" | "pv" | "worldclip"
        | "cameraprojection" => "view-projection",
        "modelviewprojection"
        | "mvp"
        | "mc"
        | "pvm"
        | "modelviewproj"
        | "worldviewprojection"
        | "wvp"
        | "modelclip"
        | "objectclip"
        | "projectionviewmodel"
        | "clip" => "model-view-projection",
        "worldnormal" | "normalworld" | "modelnormal" | "normalmodel" => "world-normal-matrix",
        "normal" | "normals" | "n" | "mg" | "mn" | "norm" => match usual {
            Space::World => "world-normal-matrix",
            Space::Eye => "normal-matrix",
        },
        "viewnormal" | "normalview" | "eyenormal" => "normal-matrix",
        _ => return None,
    };
    let is_mat4 = matches!(kind, Type::Matrix(_, 4, _));
    Some(match (is_inverse, role) {
        (false, role) => ("carries", role),
        (true, "model") if is_mat4 => ("is", "inverse(model)"),
        (true, "view") if is_mat4 => ("is", "inverse(view)"),
        (true, "projection") if is_mat4 => ("is", "inverse(projection)"),
        (true, "view-projection") if is_mat4 => ("is", "inverse(projection * view)"),
        (true, "model-view") if is_mat4 => ("is", "inverse(view * model)"),
        _ => return None,
    })
}

/// Of an attribute: what `carries` says.
pub(super) fn attribute(name: &NameWords, kind: &Type) -> Option<&'static str> {
    let Type::Vector(scalar, count) = kind else { return None };
    if *count == 1 && (name.has(&["number", "id", "index"]) || scalar.is_integer()) {
        return Some("number");
    }
    if *scalar != Scalar::Float || *count == 1 {
        return None;
    }
    match () {
        () if name.is(&["vertex", "vert", "coord3d"]) => Some("position"),
        () if name.is_bitangent() || name.is_a_value() => None,
        () if name.is_normal() => Some("normal"),
        () if name.is_tangent() => Some("tangent"),
        () if name.is_coordinates() => Some("texture-coordinates"),
        () if name.is_position() => Some("position"),
        () => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_apart() {
        let words = |name: &str| NameWords::of(name).words.join(" ");
        assert_eq!(words("u_lightPos"), "light pos");
        assert_eq!(words("pointLights[2].ambientStrength"), "ambient strength");
        assert_eq!(words("uMVPMatrix"), "mvp matrix");
        assert_eq!(words("iTime"), "time");
        assert_eq!(words("v_TexCoord0"), "tex coord0");
        assert_eq!(words("mw"), "mw");
    }

    #[test]
    fn matrices_are_known_by_the_names_of_many_courses() {
        let said = |name: &str| matrix(&NameWords::of(name), &Type::MAT4, Space::Eye).map_or("none", |(_, said)| said);
        for (names, role) in [
            ("model modelMatrix u_model M uModelMatrix world objectToWorld", "model"),
            ("view viewMatrix V worldToView uView", "view"),
            ("projection proj projectionMatrix P mp", "projection"),
            ("modelViewMatrix MV mw worldView", "model-view"),
            ("viewProjection VP u_viewProj", "view-projection"),
            ("MVP uMVPMatrix mc modelViewProjectionMatrix", "model-view-projection"),
            ("normalMatrix mg mn uNormalMat", "normal-matrix"),
            ("worldNormal modelInverseTranspose", "world-normal-matrix"),
            ("invView", "inverse(view)"),
            ("lightSpaceMatrix bones", "none"),
        ] {
            names.split(' ').for_each(|name| assert_eq!(said(name), role, "{name}"));
        }
    }

    #[test]
    fn attributes_are_known_by_name() {
        let said =
            |name: &str, kind: &str| attribute(&NameWords::of(name), &Type::named(kind).expect(kind)).unwrap_or("none");
        for (name, kind, carries) in [
            ("pv", "vec4", "position"),
            ("aPos", "vec3", "position"),
            ("a_position", "vec3", "position"),
            ("nv", "vec4", "normal"),
            ("cv", "vec4", "normal"),
            ("aNormal", "vec3", "normal"),
            ("aTexCoords", "vec2", "texture-coordinates"),
            ("uv", "vec2", "texture-coordinates"),
            ("aTangent", "vec3", "tangent"),
            ("aBitangent", "vec3", "none"),
            ("aColor", "vec3", "none"),
        ] {
            assert_eq!(said(name, kind), carries, "{name}");
        }
    }
}
