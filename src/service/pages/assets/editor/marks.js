// Lines that a report speaks of: a sign in the gutter, a tinted line, and the characters that are meant underlined.
import { RangeSet, RangeSetBuilder, StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, GutterMarker, gutterLineClass } from "@codemirror/view";

const setMarks = StateEffect.define();

class LineSign extends GutterMarker {
  constructor(kind) {
    super();
    this.elementClass = kind;
  }
  eq(other) {
    return other.elementClass === this.elementClass;
  }
}

const KINDS = ["error", "warning", "rubric"];
const lines = Object.fromEntries(KINDS.map((kind) => [kind, Decoration.line({ class: kind })]));
const signs = Object.fromEntries(KINDS.map((kind) => [kind, new LineSign(kind)]));
const underlined = Decoration.mark({ tagName: "mark" });

const NONE = { decorations: Decoration.none, signs: RangeSet.empty, isInvalid: false };

// Columns count characters, positions UTF-16 units.
const position = (line, column) => line.from + [...line.text].slice(0, column - 1).join("").length;

const placed = (doc, marks) => {
  const first = new Map();
  for (const mark of marks) if (mark.line <= doc.lines && !first.has(mark.line)) first.set(mark.line, mark);
  const decorations = new RangeSetBuilder();
  const inGutter = new RangeSetBuilder();
  for (const mark of [...first.values()].sort((a, b) => a.line - b.line)) {
    const line = doc.line(mark.line);
    decorations.add(line.from, line.from, lines[mark.kind]);
    inGutter.add(line.from, line.from, signs[mark.kind]);
    if (!mark.column) continue;
    const from = position(line, mark.column);
    const to = position(line, mark.column + mark.length);
    if (to > from) decorations.add(from, to, underlined);
  }
  return { decorations: decorations.finish(), signs: inGutter.finish(), isInvalid: marks.some((mark) => mark.kind === "error") };
};

const field = StateField.define({
  create: () => NONE,
  update(value, transaction) {
    const set = transaction.effects.find((effect) => effect.is(setMarks));
    if (set) return placed(transaction.newDoc, set.value);
    if (!transaction.docChanged || value === NONE) return value;
    return { ...value, decorations: value.decorations.map(transaction.changes), signs: value.signs.map(transaction.changes) };
  },
  provide: (self) => [
    EditorView.decorations.from(self, (value) => value.decorations),
    gutterLineClass.from(self, (value) => value.signs),
    EditorView.contentAttributes.from(self, (value) => ({ "aria-invalid": String(value.isInvalid) })),
  ],
});

export const marks = field;
export const marking = (found) => setMarks.of(found);
