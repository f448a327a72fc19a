use super::*;
use crate::hand_in::HandedInFile;
use std::path::{Path, PathBuf};

fn ggsample06() -> Likeness {
    Likeness::of(reference::assignment("ggsample06").expect("a built-in assignment"))
}

fn source(text: &str) -> Source {
    crate::source::readable(&HandedInFile::new("ggsample06.vert", text.as_bytes())).expect("a text")
}

/// The right answers among the samples: (name, text).
fn answers() -> Vec<(String, Source)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/accepted/answers");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|it| it == "vert"));
    files.sort();
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let file = HandedInFile::new("ggsample06.vert", std::fs::read(path).unwrap());
        (name, crate::source::readable(&file).expect("a text"))
    };
    files.into_iter().map(read).collect()
}

/// A copy by somebody who hides it: other names, lines that do not need each other swapped, other spacing, no comments.
fn hidden(source: &Source) -> String {
    let mut statements = reading::statements(0, &source.text);
    let kept = ggsample06();
    let own = reading::own_names(&statements, kept.wording.names());
    let is_member = |words: &[reference::interpreter::outline::Word], at: usize| at > 0 && words[at - 1].text == ".";
    for statement in &mut statements {
        let before = statement.words.clone();
        for (at, word) in statement.words.iter_mut().enumerate() {
            if own.contains(&word.text) && word.text != "main" && !is_member(&before, at) {
                word.text = format!("my_{}_", word.text);
            }
        }
    }
    let set = |statement: &TextStatement| {
        let equals = statement.words.iter().position(|word| word.text == "=")?;
        let is_plain = statement.words.iter().all(|word| !matches!(word.text.as_str(), "{" | "}" | "const" | "for"));
        (is_plain && equals > 0).then(|| statement.words[equals - 1].text.clone())
    };
    let needs = |statement: &TextStatement, name: &str| statement.words.iter().any(|word| word.text == name);
    for round in 0..2 {
        for at in (round..statements.len().saturating_sub(1)).step_by(2) {
            let (a, b) = (&statements[at], &statements[at + 1]);
            if let (Some(first), Some(second)) = (set(a), set(b))
                && !needs(b, &first)
                && !needs(a, &second)
            {
                statements.swap(at, at + 1);
            }
        }
    }
    let line = |statement: &TextStatement| {
        statement.words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ") + "\n"
    };
    statements.iter().map(line).collect()
}

#[test]
fn two_right_answers_of_the_samples_are_never_called_alike() {
    let likeness = ggsample06();
    let samples = answers();
    assert!(samples.len() > 100);
    let read: Vec<Answer> = samples.iter().map(|(_, source)| likeness.read(std::slice::from_ref(source))).collect();
    let told: Vec<_> = likeness.pairs(&read, read.len()).into_iter().map(|pair| (pair.share, pair.places)).collect();
    let told: Vec<_> = told.iter().map(|(share, (a, b))| (share, &samples[*a].0, &samples[*b].0)).collect();
    assert_eq!(told, [], "these are alike");
    // And none is near it: the most alike stands well below the bound.
    let pairs = (0..read.len()).flat_map(|one| (0..one).map(move |other| (one, other)));
    let shares = pairs.map(|(one, other)| (likeness.pair(&read[one], &read[other]), one, other));
    let most = shares.filter(|(pair, ..)| pair.shared >= FEWEST).max_by(|a, b| a.0.share.total_cmp(&b.0.share));
    let (pair, one, other) = most.expect("some share something");
    println!("{:.2} {}: {} and {}", pair.share, pair.shared, samples[one].0, samples[other].0);
    assert!(pair.share <= LEAST - 0.05, "{pair:?}");
}

#[test]
fn a_copy_in_other_names_and_another_order_is_found() {
    let likeness = ggsample06();
    let (mut found, mut long) = (0, 0);
    let mut shares = Vec::new();
    for (name, sample) in answers() {
        let copy = source(&hidden(&sample));
        let pair = [likeness.read(&[sample]), likeness.read(&[copy])];
        // What says hardly more than the lecture is nobody's own.
        if pair[0].prints(&HashSet::new()).len() < 2 * FEWEST {
            continue;
        }
        long += 1;
        shares.push((likeness.pair(&pair[0], &pair[1]).share, name.clone()));
        match likeness.pairs(&pair, 2).as_slice() {
            [told] => {
                assert!(told.share >= LEAST, "{name}: {told:?}");
                found += 1;
            }
            _ => println!("not found: {name}"),
        }
    }
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!("{found} of {long}: {:?}", &shares[..shares.len().min(6)]);
    // Of those with enough of their own, at most one in twenty is missed.
    assert!(long > 80 && found * 20 >= long * 19, "{found} of {long}");
}

#[test]
fn the_hand_out_and_the_common_right_answer_are_nobodys_own() {
    let likeness = ggsample06();
    let hand_out = reference::assignment("ggsample06").unwrap().files[0].starter.clone();
    let common = hand_out.replace(
        "vc = cv;",
        "vec3 h = normalize(l + v);\nvec4 iamb = kamb * lamb;\nvec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;\n\
         vec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;\nvc = iamb + idiff + ispec;",
    );
    let others = common.replace("iamb", "a").replace("0.0)", "0.)");
    for pair in [[&hand_out, &hand_out], [&common, &others]] {
        let read = pair.map(|text| likeness.read(&[source(text)]));
        assert_eq!(likeness.pairs(&read, 2), []);
    }
    // The same file, comments and all, is told.
    let read = [&common, &common].map(|text| likeness.read(&[source(text)]));
    assert!(likeness.pairs(&read, 2)[0].is_same);
}

#[test]
fn the_pairs_are_those_that_are_found_by_holding_each_against_each() {
    let likeness = ggsample06();
    let samples: Vec<Source> = answers().into_iter().map(|(_, sample)| sample).step_by(3).collect();
    let copies: Vec<Source> = samples.iter().step_by(2).map(|sample| source(&hidden(sample))).collect();
    let all = samples.iter().chain(&copies).chain(samples.iter().step_by(5));
    let read: Vec<Answer> = all.map(|source| likeness.read(std::slice::from_ref(source))).collect();
    let class = samples.len() + copies.len() / 2;
    let common = common(&read);
    let prints: Vec<HashSet<u64>> = read.iter().map(|answer| answer.prints(&common)).collect();
    let each = (0..class).flat_map(|one| (one + 1..read.len()).map(move |other| (one, other)));
    let pair = |places: (usize, usize)| {
        let (a, b) = (&prints[places.0], &prints[places.1]);
        let shared = a.intersection(b).count();
        let pair = Pair::of((&read[places.0], &read[places.1]), shared, a.len() + b.len() - shared);
        pair.is_told().then_some(Pair { places, ..pair })
    };
    let expected: Vec<Pair> = each.filter_map(pair).collect();
    assert!(expected.len() > 20, "{}", expected.len());
    let mut found = likeness.pairs(&read, class);
    found.sort_by_key(|pair| pair.places);
    assert_eq!(found, expected);
}

#[test]
fn what_a_tenth_of_the_class_has_is_anybodys_and_earlier_answers_are_held_against_the_class_alone() {
    let likeness = ggsample06();
    let (_, sample) = answers().into_iter().find(|(name, _)| name == "half-angle-squared-forty-times").unwrap();
    let (one, copy) = (likeness.read(std::slice::from_ref(&sample)), likeness.read(&[source(&hidden(&sample))]));
    let few = vec![one.clone(), copy.clone(), copy.clone()];
    assert_eq!(likeness.pairs(&few, 3).len(), 3);
    assert_eq!(likeness.pairs(&few, 1).len(), 2, "two earlier ones are nobody's matter");
    assert_eq!(likeness.pairs(&few, 0), []);
    let many: Vec<Answer> = std::iter::once(one).chain(vec![copy; COMMON]).collect();
    assert!(likeness.pairs(&many, many.len()).iter().all(|pair| pair.is_same), "a text that eleven have");
}

#[test]
fn what_is_shared_is_marked_where_it_stands() {
    let likeness = ggsample06();
    let (_, sample) = answers().into_iter().find(|(name, _)| name == "half-angle-squared-forty-times").unwrap();
    let copy = source(&hidden(&sample));
    let sources = [vec![sample], vec![copy]];
    let read = sources.each_ref().map(|files| likeness.read(files));
    let (left, right) = likeness.compare((&read[0], &sources[0]), (&read[1], &sources[1]));
    for (side, source) in [(&left, &sources[0]), (&right, &sources[1])] {
        let text: String =
            side[0].lines.iter().flat_map(|line| line.iter().map(|it| it.text.as_str()).chain(["\n"])).collect();
        assert_eq!(text, source[0].text, "every character is there once");
        let marked: usize =
            side[0].lines.iter().flatten().filter(|piece| piece.is_shared).map(|piece| piece.text.len()).sum();
        assert!(marked > 100 && 3 * marked < 2 * source[0].text.len(), "{marked}");
        let line =
            |start: &str| side[0].lines.iter().find(|line| line.iter().any(|it| it.text.contains(start))).unwrap();
        assert!(line("const").iter().all(|piece| !piece.is_shared), "the hand-out's lines are not marked");
    }
}
