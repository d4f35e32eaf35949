// The records of /rosout, with filters.

import { fill, make, onceAFrame, text } from "./words.js";

const MOST = 1000; // records that are kept
const SHOWN = 300; // lines on the page: the newest
const FIRST = 20; // the level at the beginning
const LEVELS = [[10, "DEBUG"], [20, "INFO"], [30, "WARN"], [40, "ERROR"], [50, "FATAL"]];

export class Log {
  constructor() {
    this.records = [];
    this.fresh = [];
    this.rows = document.getElementById("log-rows");
    this.level = document.getElementById("log-level");
    this.node = document.getElementById("log-node");
    this.search = document.getElementById("log-text");
    this.level.replaceChildren(...LEVELS.map(([number, name]) => new Option(name, number)));
    this.level.value = FIRST;
    fill(this.node, [""], [text("all_nodes")]);
    this.paint = onceAFrame(() => this.paintNow());
    for (const control of [this.level, this.node, this.search]) control.oninput = () => this.again();
    document.getElementById("log-clear").onclick = () => { this.records = []; this.again(); };
    this.rows.closest("section").querySelector("form").onsubmit = (event) => event.preventDefault();
    this.paint();
  }

  show() { this.again(); }

  log({ records }) {
    this.records.push(...records);
    this.fresh.push(...records);
    this.records.splice(0, this.records.length - MOST);
    this.paint();
  }

  again() {
    this.fresh = this.records.slice();
    this.rows.replaceChildren();
    this.paint();
  }

  fits(record) {
    const wanted = this.search.value.toLowerCase();
    return record.level >= Number(this.level.value)
      && (!this.node.value || record.name === this.node.value)
      && (!wanted || record.text.toLowerCase().includes(wanted));
  }

  paintNow() {
    if (this.rows.closest("section").hidden) { this.fresh = []; return; }
    const names = [...new Set(this.records.map((record) => record.name))].sort();
    fill(this.node, ["", ...names], [text("all_nodes"), ...names]);
    const atEnd = this.rows.scrollHeight - this.rows.scrollTop - this.rows.clientHeight < 40;
    if (this.rows.firstElementChild?.tagName === "P") this.rows.replaceChildren();
    const shown = this.fresh.filter((record) => this.fits(record)).slice(-SHOWN);
    this.rows.append(...shown.map(row));
    this.fresh = [];
    while (this.rows.childElementCount > SHOWN) this.rows.firstElementChild.remove();
    const count = this.rows.childElementCount;
    document.getElementById("log-count").textContent = text("log_count", { shown: count, all: this.records.length });
    if (!this.records.length) this.rows.replaceChildren(make("p", {}, text("log_empty")));
    if (atEnd) this.rows.scrollTop = this.rows.scrollHeight;
  }
}

function row(record) {
  const level = LEVELS.find(([number]) => number >= record.level)?.[1] ?? "FATAL";
  const at = new Date(record.stamp * 1000);
  const clock = [at.getHours(), at.getMinutes(), at.getSeconds()].map((part) => String(part).padStart(2, "0")).join(":");
  const line = make("div", { class: level.toLowerCase() },
    make("time", { datetime: at.toISOString() }, `${clock}.${String(at.getMilliseconds()).padStart(3, "0")}`),
    make("span", { class: "level" }, level),
    make("span", { class: "from" }, record.name),
    make("span", { class: "what" }, record.text));
  line.title = `${record.file}:${record.line} ${record.function}`;
  return line;
}
