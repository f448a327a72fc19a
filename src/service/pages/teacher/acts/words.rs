//! The words of a line's detail in Japanese. The log keeps them in no language: names of settings, roles, actions.

/// The acts whose detail is made of such words; others have what somebody wrote.
const ACTS: [&str; 10] =
    ["settings", "course", "courses", "plan", "person", "person-added", "platform", "pseudonyms", "folder", "deleted"];

const WORDS: [(&str, &str); 56] = [
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
    ("points", "配点"),
    ("shown", "公開"),
    ("now", "公開中"),
    ("hidden", "非公開"),
    ("order", "順序"),
    ("zone", "タイムゾーン"),
    ("language", "言語"),
    ("title", "授業名"),
    ("archived", "アーカイブ"),
    ("role", "権限"),
    ("login", "ログイン"),
    ("add", "追加"),
    ("approve", "承認"),
    ("connect", "結び付け"),
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
    // A title is what somebody wrote, to the end of the line.
    let (ours, title) = match detail.split_once("title: ").filter(|_| act == "course") {
        Some((ours, title)) => (ours, format!("{}: {title}", known(act, "title"))),
        None => (detail, String::new()),
    };
    let values = |piece: &str| piece.split(" → ").map(|value| known(act, value)).collect::<Vec<_>>().join(" → ");
    let part = |part: &str| part.split(": ").map(values).collect::<Vec<_>>().join(": ");
    ours.split(", ").map(part).collect::<Vec<_>>().join("、") + &title
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
        assert_eq!(in_japanese("course", "language: ja → en, title: – → now"), "言語: 日本語 → 英語、授業名: – → now");
        assert_eq!(
            in_japanese("plan", "order: a b → b a, waves points: – → 40, waves shown: now → hidden"),
            "順序: a b → b a、waves 配点: – → 40、waves 公開: 公開中 → 非公開"
        );
        assert_eq!(in_japanese("person", "taro role: assistant → lecturer"), "taro 権限: アシスタント → 担当教員");
        assert_eq!(in_japanese("platform", "add https://lms.example 7"), "追加 https://lms.example 7");
        assert_eq!(in_japanese("person-added", "taro assistant"), "taro アシスタント");
        assert_eq!(in_japanese("comment", "a.vert:3: on, off"), "a.vert:3: on, off");
    }
}
