// The editor: the files that are open, what is not saved, and what another program has saved.

import {
  bracketMatching, closeBrackets, closeBracketsKeymap, defaultKeymap, drawSelection, EditorState, EditorView, highlightActiveLine,
  highlightActiveLineGutter, highlightSelectionMatches, history, historyKeymap, indentOnInput, indentUnit, indentWithTab, keymap,
  lineNumbers, lintGutter, lintKeymap, openSearchPanel, properties, python, search, searchKeymap, setDiagnostics, StreamLanguage,
  syntaxHighlighting, xml, yaml,
} from "./vendor/codemirror.esm.js";
import { FileList } from "./files.js";
import { colours, phrases, theme } from "./editor-look.js";
import { button } from "./guide.js";
import { nonce } from "./nonce.js";
import { make, text } from "./words.js";

const LATER = 400; // ms without a key after which a draft is kept
const LANGUAGES = { py: () => python(), xml: () => xml(), cfg: () => StreamLanguage.define(properties), yaml: () => StreamLanguage.define(yaml), yml: () => StreamLanguage.define(yaml) };

export class Editor {
  constructor(desk) {
    this.desk = desk;
    this.files = new Map(); // by path: version, the saved text, the editor's state, a conflict
    this.path = "";
    this.place = document.getElementById("text");
    this.empty = document.getElementById("no-file");
    this.view = null;
    this.now = null;
    this.list = new FileList(desk);
    document.getElementById("save").onclick = () => this.save();
    addEventListener("keydown", (event) => {
      if ((event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && event.key === "s") {
        event.preventDefault(); // (not only in the text: the browser would save the page)
        this.save();
      }
    });
    addEventListener("pagehide", () => this.keepDrafts());
  }

  get layout() { return { files: [...this.files.keys()], file: this.path }; }

  async restore(paths, path) {
    for (const each of paths) await this.load(each);
    if (this.files.has(path)) this.turn(path);
    this.paint();
  }

  /** After a lost connection: what changed meanwhile was not heard, and drafts were not kept. */
  again() {
    for (const path of this.files.keys()) this.look(path);
    this.keepDrafts();
  }

  async open(path, line = 0) {
    if (!this.files.has(path) && !(await this.load(path))) return;
    this.turn(path);
    if (line) this.goTo(line);
    this.view.focus();
    this.desk.keepLayout();
  }

  create(path) {
    if (this.desk.names.includes(path)) return this.open(path);
    this.files.set(path, { version: "", saved: null, state: this.state(path, "") });
    return this.open(path);
  }

  async load(path) {
    const found = await this.desk.ask("read", { path });
    if (found.error) return false;
    const file = { version: found.version, saved: found.text, state: this.state(path, found.draft ?? found.text) };
    this.files.set(path, file);
    if (found.draft !== undefined && found.draft_version !== found.version) {
      file.conflict = { text: found.text, version: found.version };
      file.version = found.draft_version;
    }
    return true;
  }

  state(path, doc) {
    const language = LANGUAGES[path.split(".").at(-1)];
    return EditorState.create({ doc, extensions: [
      EditorView.cspNonce.of(nonce), theme, syntaxHighlighting(colours), phrases(),
      lineNumbers(), highlightActiveLineGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(),
      highlightActiveLine(), highlightSelectionMatches(), search({ top: true }), lintGutter(), indentUnit.of("    "),
      keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
      EditorView.contentAttributes.of({ "aria-label": text("text_of", { path }), tabindex: "0", spellcheck: "false", autocapitalize: "off" }),
      EditorView.updateListener.of((update) => { if (update.docChanged) this.edited(path); }),
      ...(language ? [language()] : []),
    ] });
  }

  turn(path) {
    if (this.path && this.view && this.files.has(this.path)) this.files.get(this.path).state = this.view.state;
    this.path = path;
    this.empty.hidden = true;
    this.view ??= new EditorView({ parent: this.place });
    this.view.setState(this.files.get(path).state);
    this.mark();
    this.paint();
  }

  text(path) {
    const state = path === this.path ? this.view.state : this.files.get(path).state;
    return state.doc.toString();
  }

  isChanged(path) {
    const { saved } = this.files.get(path);
    return saved === null || this.text(path) !== saved;
  }

  goTo(number) {
    const line = this.view.state.doc.line(Math.min(Math.max(number, 1), this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: line.from }, effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
  }

  find() { if (this.view) openSearchPanel(this.view); }

  edited(path) {
    if (this.files.get(path)?.quiet) return;
    this.paint();
    clearTimeout(this.drafting);
    this.drafting = setTimeout(() => this.keepDrafts(), LATER);
  }

  /** Keep what is not saved, so that a lost page or lab loses nothing of it. */
  keepDrafts() {
    for (const [path, file] of this.files) {
      const draft = this.isChanged(path) ? this.text(path) : null;
      if (draft === (file.draft ?? null)) continue;
      file.draft = draft;
      this.desk.work.ask("draft", { path, text: draft, version: file.version }).then(({ error }) => { if (error) file.draft = undefined; });
    }
  }

  async saveAll() {
    for (const path of this.files.keys()) if (this.isChanged(path) && !this.files.get(path).conflict) await this.save(path);
  }

  async save(path = this.path, keeps = false) {
    const file = this.files.get(path);
    if (!file || (!this.isChanged(path) && !keeps)) return;
    const written = this.text(path);
    const answer = await this.desk.ask("save", { path, text: written, version: file.version, keeps });
    if (answer.error) return;
    if (answer.conflict !== undefined) {
      file.conflict = { text: answer.conflict, version: answer.version };
    } else {
      Object.assign(file, { version: answer.version, saved: written, conflict: null, draft: null });
      if (answer.backup) this.desk.notice(text("kept_in", { place: answer.backup }));
      else this.desk.notice(text("saved", { path }));
    }
    this.paint();
  }


  async look(path) {
    const file = this.files.get(path);
    const found = await this.desk.work.ask("read", { path });
    if (found.error || found.version === file.version) return;
    if (this.text(path) === found.text) {
      Object.assign(file, { version: found.version, saved: found.text, conflict: null });
    } else if (this.isChanged(path)) {
      file.conflict = { text: found.text, version: found.version };
    } else {
      this.replace(path, found);
      this.desk.notice(text("read_again", { path }));
    }
    this.paint();
  }

  replace(path, { text: doc, version }) {
    const file = this.files.get(path);
    const state = path === this.path ? this.view.state : file.state;
    const change = { changes: { from: 0, to: state.doc.length, insert: doc } };
    Object.assign(file, { version, saved: doc, conflict: null });
    if (path === this.path) this.view.dispatch(change);
    else file.state = state.update(change).state;
    this.mark();
  }

  async takeTheirs(path) {
    const file = this.files.get(path);
    const { backup, error } = await this.desk.ask("keep", { path, text: this.text(path) });
    if (error) return;
    this.replace(path, file.conflict);
    this.keepDrafts();
    this.desk.notice(text("kept_in", { place: backup }));
    this.paint();
  }

  keepMine(path) {
    const file = this.files.get(path);
    file.version = file.conflict.version;
    return this.save(path, true);
  }

  close(path) {
    if (this.isChanged(path) && this.files.get(path).saved !== null && !this.files.get(path).closes) {
      this.files.get(path).closes = true; // (the draft stays: it is there when the file is opened again)
      this.keepDrafts();
      this.desk.notice(text("close_unsaved", { path }));
      return;
    }
    this.files.delete(path);
    const next = [...this.files.keys()].at(-1);
    if (path === this.path) {
      this.path = "";
      if (next) this.turn(next);
      else { this.view?.destroy(); this.view = null; this.empty.hidden = false; }
    }
    this.paint();
    this.desk.keepLayout();
  }

  guide(now) {
    this.now = now;
    this.mark();
  }

  /** The workspace has changed: a file that is open is looked at again. */
  changed(paths) {
    this.list.paint();
    for (const path of paths) if (this.files.has(path)) this.look(path);
  }

  /** Mark the line of the mistake, with what is wrong and the hints so far. */
  mark() {
    if (!this.view) return;
    const { file, line, found, next, hints = [] } = this.now ?? {};
    const doc = this.view.state.doc;
    const marks = [];
    if (file === this.path && line && line <= doc.lines && found) {
      const at = doc.line(line);
      const from = at.from + (at.text.length - at.text.trimStart().length);
      marks.push({ from, to: Math.max(at.to, from), severity: "error", message: [found, ...(hints.length ? hints : [next])].join("\n\n") });
    }
    this.view.dispatch(setDiagnostics(this.view.state, marks));
  }

  paint() {
    const tabs = [...this.files.keys()].map((path) => this.tab(path));
    document.getElementById("open-files").replaceChildren(...tabs);
    document.getElementById("save").disabled = !this.path || !this.isChanged(this.path);
    this.paintConflict();
  }

  tab(path) {
    const changed = this.isChanged(path);
    const name = path.split("/").at(-1);
    const open = make("button", { type: "button", title: path, ...(path === this.path && { "aria-current": "true" }) }, `${changed ? "● " : ""}${name}`);
    if (changed) open.setAttribute("aria-label", text("not_saved", { path }));
    open.onclick = () => { this.turn(path); this.desk.keepLayout(); };
    const close = make("button", { type: "button", class: "close", "aria-label": text("close_file", { path }) }, "×");
    close.onclick = () => this.close(path);
    return make("li", {}, open, close);
  }

  paintConflict() {
    const bar = document.getElementById("conflict");
    const conflict = this.files.get(this.path)?.conflict;
    bar.hidden = !conflict;
    const told = conflict ? `${this.path} ${conflict.version}` : "";
    if (bar.dataset.told === told) return;
    bar.dataset.told = told;
    if (!conflict) return bar.replaceChildren();
    const path = this.path;
    bar.replaceChildren(make("p", {}, text("conflict", { path })), make("p", { class: "actions" },
      button("keep_mine", () => this.keepMine(path), "main"), button("take_theirs", () => this.takeTheirs(path))));
  }
}
