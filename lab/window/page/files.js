// The list of the workspace's files, and a new file.

import { make, text } from "./words.js";

const MOST = 300; // names on the page

export class FileList {
  constructor(desk) {
    this.desk = desk;
    this.box = document.getElementById("open-file");
    this.search = document.getElementById("file-search");
    this.list = document.getElementById("file-list");
    this.search.oninput = () => this.paint();
    this.box.ontoggle = () => { if (!this.box.open) return void (this.search.value = ""); this.paint(); this.search.focus(); };
    this.box.onkeydown = (event) => { if (event.key === "Escape") { this.box.open = false; this.box.firstElementChild.focus(); } };
    addEventListener("pointerdown", (event) => { if (!this.box.contains(event.target)) this.box.open = false; });
    this.search.onkeydown = (event) => {
      if (event.key === "Enter") this.list.querySelector("button")?.click();
    };
    document.getElementById("new-file").onsubmit = (event) => {
      event.preventDefault();
      const input = document.getElementById("new-path");
      const path = input.value.trim().replace(/^(~\/ros2_ws\/|\.\/)/, "");
      if (!path || path.endsWith("/")) return this.desk.notice(text("no_name"));
      input.value = "";
      this.box.open = false;
      this.desk.editor.create(path);
    };
  }

  paint() {
    if (!this.box.open) return;
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.desk.names.filter((name) => words.every((word) => name.toLowerCase().includes(word))).slice(0, MOST);
    this.list.replaceChildren(...(found.length ? found.map((name) => this.entry(name)) : [make("li", {}, text("no_such_file"))]));
  }

  entry(path) {
    const [, folder, name] = path.match(/^(.*\/)?([^/]*)$/);
    const button = make("button", { type: "button" }, make("small", {}, folder ?? ""), name);
    button.onclick = () => { this.box.open = false; this.desk.open(path); };
    return make("li", {}, button);
  }
}
