//! Files that are no vertex shader, and vertex shaders that look like one of them.

use super::*;

fn said(bytes: impl AsRef<[u8]>) -> String {
    refuse(bytes).diagnostics[0].message.en.clone()
}

#[test]
fn wrong_files_are_told_what_they_seem_to_be() {
    let fragment = "#version 410 core\nout vec4 fc;\nvoid main() { fc = vec4(gl_FragCoord.x); }\n";
    let cpp = "#include <iostream>\nint main(int argc, char **argv)\n{\n  return 0;\n}\n";
    for (text, word) in [
        ("", "empty"),
        (" \r\n\t\n", "white space"),
        ("\u{FEFF}", "white space"),
        ("// TODO\n/* nothing */\n", "nothing but comments"),
        (cpp, "C++"),
        ("using namespace std;\nclass A {};\n", "C++"),
        (&format!("{cpp}const char *s = R\"(\ngl_Position = pv;\n)\";\n"), "C++"),
        (fragment, "the fragment shader"),
        ("layout(points) in;\nvoid main() { EmitVertex(); }\n", "geometry shader"),
        ("<!DOCTYPE html>\n<html><body></body></html>\n", "HTML"),
        ("\n<?xml version='1.0'?>\n<svg/>\n", "XML"),
        ("{\\rtf1\\ansi text}", "RTF"),
        ("diff --git a/a.vert b/a.vert\n--- a/a.vert\n+++ b/a.vert\n@@ -1 +1 @@\n-a\n+b\n", "patch"),
        ("# Answer\n```glsl\nvoid main() { gl_Position = vec4(0); }\n```\n", "Markdown"),
        ("void main() {\n<<<<<<< HEAD\ngl_Position = vec4(0);\n=======\n>>>>>>> x\n}\n", "merge conflict"),
        ("import moderngl\ndef main():\n    pass\n", "Python"),
    ] {
        let message = said(text);
        assert!(message.contains(word), "{text:?}: {message}");
    }
}

#[test]
fn the_refusal_points_at_the_line_that_gave_it_away() {
    let refusal = refuse("text\n```glsl\nvoid main() {}\n```\n");
    assert_eq!(places(&refusal.diagnostics), [(2, 1, 3)]);
    let refusal = refuse("out vec4 c;\nvoid main() {\n  discard;\n}\n");
    assert_eq!(places(&refusal.diagnostics), [(3, 3, 7)]);
}

#[test]
fn a_comment_without_an_end_is_named() {
    let refusal = refuse("\n/* abc\nvoid main() {}\n");
    assert_eq!(places(&refusal.diagnostics), [(2, 1, 2)]);
}

#[test]
fn vertex_shaders_are_not_refused_for_what_they_mention() {
    for text in [
        shader("int main() #include <iostream> std::cout discard gl_FragCoord", "", ""),
        shader("<html> ``` diff --git", "/*\n```\n@@ -1 +1 @@\n<<<<<<< HEAD\n<html>\n*/", ""),
        shader("", "int maintain(int a) { return a; }", ""),
        // Wrong, but the compiler says it better.
        shader("", "#include <iostream>", ""),
        "int main() { gl_Position = vec4(0); }".to_owned(),
        "#version 410 core\nint main() { return 0; }".to_owned(),
        "// 光\nfloat f;".to_owned(),
    ] {
        accept(text);
    }
}

#[test]
fn the_fragment_shader_is_told_by_what_it_takes_in() {
    let fragment = accept("#version 410 core\nin vec4 colour;\nout vec4 fc;\nvoid main() { fc = colour; }\n");
    let found = fragment_shader(&fragment, "colour").map(|refusal| places(&[refusal]));
    assert_eq!(found, Some(vec![(2, 9, 6)]));
    assert!(fragment_shader(&accept("in highp vec4 colour;\nvoid main() {}\n"), "colour").is_some());
    // A vertex shader that forgets its position, one that takes in too much, and one that only mentions it.
    for text in [
        "in vec4 pv;\nout vec4 colour;\nvoid main() { colour = pv; }\n",
        "in vec4 colour;\nvoid main() { gl_Position = colour; }\n",
        "// in vec4 colour;\nout vec4 colour;\nvoid main() { colour = vec4(0); }\n",
    ] {
        assert_eq!(fragment_shader(&accept(text), "colour"), None, "{text}");
    }
}
