// The language chosen last (or ?lang=zh, or the browser's), tables that filter and sort. The page is
// complete without it.
"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const choices = all(".choice");
  const main = document.querySelector("main");

  const stored = (value) => {
    try {
      if (value) localStorage.setItem("octocell-language", value);
      return localStorage.getItem("octocell-language");
    } catch {
      return null; // pages on disk may not remember
    }
  };

  const speak = () => {
    const chosen = choices.find((choice) => choice.checked).value;
    document.documentElement.lang = chosen === "zh" ? "zh-CN" : "en";
    const text = chosen === "zh" ? main.dataset.filterZh : main.dataset.filterEn;
    for (const input of all(".filter")) input.placeholder = text;
  };

  const filter = (table, text) => {
    const wanted = text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of table.tBodies[0].rows) {
      const content = row.textContent.toLowerCase();
      row.hidden = !wanted.every((word) => content.includes(word));
    }
  };

  const key = (row, column) => {
    const cell = row.cells[column];
    return "value" in cell.dataset ? Number(cell.dataset.value) : cell.textContent.trim();
  };

  // Numbers before words; what has no number goes last in either direction.
  const compare = (a, b, sign) => {
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return sign * (typeof a === "number" ? a - b : a.localeCompare(b));
  };

  // Up, down, and as it was.
  const sort = (table, heading, column) => {
    const order = { ascending: "descending", descending: null }[heading.getAttribute("aria-sort")];
    const sign = order === "descending" ? -1 : 1;
    const rows = [...table.original];
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    if (order !== null) {
      heading.setAttribute("aria-sort", order || "ascending");
      rows.sort((a, b) => compare(key(a, column), key(b, column), sign));
    }
    table.tBodies[0].append(...rows);
  };

  for (const table of all("table")) {
    table.original = [...table.tBodies[0].rows];
    [...table.tHead.rows[0].cells].forEach((heading, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...heading.childNodes);
      button.addEventListener("click", () => sort(table, heading, column));
      heading.append(button);
    });
    if (table.original.length > 12) {
      const input = document.createElement("input");
      input.type = "search";
      input.className = "filter";
      input.addEventListener("input", () => filter(table, input.value));
      table.parentElement.before(input);
    }
  }

  const asked = new URLSearchParams(location.search).get("lang") || stored() || navigator.language;
  const chosen = (asked || "").toLowerCase().startsWith("zh") ? "zh" : "en";
  for (const choice of choices) {
    choice.checked = choice.value === chosen;
    choice.addEventListener("change", () => {
      stored(choice.value);
      speak();
    });
  }
  speak();
  addEventListener("beforeprint", () => all("details").forEach((block) => (block.open = true)));
})();
