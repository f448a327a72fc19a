//! The pages in a real browser: as a student, on a phone, without scripts, as a teacher.
//!
//! Every page that is met is held to what holds for all (`Browser::check`): accessible in light and dark, no complaint
//! of the browser, no scrolling sideways. Pictures of the pages are written to `target/screenshots/`.

mod chromium;

use chromium::server::{Server, TOKEN};
use chromium::{Browser, sample};

const RIGHT: &str = "accepted/answers/alpha-two.vert";
const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";
const BROKEN: &str = "rejected/undeclared-capital-max.vert";

/// A hostile file: its name and text try to leave their place, and its loop never ends.
fn hostile(folder: &std::path::Path) -> String {
    let path = folder.join("<img src=x onerror=alert(1)>.vert");
    let text = "#version 410 core\n// </textarea></script><script>alert(1)</script>\nin vec4 pv; in vec4 cv;\n\
                uniform mat4 mw, mc, mg;\nout vec4 vc;\nvoid main() {\n  float x = 0.0;\n  while (pv.w > 0.5) x += 0.001;\n\
                vc = vec4(x);\n  gl_Position = mc * pv;\n}\n";
    std::fs::write(&path, text).expect("a file");
    path.to_string_lossy().into_owned()
}

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

/// Chooses a file on the student's page and waits for its result, which is a draft.
async fn choose(browser: &Browser, file: &str, mark: &str) {
    browser.keys("#file", file).await;
    browser
        .until(&format!(
            "document.querySelector('article.report[data-mark={mark}]') && \
                            !document.querySelector('[aria-busy]')"
        ))
        .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_student_uploads_right_wrong_broken_and_hostile_files() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    assert_eq!(browser.text("h1").await, "Gouraud shading");
    browser.check("student-first").await;

    choose(&browser, &sample(WRONG), "partial").await;
    assert_eq!(browser.text(".result .word").await, "Not right yet");
    assert_eq!(browser.text(".result .score").await.replace('\n', " "), "Score 80 / 100");
    // The half vector is not normalised in line 33: the editor marks it, and a link of the report leads there.
    browser.until("document.querySelectorAll('.gutter li')[32].className === 'rubric'").await;
    browser.click(".rubric a[href='#L33']").await;
    let at = browser
        .js("const t = document.querySelector('#code'); return document.activeElement === t && \
                         t.value.slice(t.selectionStart, t.selectionEnd)")
        .await;
    assert_eq!(at, "  vec3 h = (l + v) / 2.0;      // 中間ベクトル");
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("student-wrong-draft").await;
    assert!(!browser.has(".attempts").await, "a draft is no attempt");

    browser.click("form.work .primary").await;
    browser.until("location.pathname.startsWith('/r/')").await;
    assert_eq!(browser.text(".word").await, "Not right yet");
    browser.check("report-wrong").await;
    let link = browser.address().await;

    browser.open(&server.at("/")).await;
    browser.until("document.querySelectorAll('.attempts li').length === 1").await;
    choose(&browser, &sample(BROKEN), "none").await;
    assert_eq!(browser.text(".result .word").await, "Not accepted");
    assert!(browser.has(".gutter .error").await && browser.has(".paint .error mark").await);
    assert_eq!(browser.js("return document.querySelector('#code').getAttribute('aria-invalid')").await, "true");
    browser.check("student-broken").await;

    let folder = tempfile::tempdir().expect("a folder");
    choose(&browser, &hostile(folder.path()), "none").await;
    assert_eq!(browser.text(".result .word").await, "Stopped");
    assert!(browser.text(".result .file").await.contains("<img src=x onerror=alert(1)>"), "shown as it is");
    browser.check("student-hostile").await;
    browser.click("form.work .primary").await;
    browser.until("location.pathname.startsWith('/r/')").await;
    browser.check("report-hostile").await;

    browser.open(&server.at("/?lang=ja")).await;
    assert_eq!(browser.js("return document.documentElement.lang").await, "ja");
    choose(&browser, &sample(RIGHT), "full").await;
    assert_eq!(browser.text(".result .word").await, "正解");
    browser.check("student-right-ja").await;
    browser.click("form.work .primary").await;
    browser.until("location.pathname.startsWith('/r/')").await;
    browser.check("report-right-ja").await;
    browser.open(&server.at("/")).await;
    assert_eq!(browser.js("return document.documentElement.lang").await, "ja", "the choice is remembered");
    browser.until("document.querySelectorAll('.attempts li').length === 3").await;
    assert!(browser.text(".attempts .best").await.contains("100"));
    browser.check("student-attempts-ja").await;

    // Whoever has the link sees the report, with none of the student's cookies.
    browser.devtools("Network.clearBrowserCookies", serde_json::json!({})).await;
    browser.open(&link).await;
    assert_eq!(browser.text(".word").await, "Not right yet");
    browser.open(&server.at("/")).await;
    assert!(!browser.has(".attempts").await, "nobody sees another one's attempts");
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_editor_grades_what_is_typed_last() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.open(&server.at("/")).await;
    // The cursor goes behind `vc = ` and the answer is typed, with a slip first.
    browser
        .js("const t = document.querySelector('#code'); const at = t.value.indexOf('vc = cv;') + 5; \
                t.focus(); t.setSelectionRange(at, at + 2);")
        .await;
    browser.keys("#code", "kamb * lam").await;
    browser.until("document.querySelector('article.report[data-mark=none]')").await;
    browser
        .keys(
            "#code",
            "b + max(dot(n, l), 0.0) * kdiff * ldiff \
                           + pow(max(dot(n, normalize(l + v)), 0.0), kshi) * kspec * lspec",
        )
        .await;
    browser.until("document.querySelector('article.report[data-mark=full]')").await;
    assert!(browser.text("#state").await.starts_with("Correct: 100 / 100"), "said in the live region");
    assert!(!browser.has(".gutter .error").await, "no mark is left behind");
    browser.check("editor-typed").await;

    // The animation stops at a pose, by keyboard.
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.js("document.querySelector('.player input').focus()").await;
    browser.keys(".player input", "\u{E014}\u{E014}").await;
    browser.until("document.querySelector('.player').classList.contains('paused')").await;

    // Tab leaves the editor.
    browser.js("document.querySelector('#code').focus()").await;
    browser.keys("#code", "\u{E004}").await;
    assert_ne!(browser.js("return document.activeElement.id").await, "code");

    // What was typed is still there when the page is opened again, and is graded; the hand-out comes back on demand.
    browser.open(&server.at("/")).await;
    browser.until("document.querySelector('#code').value.includes('pow(max(dot(n, normalize')").await;
    browser.until("document.querySelector('article.report[data-mark=full]')").await;
    browser.click("[data-do=starter]").await;
    browser.until("document.querySelector('#code').value.includes('vc = cv;')").await;
    browser.until("document.querySelector('.brief')").await;

    // A file is dropped on the page.
    browser
        .js("const data = new DataTransfer(); data.items.add(new File(['no shader'], 'dropped.vert')); \
                dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));")
        .await;
    browser.until("document.querySelector('article.report .file')?.textContent === 'dropped.vert'").await;
    assert_eq!(browser.complaints().await, [] as [String; 0]);
    browser.end().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_phone_and_a_browser_without_scripts_do_everything() {
    let (server, browser) = (Server::start(), Browser::start().await);
    browser.size(320, 640).await;
    browser.languages("ja").await;
    browser.open(&server.at("/")).await;
    browser.check("phone-first").await;
    choose(&browser, &sample(WRONG), "partial").await;
    browser.until("[...document.querySelectorAll('.report img')].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("phone-draft").await;
    browser.click("form.work .primary").await;
    browser.until("location.pathname.startsWith('/r/')").await;
    browser.check("phone-report").await;

    browser.size(1280, 900).await;
    browser.languages("en").await;
    browser.scripts(false).await;
    browser.open(&server.at("/")).await;
    browser.shot("no-script-first").await;
    assert!(!browser.has(".gutter").await);
    browser.keys("#file", &sample(BROKEN)).await;
    browser.click("form.work .without-script").await;
    browser.until_there("article.report .listing").await;
    assert!(browser.text(".about").await.starts_with("A draft"));
    browser.shot("no-script-draft").await;
    browser.open(&server.at("/")).await;
    browser.keys("#file", &sample(RIGHT)).await;
    browser.click("form.work .primary").await;
    browser.until_there("article.report.report .head.full").await;
    assert_eq!(browser.text(".word").await, "Correct");
    browser.shot("no-script-report").await;
    browser.end().await;
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
    std::fs::write(&roster, "number,name\nS1001,和田 花子\nS1002,<b>Bold</b>\nS1006,Late Comer\n").expect("a file");
    browser.keys("#roster-file", &roster.to_string_lossy()).await;
    browser.click("form[action='/teacher/roster'] button").await;
    browser.until("document.querySelector('[role=status]')").await;
    browser.check("teacher-settings").await;

    browser.open(&server.at("/teacher")).await;
    browser.until("document.querySelectorAll('.people tbody tr').length === 6").await;
    assert!(browser.text(".people").await.contains("<b>Bold</b>"), "a name stays text");
    browser.js("document.querySelectorAll('img[loading]').forEach(i => i.loading = 'eager')").await;
    browser.until("[...document.images].every(i => i.complete && i.naturalWidth > 0)").await;
    browser.check("teacher-class").await;
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
    browser.open(&server.at("/teacher/settings")).await;
    browser.check("phone-settings-ja").await;

    // A student opens the course link, gives a number in full-width letters, and is known by it; a slip is told.
    let link = browser.js("return document.querySelector('.link a').href").await;
    browser.devtools("Network.clearBrowserCookies", serde_json::json!({})).await;
    browser.size(1280, 900).await;
    browser.open(link.as_str().expect("a link")).await;
    browser.check("join").await;
    browser.keys("#number", "山田").await;
    browser.click("main .primary").await;
    browser.until("document.querySelector('[role=alert]')").await;
    // A refused form is answered with 422, which the browser notes.
    browser.complaints().await;
    browser.js("document.querySelector('#number').value = ''").await;
    browser.keys("#number", "ｓ１００６").await;
    browser.click("main .primary").await;
    browser.until("location.pathname.startsWith('/a/')").await;
    assert!(browser.text(".who").await.contains("S1006"));
    browser.end().await;
}
