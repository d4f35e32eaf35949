// The parameters of a node: read, and set.

import { fill, make, text } from "./words.js";

export class Parameters {
  constructor(socket) {
    this.socket = socket;
    this.select = document.getElementById("parameter-node");
    this.table = document.getElementById("parameter-table");
    this.body = this.table.tBodies[0];
    this.said = document.getElementById("parameter-said");
    this.none = document.getElementById("no-parameters");
    this.select.onchange = () => { this.said.textContent = ""; this.body.replaceChildren(); this.read(); };
    this.select.form.onsubmit = (event) => event.preventDefault();
  }

  get hidden() { return this.table.closest("section").hidden; }

  show(node) {
    if (node && [...this.select.options].some((option) => option.value === node)) this.select.value = node;
    this.body.replaceChildren();
    this.read();
  }

  graph({ nodes }) {
    const before = this.select.value;
    const names = nodes.filter((node) => node.parameters && !node.hidden).map((node) => node.name);
    fill(this.select, names);
    this.none.hidden = names.length > 0;
    this.table.hidden = !names.length;
    if (this.select.value !== before) { this.body.replaceChildren(); this.read(); }
  }

  parameter_event({ node }) {
    if (node === this.select.value) this.read();
  }

  read() {
    const node = this.select.value;
    if (this.hidden || !node) return;
    this.socket.ask({ do: "parameters", node }, ({ rows }) => {
      if (node !== this.select.value) return;
      if (!rows) this.said.textContent = text("no_answer");
      else if (this.said.textContent === text("no_answer")) this.said.textContent = "";
      if (rows) this.fill(node, rows);
    });
  }

  fill(node, rows) {
    const old = new Map([...this.body.rows].map((row) => [row.dataset.name, row]));
    if ([...old.keys()].join() === rows.map((row) => row.name).join()) {
      for (const row of rows) update(old.get(row.name), row);
    } else {
      this.body.replaceChildren(...rows.map((row) => this.row(node, row)));
    }
  }

  row(node, { name, type, read_only: fixed, description = "", from, to, text: value }) {
    const isBool = type === "bool";
    const input = make("input", { type: isBool ? "checkbox" : "text", "aria-label": name });
    const wrong = make("p", { class: "wrong", role: "alert" });
    const button = make("button", { type: "submit", "aria-label": text("set_label", { name }) }, text("set"));
    input.disabled = button.disabled = Boolean(fixed) || type === "not_set";
    const form = make("form", {}, input, button);
    const range = from === undefined ? "" : text("range", { from, to });
    const notes = [fixed ? text("read_only") : "", range].filter(Boolean).join(", ");
    const row = make("tr", { "data-name": name },
      make("th", { scope: "row" }, name, make("small", {}, type.replace("_", " "))),
      make("td", {}, form, wrong),
      make("td", {}, description, make("small", {}, notes)));
    update(row, { text: value });
    form.onsubmit = (event) => {
      event.preventDefault();
      const typed = isBool ? String(input.checked) : input.value;
      this.socket.ask({ do: "set", node, name, type, text: typed }, (answer) => {
        const reason = { wrong_value: text("wrong_value", { type: type.replace("_", " ") }), no_answer: text("no_answer") };
        wrong.textContent = answer.done ? "" : text("not_set", { name, reason: reason[answer.reason] ?? answer.reason });
        this.said.textContent = answer.done ? text("was_set", { name }) : "";
        if (answer.done) row.dataset.text = typed;
        row.classList.toggle("changed", answer.done);
        setTimeout(() => row.classList.remove("changed"), 1200);
      });
    };
    return row;
  }
}

/** Show a value; what is being typed stays. */
function update(row, { text: value }) {
  const input = row.querySelector("input");
  const typed = input.type === "checkbox" ? String(input.checked) : input.value;
  if (row.dataset.text !== undefined && typed !== row.dataset.text) return;
  row.dataset.text = value;
  if (input.type === "checkbox") input.checked = value === "true";
  else input.value = value;
}
