// The check: what failed first, where it is, and one hint after the other.

import { button, hintItem } from "./guide.js";
import { make, text } from "./words.js";

export class Check {
  constructor(desk) {
    this.desk = desk;
    this.state = "idle";
    this.now = null;
    this.began = 0;
    document.getElementById("check-start").onclick = () => this.start();
    document.getElementById("check-stop").onclick = () => this.desk.ask("stop");
  }

  start() {
    this.desk.panes.show("check");
    this.desk.editor.saveAll().then(() => this.desk.ask("check"));
  }

  check({ state, status, printed }) {
    const before = this.state;
    this.state = state;
    this.status = status;
    clearInterval(this.clock);
    if (state === "running") {
      this.began ||= Date.now();
      this.clock = setInterval(() => this.tellTime(), 1000);
      this.tellTime();
    } else {
      this.began = 0;
      document.getElementById("check-said").textContent = state === "ended" && ![0, 1].includes(status) ? text("check_failed") : "";
    }
    document.getElementById("check-start").disabled = state === "running";
    document.getElementById("check-stop").hidden = state !== "running";
    const all = document.getElementById("check-printed");
    all.hidden = !printed;
    all.open = state === "ended" && ![0, 1].includes(status);
    all.querySelector("pre").textContent = printed ?? "";
    if (before === "running" && state === "ended") this.desk.panes.show("check");
    this.paint();
  }

  tellTime() {
    document.getElementById("check-said").textContent = text("check_runs", { seconds: Math.round((Date.now() - this.began) / 1000) });
  }

  guide(now) {
    this.now = now;
    this.paint();
  }

  paint() {
    const place = document.getElementById("verdict");
    const ran = this.now?.check;
    if (!ran?.ran) return place.replaceChildren(make("p", { class: "hint" }, text("check_hint")));
    const score = make("p", { class: `score ${ran.passed ? "fine" : ""}` },
      make("strong", {}, text("points", { score: ran.score, most: ran.most })),
      make("meter", { min: 0, max: ran.most || 1, value: ran.score, "aria-label": text("points", { score: ran.score, most: ran.most }) }));
    const parts = [score];
    if (!ran.current) parts.push(make("p", { class: "hint" }, text("check_old")));
    else if (ran.passed) parts.push(make("p", { class: "fine" }, text("check_passed")), make("p", {}, this.now.next));
    else parts.push(...this.cause());
    place.replaceChildren(...parts);
  }

  cause() {
    const { found, next, file, line, hints, hints_left: left } = this.now;
    const actions = make("p", { class: "actions" });
    if (file) actions.append(button("show_line", () => this.desk.open(file, line || 1), "main"));
    if (left) actions.append(button("next_hint", () => this.desk.ask("hint")));
    return [make("h3", {}, text("first_cause")), make("p", { class: "cause" }, found), make("p", {}, next), actions,
      make("ol", { class: "hints" }, ...hints.map(hintItem))];
  }
}
