// The student's desk: guide, editor, terminals and check, which know of each other.

import { Check } from "./check.js";
import { Editor } from "./editor.js";
import { Guide } from "./guide.js";
import { Terminals } from "./terminals.js";
import { Work } from "./work.js";

const LATER = 500; // ms after which a changed layout is kept

export class Desk {
  /** `notice` says something to the student in one line. */
  constructor(panes, notice) {
    this.panes = panes;
    this.notice = notice;
    this.names = [];
    this.restored = false;
    this.work = new Work((message) => this.hear(message), () => this.editor?.again());
    this.editor = new Editor(this);
    this.terminals = new Terminals(this);
    this.guide = new Guide(this);
    this.check = new Check(this);
    this.parts = [this.guide, this.check, this.editor, this.terminals];
    addEventListener("pagehide", () => this.sendLayout()); // (a reload finds what was opened a moment ago)
  }

  hear(message) {
    if (message.kind === "layout") return this.restore(message.layout);
    if (message.kind === "files") {
      this.names = message.names;
      return this.editor.changed(message.changed ?? []);
    }
    for (const part of this.parts) part[message.kind]?.(message);
  }

  /** Ask; what cannot be done is said. */
  async ask(what, more) {
    const answer = await this.work.ask(what, more);
    if (answer.error) this.notice(answer.error);
    return answer;
  }

  /** Open a file of the workspace at a line, from 1; 0 is where it was left. */
  open(path, line = 0) {
    this.panes.show("editor");
    return this.editor.open(path, line);
  }

  /** Write a command into the terminal; the student presses Enter. */
  type(command) {
    this.panes.show("terminal");
    this.terminals.type(command);
  }

  /** The path in the workspace of a file that a program names; "" if it is none of it. */
  locate(named) {
    const inside = named.replace(/^(~|\/home\/[^/]+)\/ros2_ws\//, "");
    if (this.names.includes(inside)) return inside;
    const parts = inside.split("/"); // what is installed is a copy or a link of a source
    const ends = [3, 2].map((count) => `/${parts.slice(-count).join("/")}`);
    const own = this.names.filter((name) => name.startsWith("src/"));
    const found = ends.map((end) => own.filter((name) => name.endsWith(end))).find((list) => list.length === 1);
    return /^(build|install)\/|^src\//.test(inside) || !named.startsWith("/") ? found?.[0] ?? "" : "";
  }

  show() {
    for (const part of this.parts ?? []) part.show?.();
  }

  restore(kept) {
    if (this.restored) return; // (a second connection: the page knows better)
    this.restored = true;
    const { files = [], file = "", ...layout } = kept ? JSON.parse(kept) : {};
    if (kept) this.panes.restore(layout);
    this.editor.restore(files, file);
  }

  keepLayout() {
    clearTimeout(this.keeping);
    if (!this.restored) return;
    this.keeping = setTimeout(() => this.sendLayout(), LATER);
  }

  sendLayout() {
    clearTimeout(this.keeping);
    if (!this.restored) return;
    const layout = JSON.stringify({ ...this.panes.layout, ...this.editor.layout });
    this.work.ask("layout", { layout });
  }
}
