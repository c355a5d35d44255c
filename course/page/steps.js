// SPDX-License-Identifier: MIT
// From a trace to the list of steps that the page goes through. Each step says its stage, what it
// highlights, what it tells, and the function of course/pipeline that does it.
"use strict";

const EMPTY = 4294967295;
const RULES = ["as_written", "chapter32", "lowest_cell", "half_shell"];
// Which step of course/pipeline the page shows beside a rule.
const PROGRAM_OF = {
  as_written: "1_as_written.cpp",
  chapter32: "6_control_bits.cpp",
  lowest_cell: "8_exact.cpp",
  half_shell: null,  // the course text has nothing like it
};

// The function of course/pipeline that does a step, and its line that does it.
const CODE = {
  make_grid: ["make_grid", /1\.5F|2 \* r_max/],
  list_cells: ["list_cells", /cell_ids\[slot\]|cell_ids\.push_back/],
  tabulate: ["tabulate", /\+\+counters/],
  prefix_sum: ["prefix_sum", /sums\[d\] =/],
  reorder: ["reorder", /sorted\.cell_ids\[place\]/],
  index_cells: ["index_cells", /cells\.back\(\)\.phantoms/],
  is_tested_here: ["is_tested_here", /return cell_id|return !is_elsewhere|return cell ==/],
  main: ["main", /print_pairs/],
};

// The text's rule decides in one of three lines.
const CODE_OF_REASON = {
  "both are phantoms": /a & b & kPhantom/,
  "home with home": /return true/,
};

/** The entries of one sphere, the home first, with their places. */
function entriesOf(trace, ball) {
  const {cell_ids: ids, objects} = trace.stages.cell_ids;
  const found = [];
  objects.forEach((object, place) => {
    if (object && object.sphere === ball) found.push({place, id: ids[place], ...object});
  });
  return found.sort((a, b) => a.phantom - b.phantom);
}

/** Whether the eight places that the text gives a ball are used: more cells would be left out. */
function isFull(trace, ball) {
  return trace.rule === "as_written" && entriesOf(trace, ball).length === 8;
}

function digitOf(id, pass) {
  return Math.floor(id / 2 ** pass.shift) % 2 ** pass.bits;
}

function sceneStep(trace) {
  const values = {
    count: trace.spheres.length, exact: trace.exact.length, side: short(trace.side), column: short(trace.column),
  };
  const key = trace.rule === "half_shell" ? "say_scene_rows" : "say_scene";
  return {stage: "scene", say: [key, values], code: CODE.make_grid};
}

/** Whether the home is the cell of the centre: the text's conversion to unsigned may say otherwise. */
function holdsCentre(trace, ball, cell) {
  if (trace.rule !== "as_written") return true;
  const {low, width} = boxOf(trace, cell);
  return [0, 1, 2].every((axis) => {
    const at = trace.spheres[ball][axis] - low[axis];
    const rounding = 1e-6 * width[axis];
    return at >= -rounding && at <= width[axis] + rounding;
  });
}

function cellSteps(trace) {
  return trace.spheres.map((_, ball) => {
    const entries = entriesOf(trace, ball);
    const values = {ball, cell: entries[0].id, phantoms: entries.length - 1};
    const isFiled = holdsCentre(trace, ball, entries[0].cell);
    const key = trace.rule === "half_shell" ? "say_no_phantoms" : isFiled ? "say_cell_ids" : "say_saturated";
    const say = [key, values];
    if (isFull(trace, ball)) say.push("say_full", {});
    const ask = ball % 2 === 0 ? "ask_home" : "ask_phantoms";
    const answer = ball % 2 === 0 ? values.cell : values.phantoms;
    return {
      stage: "cell_ids", ball, say, code: CODE.list_cells,
      question: {ask: [ask, values], answer},
    };
  });
}

function passSteps(trace, number) {
  const {passes} = trace.stages.sort;
  const pass = passes[number];
  const before = number === 0 ? trace.stages.cell_ids : passes[number - 1];
  const values = {
    pass: number + 1, passes: passes.length, low: pass.shift, high: pass.shift + pass.bits - 1,
  };
  const steps = [
    {stage: "sort", pass: number, part: "counts", moved: 0, say: ["say_counts", values], code: CODE.tabulate},
    {stage: "sort", pass: number, part: "offsets", moved: 0, say: ["say_offsets", values], code: CODE.prefix_sum},
  ];
  before.cell_ids.forEach((id, from) => {
    if (id === EMPTY) return;
    const to = pass.places[from];
    const told = {from, to, digit: digitOf(id, pass)};
    steps.push({
      stage: "sort", pass: number, part: "reorder", from, moved: from + 1, say: ["say_place", told],
      code: CODE.reorder, question: {ask: ["ask_place", told], answer: to},
      ball: before.objects[from].sphere,
    });
  });
  return steps;
}

function sortSteps(trace) {
  const {passes} = trace.stages.sort;
  if (passes.length === 0) return [{stage: "sort", pass: -1, say: ["say_no_pass", {}], code: CODE.reorder}];
  return passes.flatMap((_, number) => passSteps(trace, number));
}

function indexSteps(trace) {
  const sorted = lastArrays(trace);
  return trace.stages.cell_index.cells.map((cell, row) => {
    const first = sorted.objects[cell.begin];
    const say = [["say_cell_index", cell]];
    if (cell.homes > 0 && first.phantom) say.push(["say_phantom_first", {}]);
    return {stage: "cell_index", row, cell: cell.cell, say: say.flat(), code: CODE.index_cells};
  });
}

function testSteps(trace) {
  return trace.stages.pair_tests.considered.map((one, row) => ({
    stage: "pair_tests", row, cell: one.cell, pair: [one.i, one.j],
    say: [
      trace.rule === "half_shell" ? "say_considered_row" :
        one.i === one.j ? "say_considered_self" : "say_considered",
      {...one, reason: {key: one.reason}, verdict: {key: one.verdict}},
    ],
    code: [CODE.is_tested_here[0], CODE_OF_REASON[one.reason] || CODE.is_tested_here[1]],
    question: {
      ask: ["ask_tested", one],
      answer: {key: one.verdict === "passed over" ? "no" : "yes"}, options: [{key: "yes"}, {key: "no"}],
    },
  }));
}

/** What is missed, and what is found twice: pairs as "i,j". */
function judge(trace) {
  const found = trace.pairs.map(String);
  const once = new Set(found);
  return {
    found: once.size,
    missed: trace.exact.map(String).filter((pair) => !once.has(pair)),
    duplicates: found.filter((pair, k) => found.indexOf(pair) !== k),
  };
}

/** Why a pair is missed: what happened in each cell that lists both. */
function lostStep(trace, pair) {
  const [i, j] = pair.split(",").map(Number);
  const met = trace.stages.pair_tests.considered.filter(
    (one) => Math.min(one.i, one.j) === i && Math.max(one.i, one.j) === j);
  const say = [met.length === 0 ? "say_lost_nowhere" : "say_lost", {i, j}];
  for (const one of met.slice(0, 3)) {
    if (one.reason !== "the phantom has the smaller home id") {
      say.push("say_lost_neither", {cell: one.cell});
      continue;
    }
    const phantom = entriesOf(trace, i).some((e) => e.id === one.cell && e.phantom) ? i : j;
    const home = entriesOf(trace, phantom)[0].id;
    const isListed = entriesOf(trace, i + j - phantom).some((e) => e.id === home);
    const values = {cell: one.cell, phantom, home, other: i + j - phantom};
    say.push(isListed ? "say_lost_left" : "say_lost_left_alone", values);
  }
  for (const ball of [i, j]) if (isFull(trace, ball)) say.push("say_lost_full", {ball});
  const code = met.length === 0 ? CODE.list_cells :
    [CODE.is_tested_here[0], CODE_OF_REASON[met[0].reason] || CODE.is_tested_here[1]];
  return {stage: "pairs", pair: [i, j], say, code};
}

function answerStep(trace) {
  const {found, missed, duplicates} = judge(trace);
  const values = {found, missed: missed.length, duplicates: duplicates.length};
  return {stage: "pairs", say: ["say_pairs", values], code: CODE.main};
}

/** The arrays after the last pass. */
function lastArrays(trace) {
  const {passes} = trace.stages.sort;
  return passes.length > 0 ? passes[passes.length - 1] : trace.stages.cell_ids;
}

function stepsOf(trace) {
  return [
    sceneStep(trace), ...cellSteps(trace), ...sortSteps(trace), ...indexSteps(trace), ...testSteps(trace),
    ...judge(trace).missed.map((pair) => lostStep(trace, pair)), answerStep(trace),
  ];
}

/** Numbers of a rule for the table of rules. */
function numbersOf(trace) {
  const {missed, duplicates, found} = judge(trace);
  return {
    entries: trace.stages.cell_ids.objects.filter(Boolean).length,
    tests: trace.stages.pair_tests.considered.filter((one) => one.verdict !== "passed over").length,
    pairs: found,
    missed: missed.length,
    duplicates: duplicates.length,
  };
}

function short(value) {
  return String(Number(value.toPrecision(4)));
}


