// The terminals: shells of the lab, which go on when the page is closed.

import { FitAddon } from "./vendor/xterm-fit.esm.js";
import { Terminal } from "./vendor/xterm.esm.js";
import { socketAddress } from "./socket.js";
import { links } from "./traceback.js";
import { make, text } from "./words.js";

const AGAIN = 1000; // ms after which a lost connection is tried again
const ENDED = [4000, 4004]; // the codes with which the server closes: the terminal is no more
const LINES = 20_000; // kept on the page
const PART = 16_000; // letters in one message
const OPEN = 5379; // the number of the sequence with which the lab's `code` opens a file here
const DARK = matchMedia("(prefers-color-scheme: dark)");
const COLOURS = {
  light: { background: "#ffffff", foreground: "#18202c", cursor: "#18202c", cursorAccent: "#ffffff", selectionBackground: "#b9cdfa", black: "#18202c", red: "#b3261e", green: "#1c7a43", yellow: "#8a5a00", blue: "#2450c8", magenta: "#8a4fb5", cyan: "#0b6e80", white: "#566172", brightBlack: "#566172", brightRed: "#b3261e", brightGreen: "#1c7a43", brightYellow: "#8a5a00", brightBlue: "#2450c8", brightMagenta: "#8a4fb5", brightCyan: "#0b6e80", brightWhite: "#18202c" },
  dark: { background: "#191f29", foreground: "#e7ecf3", cursor: "#e7ecf3", cursorAccent: "#191f29", selectionBackground: "#3b5390", black: "#343d4b", red: "#ff9c94", green: "#7fd6a0", yellow: "#f2c063", blue: "#8fb0ff", magenta: "#cfa5ee", cyan: "#7fd3e0", white: "#e7ecf3", brightBlack: "#a3afbf", brightRed: "#ff9c94", brightGreen: "#7fd6a0", brightYellow: "#f2c063", brightBlue: "#8fb0ff", brightMagenta: "#cfa5ee", brightCyan: "#7fd3e0", brightWhite: "#ffffff" },
};

export class Terminals {
  constructor(desk) {
    this.desk = desk;
    this.all = new Map();
    this.chosen = 0;
    this.screens = document.getElementById("screens");
    document.getElementById("terminal-new").onclick = () => this.create();
    const beside = document.getElementById("terminal-beside");
    beside.onclick = () => {
      const pressed = beside.getAttribute("aria-pressed") !== "true";
      beside.setAttribute("aria-pressed", pressed);
      this.screens.classList.toggle("beside", pressed);
      this.show();
    };
    DARK.addEventListener("change", () => { for (const one of this.all.values()) one.colour(); });
    new ResizeObserver(() => this.show()).observe(this.screens);
  }

  terminals({ numbers }) {
    for (const [number, one] of this.all) if (!numbers.includes(number)) { one.dispose(); this.all.delete(number); }
    for (const number of numbers) if (!this.all.has(number)) this.all.set(number, new Screen(this, number));
    if (!numbers.length && !this.asked) this.create(); // (the first of the lab)
    if (!this.all.has(this.chosen)) this.choose(numbers.at(-1) ?? 0);
    else this.paint();
  }

  async create() {
    this.asked = true;
    const { number, error } = await this.desk.ask("open");
    if (number) this.choose(number, true);
    else if (!error) this.desk.notice(text("too_many_terminals"));
  }

  choose(number, focus = false) {
    this.chosen = number;
    this.paint();
    this.show();
    if (focus) this.all.get(number)?.terminal.focus();
  }

  paint() {
    document.getElementById("terminal-list").replaceChildren(...[...this.all.keys()].map((number) => {
      const open = make("button", { type: "button", ...(number === this.chosen && { "aria-current": "true" }) }, text("terminal_number", { number }));
      open.onclick = () => this.choose(number, true);
      const close = make("button", { type: "button", class: "close", "aria-label": text("terminal_close", { number }) }, "×");
      close.onclick = () => this.desk.ask("close", { number });
      return make("li", {}, open, close);
    }));
    for (const [number, one] of this.all) one.element.classList.toggle("chosen", number === this.chosen);
  }

  show() {
    for (const one of this.all.values()) one.fit();
  }

  /** Write a command into the chosen terminal, without Enter. */
  type(command) {
    const one = this.all.get(this.chosen);
    if (!one) return;
    one.send(command);
    one.terminal.focus();
  }
}

class Screen {
  constructor(terminals, number) {
    this.terminals = terminals;
    this.number = number;
    this.element = make("div", { class: "screen", role: "group", "aria-label": text("terminal_number", { number }) });
    terminals.screens.append(this.element);
    this.terminal = new Terminal({ fontSize: 13, fontFamily: 'ui-monospace, "SF Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace', scrollback: LINES, cursorBlink: false, minimumContrastRatio: 4.5 });
    this.fitting = new FitAddon();
    this.terminal.loadAddon(this.fitting);
    this.colour();
    this.terminal.open(this.element);
    this.terminal.textarea.setAttribute("aria-label", text("terminal_number", { number }));
    this.terminal.attachCustomKeyEventHandler((event) => this.key(event));
    this.terminal.onData((data) => { if (!this.replays) this.send(data); });
    this.terminal.onResize(({ rows, cols }) => this.say({ size: [rows, cols] }));
    this.terminal.registerLinkProvider(links(this.terminal, terminals.desk));
    this.terminal.parser.registerOscHandler(OPEN, (data) => this.asks(data));
    this.element.onpointerdown = () => { if (terminals.chosen !== number) terminals.choose(number); };
    this.replays = 0; // bytes of the history, to whose questions nobody waits for an answer
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(socketAddress(`terminal/${this.number}`));
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.terminal.reset(); // (what was shown comes again)
      this.fit();
      this.say({ size: [this.terminal.rows, this.terminal.cols] });
    };
    this.socket.onmessage = ({ data }) => {
      if (typeof data === "string") return this.told(JSON.parse(data));
      const bytes = new Uint8Array(data);
      this.terminal.write(bytes, () => {
        this.replays = Math.max(this.replays - bytes.length, 0);
        this.say({ took: bytes.length });
      });
    };
    this.socket.onclose = ({ code }) => {
      if (!this.closed && !ENDED.includes(code)) setTimeout(() => this.connect(), AGAIN);
    };
  }

  told({ history }) { this.replays = history; }

  say(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  send(data) {
    for (let at = 0; at < data.length; at += PART) this.say({ type: data.slice(at, at + PART) });
  }

  /** Keys that are not for the program: those of the page, and copying what is selected. */
  key(event) {
    if (event.key === "F6" || (event.altKey && /^Digit[1-9]$/.test(event.code))) return false;
    const copies = event.ctrlKey && !event.altKey && event.code === "KeyC" && (event.shiftKey || this.terminal.hasSelection());
    if (copies && event.type === "keydown") {
      event.preventDefault();
      navigator.clipboard?.writeText(this.terminal.getSelection());
      this.terminal.clearSelection();
    }
    return !copies && !(event.ctrlKey && event.code === "KeyV");
  }

  /** What a program asks of the page: `open;PATH`. */
  asks(data) {
    const [what, ...path] = data.split(";");
    const found = what === "open" && !this.replays ? this.terminals.desk.locate(path.join(";")) : "";
    if (found) this.terminals.desk.open(found);
    else if (what === "open" && !this.replays) this.terminals.desk.panes.show("editor");
    return true;
  }

  colour() { this.terminal.options.theme = COLOURS[DARK.matches ? "dark" : "light"]; }

  fit() {
    if (this.element.offsetParent && this.element.clientWidth > 40 && this.element.clientHeight > 20) this.fitting.fit();
  }

  dispose() {
    this.closed = true;
    this.socket.close();
    this.terminal.dispose();
    this.element.remove();
  }
}
