"use strict";
// Search and sort; without this script the whole table is still readable.

const plain = (text) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();

const value = (row, column) => {
  const cell = row.cells[column];
  return cell.dataset.value ?? cell.textContent.trim();
};

const compare = (a, b, isNumber) =>
  isNumber ? Number(a) - Number(b) : a.localeCompare(b, document.documentElement.lang, { numeric: true, sensitivity: "base" });

const sort = (table, column, direction) => {
  const isNumber = table.tHead.rows[0].cells[column].classList.contains("number");
  const sign = direction === "ascending" ? 1 : -1;
  const rows = [...table.tBodies[0].rows].map((row) => ({ row, key: value(row, column) }));
  rows.sort((a, b) => {
    // rows without a value come last in either direction
    if (a.key === "" || b.key === "") return Number(a.key === "") - Number(b.key === "");
    return sign * compare(a.key, b.key, isNumber);
  });
  table.tBodies[0].append(...rows.map(({ row }) => row));
  for (const head of table.tHead.rows[0].cells) head.removeAttribute("aria-sort");
  table.tHead.rows[0].cells[column].setAttribute("aria-sort", direction);
};

for (const table of document.querySelectorAll("table.sortable")) {
  for (const [column, head] of [...table.tHead.rows[0].cells].entries()) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const before = head.getAttribute("aria-sort");
      sort(table, column, before === "ascending" ? "descending" : "ascending");
    });
  }
}

// the words of mistakes' ids: "lee" finds the student Lee, but no node that sleeps
const parts = (ids) => ` ${plain(ids).replace(/[._]/g, " ")}`;

const field = document.getElementById("find");
const shown = document.getElementById("shown");
const all = shown.textContent;
const rows = [...document.querySelectorAll("#all tbody tr")].map((row) => ({
  row,
  text: plain(`${row.textContent} ${row.dataset.find}`),
  mistakes: parts(row.dataset.mistakes),
  section: row.dataset.section ?? "",
  bin: row.dataset.points ?? "",
}));
const section = document.getElementById("section");
const ranges = [...document.querySelectorAll(".range")];
const pressed = () => new Set(ranges.filter((one) => one.ariaPressed === "true").map((one) => one.dataset.bin));

const find = () => {
  const words = plain(field.value).split(/\s+/).filter(Boolean);
  const bins = pressed();
  const only = section?.value ?? "";
  let count = 0;
  for (const { row, text, mistakes, section: own, bin } of rows) {
    row.hidden =
      (only !== "" && own !== only) ||
      (bins.size > 0 && !bins.has(bin)) ||
      !words.every((word) => text.includes(word) || mistakes.includes(parts(word)));
    count += row.hidden ? 0 : 1;
  }
  const some = words.length || only !== "" || bins.size;
  shown.textContent = some ? shown.dataset.some.replace("{shown}", count) : all;
};

field.addEventListener("input", find);
section?.addEventListener("change", find);
document.querySelector(".find").hidden = false;

// one click on a bar or its button shows the students with these points, another one all of them
for (const group of document.querySelectorAll(".ranges")) group.hidden = false;
for (const one of document.querySelectorAll(".range, rect.bar[data-bin]")) {
  one.addEventListener("click", () => {
    const button = ranges.find((range) => range.dataset.bin === one.dataset.bin);
    if (button === undefined) return;
    button.ariaPressed = button.ariaPressed === "true" ? "false" : "true";
    find();
  });
}

for (const button of document.querySelectorAll(".who")) {
  button.hidden = false;
  button.addEventListener("click", () => {
    field.value = button.dataset.find;
    find();
    field.focus();
  });
}
find();
