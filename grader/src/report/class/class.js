// Sorting and filtering of the class table. Without this script the table is ordered by name.
"use strict";

const table = document.querySelector("table.class"), body = table.tBodies[0];
const rows = [...body.rows], filter = document.querySelector(".filter");

function keyOf(row, column) {
  const cell = row.cells[column];
  return cell.dataset.value === undefined ? cell.textContent.trim() : Number(cell.dataset.value);
}

function sort(column, down) {
  const order = (a, b) => (typeof a === "number" ? a - b : a.localeCompare(b, undefined, { numeric: true }));
  rows.sort((a, b) => order(keyOf(a, column), keyOf(b, column)) * (down ? -1 : 1));
  body.append(...rows);
}

function sieve(text) {
  const words = text.toLowerCase().split(/\s+/);
  rows.forEach((row) => {
    const held = row.textContent.toLowerCase();
    row.hidden = !words.every((word) => held.includes(word));
  });
  filter.querySelector("output").textContent = text ? `${rows.filter((row) => !row.hidden).length} of ${rows.length}` : "";
}

[...table.tHead.rows[0].cells].forEach((head, column) => {
  const button = document.createElement("button");
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener("click", () => {
    const old = head.getAttribute("aria-sort");
    const down = old ? old === "ascending" : head.classList.contains("number");
    table.querySelectorAll("[aria-sort]").forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    sort(column, down);
  });
});
filter.hidden = false;
filter.querySelector("input").addEventListener("input", (event) => sieve(event.target.value));
