//! A teacher's way through the service.

use crate::chromium::server::{Server, TOKEN};
use crate::chromium::{Browser, sample};
use crate::{BROKEN, RIGHT, WRONG};

/// A download of Moodle's with three students.
fn moodle_archive(path: &std::path::Path) {
    let members = [
        ("山田 太郎_1001_assignsubmission_file/ggsample06.vert", RIGHT),
        ("Smith Ann_1002_assignsubmission_file/ggsample06.vert", WRONG),
        ("佐藤 花_1003_assignsubmission_file/ggsample06.vert", BROKEN),
    ];
    let mut zip = zip::ZipWriter::new(std::fs::File::create(path).expect("a file"));
    for (name, file) in members {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).expect("a member");
        std::io::Write::write_all(&mut zip, &std::fs::read(sample(file)).expect("a sample")).expect("its bytes");
    }
    zip.finish().expect("an archive");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_teacher_walks_through_the_class() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    let class = [
        ("S1001", "wrong/unchanged--as-handed-out.vert"),
        ("S1001", WRONG),
        ("S1001", RIGHT),
        ("S1002", "wrong/ambient-added--plus.vert"),
        ("S1003", BROKEN),
        ("S1004", "wrong/specular-missing--ambient-and-diffuse.vert"),
        ("S1004", "wrong/diffuse-unclamped--no-max.vert"),
        ("S1005", RIGHT),
    ];
    for (student, file) in class {
        server.hand_in(student, file).await;
    }
    browser.open(&server.at("/teacher")).await;
    assert!(browser.address().await.ends_with("/teacher/login"));
    browser.check("teacher-login").await;
    browser.keys("#password", "not the password").await;
    browser.click("main .primary").await;
    browser.until("document.querySelector('[role=alert]')").await;
    // A refused form is answered with 403, which the browser notes.
    browser.complaints().await;
    browser.keys("#password", TOKEN).await;
    browser.click("main .primary").await;
    browser.until("location.pathname === '/teacher'").await;
    assert_eq!(browser.js("return document.querySelectorAll('.people tbody tr').length").await, 5);

    browser.click(".top nav a[href='/teacher/settings']").await;
    browser.until("location.pathname === '/teacher/settings'").await;
    let folder = tempfile::tempdir().expect("a folder");
    let roster = folder.path().join("roster.csv");
    // One that cannot be read leads back to its form, with what is wrong beside it.
    std::fs::write(&roster, "number,name\nS1001,和田 花子\n,Nobody\n").expect("a file");
    browser.keys("#roster-file", &roster.to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('#roster-wrong')?.textContent.startsWith('Line 3 ')").await;
    // A refused form is answered with 422, which the browser notes.
    browser.complaints().await;
    browser.check("teacher-roster-wrong").await;
    let students = "S1001,和田 花子\nS1002,<b>Bold</b>\nS1003,C\nS1004,D\nS1005,E\nS1006,Late Comer\n";
    std::fs::write(&roster, format!("number,name\n{students}")).expect("a file");
    browser.keys("#roster-file", &roster.to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('[role=status]')?.textContent.includes('6 on it, 6 of them new')").await;
    browser.check("teacher-settings").await;
    // What Excel saves in Japan, of a lecture that is full; and what takes its place.
    let line = |n: usize| format!("{n},2026{n:04},\"学生, {n}\",{}\r\n", n % 4 + 1);
    let full = format!("科目名,ＣＧ\r\nNo.,学籍番号,氏名,学年\r\n{}", (1..=400).map(line).collect::<String>());
    std::fs::write(&roster, encoding_rs::SHIFT_JIS.encode(&full).0).expect("a file");
    browser.keys("#roster-file", &roster.to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('[role=status]')?.textContent.includes('20260001 学生, 1;')").await;
    assert!(browser.text("[role=status]").await.contains("400 on it, 400 of them new; 6 of the roster before"));
    std::fs::write(&roster, format!("\u{feff}number;name\n{}", students.replace(',', ";"))).expect("a file");
    browser.keys("#roster-file", &roster.to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('[role=status]')?.textContent.includes('6 on it, 6 of them new')").await;

    browser.open(&server.at("/teacher")).await;
    browser.until("document.querySelectorAll('.people tbody tr').length === 6").await;
    assert!(browser.text(".people").await.contains("<b>Bold</b>"), "a name stays text");
    browser.js("document.querySelectorAll('img[loading]').forEach(i => i.loading = 'eager')").await;
    browser.until("[...document.images].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("teacher-class").await;
    // What arrives appears, and the page is still the same.
    browser.js("window.stays = true; document.querySelector('#q').value = 'typed'").await;
    server.hand_in("S1006", RIGHT).await;
    browser.until("document.querySelector('.people tbody tr:last-child .sign.full')").await;
    assert_eq!(browser.js("return window.stays && document.querySelector('#q').value").await, "typed");
    browser.until("document.querySelector('.overview .lead').textContent.startsWith('6 of 6 ')").await;
    // A heading sorts, and says so.
    browser.click(".people thead th:nth-child(4) a").await;
    browser.until("document.querySelector('th[aria-sort=ascending]')?.textContent === 'Score'").await;
    assert_eq!(browser.text(".people tbody tr:first-child th a").await, "S1003");
    browser.open(&server.at("/teacher?verdict=wrong")).await;
    assert_eq!(browser.js("return document.querySelectorAll('.people tbody tr').length").await, 2);
    browser.click(".trends a").await;
    browser.until("location.search.includes('mistake=')").await;
    assert_eq!(browser.js("return document.querySelectorAll('.people tbody tr').length").await, 1);
    browser.open(&server.at("/teacher?anonymous=on")).await;
    assert!(!browser.text("main").await.contains("S1001"), "no number is shown");
    browser.open(&server.at("/teacher?q=s1001")).await;
    browser.click(".people tbody a").await;
    browser.until("document.querySelectorAll('.attempts li').length === 3").await;
    browser.check("teacher-person").await;
    // One of three attempts goes, after a page that says what goes.
    browser.click(".attempts li:last-child .gone").await;
    browser.until("document.querySelector('.goes li')").await;
    browser.check("teacher-delete").await;
    browser.click("main .danger").await;
    browser.until("location.search === '?done=deleted'").await;
    assert_eq!(browser.text(".people tbody tr:first-child td:nth-child(6)").await, "2");

    // A class comes as an archive of Moodle's; it is graded in the background.
    browser.open(&server.at("/teacher/batches")).await;
    browser.check("teacher-archives").await;
    let archive = folder.path().join("CG-第6回.zip");
    moodle_archive(&archive);
    browser.keys("#archive", &archive.to_string_lossy()).await;
    browser.click("form[action='/teacher/batches'] .primary").await;
    browser.until("location.pathname.startsWith('/teacher/batches/') && document.querySelector('.downloads')").await;
    browser.until("[...document.images].every(i => (i.loading = 'eager', i.complete && i.naturalWidth > 0))").await;
    assert_eq!(browser.js("return document.querySelectorAll('.people tbody tr').length").await, 3);
    assert!(browser.text("main").await.contains("山田 太郎"));
    browser.check("teacher-batch").await;
    let csv = browser.js("return document.querySelector('.downloads a[href$=\"/csv\"]').getAttribute('href')").await;
    let csv = browser.fetch(csv.as_str().expect("an address")).await;
    assert!(csv.contains("山田 太郎") && csv.contains("100"), "{csv}");

    // Everything is graded again, with other probes; the results agree, and are adopted.
    browser.open(&server.at("/teacher/batches")).await;
    browser.click("[name=new_seed]").await;
    browser.click("form[action='/teacher/regradings'] button").await;
    browser.until("location.pathname.startsWith('/teacher/regradings/') && document.querySelector('.adopt')").await;
    assert!(browser.text(".lead").await.contains("0 lose points"));
    browser.check("teacher-regrading").await;
    browser.js("window.confirm = () => true").await;
    browser.click(".adopt button").await;
    browser.until("document.querySelector('.notice.good') && !document.querySelector('.adopt')").await;

    // Handing in ends; a student is told so.
    browser.open(&server.at("/teacher/settings")).await;
    browser.js("document.querySelector('#closes').value = '2020-01-01T00:00'").await;
    browser.click("form[action='/teacher/settings'] .primary").await;
    browser.until("location.search === '?done=saved'").await;
    browser.open(&server.at("/")).await;
    assert!(!browser.has("form.work .primary").await);
    assert!(browser.text(".terms-of-hand-in").await.contains("Closed since"));
    browser.check("student-closed").await;

    browser.size(320, 640).await;
    browser.open(&server.at("/teacher?lang=ja")).await;
    browser.check("phone-teacher-ja").await;
    browser.open(&server.at("/teacher/batches")).await;
    browser.check("phone-batches-ja").await;
    browser.click(".people tbody a").await;
    browser.until("document.querySelector('.downloads')").await;
    // Of a student, who it is and the points are in sight without scrolling sideways.
    let right = "document.querySelector('.people tbody td.number').getBoundingClientRect().right";
    browser.until(&format!("{right} <= document.documentElement.clientWidth")).await;
    browser.check("phone-batch-ja").await;
    browser.open(&server.at("/teacher/settings")).await;
    browser.check("phone-settings-ja").await;

    // A student opens the course link, gives a number in full-width letters and the personal code, and is known by them; a slip
    // is told.
    let link = browser.js("return document.querySelector('.link a').href").await;
    browser.open(&server.at("/teacher/codes")).await;
    browser.check("phone-codes-ja").await;
    let row = "[...document.querySelectorAll('.people tbody tr')].find(row => row.textContent.includes('S1006'))";
    let code = browser.js(&format!("return {row}.querySelector('code').textContent")).await;
    let code = code.as_str().expect("a code");
    browser.devtools("Network.clearBrowserCookies", serde_json::json!({})).await;
    browser.size(1280, 900).await;
    browser.open(link.as_str().expect("a link")).await;
    browser.check("join").await;
    browser.keys("#number", "山田").await;
    browser.keys("#code", code).await;
    browser.click("main .primary").await;
    browser.until("document.querySelector('[role=alert]')").await;
    // A refused form is answered with 422, which the browser notes.
    browser.complaints().await;
    browser.js("document.querySelectorAll('#number, #code').forEach(field => field.value = '')").await;
    browser.keys("#number", "ｓ１００６").await;
    browser.keys("#code", code).await;
    browser.click("main .primary").await;
    browser.until("location.pathname.startsWith('/a/')").await;
    assert!(browser.text(".who").await.contains("S1006"));
    browser.end().await;
}
