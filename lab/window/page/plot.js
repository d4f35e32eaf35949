// Numeric fields of topics over time, drawn by uPlot.

import { draw, fill, make, onceAFrame, text } from "./words.js";

const MOST_POINTS = 20000; // of a series
const VALUES = 250; // ms between two updates of the numbers
const LIGHT = ["#2450c8", "#c2410c", "#1c7a43", "#a21caf", "#0e7490", "#b3261e", "#7a5c00", "#4b5563"];
const DARK = ["#8fb0ff", "#fda769", "#7fd6a0", "#eaa0f5", "#6fd3e8", "#ff9c94", "#f2c063", "#c3cad5"];
const dark = matchMedia("(prefers-color-scheme: dark)");

export class Plot {
  constructor(socket, changed) {
    this.socket = socket;
    this.changed = changed;
    this.series = []; // {topic, field, times, values}
    this.topics = [];
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

  wanted() { return this.series.map(({ topic, field }) => [topic, field]); }

  show(topic) {
    this.wanted_topic = topic;
    this.fillTopics();
    if (topic && this.topics.includes(topic)) { this.topic.value = topic; this.askFields(); }
    this.rebuild();
  }

  graph({ topics }) {
    this.topics = topics.filter((topic) => topic.publishers.length).map((topic) => topic.name);
    this.types = new Map(topics.map((topic) => [topic.name, topic.types.join()]));
    this.fillTopics();
  }

  fillTopics() {
    const before = this.topic.value + this.types?.get(this.topic.value);
    fill(this.topic, this.topics.length ? this.topics : [""], this.topics.length ? this.topics : [text("plot_no_topic")]);
    if (this.topic.value + this.types?.get(this.topic.value) !== before || this.wanted_fields) this.askFields();
  }

  askFields() {
    const topic = this.topic.value;
    this.wanted_fields = false;
    if (!topic) return fill(this.field, [""], [""]);
    this.socket.ask({ do: "fields", topic }, ({ fields }) => {
      if (topic !== this.topic.value) return;
      const known = fields?.length ? fields : [""];
      fill(this.field, known, fields?.length ? fields : [text("no_number")]);
      this.unknown.hidden = fields !== null;
    });
  }

  add() {
    const [topic, field] = [this.topic.value, this.field.value];
    if (!topic || !field || this.series.length >= LIGHT.length) return;
    if (this.series.some((one) => one.topic === topic && one.field === field)) return;
    this.series.push({ topic, field, times: [], values: [] });
    this.changed();
    this.rebuild();
  }

  remove(series) {
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
      series: [{}, ...this.series.map((series, i) => ({ label: `${series.topic} ${series.field}`, stroke: color(i), width: 2, spanGaps: true, points: { show: false } }))],
    }, [[], ...this.series.map(() => [])], this.chart);
    this.paint();
  }

  item(series, stroke) {
    const name = `${series.topic} ${series.field}`;
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
