//! Which page follows one of a list: the `Link` header of RFC 8288.

use super::platform::Failure;
use reqwest::Url;
use reqwest::header::{HeaderMap, LINK};

/// The address of the page that follows the one at an address. It is of the same host: the token that opens the list is for no other.
pub(super) fn next_page(address: &str, headers: &HeaderMap) -> Result<Option<String>, Failure> {
    let mut lines = headers.get_all(LINK).iter().map(|line| String::from_utf8_lossy(line.as_bytes()));
    let Some(next) = lines.find_map(|line| next_of(&line)) else { return Ok(None) };
    let here = Url::parse(address).map_err(|error| format!("{address}: {error}"))?;
    let next = here.join(&next).map_err(|error| format!("{next}: {error}"))?;
    if next.origin() != here.origin() {
        return Err(format!("{address} goes on at another host, {next}"));
    }
    Ok(Some(next.into()))
}

/// The target of the link of a header's line whose relation is `next`.
fn next_of(line: &str) -> Option<String> {
    let mut rest = line;
    loop {
        let (address, after) = rest.trim_start_matches([',', ' ', '\t']).strip_prefix('<')?.split_once('>')?;
        let (is_next, after) = parameters(after);
        if is_next {
            return Some(address.trim().to_owned());
        }
        rest = after.find(',').map_or("", |end| &after[end..]);
    }
}

/// Whether the parameters of a link say that it leads on from this very list, and what stands after them.
fn parameters(mut rest: &str) -> (bool, &str) {
    let (mut relations, mut is_of_another) = (None, false);
    while let Some(after) = rest.trim_start().strip_prefix(';') {
        let (name, after) = after.split_at(after.find(['=', ';', ',']).unwrap_or(after.len()));
        let (said, after) = match after.strip_prefix('=') {
            Some(after) => value(after.trim_start()),
            None => (String::new(), after),
        };
        match name.trim().to_ascii_lowercase().as_str() {
            // Of several the first counts.
            "rel" => _ = relations.get_or_insert(said),
            "anchor" => is_of_another = true,
            _ => {}
        }
        rest = after;
    }
    let relations = relations.unwrap_or_default();
    (!is_of_another && relations.split_ascii_whitespace().any(|relation| relation.eq_ignore_ascii_case("next")), rest)
}

/// The value of a parameter, with or without quotes, and what stands after it.
fn value(text: &str) -> (String, &str) {
    let Some(quoted) = text.strip_prefix('"') else {
        let (value, after) = text.split_at(text.find([';', ',']).unwrap_or(text.len()));
        return (value.trim().to_owned(), after);
    };
    let mut value = String::new();
    let mut characters = quoted.char_indices();
    while let Some((at, character)) = characters.next() {
        match character {
            '"' => return (value, &quoted[at + 1..]),
            '\\' => value.extend(characters.next().map(|(_, escaped)| escaped)),
            _ => value.push(character),
        }
    }
    (value, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn next(line: &'static str) -> Result<Option<String>, Failure> {
        let headers = HeaderMap::from_iter([(LINK, line.parse().expect("a header"))]);
        next_page("https://lms.example/api/members?page=1", &headers)
    }

    #[test]
    fn the_next_page_is_found_however_the_header_is_written() {
        for line in [
            "<https://lms.example/m?p=2>; rel=\"next\"",
            "<https://lms.example/m?p=2>;rel=next",
            "<https://lms.example/m?p=2>; REL = \"Next\"",
            "<https://lms.example/m?p=2>; rel=\"last next\"; title=\"a, b; c \\\" <d>\"",
            "<https://lms.example/m?a,b=1;c>; rel=\"prev\", , <https://lms.example/m?p=2>; title=\"x\"; rel=\"next\"",
            "<https://lms.example/a>; title=\"<https://lms.example/x>; rel=next\", <https://lms.example/m?p=2>; rel=next",
            "<https://lms.example/other>; rel=next; anchor=\"#part\", <//lms.example/m?p=2>; rel=next",
            "</m?p=2>; rel=next",
        ] {
            assert_eq!(next(line), Ok(Some("https://lms.example/m?p=2".to_owned())), "{line}");
        }
        assert_eq!(next("<?page=2,3>; rel=next"), Ok(Some("https://lms.example/api/members?page=2,3".to_owned())));
    }

    #[test]
    fn what_is_no_next_page_is_none() {
        for line in ["", "next", "<https://lms.example/m", "<https://lms.example/m>", "</m>; rel=\"nextish\""] {
            assert_eq!(next(line), Ok(None), "{line}");
        }
        assert_eq!(next("</m>; rel=prev; rel=next"), Ok(None), "the first relation counts");
        for line in
            ["<https://mallory.example/m>; rel=next", "<http://lms.example/m>; rel=next", "<http://[>; rel=next"]
        {
            assert!(next(line).is_err(), "{line}");
        }
    }
}
