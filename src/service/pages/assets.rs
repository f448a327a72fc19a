//! What pages load besides themselves: styles, scripts, the right pictures of each assignment. All of it is part of the
//! program; an address holds a hash of the content, so that a browser may keep it for ever.

use crate::hand_in::hexadecimal;
use crate::pictures::{DrawnOnce, expected_pictures, telling_pose};
use crate::report::html::{BASE_STYLE, Motion, REPORT_STYLE, SCRIPT, expected_sheet};
use axum::extract::Path;
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use reference::Assignment;
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::sync::{Arc, LazyLock};

/// One file.
#[derive(Debug)]
struct Asset {
    name: String,
    address: String,
    kind: &'static str,
    content: Cow<'static, [u8]>,
}

impl Asset {
    fn new(name: impl Into<String>, content: impl Into<Cow<'static, [u8]>>) -> Self {
        let (name, content) = (name.into(), content.into());
        let hash = hexadecimal(&Sha256::digest(&content)[..8]);
        let (stem, extension) = name.rsplit_once('.').unwrap_or((&name, ""));
        let kind = match extension {
            "css" => "text/css; charset=utf-8",
            "js" => "text/javascript; charset=utf-8",
            "svg" => "image/svg+xml",
            "png" => "image/png",
            _ => "application/octet-stream",
        };
        Self { address: format!("/assets/{stem}.{hash}.{extension}"), name, kind, content }
    }

    fn text(name: &'static str, content: &'static str) -> Self {
        Self::new(name, content.as_bytes())
    }
}

static ASSETS: LazyLock<Vec<Asset>> = LazyLock::new(|| {
    vec![
        Asset::text("base.css", BASE_STYLE),
        Asset::text("report.css", REPORT_STYLE),
        Asset::text("report.js", SCRIPT),
        Asset::text("pages.css", include_str!("assets/pages.css")),
        Asset::text("teacher.css", include_str!("assets/teacher.css")),
        Asset::text("side_by_side.css", crate::likeness::view::STYLE),
        Asset::text("editor.css", include_str!("assets/editor.css")),
        Asset::text("editor.js", include_str!("assets/editor.js")),
        Asset::text("sheets.js", include_str!("assets/sheets.js")),
        Asset::text("drafts.js", include_str!("assets/drafts.js")),
        Asset::text("versions.js", include_str!("assets/versions.js")),
        Asset::text("picker.js", include_str!("assets/picker.js")),
        Asset::text("connection.js", include_str!("assets/connection.js")),
        Asset::text("grading.js", include_str!("assets/grading.js")),
        Asset::text("registered.js", include_str!("assets/registered.js")),
        Asset::text("standing.js", include_str!("assets/standing.js")),
        Asset::text("permalink.js", include_str!("assets/permalink.js")),
        Asset::text("receipt.js", include_str!("assets/receipt.js")),
        Asset::text("student.js", include_str!("assets/student.js")),
        Asset::text("preview.js", include_str!("assets/preview.js")),
        Asset::text("live.js", include_str!("assets/live.js")),
        Asset::text("menus.js", include_str!("assets/menus.js")),
        Asset::text("icon.svg", include_str!("assets/icon.svg")),
    ]
});

/// What is drawn for each assignment.
static DRAWN: DrawnOnce<Asset> = DrawnOnce::empty();

/// How the pictures of an assignment move, and the right ones; drawn once.
fn of_assignment(assignment: &Assignment) -> Arc<[Asset]> {
    DRAWN.of(assignment, || draw(assignment).into())
}

fn draw(assignment: &Assignment) -> Vec<Asset> {
    let expected = expected_pictures(assignment);
    let size = |side: u32| side as usize;
    let (width, height) = expected.first().map_or((4, 3), |first| (size(first.width), size(first.height)));
    let motion = Motion::of(expected.len().max(1), width, height).opening_with(telling_pose(assignment));
    let style = motion.style(assignment.scene.cycle).into_bytes();
    let mut assets = vec![Asset::new(motion_name(assignment), style)];
    match expected_sheet(&expected) {
        Ok(sheet) => assets.push(Asset::new(expected_name(assignment), sheet)),
        Err(fault) => tracing::error!(assignment = %assignment.id, fault = %fault.message.en, "no expected pictures"),
    }
    assets
}

/// Name of the style that moves the pictures of an assignment.
fn motion_name(assignment: &Assignment) -> String {
    format!("motion-{}.css", assignment.id)
}

/// Name of the sheet of the right pictures of an assignment.
fn expected_name(assignment: &Assignment) -> String {
    format!("expected-{}.png", assignment.id)
}

/// Makes all assets now, so that no student waits for the pictures.
pub fn warm(assignment: &Assignment) {
    LazyLock::force(&ASSETS);
    of_assignment(assignment);
}

/// The address of an asset; where there is none, one that answers "not found".
pub(super) fn address(name: &str) -> &'static str {
    ASSETS.iter().find(|asset| asset.name == name).map_or(NONE, |asset| asset.address.as_str())
}

/// The address of the style that moves the pictures of an assignment.
pub(super) fn motion(assignment: &Assignment) -> String {
    address_of(assignment, &motion_name(assignment))
}

/// The address of the sheet of the right pictures of an assignment.
pub(super) fn expected(assignment: &Assignment) -> String {
    address_of(assignment, &expected_name(assignment))
}

fn address_of(assignment: &Assignment, name: &str) -> String {
    let drawn = of_assignment(assignment);
    drawn.iter().find(|asset| asset.name == name).map_or(NONE, |asset| asset.address.as_str()).to_owned()
}

/// The address of what there is not.
const NONE: &str = "/assets/none";

/// `GET /assets/{name}`.
pub(super) async fn serve(Path(name): Path<String>) -> Response {
    let address = format!("/assets/{name}");
    let is_it = |asset: &&Asset| asset.address == address;
    let drawn = || {
        let drawn = DRAWN.all();
        drawn.iter().flat_map(|assets| assets.iter()).find(is_it).map(|asset| (asset.kind, asset.content.clone()))
    };
    let fixed = ASSETS.iter().find(is_it).map(|asset| (asset.kind, asset.content.clone()));
    let Some((kind, content)) = fixed.or_else(drawn) else { return StatusCode::NOT_FOUND.into_response() };
    let headers = [
        (header::CONTENT_TYPE, HeaderValue::from_static(kind)),
        (header::CACHE_CONTROL, HeaderValue::from_static("public, max-age=31536000, immutable")),
    ];
    (headers, content).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_asset_has_an_address_of_its_own_content() {
        let mut addresses: Vec<_> = ASSETS.iter().map(|asset| asset.address.as_str()).collect();
        addresses.sort_unstable();
        addresses.dedup();
        assert_eq!(addresses.len(), ASSETS.len());
        let one = Asset::new("a.css", b"x".as_slice());
        let other = Asset::new("a.css", b"y".as_slice());
        // SHA-256 of "x" begins 2d711642b726b044.
        assert_eq!(one.address, "/assets/a.2d711642b726b044.css");
        assert_ne!(one.address, other.address);
    }

    #[test]
    fn styles_and_scripts_refer_to_no_other_host() {
        for asset in ASSETS.iter().filter(|asset| asset.name.ends_with(".css") || asset.name.ends_with(".js")) {
            // The name of a markup language is no reference.
            let text = String::from_utf8_lossy(&asset.content).replace("http://www.w3.org/2000/svg", "");
            for reference in ["http:", "https:", "@import", "url(//"] {
                assert!(!text.contains(reference), "{} has {reference}", asset.name);
            }
        }
    }

    #[test]
    fn scripts_make_no_markup_of_text() {
        for asset in ASSETS.iter().filter(|asset| asset.name.ends_with(".js")) {
            let text = String::from_utf8_lossy(&asset.content);
            for way in ["innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(", "new Function"] {
                assert!(!text.contains(way), "{} has {way}", asset.name);
            }
        }
    }

    /// The editor is built with npm and kept beside its sources: `script/editor`. It may not be edited by hand, nor its
    /// sources without it.
    #[test]
    fn the_editor_is_what_its_sources_build() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/service/pages/assets/editor");
        let read = |name: &str| std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let sha256 = |bytes: &[u8]| Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
        let build = String::from_utf8(read("build.js")).expect("a text");
        let (_, rest) = build.split_once("const SOURCES = [").expect("the list of sources");
        let names: Vec<_> = rest.split("];").next().expect("its end").split('"').skip(1).step_by(2).collect();
        let mut files: Vec<_> = std::fs::read_dir(&folder)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .filter(|name| name.ends_with(".js") || name.ends_with(".json"))
            .collect();
        files.sort();
        let mut listed = names.clone();
        listed.sort_unstable();
        assert_eq!(listed, files, "build.js lists its sources");

        let sources: Vec<u8> = names.iter().flat_map(|name| read(name)).collect();
        let built = include_str!("assets/editor.js");
        let (head, body) = built.split_once('\n').expect("a first line");
        let expected = format!("// sources {} body {}", sha256(&sources), sha256(body.as_bytes()));
        assert_eq!(
            head, expected,
            "src/service/pages/assets/editor.js is not what its sources build: run script/editor"
        );
        assert!(body.contains("Permission is hereby granted"), "without its licence");
    }
}
