//! A text as statements of words, and these as fingerprints that no renaming changes.

use super::RUN;
use reference::interpreter::outline::{self, Word};
use std::collections::{HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;

/// What ends in `;`, `{` or `}`.
#[derive(Clone, Debug)]
pub struct TextStatement {
    /// The file that it stands in, as its place in the hand-in.
    pub file: usize,
    /// Its place among the statements of the file.
    pub number: usize,
    /// Its words; numbers are written in one way.
    pub words: Vec<Word>,
}

/// A fingerprint, and where its tokens stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    pub print: u64,
    /// The bytes from the first token to the last in each file; two where it begins in one file and ends in another.
    pub places: Vec<(usize, Range<usize>)>,
}

/// The statements of a file; comments are white space, and a directive ends with its line.
pub fn statements(file: usize, text: &str) -> Vec<TextStatement> {
    let directives: HashSet<u32> =
        (1..).zip(text.lines()).filter(|(_, line)| line.trim_start().starts_with('#')).map(|(line, _)| line).collect();
    // Directives are words as well: a macro is no hiding place. The text keeps its length, and every word its place.
    let words = outline::words(&text.replace('#', " "));
    let mut statements: Vec<TextStatement> = Vec::new();
    let mut own: Vec<Word> = Vec::new();
    let mut close = |own: &mut Vec<Word>| {
        if !own.is_empty() {
            let number = statements.len();
            statements.push(TextStatement { file, number, words: std::mem::take(own) });
        }
    };
    for mut word in words {
        let is_apart = |line: u32| line != word.line && (directives.contains(&line) || directives.contains(&word.line));
        if own.last().is_some_and(|last| is_apart(last.line)) {
            close(&mut own);
        }
        word.text = spelt(word.text);
        let ends = matches!(word.text.as_str(), ";" | "{" | "}");
        own.push(word);
        if ends {
            close(&mut own);
        }
    }
    close(&mut own);
    statements
}

/// A number as everybody writes it: `0`, `0.` and `0.0f` are the same.
fn spelt(word: String) -> String {
    let is_number = word.starts_with(|c: char| c.is_ascii_digit()) || word.starts_with('.') && word.len() > 1;
    let digits = word.trim_end_matches(['f', 'F', 'l', 'L', 'u', 'U']);
    match digits.parse::<f64>() {
        Ok(value) if is_number => format!("{value:?}"),
        _ => word,
    }
}

/// The words of statements as texts, for looking them up.
pub fn texts(statement: &TextStatement) -> Vec<String> {
    statement.words.iter().map(|word| word.text.clone()).collect()
}

/// Words that stand before a name without declaring it.
const NO_TYPES: [&str; 4] = ["return", "else", "do", "case"];

/// The names that the statements declare, but for `kept`: those that a student can change at will.
pub fn own_names(statements: &[TextStatement], kept: &HashSet<String>) -> HashSet<String> {
    let mut names = HashSet::new();
    for statement in statements {
        let (mut depth, mut declares) = (0_i32, false);
        for pair in statement.words.windows(2) {
            let [before, word] = pair else { continue };
            match before.text.as_str() {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            let follows_type = before.is_name && !NO_TYPES.contains(&before.text.as_str());
            let goes_on = depth == 0 && declares && before.text == ",";
            if word.is_name && (follows_type || goes_on) {
                declares |= depth == 0;
                names.insert(word.text.clone());
            }
        }
    }
    names.retain(|name| !kept.contains(name));
    names
}

/// The fingerprints of statements, in their order. Within a run of tokens, the student's own names count by the order in which
/// they come up in it; `kept` names count as they are.
pub fn passages(statements: &[TextStatement], kept: &HashSet<String>) -> Vec<Passage> {
    let own = own_names(statements, kept);
    let words: Vec<PlacedWord<'_>> = statements
        .iter()
        .flat_map(|TextStatement { file, number, words }| {
            words.iter().map(|word| PlacedWord { file: *file, number: *number, word })
        })
        .collect();
    // A member is not the name that it is spelt like.
    let is_own = |at: usize| own.contains(&words[at].word.text) && (at == 0 || words[at - 1].word.text != ".");
    let is_own: Vec<bool> = (0..words.len()).map(is_own).collect();
    let runs = words.windows(RUN).enumerate();
    runs.map(|(from, run)| Passage { print: print(run, &is_own[from..from + RUN]), places: places(run) }).collect()
}

/// A word with the file and the statement that it stands in.
struct PlacedWord<'a> {
    file: usize,
    number: usize,
    word: &'a Word,
}

fn print(run: &[PlacedWord<'_>], is_own: &[bool]) -> u64 {
    let mut order: HashMap<&str, usize> = HashMap::new();
    let mut hasher = DefaultHasher::new();
    for (PlacedWord { word, .. }, is_own) in run.iter().zip(is_own) {
        let next = order.len();
        let text = word.text.as_str();
        match is_own {
            true => order.entry(text).or_insert(next).hash(&mut hasher),
            false => text.hash(&mut hasher),
        }
    }
    hasher.finish()
}

fn places(run: &[PlacedWord<'_>]) -> Vec<(usize, Range<usize>)> {
    let mut places: Vec<(usize, Range<usize>)> = Vec::new();
    let mut before: Option<(usize, usize)> = None;
    for PlacedWord { file, number, word } in run {
        // Where statements of the hand-out lie between, the words are not in one piece.
        let goes_on = before.is_some_and(|(in_file, last)| in_file == *file && *number <= last + 1);
        match places.last_mut().filter(|_| goes_on) {
            Some((_, range)) => range.end = word.range.end,
            None => places.push((*file, word.range.clone())),
        }
        before = Some((*file, *number));
    }
    places
}
