// Builds ../editor.js from this folder: `script/editor`. Its first line says from what it was built, and a test of the
// service holds it to that.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const SOURCES = ["package.json", "package-lock.json", "build.js", "editor.js", "glsl.js", "japanese.js", "marks.js", "styles.js"];
const sha256 = (parts) => parts.reduce((hash, part) => hash.update(part), createHash("sha256")).digest("hex");

const { outputFiles } = await build({
  entryPoints: ["editor.js"],
  alias: { "style-mod": "./styles.js" },
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  write: false,
});
const licence = readFileSync("node_modules/@codemirror/view/LICENSE", "utf8").trim();
const body = `"use strict";\n/* Built by script/editor from src/service/pages/assets/editor/ and CodeMirror (codemirror.net):\n\n${licence}\n*/\n${outputFiles[0].text}`;
const sources = sha256(SOURCES.map((name) => readFileSync(name)));
writeFileSync("../editor.js", `// sources ${sources} body ${sha256([body])}\n${body}`);
