//! What parts of a solution are called, by their names in it.

use crate::Text;
use crate::proposal::names::NameWords;
use crate::text::both;

/// Verbs before a name that say nothing of what is computed.
const VERBS: [&str; 5] = ["calc", "calculate", "compute", "get", "eval"];

/// From so many letters on a word of a name reads as a word of English.
const LETTERS_OF_A_WORD: usize = 4;

/// What a part is called in both languages.
pub(super) fn label(name: &str) -> Text {
    known(name).unwrap_or_else(|| both(spelt(name).unwrap_or_else(|| name.to_owned()), name))
}

/// The same within a sentence.
pub(super) fn in_sentences(name: &str) -> Text {
    let code = format!("`{name}`");
    known(name).unwrap_or_else(|| both(spelt(name).unwrap_or_else(|| code.clone()), code))
}

/// Whether a name says by itself what a part is.
pub(super) fn is_telling(name: &str) -> bool {
    let words = NameWords::of(name).words;
    PARTS.iter().any(|(known, ..)| known.len() > 3 && words.iter().any(|word| word.starts_with(known)))
}

fn known(name: &str) -> Option<Text> {
    let whole = name.replace('_', "").to_lowercase();
    let words = words(name);
    let short = SHORT.iter().find(|(known, ..)| known.split(' ').any(|known| known == whole));
    let long = || PARTS.iter().find(|(known, ..)| words.iter().any(|word| word.contains(known)));
    short.or_else(long).map(|(_, en, ja)| both(*en, *ja))
}

/// The words of a name as a heading, where one of them is a word: `rimStrength` is `Rim strength`.
fn spelt(name: &str) -> Option<String> {
    let words = words(name);
    words.iter().any(|word| word.len() >= LETTERS_OF_A_WORD).then(|| {
        let words = words.join(" ");
        let mut letters = words.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    })
}

fn words(name: &str) -> Vec<String> {
    let mut words = NameWords::of(name).words;
    if words.len() > 1 && VERBS.contains(&words[0].as_str()) {
        words.remove(0);
    }
    words
}

/// Names that are short for what a lecture on shading calls so.
const SHORT: &[(&str, &str, &str)] = &[
    ("n nn norm normal", "Normal vector", "法線ベクトル"),
    ("l ll tolight lightdir lightvector", "Light vector", "光線ベクトル"),
    ("v vv toeye viewdir eyedir viewvector", "View vector", "視線ベクトル"),
    ("h hh half halfvector halfway halfdir halfwaydir", "Half vector", "中間ベクトル"),
    ("r rr reflectdir reflectvector", "Reflection vector", "反射ベクトル"),
    ("nl nol ndotl dotnl costheta", "Angle of the light, N·L", "光の当たる角度（N·L）"),
    ("nv nov ndotv dotnv", "Angle of the view, N·V", "見る角度（N·V）"),
    ("nh noh ndoth dotnh", "Highlight, N·H", "ハイライト（N·H）"),
    ("hv vh hl lh hdotv vdoth ldoth hdotl", "Angle of the half vector, H·V", "中間ベクトルの角度（H·V）"),
    ("rv vr rdotv vdotr", "Highlight, R·V", "ハイライト（R·V）"),
    ("d dist distance", "Distance", "距離"),
    ("att atten attenuation falloff", "Falloff with distance", "距離減衰"),
    ("ka ia iamb", "Ambient light", "環境光"),
    ("kd id idiff", "Diffuse reflection", "拡散反射光"),
    ("ks is ispec", "Specular reflection", "鏡面反射光"),
];

/// Words in names, and what such a part is called.
const PARTS: &[(&str, &str, &str)] = &[
    ("shape", "Shape", "形"),
    ("lambert", "Diffuse reflection", "拡散反射光"),
    ("amb", "Ambient light", "環境光"),
    ("diff", "Diffuse reflection", "拡散反射光"),
    ("spec", "Specular reflection", "鏡面反射光"),
    ("highlight", "Highlight", "ハイライト"),
    ("rim", "Rim light", "リムライト"),
    ("fog", "Fog", "霧"),
    ("gamma", "Gamma correction", "ガンマ補正"),
    ("exposure", "Exposure", "露出"),
    ("reflect", "Reflection", "反射"),
    ("refract", "Refraction", "屈折"),
    ("fresnel", "Fresnel reflection", "フレネル反射"),
    ("emis", "Emission", "発光"),
    ("outline", "Outline", "輪郭線"),
    ("edge", "Edge", "縁"),
    ("shadow", "Shadow", "影"),
    ("discard", "What is cut out", "切り抜き"),
    ("glow", "Glow", "光彩"),
    ("noise", "Noise", "ノイズ"),
    ("spot", "Spot light", "スポットライト"),
    ("point", "Point lights", "点光源"),
    ("dir", "Directional light", "平行光源"),
    ("colo", "Colour", "色"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_words_that_a_lecturer_keeps() {
        for (name, en, ja, sentence) in [
            ("nl", "Angle of the light, N·L", "光の当たる角度（N·L）", "光の当たる角度（N·L）"),
            ("NdotL", "Angle of the light, N·L", "光の当たる角度（N·L）", "光の当たる角度（N·L）"),
            ("half_vector", "Half vector", "中間ベクトル", "中間ベクトル"),
            ("calcSpec", "Specular reflection", "鏡面反射光", "鏡面反射光"),
            ("amb", "Ambient light", "環境光", "環境光"),
            ("woodGrain", "Wood grain", "woodGrain", "`woodGrain`"),
            ("wood_grain", "Wood grain", "wood_grain", "`wood_grain`"),
            ("q2", "q2", "q2", "`q2`"),
        ] {
            assert_eq!((label(name).en.as_str(), label(name).ja.as_str()), (en, ja), "{name}");
            assert_eq!(in_sentences(name).ja, sentence, "{name}");
        }
        assert_eq!(in_sentences("q2").en, "`q2`");
    }
}
