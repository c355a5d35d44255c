// SPDX-License-Identifier: MIT
// The run in the file, as `octocell trace` recorded it: where the page begins, and a check that what
// the page computes is what the program computed.
"use strict";

const PHANTOM_BIT = 2 ** 31;
const ID_BITS = 2 ** 28;

function recordedRule(recorded) {
  const name = recorded.plan.rule || recorded.plan.method;
  return RULES.includes(name) ? name : "lowest_cell";
}

/** The cell side that was asked for, of rule lowest_cell; 0: two largest radii. */
function recordedSide(recorded) {
  const {rule, cell_side: asked, grids} = recorded.plan;
  return rule === "lowest_cell" ? asked || grids[0].sides[1] : 0;
}

/** A side that the planner chose itself may lead to other cells here. */
function hasSameCells(recorded, trace) {
  const {method, grids} = recorded.plan;
  return method === "home_phantom" && Math.fround(trace.side) === Math.fround(grids[0].sides[1]);
}

/** Cell, sphere, home or phantom: sorted, since threads may list phantoms in any order. */
function recordedEntries(recorded) {
  const {cell_ids: ids, objects} = recorded.stages.cell_ids;
  return objects.map((word, k) => `${ids[k]} ${word % ID_BITS} ${word >= PHANTOM_BIT}`).sort();
}

function computedEntries(trace) {
  const {cell_ids: ids, objects} = trace.stages.cell_ids;
  return objects.map((object, k) => object && `${ids[k]} ${object.sphere} ${object.phantom}`)
    .filter((entry) => entry).sort();
}

/** Whether the page shows the spheres, the rule and the cells of the run. */
function isShown(recorded, trace) {
  const isSame = JSON.stringify(recorded.spheres.map((s) => s.map(Math.fround))) === JSON.stringify(trace.spheres);
  const {rule, grids} = recorded.plan;
  const sameSide = rule !== "lowest_cell" || Math.fround(trace.side) === Math.fround(grids[0].sides[1]);
  return isSame && sameSide && recordedRule(recorded) === trace.rule;
}

/** The text that says what agrees. Half shells have other columns here, brute force has no cells. */
function compareWith(recorded, tracer) {
  const trace = tracer.trace(recorded.spheres, recordedRule(recorded), recordedSide(recorded));
  const isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b);
  const hasCells = hasSameCells(recorded, trace);
  const same = isSame(trace.pairs, recorded.pairs) &&
    (!hasCells || isSame(computedEntries(trace), recordedEntries(recorded)));
  return {key: !same ? "recorded_differs" : hasCells ? "recorded_same" : "recorded_pairs", side: trace.side};
}
