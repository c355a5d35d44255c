// SPDX-License-Identifier: MIT
// The scene as SVG and the arrays as HTML, from a trace and one of its steps. Nothing here keeps
// state: the same trace and step give the same text.
"use strict";

const WIDTH = 640;
const HEIGHT = 480;

/** Which cell, in the scene's units: the lowest corner and the width on each axis. */
function boxOf(trace, cell) {
  const width = [trace.column, trace.side, trace.side];
  return {low: cell.map((at, axis) => trace.corner[axis] + at * width[axis]), width};
}

/** The cells that the trace mentions, by coordinates. */
function cellsOf(trace) {
  const cells = new Map();
  for (const object of trace.stages.cell_ids.objects) {
    if (object) cells.set(String(object.cell), object.cell);
  }
  return [...cells.values()];
}

function isFlat(trace) {
  return trace.spheres.every((s) => s[2] === trace.spheres[0][2]);
}

/** From scene to picture: seen from above if flat, else turned so that depth shows. */
class View {
  constructor(trace) {
    this.flat = isFlat(trace);
    const corners = [];
    for (const cell of cellsOf(trace)) {
      const {low, width} = boxOf(trace, cell);
      for (let k = 0; k < 8; k++) corners.push(low.map((at, axis) => at + ((k >> axis) & 1) * width[axis]));
    }
    const balls = trace.spheres.flatMap(([x, y, z, r]) => [[x - r, y - r, z - r], [x + r, y + r, z + r]]);
    const points = [...balls, ...corners].map((p) => this.turn(p));
    const [left, right] = range(points.map((p) => p[0]));
    const [low, high] = range(points.map((p) => p[1]));
    this.scale = Math.min((WIDTH - 40) / (right - left || 1), (HEIGHT - 40) / (high - low || 1));
    this.middle = [(left + right) / 2, (low + high) / 2];
  }

  turn([x, y, z]) {
    if (this.flat) return [x, y, 0];
    const [a, b] = [0.5, 0.35];  // around the vertical axis, then towards the viewer
    const [u, w] = [x * Math.cos(a) + z * Math.sin(a), z * Math.cos(a) - x * Math.sin(a)];
    return [u, y * Math.cos(b) + w * Math.sin(b), w * Math.cos(b) - y * Math.sin(b)];
  }

  at(point) {
    const [u, v, depth] = this.turn(point);
    return [
      WIDTH / 2 + (u - this.middle[0]) * this.scale, HEIGHT / 2 - (v - this.middle[1]) * this.scale, depth,
    ];
  }
}

function range(values) {
  return [Math.min(...values), Math.max(...values)];
}

function line(from, to, style) {
  return `<line x1="${from[0]}" y1="${from[1]}" x2="${to[0]}" y2="${to[1]}" class="${style}"/>`;
}

/** A line that leaves the numbers at its ends legible. */
function shortLine(from, to, style) {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const cut = Math.min(12, length / 3) / (length || 1);
  const at = (share) => [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  return line(at(cut), at(1 - cut), style);
}

function cellShape(view, trace, cell, style) {
  const {low, width} = boxOf(trace, cell);
  const corner = (k) => view.at(low.map((at, axis) => at + ((k >> axis) & 1) * width[axis]));
  if (view.flat) {
    const [left, bottom] = corner(0);
    const [right, top] = corner(3);
    const size = `width="${right - left}" height="${bottom - top}"`;
    return `<rect x="${left}" y="${top}" ${size} class="cell ${style}" data-cell="${cell}"/>`;
  }
  const edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
  return edges.map(([a, b]) => line(corner(a), corner(b), `edge ${style}`)).join("");
}

/** Cells that the step is about: [cell, "home" or "phantom"]. */
function highlighted(trace, step) {
  if (step.stage === "cell_ids" || step.part === "reorder") {
    const shown = entriesOf(trace, step.ball).map((e) => [e.cell, e.phantom ? "phantom" : "home"]);
    return shown.reverse();
  }
  if (step.cell === undefined) return [];
  const {cell_ids: ids, objects} = trace.stages.cell_ids;
  const place = ids.indexOf(step.cell);
  return place < 0 ? [] : [[objects[place].cell, "home"]];
}

function pairLines(view, trace, step) {
  const middle = (ball) => view.at(trace.spheres[ball]);
  const shown = (pair, style) => {
    const [i, j] = typeof pair === "string" ? pair.split(",").map(Number) : pair;
    return shortLine(middle(i), middle(j), `pair ${style}`);
  };
  if (step.stage === "pair_tests") {
    const {considered} = trace.stages.pair_tests;
    const before = considered.slice(0, step.row).filter((one) => one.verdict === "overlap");
    const now = considered[step.row];
    return [
      ...before.map((one) => shown([one.i, one.j], "found")),
      shown(step.pair, now.verdict.replace(" ", "-")),
    ].join("");
  }
  if (step.stage !== "pairs") return "";
  if (step.pair) return shown(step.pair, "missed");
  const {missed, duplicates} = judge(trace);
  return [
    ...trace.pairs.map((pair) => shown(pair, "found")),
    ...duplicates.map((pair) => shown(pair, "duplicate")),
    ...missed.map((pair) => shown(pair, "missed")),
  ].join("");
}

function ballShape(view, trace, ball, step, word) {
  const [x, y] = view.at(trace.spheres[ball]);
  const radius = trace.spheres[ball][3] * view.scale;
  const isActive = step.ball === ball || (step.pair || []).includes(ball);
  return `<g class="ball${isActive ? " active" : ""}${view.flat ? "" : " solid"}" data-ball="${ball}" tabindex="0" role="button" aria-label="${word("ball", {ball})}">
<circle cx="${x}" cy="${y}" r="${Math.max(radius, 3)}"/><text x="${x}" y="${y}">${ball}</text></g>`;
}

function drawScene(trace, step, word) {
  const view = new View(trace);
  const order = trace.spheres.map((_, ball) => ball);
  if (!view.flat) order.sort((a, b) => view.at(trace.spheres[b])[2] - view.at(trace.spheres[a])[2]);
  return [
    ...cellsOf(trace).map((cell) => cellShape(view, trace, cell, "")),
    ...highlighted(trace, step).map(([cell, style]) => cellShape(view, trace, cell, style)),
    ...order.map((ball) => ballShape(view, trace, ball, step, word)),
    pairLines(view, trace, step),
  ].join("");
}

// ---- The arrays.

/** The id, and beside it the digit that the pass sorts by. */
function idAndDigit(id, pass) {
  return pass ? `${id}<b>:${digitOf(id, pass)}</b>` : String(id);
}

function chip(id, object, options, word) {
  const style = `${object.phantom ? "phantom" : "home"} ${options.style || ""}`;
  const title = `${word("cell", {cell: id})}, ${word("ball", {ball: object.sphere})}, ${word(object.phantom ? "phantom" : "home", {})}`;
  const name = `${object.sphere}${object.phantom ? "P" : "H"}`;
  return `<span class="chip ${style}" data-ball="${object.sphere}" data-cell="${object.cell}" title="${title}">` +
    `<i>${idAndDigit(id, options.pass)}</i>${name}</span>`;
}

function emptySlots(count, word) {
  if (count === 0) return "";
  return `<span class="chip empty" title="${word("empty", {})}">${count === 1 ? "·" : `·${count}`}</span>`;
}

/** Entries in their order; runs of empty slots are one chip with their number. */
function chips(arrays, optionsOf, word) {
  let text = "";
  let empty = 0;
  arrays.cell_ids.forEach((id, k) => {
    if (!arrays.objects[k]) {
      empty += 1;
      return;
    }
    text += emptySlots(empty, word) + chip(id, arrays.objects[k], optionsOf(k), word);
    empty = 0;
  });
  return text + emptySlots(empty, word);
}

function cellIdTable(trace, step, word) {
  const shown = step.stage === "scene" ? -1 : step.stage === "cell_ids" ? step.ball : Infinity;
  const rows = trace.spheres.map((_, ball) => {
    if (ball > shown) return "";
    const entries = entriesOf(trace, ball);
    const slots = trace.rule === "as_written" ? 8 - entries.length : 0;
    const filled = entries.map((e) => chip(e.id, e, {style: ball === step.ball ? "now" : ""}, word));
    return `<div class="row"><span class="name">${word("ball", {ball})}</span>${filled.join("")}${emptySlots(slots, word)}</div>`;
  });
  return rows.join("");
}

/** After a few moves: what lies where, the rest empty. */
function partlySorted(before, pass, moved) {
  const cell_ids = before.cell_ids.map(() => EMPTY);
  const objects = before.objects.map(() => null);
  for (let from = 0; from < moved; from++) {
    cell_ids[pass.places[from]] = before.cell_ids[from];
    objects[pass.places[from]] = before.objects[from];
  }
  return {cell_ids, objects};
}

function counterTable(pass, step, before, word) {
  const moving = step.part === "reorder" ? digitOf(before.cell_ids[step.from], pass) : -1;
  const columns = pass.counts.map((count, digit) => ({count, digit})).filter(({count}) => count > 0);
  const cells = (tag, text) => columns.map((c) => `<${tag}${c.digit === moving ? ' class="now"' : ""}>${text(c)}</${tag}>`).join("");
  const offsets = step.part === "counts" ? "" :
    `<tr><th>${word("offset", {})}</th>${cells("td", ({digit}) => pass.offsets[digit])}</tr>`;
  return `<table><tr><th>${word("digit", {})}</th>${cells("th", ({digit}) => digit)}</tr>
<tr><th>${word("counted", {})}</th>${cells("td", ({count}) => count)}</tr>${offsets}</table>`;
}

function sortArrays(trace, step, word) {
  const {passes} = trace.stages.sort;
  if (passes.length === 0) return chips(trace.stages.cell_ids, () => ({}), word);
  const pass = passes[step.pass];
  const before = step.pass === 0 ? trace.stages.cell_ids : passes[step.pass - 1];
  const after = partlySorted(before, pass, step.moved);
  const to = step.part === "reorder" ? pass.places[step.from] : -1;
  return `<h3>${word("before", {})}</h3><div class="row">${chips(before, (k) => ({pass, style: k === step.from ? "now" : k < step.moved ? "gone" : ""}), word)}</div>
${counterTable(pass, step, before, word)}
<h3>${word("after", {})}</h3><div class="row">${chips(after, (k) => ({pass, style: k === to ? "now" : ""}), word)}</div>`;
}

function indexTable(trace, step, word) {
  const {cells} = trace.stages.cell_index;
  const last = step.stage === "cell_index" ? step.row : cells.length - 1;
  const rows = cells.slice(0, last + 1).map((c) =>
    `<tr class="${c.cell === step.cell ? "now" : ""}"><td>${c.cell}</td><td>${c.begin}</td><td>${c.homes}</td><td>${c.phantoms}</td></tr>`);
  const heads = [word("cell", {cell: ""}), word("begin", {}), word("homes", {}), word("phantoms", {})];
  return `<div class="row">${chips(lastArrays(trace), (k) => ({style: lastArrays(trace).cell_ids[k] === step.cell ? "now" : ""}), word)}</div>
<table><tr>${heads.map((head) => `<th>${head}</th>`).join("")}</tr>${rows.join("")}</table>`;
}

function testTable(trace, step, word) {
  const all = trace.stages.pair_tests.considered;
  const last = step.stage === "pair_tests" ? step.row : all.length - 1;
  const first = Math.max(0, last - 13);  // what fits; the newest last
  const rows = all.slice(first, last + 1).map((one, k) =>
    `<tr class="${first + k === step.row ? "now " : ""}${one.verdict.replace(" ", "-")}"><td>${one.cell}</td><td>(${one.i}, ${one.j})</td>` +
    `<td>${word(one.reason, {})}</td><td>${word(one.verdict, {})}</td></tr>`);
  return `<table class="tests">${rows.join("")}</table>`;
}

function answerList(trace, word) {
  const {missed, duplicates} = judge(trace);
  const item = (pair, style) => `<span class="chip ${style}">(${String(pair).replace(",", ", ")})</span>`;
  return `<div class="row"><span class="name">${word("pairs", {})}</span>${[...new Set(trace.pairs.map(String))].map((p) => item(p, "found")).join("")}</div>
<div class="row"><span class="name">${word("missed", {})}</span>${missed.map((p) => item(p, "missed")).join("")}</div>
<div class="row"><span class="name">${word("duplicates", {})}</span>${duplicates.map((p) => item(p, "duplicate")).join("")}</div>`;
}

function drawArrays(trace, step, word) {
  switch (step.stage) {
    case "sort": return sortArrays(trace, step, word);
    case "cell_index": return indexTable(trace, step, word);
    case "pair_tests": return testTable(trace, step, word);
    case "pairs": return answerList(trace, word);
    default: return cellIdTable(trace, step, word);
  }
}
