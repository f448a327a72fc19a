//! One picture, and others of its kind: two maps of a solution that have one picture cannot be told apart when they are swapped.

/// How a picture is said that has a sky around it, and others.
const SKY: &str = "sky = {}";
const OTHER_SKIES: [&str; 2] = [
    "sky = { zenith = [0.1, 0.4, 0.3], horizon = [0.9, 0.8, 0.5], sun = { direction = [-1.0, 0.8, -0.4] } }",
    "sky = { zenith = [0.4, 0.1, 0.4], horizon = [0.9, 0.6, 0.6], sun = { direction = [0.3, 0.7, -1.0] } }",
];

/// How far the seeds of two pictures are apart: as far that no two of the tables meet.
const BETWEEN_SEEDS: usize = 10;

/// A line of an entry `[[texture]]`, for the picture with this number of those that are made of it; 0 is the line itself. Seeds and the
/// counts of bumps are other ones, and the channels of colours change their places.
pub(super) fn another(line: &str, nth: usize) -> String {
    if nth == 0 {
        return line.to_owned();
    }
    let line = line.replace(SKY, OTHER_SKIES[(nth - 1) % OTHER_SKIES.len()]);
    let line = with_numbers(&line, "seed = ", |seed| seed + BETWEEN_SEEDS * nth);
    let line = with_numbers(&line, "count = [", |count| count + nth);
    turned(&line, nth)
}

/// The text with another whole number behind each of these words.
fn with_numbers(text: &str, before: &str, other: impl Fn(usize) -> usize) -> String {
    let mut parts = text.split(before);
    let mut all = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(digits);
        let number = number.parse().map_or_else(|_| number.to_owned(), |number| other(number).to_string());
        all += &format!("{before}{number}{rest}");
    }
    all
}

/// The text with the three numbers of each colour turned so many places, and from each third turn on in the other order.
fn turned(text: &str, places: usize) -> String {
    let (mut all, mut rest) = (String::new(), text);
    while let Some(open) = rest.find('[') {
        let (before, inside) = rest.split_at(open + 1);
        all += before;
        let end = inside.find(['[', ']']).unwrap_or(inside.len());
        let mut numbers: Vec<&str> = inside[..end].split(", ").collect();
        if numbers.len() == 3 && inside[end..].starts_with(']') {
            numbers.rotate_left(places % 3);
            if places / 3 % 2 == 1 {
                numbers.reverse();
            }
        }
        all += &numbers.join(", ");
        rest = &inside[end..];
    }
    all + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_of_a_kind_is_another_picture() {
        for (line, second) in [
            (
                "generate = { noise = { seed = 5, cells = [6, 4], colours = [[0.1, 0.1, 0.1], [1, 1, 1]] } }",
                "generate = { noise = { seed = 15, cells = [6, 4], colours = [[0.1, 0.1, 0.1], [1, 1, 1]] } }",
            ),
            ("generate = { bumps = { count = [4, 4] } }", "generate = { bumps = { count = [5, 4] } }"),
            (
                "generate = { gradient = { rows = [[[0.1, 0.2, 0.3], [1, 1, 0.8]]] } }",
                "generate = { gradient = { rows = [[[0.2, 0.3, 0.1], [1, 0.8, 1]]] } }",
            ),
            ("size = [64, 64]", "size = [64, 64]"),
        ] {
            assert_eq!(another(line, 0), line);
            assert_eq!(another(line, 1), second);
        }
        let ramp = "{ gradient = { rows = [[[0.1, 0.2, 0.3]]] } }";
        let all: std::collections::HashSet<String> = (0..6).map(|nth| another(ramp, nth)).collect();
        assert_eq!(all.len(), 6);
    }
}
