// CodeMirror's styles as adopted style sheets: the Content-Security-Policy of the service allows no <style> element.
import { StyleModule as Module } from "./node_modules/style-mod/src/style-mod.js";

// What style-mod takes for a shadow root, in which it adopts style sheets.
const page = {
  ownerDocument: document,
  get adoptedStyleSheets() { return document.adoptedStyleSheets; },
  set adoptedStyleSheets(sheets) { document.adoptedStyleSheets = sheets; },
};

export class StyleModule extends Module {
  static mount(root, modules) {
    super.mount(page, modules);
  }
}
