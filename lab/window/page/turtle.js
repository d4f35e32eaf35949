// The turtles on their field: drawn from their poses, driven by the arrow keys.

import { draw, make, onceAFrame, text } from "./words.js";

const SIZE = 499 / 45; // m, of the square field
const SPEED = 2; // m/s and rad/s of a key, as turtle_teleop_key
const REPEAT = 100; // ms between the commands while a key is down
const MOST_POINTS = 20000; // of a turtle's line
const LIST = 200; // ms between two updates of the numbers
const BACKGROUND = [69, 86, 255];
const COLORS = [
  ["#d7f7de", "#3aa35c"], ["#ffd9a8", "#d9822b"], ["#ffc2d4", "#d6457a"], ["#fff3a3", "#c9a400"],
  ["#b8f1ff", "#1d96b8"], ["#e6ccff", "#9a5bd6"], ["#ffb8ad", "#d3452f"], ["#e3e6ec", "#6d7a8c"],
];
const KEYS = { ArrowUp: [SPEED, 0], ArrowDown: [-SPEED, 0], ArrowLeft: [0, SPEED], ArrowRight: [0, -SPEED], " ": [0, 0] };

export class Turtle {
  constructor(socket) {
    this.socket = socket;
    this.field = document.getElementById("field");
    this.list = document.getElementById("turtle-list");
    this.layers = [document.getElementById("traces"), document.getElementById("turtles")];
    this.pens = this.layers.map((layer) => layer.getContext("2d"));
    this.poses = new Map(); // name → [x, y, theta, linear, angular]
    this.lines = new Map(); // name → {points, drawn}
    this.colors = new Map();
    this.chosen = "";
    this.down = new Set();
    this.listed = 0;
    this.background = BACKGROUND;
    this.paint = onceAFrame(() => this.paintNow());
    this.frames = 0;
    new ResizeObserver(() => this.resize()).observe(this.field);
    document.getElementById("clear").onclick = () => this.clear();
    for (const button of document.querySelectorAll("#pad button")) this.hold(button);
    addEventListener("keydown", (event) => this.key(event));
    addEventListener("keyup", (event) => this.release(event.key));
    addEventListener("blur", () => this.release());
  }

  show() {
    this.paint();
  }

  turtles({ turtles, background }) {
    this.background = background ?? BACKGROUND;
    const names = new Set(turtles.map(([name]) => name));
    for (const name of this.poses.keys()) {
      if (!names.has(name)) { this.poses.delete(name); this.lines.get(name)?.points.push(null); }
    }
    for (const [name, ...pose] of turtles) {
      this.poses.set(name, pose);
      if (!this.colors.has(name)) this.colors.set(name, COLORS[this.colors.size % COLORS.length]);
      this.extend(name, pose);
    }
    if (!names.has(this.chosen)) this.chosen = turtles[0]?.[0] ?? "";
    this.paint();
  }

  extend(name, [x, y]) {
    if (!this.lines.has(name)) this.lines.set(name, { points: [], drawn: 0 });
    const line = this.lines.get(name);
    const last = line.points[line.points.length - 1];
    if (last && last[0] === x && last[1] === y) return;
    line.points.push([x, y]);
    if (line.points.length > MOST_POINTS) {
      const cut = line.points.length - MOST_POINTS / 2;
      line.points.splice(0, cut);
      line.drawn = Math.max(0, line.drawn - cut);
    }
  }

  clear() {
    for (const line of this.lines.values()) { line.points.splice(0, line.points.length - 1); line.drawn = 0; }
    this.resize();
  }

  resize() {
    const size = this.field.clientWidth;
    if (!size) return;
    this.scale = (size * devicePixelRatio) / SIZE;
    for (const layer of this.layers) layer.width = layer.height = Math.round(size * devicePixelRatio);
    for (const line of this.lines.values()) line.drawn = 0;
    this.paint();
  }

  paintNow() {
    if (!this.scale || !this.field.clientWidth) return;
    this.frames += 1;
    this.field.dataset.frames = this.frames; // the tests count them
    this.field.style.backgroundColor = `rgb(${this.background.join(" ")})`;
    for (const [name, line] of this.lines) this.paintLine(name, line);
    const [, pen] = this.pens;
    pen.clearRect(0, 0, this.layers[1].width, this.layers[1].height);
    for (const [name, pose] of this.poses) this.paintTurtle(pen, name, pose);
    document.getElementById("no-turtle").hidden = this.poses.size > 0;
    if (performance.now() - this.listed > LIST || this.list.childElementCount !== this.poses.size) this.paintList();
    else this.later ??= setTimeout(() => { this.later = undefined; this.paintList(); }, LIST);
  }

  paintLine(name, line) {
    const [pen] = this.pens;
    const from = Math.max(0, line.drawn - 1);
    if (line.points.length - from < 2) return;
    pen.strokeStyle = this.colors.get(name)[0];
    pen.lineWidth = (3 / 45) * this.scale;
    pen.lineCap = pen.lineJoin = "round";
    pen.beginPath();
    let lifted = true;
    for (const point of line.points.slice(from)) {
      if (point && lifted) pen.moveTo(...this.place(point));
      else if (point) pen.lineTo(...this.place(point));
      lifted = !point;
    }
    pen.stroke();
    line.drawn = line.points.length;
  }

  place([x, y]) {
    return [x * this.scale, (SIZE - y) * this.scale];
  }

  paintTurtle(pen, name, [x, y, theta]) {
    const [light, dark] = this.colors.get(name);
    pen.save();
    pen.translate(...this.place([x, y]));
    if (name === this.chosen && this.poses.size > 1) {
      pen.beginPath();
      pen.arc(0, 0, 0.62 * this.scale, 0, 2 * Math.PI);
      pen.strokeStyle = "#ffffffb0";
      pen.setLineDash([0.1 * this.scale, 0.1 * this.scale]);
      pen.lineWidth = 0.04 * this.scale;
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.rotate(-theta);
    pen.scale(this.scale, this.scale);
    const blob = (cx, cy, rx, ry, color) => {
      pen.beginPath();
      pen.ellipse(cx, cy, rx, ry, 0, 0, 2 * Math.PI);
      pen.fillStyle = color;
      pen.fill();
    };
    for (const side of [-1, 1]) {
      blob(0.2, side * 0.26, 0.12, 0.1, light);
      blob(-0.22, side * 0.25, 0.12, 0.1, light);
    }
    blob(0.4, 0, 0.14, 0.12, light);
    blob(-0.38, 0, 0.08, 0.04, light);
    blob(0, 0, 0.34, 0.28, dark);
    blob(0, 0, 0.22, 0.17, light + "90");
    for (const side of [-1, 1]) blob(0.45, side * 0.055, 0.022, 0.022, "#18202c");
    pen.restore();
    pen.font = `600 ${0.26 * this.scale}px system-ui, sans-serif`;
    pen.textAlign = "center";
    pen.lineWidth = 0.06 * this.scale;
    pen.strokeStyle = "#10141b99";
    pen.fillStyle = "#fff";
    const [px, py] = this.place([x, y]);
    const below = y < 1 ? -0.6 : 0.85;
    const label = this.poses.size > 1 ? name.slice(1) : "";
    pen.strokeText(label, px, py + below * this.scale);
    pen.fillText(label, px, py + below * this.scale);
  }

  paintList() {
    this.listed = performance.now();
    const names = [...this.poses.keys()];
    const buttons = [...this.list.querySelectorAll("button")];
    if (buttons.map((button) => button.value).join() !== names.join()) {
      this.list.replaceChildren(...names.map((name) => this.listItem(name)));
    }
    for (const button of this.list.querySelectorAll("button")) {
      const [x, y, theta, linear, angular] = this.poses.get(button.value).map((value) => value.toFixed(2));
      button.setAttribute("aria-pressed", String(button.value === this.chosen));
      button.children[2].textContent = text("pose", { x, y, theta });
      button.children[3].textContent = text("speed", { linear, angular });
    }
  }

  listItem(name) {
    const [light, dark] = this.colors.get(name);
    const icon = draw("svg", { viewBox: "-12 -12 24 24", "aria-hidden": "true" },
      draw("circle", { cx: 8, r: 4, fill: light, stroke: dark }),
      draw("ellipse", { rx: 9, ry: 8, fill: dark }));
    const button = make("button", { type: "button", value: name }, icon, make("span", {}, name), make("small"), make("small"));
    button.children[3].classList.add("speed");
    button.onclick = () => { this.chosen = name; this.paintList(); this.paint(); };
    return make("li", {}, button);
  }

  // driving

  key(event) {
    const inField = event.target.closest?.("#turtle") || event.target === document.body;
    const isButton = event.target.closest?.("button") && event.key === " ";
    if (document.getElementById("turtle").hidden || !KEYS[event.key] || !inField || isButton) return;
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    if (!event.repeat) this.press(event.key, KEYS[event.key]);
  }

  hold(button) {
    const [linear, angular] = button.dataset.drive.split(" ").map(Number);
    button.onpointerdown = () => { this.pointed = true; this.press("pad", [linear, angular]); };
    button.onpointerup = button.onpointerleave = button.onpointercancel = () => this.release("pad");
    button.onclick = () => { // from the keyboard or a screen reader: no pointer came before
      if (!this.pointed) this.drive(linear, angular);
      this.pointed = false;
    };
  }

  press(key, velocity) {
    if (key === "pad") KEYS.pad = velocity;
    if (velocity[0] || velocity[1]) this.down.add(key);
    else this.down.clear();
    this.command(velocity);
    clearInterval(this.repeat);
    this.repeat = setInterval(() => this.command(), REPEAT);
  }

  release(key) {
    if (key === undefined) this.down.clear();
    this.down.delete(key);
    if (!this.down.size) clearInterval(this.repeat);
  }

  command(alone = [0, 0]) {
    const keys = [...this.down].map((key) => KEYS[key]);
    const sum = (index) => Math.max(-SPEED, Math.min(SPEED, keys.reduce((all, key) => all + key[index], 0)));
    if (keys.length) this.drive(sum(0), sum(1));
    else this.drive(...alone);
  }

  drive(linear, angular) {
    if (this.chosen) this.socket.send({ do: "drive", turtle: this.chosen, linear, angular });
  }
}
