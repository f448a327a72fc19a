//! The words of a line's detail in Japanese. The log keeps them in no language: names of settings, roles, actions.

/// The acts whose detail is made of such words; others have what somebody wrote.
const ACTS: [&str; 8] = ["settings", "course", "courses", "person", "person-added", "pseudonyms", "folder", "deleted"];

const WORDS: [(&str, &str); 42] = [
    ("opens", "受付開始"),
    ("closes", "締切"),
    ("attempts", "提出回数"),
    ("hints", "ヒント"),
    ("audience", "提出できる人"),
    ("practice", "締切後の練習"),
    ("grace", "猶予（分）"),
    ("late until", "遅延提出の受付終了"),
    ("late percent", "減点（%）"),
    ("late span", "減点の単位"),
    ("late floor", "減点後の下限（%）"),
    ("counting", "成績に反映する提出"),
    ("number", "学籍番号を登録した人"),
    ("none", "なし"),
    ("gentle", "式まで"),
    ("full", "行まで"),
    ("day", "日"),
    ("hour", "時間"),
    ("best", "最高得点"),
    ("last", "最後"),
    ("chosen", "学生の選択"),
    ("on", "オン"),
    ("off", "オフ"),
    ("ja", "日本語"),
    ("en", "英語"),
    ("administrator", "管理者"),
    ("lecturer", "担当教員"),
    ("assistant", "アシスタント"),
    ("close", "停止"),
    ("link", "リンクを発行"),
    ("pseudonyms", "仮名での表示"),
    ("uploaded", "アップロード"),
    ("publish", "公開"),
    ("withdraw", "公開をやめる"),
    ("remove", "削除"),
    ("make", "作成"),
    ("copy", "コピー"),
    ("archive", "アーカイブ"),
    ("batch", "アーカイブ"),
    ("student", "学生"),
    ("submission", "提出"),
    ("open", "開く"),
];

/// What deletions count.
const COUNTED: [(&str, &str); 4] = [
    ("submission", "提出（レポートと画像を含む）"),
    ("draft", "下書き"),
    ("entr", "アーカイブの項目"),
    ("browser", "ブラウザの履歴"),
];

/// The detail of an act.
pub(super) fn in_japanese(act: &str, detail: &str) -> String {
    if !ACTS.contains(&act) {
        return detail.to_owned();
    }
    let values = |piece: &str| piece.split(" → ").map(|value| known(act, value)).collect::<Vec<_>>().join(" → ");
    let part = |part: &str| part.split(": ").map(values).collect::<Vec<_>>().join(": ");
    detail.split(", ").map(part).collect::<Vec<_>>().join("、")
}

fn known(act: &str, piece: &str) -> String {
    if let Some((number, what)) = piece.split_once(' ').filter(|(number, _)| act == "deleted" && is_number(number))
        && let Some((_, ja)) = COUNTED.iter().find(|(en, _)| what.starts_with(en))
    {
        return format!("{ja} {number} 件");
    }
    let word = |text: &str| match text {
        "open" if act == "settings" => Some("だれでも"),
        text => WORDS.iter().find(|(en, _)| *en == text).map(|(_, ja)| *ja),
    };
    match word(piece) {
        Some(ja) => ja.to_owned(),
        None => piece.split(' ').map(|one| word(one).unwrap_or(one)).collect::<Vec<_>>().join(" "),
    }
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::in_japanese;

    #[test]
    fn our_own_words_are_translated_and_nothing_that_somebody_wrote() {
        assert_eq!(
            in_japanese("settings", "audience: open → number, attempts: – → 3"),
            "提出できる人: だれでも → 学籍番号を登録した人、提出回数: – → 3"
        );
        assert_eq!(
            in_japanese("deleted", "student: 2 submissions with their reports and pictures, 1 draft"),
            "学生: 提出（レポートと画像を含む） 2 件、下書き 1 件"
        );
        assert_eq!(in_japanese("person-added", "taro assistant"), "taro アシスタント");
        assert_eq!(in_japanese("comment", "a.vert:3: on, off"), "a.vert:3: on, off");
    }
}
