//! Characters that look like GLSL, or like nothing, and what to type in their place.

/// What `c` is meant to be in code, where that is clear: ASCII, and empty for what only has to go.
pub(super) fn ascii_for(c: char) -> Option<String> {
    if let '\u{FF01}'..='\u{FF5E}' = c {
        // The full-width forms stand in the order of ASCII, from "!" on.
        return char::from_u32(u32::from(c) - 0xFF01 + u32::from('!')).map(String::from);
    }
    if is_space(c) {
        return Some(" ".to_owned());
    }
    if is_invisible(c) || is_bidi(c) || c.is_control() {
        return Some(String::new());
    }
    punctuation(c).or_else(|| letter(c)).map(str::to_owned)
}

/// Blank characters that no compiler takes for a space.
pub(super) fn is_space(c: char) -> bool {
    matches!(
        c,
        '\u{3000}' | '\u{A0}' | '\u{1680}' | '\u{2000}'
            ..='\u{200A}' | '\u{202F}' | '\u{205F}' | '\u{2028}' | '\u{2029}' | '\u{85}'
    )
}

/// Characters that take no room at all.
pub(crate) fn is_invisible(c: char) -> bool {
    matches!(c, '\u{AD}' | '\u{34F}' | '\u{180E}' | '\u{200B}'..='\u{200D}' | '\u{2060}'..='\u{2064}' | '\u{FE00}'..='\u{FE0F}' | '\u{FEFF}')
}

/// Characters that have a say in the direction of text, so that code reads in another order than it runs.
pub(crate) fn is_bidi(c: char) -> bool {
    reorders(c) || matches!(c, '\u{61C}' | '\u{200E}' | '\u{200F}')
}

/// Those of them that turn the direction of all the text after them.
pub(crate) fn reorders(c: char) -> bool {
    matches!(c, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

fn punctuation(c: char) -> Option<&'static str> {
    Some(match c {
        '−' | '‐' | '‑' | '‒' | '–' | '—' | '―' | '─' | '﹣' | 'ー' | 'ｰ' => "-",
        '×' | '✕' | '✖' | '∗' | '⋅' | '·' | '・' | '•' | '･' => "*",
        '÷' | '∕' | '⁄' => "/",
        '≤' | '≦' | '⩽' => "<=",
        '≥' | '≧' | '⩾' => ">=",
        '≠' => "!=",
        '、' | '､' | '‚' => ",",
        '。' | '｡' | '．' => ".",
        '\u{37E}' => ";",
        '∶' => ":",
        '“' | '”' | '„' | '‟' | '〝' | '〟' | '＂' => "\"",
        '‘' | '’' | '‛' | '´' | '′' => "'",
        '「' | '【' | '〔' | '［' => "[",
        '」' | '】' | '〕' | '］' => "]",
        '〈' | '‹' => "<",
        '〉' | '›' => ">",
        '〜' => "~",
        '＼' | '￥' | '¥' => "\\",
        _ => return None,
    })
}

/// Greek and Cyrillic letters with the shape of a Latin one.
fn letter(c: char) -> Option<&'static str> {
    Some(match c {
        'Α' | 'А' => "A",
        'Β' | 'В' => "B",
        'С' | 'Ϲ' => "C",
        'Ε' | 'Е' => "E",
        'Η' | 'Н' => "H",
        'Ι' | 'І' => "I",
        'Ј' => "J",
        'Κ' | 'К' => "K",
        'Μ' | 'М' => "M",
        'Ν' => "N",
        'Ο' | 'О' => "O",
        'Ρ' | 'Р' => "P",
        'Ѕ' => "S",
        'Τ' | 'Т' => "T",
        'Χ' | 'Х' => "X",
        'Υ' | 'У' => "Y",
        'Ζ' => "Z",
        'а' => "a",
        'с' | 'ϲ' => "c",
        'ԁ' => "d",
        'е' => "e",
        'һ' => "h",
        'і' | 'ı' => "i",
        'ј' => "j",
        'ο' | 'о' => "o",
        'р' => "p",
        'ѕ' => "s",
        'ν' => "v",
        'х' => "x",
        'у' => "y",
        _ => return None,
    })
}

/// The Unicode name of `c`; for control characters, which have none, the name in ISO 6429.
pub(super) fn name(c: char) -> String {
    if let Some(name) = unicode_names2::name(c) {
        return name.to_string();
    }
    match c {
        '\u{7}' => "BELL".to_owned(),
        '\u{8}' => "BACKSPACE".to_owned(),
        '\u{1A}' => "SUBSTITUTE".to_owned(),
        '\u{1B}' => "ESCAPE".to_owned(),
        '\u{7F}' => "DELETE".to_owned(),
        '\u{85}' => "NEXT LINE".to_owned(),
        '\u{E000}'..='\u{F8FF}' => "PRIVATE USE".to_owned(),
        _ if c.is_control() => "CONTROL CHARACTER".to_owned(),
        _ => "UNASSIGNED".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_width_forms_become_their_ascii() {
        let typed: String = "ｖｅｃ４（＋－＊／＝；，．｛｝［］＜＞～".chars().filter_map(ascii_for).collect();
        assert_eq!(typed, "vec4(+-*/=;,.{}[]<>~");
    }

    #[test]
    fn blanks_become_spaces_and_the_unseen_goes() {
        for c in ['\u{3000}', '\u{A0}', '\u{2003}', '\u{202F}'] {
            assert_eq!(ascii_for(c).as_deref(), Some(" "), "{c:?}");
        }
        for c in ['\u{200B}', '\u{FEFF}', '\u{AD}', '\u{202E}', '\u{2066}', '\u{1A}'] {
            assert_eq!(ascii_for(c).as_deref(), Some(""), "{c:?}");
        }
    }

    #[test]
    fn words_of_other_scripts_have_no_ascii() {
        for c in ['光', 'あ', 'π', 'é', '😀', '\u{FFFD}'] {
            assert_eq!(ascii_for(c), None, "{c:?}");
        }
        assert_eq!(ascii_for('а').as_deref(), Some("a"));
    }

    #[test]
    fn names_are_those_of_unicode() {
        assert_eq!(name('\u{3000}'), "IDEOGRAPHIC SPACE");
        assert_eq!(name('；'), "FULLWIDTH SEMICOLON");
        assert_eq!(name('\u{1B}'), "ESCAPE");
        assert_eq!(name('\u{E000}'), "PRIVATE USE");
    }
}
