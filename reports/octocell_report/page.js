// Language by address (?lang=zh) or browser, filters above tables, columns that sort. The page is
// complete without it.
"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const asked = new URLSearchParams(location.search).get("lang") || navigator.language || "en";
  const choices = all(".choice");
  const inputs = [];

  const speak = () => {
    const chosen = choices.find((choice) => choice.checked).value;
    document.documentElement.lang = chosen === "zh" ? "zh-CN" : "en";
    for (const input of inputs) input.placeholder = input.dataset[chosen];
  };

  const filter = (area, text) => {
    const wanted = text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const table of all("table", area)) {
      const block = table.closest("details");
      const title = block ? block.querySelector("summary").textContent : "";
      let left = 0;
      for (const row of table.tBodies[0].rows) {
        const content = `${title} ${row.textContent}`.toLowerCase();
        row.hidden = !wanted.every((word) => content.includes(word));
        left += row.hidden ? 0 : 1;
      }
      table.dataset.filtered = wanted.length ? "yes" : "";
      loosen(table);
      if (block) {
        block.hidden = left === 0;
        if (wanted.length && left) block.open = true;
      }
    }
  };

  // Rows that are out of their order, or whose neighbours are hidden, each show their size.
  const loosen = (table) =>
    table.classList.toggle("loose", Boolean(table.dataset.filtered || table.dataset.sorted));

  const key = (row, column) => {
    const cell = row.cells[column];
    return "value" in cell.dataset ? Number(cell.dataset.value) : cell.textContent.trim();
  };

  // Numbers before words; what has no number goes last in either direction.
  const compare = (a, b, sign) => {
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return sign * (typeof a === "number" ? a - b : a.localeCompare(b));
  };

  const sort = (table, heading, column) => {
    const body = table.tBodies[0];
    table.original ||= [...body.rows];
    const next = { ascending: "descending", descending: null }[heading.getAttribute("aria-sort")];
    const order = next === undefined ? "ascending" : next;
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    table.dataset.sorted = order || "";
    const rows = [...table.original];
    if (order) {
      const sign = order === "ascending" ? 1 : -1;
      heading.setAttribute("aria-sort", order);
      rows.sort((a, b) => compare(key(a, column), key(b, column), sign));
    }
    body.append(...rows);
    loosen(table);
  };

  for (const area of all("[data-filter-en]")) {
    const input = document.createElement("input");
    input.type = "search";
    input.className = "filter";
    input.dataset.en = area.dataset.filterEn;
    input.dataset.zh = area.dataset.filterZh;
    input.addEventListener("input", () => filter(area, input.value));
    area.prepend(input);
    inputs.push(input);
  }
  for (const table of all("table")) {
    [...table.tHead.rows[0].cells].forEach((heading, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...heading.childNodes);
      button.addEventListener("click", () => sort(table, heading, column));
      heading.append(button);
    });
  }
  for (const choice of choices) {
    choice.checked = choice.value === (asked.toLowerCase().startsWith("zh") ? "zh" : "en");
    choice.addEventListener("change", speak);
  }
  speak();
})();
