// Elements of a lesson's text. Its nodes are texts, or a tag, its attributes and its nodes.

import { make, text } from "./words.js";

/** The elements of nodes; `type` gets a command that the student wants in the terminal. */
export function elements(nodes, type) {
  return nodes.map((node) => (typeof node === "string" ? node : element(node, type)));
}

function element([tag, attributes, nodes], type) {
  if (tag === "code-lines") return lines(nodes, type);
  if (tag === "code" && attributes.command) return make("span", { class: "command" }, make("code", {}, ...nodes), typer(nodes[0], type));
  if (tag === "table") return make("div", { class: "wide", tabindex: 0, role: "region", "aria-label": text("table") }, make("table", {}, ...elements(nodes, type)));
  if (tag === "a") return make("a", { href: attributes.href ?? "#", target: "_blank", rel: "noopener noreferrer" }, ...elements(nodes, type));
  const made = make(/^h[12]$/.test(tag) ? "h3" : tag, {}, ...elements(nodes, type));
  if (tag === "th") made.scope = "col";
  return made;
}

/** A block of code: each command has a button that writes it into the terminal. */
function lines(all, type) {
  if (!all.some(([, isCommand]) => isCommand)) return make("pre", { tabindex: 0 }, all.map(([line]) => line).join("\n"));
  return make("div", { class: "commands" }, ...all.map(([line, isCommand]) =>
    make("div", {}, make("code", {}, line), ...(isCommand ? [typer(line, type)] : []))));
}

function typer(command, type) {
  const button = make("button", { type: "button", class: "typer", title: text("type_it"), "aria-label": text("type_this", { command }) }, "⌨");
  button.onclick = () => type(command);
  return button;
}
