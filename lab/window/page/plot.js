// Numeric fields of topics over time, drawn by uPlot.

import { draw, fill, make, onceAFrame, text } from "./words.js";

const MOST_POINTS = 20000; // of a series
const VALUES = 250; // ms between two updates of the numbers
const LOG = "/rosout";
const OF_NODE = "log "; // before a node's name: the field is the last number of its log lines
const NUMBER = /(-?\d+(?:\.\d+)?)\D*$/;
const MOST_LOGGED = 2000; // numbers of a node
const PATIENCE = 1500; // ms in which a topic may move before a number in the log is taken
const LIGHT = ["#2450c8", "#c2410c", "#1c7a43", "#a21caf", "#0e7490", "#b3261e", "#7a5c00", "#4b5563"];
const DARK = ["#8fb0ff", "#fda769", "#7fd6a0", "#eaa0f5", "#6fd3e8", "#ff9c94", "#f2c063", "#c3cad5"];
const dark = matchMedia("(prefers-color-scheme: dark)");

export class Plot {
  constructor(socket, changed) {
    this.socket = socket;
    this.changed = changed;
    this.series = []; // {topic, field, times, values}
    this.topics = [];
    this.numbers = new Map(); // name of a node → {times, values} of the numbers in its log lines
    this.chosen = false; // the reader has chosen what is plotted
    this.since = Infinity; // s, from which on a number may move
    for (const name of ["topic", "field", "span", "pause", "unknown", "hint"]) this[name] = document.getElementById(`plot-${name}`);
    this.chart = document.getElementById("chart");
    this.paint = onceAFrame(() => this.paintNow());
    this.topic.onchange = () => this.askFields();
    this.span.onchange = () => this.paint();
    this.pause.onclick = () => this.hold();
    document.getElementById("plot-form").onsubmit = (event) => { event.preventDefault(); this.add(); };
    document.getElementById("plot-restart").onclick = () => { this.socket.send({ do: "restart" }); this.wanted_fields = true; };
    new ResizeObserver(() => this.resize()).observe(this.chart);
    dark.addEventListener("change", () => this.rebuild());
    this.wanted_topic = "";
  }

  wanted() { return this.series.filter(({ field }) => !field.startsWith(OF_NODE)).map(({ topic, field }) => [topic, field]); }

  /** Whether the plot waits for a number that moves, to begin with it. */
  get seeks() { return !this.series.length && !this.chosen; }

  moving({ topic, field }) {
    if (this.seeks && !this.chart.closest("section").hidden) this.begin(topic, field);
  }

  log({ records }) {
    for (const { name, text: words, stamp } of records) {
      const number = NUMBER.exec(words);
      if (!number) continue;
      if (!this.numbers.has(name)) this.numbers.set(name, { times: [], values: [] });
      const { times, values } = this.numbers.get(name);
      times.push(stamp);
      values.push(Number(number[1]));
      if (times.length > MOST_LOGGED) { times.shift(); values.shift(); }
      const moved = times.at(-2) >= this.since && values.at(-2) !== values.at(-1);
      if (moved && this.seeks) this.counted ??= setTimeout(() => this.count(name), PATIENCE);
    }
    if (!this.held && this.series.some(({ field }) => field.startsWith(OF_NODE))) this.paint();
  }

  count(name) {
    this.counted = undefined;
    this.moving({ topic: LOG, field: OF_NODE + name });
  }

  begin(topic, field) {
    this.put(topic, field);
    if (this.topics.includes(topic)) { this.topic.value = topic; this.askFields(field); }
  }

  show(topic) {
    this.wanted_topic = topic;
    this.since = Math.min(this.since, Date.now() / 1000);
    if (topic && !this.chosen) { this.chosen = true; this.changed(); }
    this.fillTopics();
    if (topic && this.topics.includes(topic)) { this.topic.value = topic; this.askFields(); }
    this.rebuild();
  }

  graph({ topics }) {
    this.topics = topics.filter((topic) => topic.publishers.length).sort((a, b) => a.plumbing - b.plumbing).map((topic) => topic.name);
    this.types = new Map(topics.map((topic) => [topic.name, topic.types.join()]));
    this.fillTopics();
  }

  fillTopics() {
    const before = this.topic.value + this.types?.get(this.topic.value);
    fill(this.topic, this.topics.length ? this.topics : [""], this.topics.length ? this.topics : [text("plot_no_topic")]);
    if (this.topic.value + this.types?.get(this.topic.value) !== before || this.wanted_fields) this.askFields();
  }

  askFields(chosen) {
    const topic = this.topic.value;
    this.wanted_fields = false;
    if (!topic) return fill(this.field, [""], [""]);
    this.socket.ask({ do: "fields", topic }, ({ fields }) => {
      if (topic !== this.topic.value) return;
      const nodes = topic === LOG ? [...this.numbers.keys()].sort() : [];
      const known = [...nodes.map((name) => OF_NODE + name), ...(fields ?? [])];
      if (known.length) fill(this.field, known, known.map(label));
      else fill(this.field, [""], [text("no_number")]);
      if (known.includes(chosen)) this.field.value = chosen;
      this.unknown.hidden = fields !== null;
    });
  }

  add() {
    const [topic, field] = [this.topic.value, this.field.value];
    if (!topic || !field || this.series.length >= LIGHT.length) return;
    this.chosen = true;
    if (this.series.some((one) => one.topic === topic && one.field === field)) return;
    this.put(topic, field);
  }

  put(topic, field) {
    const logged = field.startsWith(OF_NODE) ? this.numbers.get(field.slice(OF_NODE.length)) : undefined;
    this.series.push({ topic, field, ...(logged ?? { times: [], values: [] }) });
    this.changed();
    this.rebuild();
  }

  remove(series) {
    this.chosen = true;
    this.series = this.series.filter((one) => one !== series);
    this.changed();
    this.rebuild();
  }

  hold() {
    this.held = this.held ? 0 : Date.now() / 1000;
    this.pause.setAttribute("aria-pressed", String(Boolean(this.held)));
    this.paint();
  }

  samples({ series }) {
    for (const [topic, field, times, values] of series) {
      const found = this.series.find((one) => one.topic === topic && one.field === field);
      if (!found) continue;
      found.times.push(...times);
      found.values.push(...values);
      const cut = found.times.length - MOST_POINTS;
      if (cut > 0) { found.times.splice(0, cut); found.values.splice(0, cut); }
    }
    if (!this.held) this.paint();
  }

  rebuild() {
    this.plot?.destroy();
    this.plot = undefined;
    this.hint.hidden = this.series.length > 0;
    this.hint.textContent = text(this.seeks ? "plot_seeks" : "plot_hint");
    document.getElementById("series").replaceChildren(...this.series.map((series, i) => this.item(series, color(i))));
    if (!this.series.length || this.chart.closest("section").hidden) return;
    const style = getComputedStyle(document.documentElement);
    const axis = { stroke: style.getPropertyValue("--quiet"), grid: { stroke: style.getPropertyValue("--line"), width: 1 }, ticks: { stroke: style.getPropertyValue("--line"), width: 1 } };
    this.plot = new uPlot({
      ...this.size(),
      legend: { show: false },
      cursor: { drag: { x: false, y: false } },
      scales: { x: { time: true, range: () => this.range() } },
      axes: [{ ...axis, values: (_, times) => times.map(clock) }, { ...axis, size: 64 }],
      series: [{}, ...this.series.map((series, i) => ({ label: title(series), stroke: color(i), width: 2, spanGaps: true, points: { show: false } }))],
    }, [[], ...this.series.map(() => [])], this.chart);
    this.paint();
  }

  item(series, stroke) {
    const name = title(series);
    const button = make("button", { type: "button", "aria-label": text("remove", { series: name }) }, "✕");
    button.onclick = () => this.remove(series);
    const icon = draw("svg", { viewBox: "0 0 20 4", "aria-hidden": "true" }, draw("rect", { width: 20, height: 4, rx: 2, fill: stroke }));
    return make("li", {}, icon, make("span", {}, name), make("output", { "aria-live": "off" }), button);
  }

  range() {
    const last = Math.max(...this.series.map(({ times }) => times[times.length - 1] ?? 0));
    const end = this.held || last || Date.now() / 1000;
    return [end - Number(this.span.value), end];
  }

  size() {
    const inside = getComputedStyle(this.chart);
    return { width: this.chart.clientWidth - 2 * parseFloat(inside.paddingLeft), height: Math.max(200, this.chart.clientHeight - 2 * parseFloat(inside.paddingTop)) };
  }

  resize() {
    if (this.plot && this.chart.clientWidth) this.plot.setSize(this.size());
  }

  paintNow() {
    if (!this.plot || this.chart.closest("section").hidden) return;
    const [from] = this.range();
    const tables = this.series.map(({ times, values }) => {
      const start = Math.max(0, firstAfter(times, from) - 1);
      return [times.slice(start), values.slice(start)];
    });
    this.plot.setData(tables.length === 1 ? tables[0] : uPlot.join(tables));
    this.chart.dataset.points = tables[0][0].length; // the tests count them
    if (performance.now() - (this.written ?? 0) > VALUES) this.paintValues();
    else this.later ??= setTimeout(() => { this.later = undefined; this.paintValues(); }, VALUES);
  }

  paintValues() {
    this.written = performance.now();
    document.querySelectorAll("#series output").forEach((output, i) => {
      const value = this.series[i]?.values.at(-1);
      output.textContent = value === undefined ? text("no_value") : Number(value.toPrecision(6));
    });
  }
}

/** A field as the page names it. */
function label(field) {
  return field.startsWith(OF_NODE) ? text("logged_number", { node: field.slice(OF_NODE.length) }) : field;
}

function title({ topic, field }) {
  return `${topic} ${label(field)}`;
}

function color(index) {
  return (dark.matches ? DARK : LIGHT)[index % LIGHT.length];
}

/** The time of day of an instant (s since the epoch). */
function clock(instant) {
  return new Date(instant * 1000).toLocaleTimeString("en-GB");
}

/** The first place in sorted times that is not before an instant. */
function firstAfter(times, instant) {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < instant) low = middle + 1;
    else high = middle;
  }
  return low;
}
