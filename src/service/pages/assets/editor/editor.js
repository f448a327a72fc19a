// The editor of the student's page. It stands in the place of a textarea, which stays in the form and holds the text:
// without scripts, it is the editor. Tab leaves the editor as it leaves every field.
import { defaultKeymap, history, historyKeymap, isolateHistory } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState } from "@codemirror/state";
import { EditorView, highlightSpecialChars, keymap, lineNumbers } from "@codemirror/view";
import { tagHighlighter, tags } from "@lezer/highlight";
import { glsl } from "./glsl.js";
import { japanese } from "./japanese.js";
import { marking, marks } from "./marks.js";

const TAKEN_OVER = 150; // milliseconds
const isFilled = Annotation.define();
// Android's keyboards compose every word, and go on until the cursor leaves it.
const isAndroid = /Android/.test(navigator.userAgent);
const colours = tagHighlighter([
  { tag: tags.comment, class: "comment" },
  { tag: tags.keyword, class: "keyword" },
  { tag: tags.typeName, class: "type" },
  { tag: tags.standard(tags.variableName), class: "builtin" },
  { tag: [tags.number, tags.atom], class: "number" },
  { tag: tags.meta, class: "directive" },
]);

globalThis.editGlsl = (host, textarea, { grade }) => {
  const listeners = [];
  let composing = false;
  let heldBack = false; // whether the text changed while an input method composes

  const tell = () => {
    if (composing) {
      heldBack = true;
      return;
    }
    heldBack = false;
    for (const listener of listeners) listener();
  };
  // The view takes over what was composed a moment after the end of it, and then there is nothing left to tell.
  const composed = () => {
    composing = false;
    setTimeout(() => { if (heldBack) tell(); }, TAKEN_OVER);
  };

  const view = new EditorView({
    state: EditorState.create({
      doc: textarea.value,
      extensions: [
        lineNumbers(),
        highlightSpecialChars(),
        history(),
        EditorState.tabSize.of(4),
        indentUnit.of("  "),
        glsl,
        syntaxHighlighting(colours),
        indentOnInput(),
        bracketMatching(),
        highlightSelectionMatches(),
        search({ top: true }),
        keymap.of([
          { key: "Mod-Enter", run: () => { grade(); return true; } },
          ...searchKeymap,
          ...historyKeymap,
          ...defaultKeymap,
        ]),
        marks,
        EditorState.phrases.of(document.documentElement.lang === "ja" ? japanese : {}),
        EditorView.contentAttributes.of({
          "aria-label": textarea.labels[0].textContent,
          "aria-describedby": textarea.getAttribute("aria-describedby"),
          tabindex: "0",
        }),
        EditorView.domEventHandlers({
          compositionstart: () => { composing = !isAndroid; },
          compositionend: composed,
          blur: composed,
        }),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged) return;
          textarea.value = view.state.doc.toString();
          if (!update.transactions.some((transaction) => transaction.annotation(isFilled))) tell();
        }),
      ],
    }),
  });
  // Before the textarea, as it is met first.
  host.prepend(view.dom);
  addEventListener("pagehide", () => {
    composing = false;
    if (heldBack) tell();
  });
  host.classList.add("live");
  textarea.hidden = true;

  const lineOf = (number) => view.state.doc.line(Math.max(1, Math.min(number, view.state.doc.lines)));

  return {
    get text() {
      return view.state.doc.toString();
    },
    // Whether an input method composes: the text holds what nobody has decided on yet.
    get isComposing() {
      return composing;
    },
    // Calls the listener when a person has changed the text: not when the page fills it, and not before an input method
    // has done.
    changed(listener) {
      listeners.push(listener);
    },
    // Everything in it, in place of what is there; undo brings that back.
    fill(text) {
      view.dispatch({
        changes: { from: 0, to: view.state.doc.length, insert: text },
        selection: { anchor: 0 },
        annotations: [isFilled.of(true), isolateHistory.of("full")],
      });
      view.scrollDOM.scrollTo({ top: 0, left: 0 });
    },
    // Marks lines: { line, column, length, kind }, counted from 1 in characters; of several on a line the first.
    mark(found) {
      view.dispatch({ effects: marking(found) });
    },
    // Selects a line, and goes there.
    go(number) {
      const line = lineOf(number);
      view.focus();
      view.dispatch({
        selection: { anchor: line.from, head: line.to },
        effects: EditorView.scrollIntoView(line.from, { y: "center", x: "start" }),
      });
    },
    // Brings a line into the middle of the box, and the cursor to it; the page and the focus stay where they are. Nothing
    // moves under a person who is in the editor.
    show(number) {
      if (view.hasFocus) return;
      const line = lineOf(number);
      view.dispatch({ selection: { anchor: line.from + /^\s*/.exec(line.text)[0].length } });
      const block = view.lineBlockAt(line.from);
      view.scrollDOM.scrollTop = block.top - (view.scrollDOM.clientHeight - block.height) / 2;
    },
  };
};
