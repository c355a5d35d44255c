// SPDX-License-Identifier: MIT
// Steps through the slides: keys, clicks, and a link such as slides.html#7.
"use strict";

const slides = [...document.querySelectorAll("section")];

function shown() {
  const wanted = Number.parseInt(location.hash.slice(1), 10) || 1;
  return Math.min(Math.max(wanted, 1), slides.length);
}

function show() {
  slides.forEach((slide, k) => slide.classList.toggle("shown", k + 1 === shown()));
  document.getElementById("number").textContent = `${shown()} / ${slides.length}`;
}

function go(to) {
  location.hash = String(Math.min(Math.max(to, 1), slides.length));
}

const KEYS = {
  ArrowRight: () => go(shown() + 1),
  PageDown: () => go(shown() + 1),
  " ": () => go(shown() + 1),
  ArrowLeft: () => go(shown() - 1),
  PageUp: () => go(shown() - 1),
  Home: () => go(1),
  End: () => go(slides.length),
  f: () => document.documentElement.requestFullscreen(),
  l: () => { location.href = document.body.dataset.other + location.hash; },
  "?": () => document.getElementById("keys").classList.toggle("shown"),
};

addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key]) return;
  event.preventDefault();
  KEYS[event.key]();
});
addEventListener("hashchange", show);
show();
