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
  half_shell: "8_exact.cpp",
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

/** The entries of one sphere, the home first, with their places. */
function entriesOf(trace, ball) {
  const {cell_ids: ids, objects} = trace.stages.cell_ids;
  const found = [];
  objects.forEach((object, place) => {
    if (object && object.sphere === ball) found.push({place, id: ids[place], ...object});
  });
  return found.sort((a, b) => a.phantom - b.phantom);
}

function digitOf(id, pass) {
  return Math.floor(id / 2 ** pass.shift) % 2 ** pass.bits;
}

function sceneStep(trace) {
  const values = {count: trace.spheres.length, exact: trace.exact.length, side: short(trace.side)};
  return {stage: "scene", say: ["say_scene", values], code: CODE.make_grid};
}

function cellSteps(trace) {
  return trace.spheres.map((_, ball) => {
    const entries = entriesOf(trace, ball);
    const values = {ball, cell: entries[0].id, phantoms: entries.length - 1};
    const key = trace.rule === "half_shell" ? "say_no_phantoms" : "say_cell_ids";
    const ask = ball % 2 === 0 ? "ask_home" : "ask_phantoms";
    const answer = ball % 2 === 0 ? values.cell : values.phantoms;
    return {
      stage: "cell_ids", ball, say: [key, values], code: CODE.list_cells,
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
    say: ["say_considered", {...one, reason: {key: one.reason}, verdict: {key: one.verdict}}],
    code: CODE.is_tested_here,
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
    answerStep(trace),
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


