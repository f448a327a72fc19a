"use strict";
// An editor that is a textarea: line numbers, colours and marks are painted behind it, and the keyboard stays the
// browser's own. Tab leaves it as it leaves every field.
const editGlsl = (host, textarea) => {
  const gutter = document.createElement("ol");
  const paint = document.createElement("pre");
  gutter.className = "gutter";
  paint.className = "paint";
  gutter.setAttribute("aria-hidden", "true");
  paint.setAttribute("aria-hidden", "true");
  host.append(gutter, paint);
  host.classList.add("live");

  const WORDS = {
    keyword: "attribute const uniform varying buffer shared centroid flat smooth noperspective layout patch sample break continue do for while switch case default if else subroutine in out inout discard return struct precision highp mediump lowp invariant precise true false",
    type: "void bool int uint float double vec2 vec3 vec4 dvec2 dvec3 dvec4 bvec2 bvec3 bvec4 ivec2 ivec3 ivec4 uvec2 uvec3 uvec4 mat2 mat3 mat4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 sampler2D samplerCube",
    builtin: "radians degrees sin cos tan asin acos atan pow exp log exp2 log2 sqrt inversesqrt abs sign floor ceil fract mod min max clamp mix step smoothstep length distance dot cross normalize faceforward reflect refract matrixCompMult transpose inverse determinant gl_Position gl_VertexID gl_InstanceID",
  };
  const kinds = new Map(Object.entries(WORDS).flatMap(([kind, list]) => list.split(" ").map((word) => [word, kind])));
  const TOKEN = /(\/\/.*)|(\/\*)|(^\s*#.*)|((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:lf|LF|[uUfF])?\b)|([A-Za-z_]\w*)/g;

  // The stretches of a line as [kind, text], and whether a comment goes on after it.
  const stretches = (line, commented) => {
    const found = [];
    let at = 0;
    if (commented) {
      const end = line.indexOf("*/");
      if (end < 0) return [[["comment", line]], true];
      at = end + 2;
      found.push(["comment", line.slice(0, at)]);
    }
    TOKEN.lastIndex = at;
    for (let match; (match = TOKEN.exec(line)); at = TOKEN.lastIndex) {
      if (match.index > at) found.push(["", line.slice(at, match.index)]);
      if (match[2]) {
        const end = line.indexOf("*/", match.index + 2);
        if (end < 0) return [[...found, ["comment", line.slice(match.index)]], true];
        TOKEN.lastIndex = end + 2;
        found.push(["comment", line.slice(match.index, end + 2)]);
      } else {
        const kind = match[1] ? "comment" : match[3] ? "directive" : match[4] ? "number" : kinds.get(match[5]) ?? "";
        found.push([kind, match[0]]);
      }
    }
    if (at < line.length) found.push(["", line.slice(at)]);
    return [found, false];
  };

  let marks = new Map();
  let painted = [];
  let isFilling = false;

  // A line with its marked characters told apart; columns count characters, not UTF-16 units.
  const row = (pieces, mark) => {
    const element = document.createElement("span");
    element.className = mark ? `row ${mark.kind}` : "row";
    let column = 1;
    for (const [kind, text] of pieces) {
      for (const [part, marked] of split(text, column, mark)) {
        const piece = document.createElement(marked ? "mark" : "span");
        piece.className = kind;
        piece.textContent = part;
        element.append(piece);
      }
      column += [...text].length;
    }
    element.append("\n");
    return element;
  };
  const split = (text, column, mark) => {
    if (!mark?.column) return [[text, false]];
    const letters = [...text];
    const from = Math.max(0, Math.min(letters.length, mark.column - column));
    const to = Math.max(from, Math.min(letters.length, mark.column + mark.length - column));
    const parts = [[letters.slice(0, from), false], [letters.slice(from, to), true], [letters.slice(to), false]];
    return parts.filter(([part]) => part.length).map(([part, marked]) => [part.join(""), marked]);
  };

  const draw = () => {
    const lines = textarea.value.split("\n");
    let commented = false;
    const next = lines.map((line, index) => {
      const mark = marks.get(index + 1);
      const key = `${commented ? 1 : 0}${mark ? `${mark.kind}:${mark.column}:${mark.length}` : ""}|${line}`;
      const [pieces, open] = stretches(line, commented);
      commented = open;
      return { key, pieces, mark };
    });
    next.forEach((line, index) => {
      if (painted[index] === line.key) return;
      const element = row(line.pieces, line.mark);
      const number = document.createElement("li");
      number.className = line.mark ? line.mark.kind : "";
      if (index < paint.children.length) {
        paint.children[index].replaceWith(element);
        gutter.children[index].replaceWith(number);
      } else {
        paint.append(element);
        gutter.append(number);
      }
    });
    while (paint.children.length > next.length) {
      paint.lastChild.remove();
      gutter.lastChild.remove();
    }
    painted = next.map((line) => line.key);
    textarea.rows = Math.max(lines.length, 20);
  };

  // A new line begins where the last one did.
  textarea.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || event.isComposing || event.ctrlKey || event.metaKey || event.altKey) return;
    const before = textarea.value.slice(0, textarea.selectionStart);
    const indent = /[ \t]*$/.exec(/(?:^|\n)([ \t]*)[^\n]*$/.exec(before)?.[1] ?? "")[0];
    const deeper = /\{[ \t]*$/.test(before) ? "  " : "";
    if (!indent && !deeper) return;
    event.preventDefault();
    insert(`\n${indent}${deeper}`);
  });

  // Through the browser's own command, so that undo takes it back.
  const insert = (text) => {
    if (!document.execCommand("insertText", false, text)) textarea.setRangeText(text, textarea.selectionStart, textarea.selectionEnd, "end");
  };

  // The box around scrolls, not the textarea in it: what is typed stays in sight.
  const reveal = () => {
    const before = textarea.value.slice(0, textarea.selectionEnd).split("\n");
    const element = paint.children[before.length - 1];
    if (!element || document.activeElement !== textarea) return;
    const range = document.createRange();
    let left = before[before.length - 1].length;
    const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
    for (let node; (node = walker.nextNode()); left -= node.length) {
      range.setStart(node, Math.min(left, node.length));
      if (left <= node.length) break;
    }
    range.collapse(true);
    const caret = range.getClientRects()[0] ?? element.getBoundingClientRect();
    const box = host.getBoundingClientRect();
    const margin = 24;
    const start = box.left + gutter.offsetWidth + margin;
    if (caret.left < start) host.scrollLeft -= start - caret.left;
    if (caret.left > box.right - margin) host.scrollLeft += caret.left - box.right + margin;
    if (caret.top < box.top + margin) host.scrollTop -= box.top + margin - caret.top;
    if (caret.bottom > box.bottom - margin) host.scrollTop += caret.bottom - box.bottom + margin;
  };

  let scheduled = 0;
  textarea.addEventListener("input", () => {
    cancelAnimationFrame(scheduled);
    scheduled = requestAnimationFrame(() => {
      draw();
      reveal();
    });
  });
  draw();

  return {
    get text() {
      return textarea.value;
    },
    // Calls the listener when a person changes the text; not when the page fills it.
    changed(listener) {
      textarea.addEventListener("input", () => { if (!isFilling) listener(); });
    },
    // Everything in it, in place of what is there; undo brings that back.
    fill(text) {
      const focused = document.activeElement;
      textarea.focus({ preventScroll: true });
      textarea.select();
      isFilling = true;
      insert(text);
      isFilling = false;
      textarea.setSelectionRange(0, 0);
      host.scrollTop = 0;
      if (focused && focused !== document.body) focused.focus({ preventScroll: true });
      else textarea.blur();
      draw();
    },
    mark(found) {
      marks = new Map();
      for (const mark of found) if (!marks.has(mark.line)) marks.set(mark.line, mark);
      draw();
    },
    go(line) {
      const lines = textarea.value.split("\n");
      const start = lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
      textarea.focus();
      textarea.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
      paint.children[line - 1]?.scrollIntoView({ block: "center", inline: "nearest" });
    },
    // Brings a line into the middle of the box; the page and the cursor stay where they are.
    show(line) {
      const element = paint.children[line - 1];
      if (element) host.scrollTop = element.offsetTop - host.clientHeight / 2;
    },
  };
};
