// The guide: what is next, what was found, the hints, and the text of the step.

import { make, text } from "./words.js";
import { elements } from "./markup.js";

export class Guide {
  constructor(desk) {
    this.desk = desk;
    this.steps = [];
    this.now = null;
    this.shown = 0; // the position of the step whose text is shown
    this.choice = document.getElementById("step");
    this.choice.onchange = () => this.turn(Number(this.choice.value));
    document.getElementById("step-back").onclick = () => this.turn(this.shown - 1);
    document.getElementById("step-on").onclick = () => this.turn(this.shown + 1);
  }

  lesson({ title, introduction, steps }) {
    if (this.title !== title) [this.now, this.shown] = [null, 0];
    this.title = title;
    this.steps = steps;
    this.introduction = introduction;
    document.title = title;
    this.choose();
    if (this.shown) this.turn(this.shown);
  }

  guide(now) {
    const before = this.now;
    this.now = now;
    this.tellDone(before);
    this.choose();
    if (!before || before.position !== now.position || !this.shown) this.turn(now.position);
    this.paint();
  }

  /** Say which steps have been done since the last time. */
  tellDone(before) {
    if (!before) return;
    const done = this.steps.filter((_, i) => this.now.steps[i] === "done" && before.steps[i] !== "done");
    if (this.now.ready && !before.ready) this.desk.notice(this.now.next);
    else if (done.length) this.desk.notice(done.map(({ number, title }) => text("step_done", { number, title })).join(" "));
  }

  choose() {
    const marks = { done: "✓", now: "▶", todo: " " };
    this.choice.replaceChildren(...this.steps.map((step, i) =>
      new Option(`${marks[this.now?.steps[i]] ?? ""} ${step.number}. ${step.title}`, i + 1)));
    if (this.shown) this.choice.value = this.shown;
    const done = this.now?.steps.filter((state) => state === "done").length ?? 0;
    const bar = document.getElementById("done-steps");
    bar.max = Math.max(this.steps.length, 1);
    bar.value = done;
    bar.title = text("steps_done", { done, all: this.steps.length });
  }

  turn(position) {
    const step = this.steps[position - 1];
    if (!step) return;
    this.shown = position;
    this.choice.value = position;
    document.getElementById("step-back").disabled = position === 1;
    document.getElementById("step-on").disabled = position === this.steps.length;
    const type = (command) => this.desk.type(command);
    const parts = [make("h3", { class: "step-title" }, `${step.number}. ${step.title}`), ...elements(step.text, type)];
    if (position === 1) parts.unshift(...elements(this.introduction, type));
    const place = document.getElementById("step-text");
    place.replaceChildren(...parts);
    place.scrollTop = 0;
  }

  paint() {
    const { found, next, command, ready, hints, hints_left: left = 0, file, line } = this.now;
    const say = (id, words) => { const at = document.getElementById(id); at.replaceChildren(words); at.hidden = !words; };
    say("found", found);
    document.getElementById("next").classList.toggle("ready", ready);
    say("todo", command && !ready ? make("span", {}, make("code", {}, command), next.slice(command.length).replace(/^ +/, " ")) : next);
    const actions = [];
    if (command) actions.push(button(command === "check" ? "check_start" : "type_it", () => (command === "check" ? this.desk.check.start() : this.desk.type(command)), "main"));
    if (file) actions.push(button("show_line", () => this.desk.open(file, line || 1), command ? "" : "main"));
    if (!ready && (left || !hints.length)) actions.push(button(hints.length ? "next_hint" : "hint", () => this.desk.ask("hint")));
    document.getElementById("next-actions").replaceChildren(...actions);
    document.getElementById("hints").replaceChildren(...hints.map(hintItem));
  }
}

/** A hint, in which indented lines are code. */
export function hintItem(hint) {
  return make("li", {}, ...hint.split(/\n(?=\S)|(?<=\S)\n(?= {4})/).map((part) =>
    (part.startsWith("    ") ? make("pre", {}, part.replace(/^ {4}/gm, "")) : make("p", {}, part))));
}

export function button(words, action, kind = "") {
  const made = make("button", { type: "button", ...(kind && { class: kind }) }, text(words));
  made.onclick = action;
  return made;
}
