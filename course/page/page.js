// SPDX-License-Identifier: MIT
// What the reader does: steps, keys, dragging, sliders, questions. The page is drawn again from the
// state after each.
"use strict";

// A link may say where to begin: ?lang=zh&scene=negative&rule=lowest_cell&step=12
const asked = new URLSearchParams(location.search);
const firstScene = Math.max(0, SCENES.findIndex((scene) => scene.name === asked.get("scene")));
const state = {
  language: asked.get("lang") === "zh" ? 1 : 0,
  scene: firstScene,
  rule: RULES.includes(asked.get("rule")) ? asked.get("rule") : recordedRule(SCENES[firstScene].recorded),
  step: 0,
  side: 0,       // of rule lowest_cell; 0: two largest radii
  spread: 1,     // radii become r_max (r / r_max) ^ spread
  count: 0,      // of balls; 0: as many as the scene has
  moved: {},     // ball -> its place
  predict: false,
  answer: null,  // to the question of this step
  asked: 0,
  right: 0,
};
let tracer;
let trace;
let steps;
let timer = null;

const $ = (id) => document.getElementById(id);

function word(key, values = {}) {
  const text = TEXTS[key][state.language];
  return text.replace(/\{(\w+)\}/g, (_, name) => {
    const value = values[name];
    return value && value.key ? word(value.key) : value;
  });
}

function say(parts) {
  const sentences = [];
  for (let k = 0; k < parts.length; k += 2) sentences.push(word(parts[k], parts[k + 1]));
  return sentences.join(" ");
}

// ---- The scene that is shown.

/** A number in [0, 1) that depends on `seed` alone. */
function random(seed) {
  const value = Math.sin(seed * 12.9898) * 43758.5453;
  return value - Math.floor(value);
}

function shownSpheres() {
  const given = SCENES[state.scene].spheres;
  const count = state.count || given.length;
  const largest = Math.max(...given.map((s) => s[3]));
  const [low, high] = [0, 1, 2].map((axis) => range(given.map((s) => s[axis]))).reduce(
    ([lows, highs], [from, to]) => [[...lows, from], [...highs, to]], [[], []]);
  return Array.from({length: count}, (_, ball) => {
    const made = () => [0, 1, 2].map((axis) => low[axis] + random(7 * ball + axis) * (high[axis] - low[axis]));
    const [x, y, z] = state.moved[ball] || (ball < given.length ? given[ball] : made());
    const r = ball < given.length ? given[ball][3] : largest * (0.3 + 0.7 * random(7 * ball + 3));
    return [x, y, z, largest * (r / largest) ** state.spread].map(Math.fround);
  });
}

/** Runs the C++ again; the step stays where it was, if there is one. */
function retrace() {
  trace = tracer.trace(shownSpheres(), state.rule, state.side);
  steps = stepsOf(trace);
  state.step = Math.min(state.step, steps.length - 1);
  state.answer = null;
  show();
}

// ---- Drawing.

function show() {
  const step = steps[state.step];
  document.documentElement.lang = state.language ? "zh-CN" : "en";
  for (const element of document.querySelectorAll("[data-text]"))
    element.textContent = word(element.dataset.text);
  $("play").textContent = word(timer ? "pause" : "play");
  $("stage").textContent = word(`stage_${step.stage}`);
  $("where").textContent = word("step", {step: state.step + 1, steps: steps.length});
  const isHidden = state.predict && step.question && state.answer === null;
  $("picture").innerHTML = drawScene(trace, isHidden ? steps[state.step - 1] || step : step, word);
  $("say").textContent = isHidden ? "" : say(step.say);
  $("arrays").innerHTML = drawArrays(trace, isHidden ? steps[state.step - 1] || step : step, word);
  $("position").max = steps.length - 1;
  $("position").value = state.step;
  $("side").disabled = state.rule !== "lowest_cell";
  const program = state.rule === "as_written" ? "program" : "program_idea";
  $("program-title").textContent = PROGRAM_OF[state.rule] ? word(program, {file: PROGRAM_OF[state.rule]}) : "";
  showProgram(step.code);
  showQuestion(step);
  showRules();
  showRecorded();
}

/** Whether the run in the file, on the scene as it was given, agrees with this page. */
function showRecorded() {
  const {recorded} = SCENES[state.scene];
  const {key, side} = isShown(recorded, trace) ? compareWith(recorded, tracer) : {key: "recorded_other", side: 0};
  const values = {backend: recorded.backend, side: short(side), rule: recorded.plan.rule || recorded.plan.method};
  $("recorded").textContent = word(key, values);
  $("recorded").classList.toggle("differs", key === "recorded_differs");
}

function showProgram([name, pattern]) {
  const lines = PROGRAMS[PROGRAM_OF[state.rule]];
  $("program").hidden = !lines;
  if (!lines) return;
  const begin = lines.findIndex((text) => new RegExp(`^\\S.*\\b${name}\\(`).test(text));
  const end = lines.findIndex((text, k) => k > begin && text === "}");
  const inside = lines.findIndex((text, k) => k > begin && k < end && pattern.test(text));
  const at = inside >= 0 ? inside : lines.findIndex((text, k) => k > begin && CODE.is_tested_here[1].test(text));
  const escaped = (text) => text.replace(/[&<]/g, (letter) => (letter === "&" ? "&amp;" : "&lt;"));
  $("program").innerHTML = `${escaped(lines[begin])}\n<mark>${escaped(lines[at])}</mark>`;
}

function showRules() {
  const names = ["entries", "tests", "pairs", "missed", "duplicates"];
  const rows = RULES.map((rule) => {
    const numbers = numbersOf(rule === state.rule ? trace : tracer.trace(trace.spheres, rule, state.side));
    const cells = names.map((name) => `<td class="${numbers[name] ? name : ""}">${numbers[name]}</td>`);
    return `<tr class="${rule === state.rule ? "now" : ""}"><th>${word(rule)}</th>${cells.join("")}</tr>`;
  });
  const heads = names.map((name) => `<th>${word(name)}</th>`).join("");
  $("rules").innerHTML = `<tr><th></th>${heads}</tr>${rows.join("")}`;
}

/** The right answer and up to three wrong ones, in an order that depends on the step alone. */
function optionsOf(question) {
  if (question.options) return question.options;
  const right = Number(question.answer);
  const options = [right, right + 1, right > 0 ? right - 1 : right + 2, right + 3];
  return options.sort((a, b) => random(a + state.step) - random(b + state.step));
}

function shownAnswer(answer) {
  return answer.key ? word(answer.key) : String(answer);
}

function showQuestion(step) {
  $("score").textContent = state.predict ? word("predict_score", state) : "";
  const {question} = step;
  if (!state.predict || !question) {
    $("question").innerHTML = "";
    return;
  }
  const buttons = optionsOf(question).map((option) => `<button class="option">${shownAnswer(option)}</button>`);
  const right = shownAnswer(question.answer);
  const verdict = state.answer === null ? "" : state.answer === right ? word("right") : word("wrong", {answer: right});
  $("question").innerHTML = `<p>${say(question.ask)}</p>${state.answer === null ? buttons.join("") : `<p class="verdict">${verdict}</p>`}`;
}

// ---- What the reader does.

function go(step) {
  state.step = Math.min(Math.max(step, 0), steps.length - 1);
  state.answer = null;
  show();
}

function goToStage(direction) {
  const {stage, pass} = steps[state.step];
  let at = state.step;
  while (steps[at] && steps[at].stage === stage && steps[at].pass === pass) at += direction;
  go(at);
}

function togglePlay() {
  timer = timer ? clearInterval(timer) : setInterval(() => {
    if (state.step >= steps.length - 1) togglePlay();
    else go(state.step + 1);
  }, 900);
  timer = timer || null;
  show();
}

function moveBall(ball, dx, dy) {
  const [x, y, z] = trace.spheres[ball];
  state.moved[ball] = [x + dx, y + dy, z];
  retrace();
  const again = document.querySelector(`[data-ball="${ball}"][tabindex]`);
  if (again) again.focus();
}

function onKey(event) {
  if (event.target.matches("select, input") || event.ctrlKey || event.altKey || event.metaKey) return;
  const ball = event.target.dataset && event.target.dataset.ball;
  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
  if (event.shiftKey && ball !== undefined && arrows[event.key]) {
    const [dx, dy] = arrows[event.key];
    moveBall(Number(ball), dx * trace.side / 20, dy * trace.side / 20);
  } else if (event.key === "ArrowRight") go(state.step + 1);
  else if (event.key === "ArrowLeft") go(state.step - 1);
  else if (event.key === "PageDown") goToStage(1);
  else if (event.key === "PageUp") goToStage(-1);
  else if (event.key === "Home") go(0);
  else if (event.key === "End") go(steps.length - 1);
  else if (event.key === " " && !event.target.matches("button")) togglePlay();
  else return;
  event.preventDefault();
}

function dragBalls() {
  const picture = $("picture");
  let dragged = null;
  picture.addEventListener("pointerdown", (event) => {
    const ball = event.target.closest("[data-ball]");
    if (!ball || !isFlat(trace)) return;
    dragged = {ball: Number(ball.dataset.ball), x: event.clientX, y: event.clientY, scale: new View(trace).scale};
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const zoom = picture.getBoundingClientRect().width / WIDTH * dragged.scale;
    moveBall(dragged.ball, (event.clientX - dragged.x) / zoom, (dragged.y - event.clientY) / zoom);
    [dragged.x, dragged.y] = [event.clientX, event.clientY];
  });
  for (const end of ["pointerup", "pointercancel"]) picture.addEventListener(end, () => { dragged = null; });
}

/** A ball, its cells and its entries light up together. */
function linkHover() {
  document.addEventListener("pointerover", (event) => {
    const over = event.target.closest("[data-ball], [data-cell]");
    const {ball, cell} = over ? over.dataset : {};
    for (const element of document.querySelectorAll("[data-ball], [data-cell]")) {
      const same = ball !== undefined ? element.dataset.ball === ball :
        cell !== undefined && element.dataset.cell === cell;
      element.classList.toggle("linked", same);
    }
  });
}

function onInput(id, change) {
  $(id).addEventListener("input", (event) => {
    change(event.target.value);
    retrace();
  });
}

function reset() {
  const {recorded, spheres} = SCENES[state.scene];
  const side = recordedSide(recorded);
  Object.assign(state, {step: 0, side, spread: 1, count: 0, moved: {}});
  const largest = Math.max(...spheres.map((s) => s[3]));
  for (const [id, value] of [["side", largest ? 10 * side / largest : 0], ["spread", 1], ["count", SCENES[state.scene].spheres.length]]) $(id).value = value;
}

function listen() {
  $("scene").innerHTML = SCENES.map((scene, k) => `<option value="${k}">${scene.name}</option>`).join("");
  $("rule").innerHTML = RULES.map((rule) => `<option value="${rule}" data-text="${rule}"></option>`).join("");
  onInput("scene", (value) => { state.scene = Number(value); reset(); });
  onInput("rule", (value) => { state.rule = value; state.step = 0; });
  onInput("side", (value) => { state.side = value / 10 * Math.max(...shownSpheres().map((s) => s[3])); });
  onInput("spread", (value) => { state.spread = Number(value); });
  onInput("count", (value) => { state.count = Number(value); });
  $("position").addEventListener("input", (event) => go(Number(event.target.value)));
  $("back").addEventListener("click", () => go(state.step - 1));
  $("forward").addEventListener("click", () => go(state.step + 1));
  $("previous").addEventListener("click", () => goToStage(-1));
  $("next").addEventListener("click", () => goToStage(1));
  $("play").addEventListener("click", togglePlay);
  $("reset").addEventListener("click", () => { reset(); retrace(); });
  $("language").addEventListener("click", () => { state.language = 1 - state.language; show(); });
  $("theme").addEventListener("click", () => document.documentElement.classList.toggle("turned"));
  $("predict").addEventListener("change", (event) => { state.predict = event.target.checked; go(state.step); });
  $("question").addEventListener("click", (event) => {
    if (!event.target.matches(".option")) return;
    state.answer = event.target.textContent;
    state.asked += 1;
    state.right += state.answer === shownAnswer(steps[state.step].question.answer) ? 1 : 0;
    show();
  });
  document.addEventListener("keydown", onKey);
  dragBalls();
  linkHover();
}

Tracer.load(MODULE).then((loaded) => {
  tracer = loaded;
  listen();
  [$("scene").value, $("rule").value] = [state.scene, state.rule];
  reset();
  retrace();
  go(Number(asked.get("step") || 1) - 1);
  document.body.classList.add("ready");
});
