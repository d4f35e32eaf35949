// The frame of the page: the views, the connection, and what is wrong with it.

import { Graph } from "./graph.js";
import { Log } from "./log.js";
import { Parameters } from "./parameters.js";
import { Plot } from "./plot.js";
import { Socket } from "./socket.js";
import { Turtle } from "./turtle.js";
import { loadTexts, text } from "./words.js";

const LOST = 4000; // ms without connection after which the page says what to do

history.replaceState(null, "", location.pathname + location.hash); // the token is in the cookie
await loadTexts();

const socket = new Socket(receive, connection);
const views = {
  turtle: new Turtle(socket),
  graph: new Graph(socket),
  log: new Log(),
  plot: new Plot(socket, () => watch()),
  parameters: new Parameters(socket),
};
let shown = "";
let lost = 0;
const received = { frames: 0 };

function receive(message) {
  if (message.kind === "bridge") return bridge(message);
  received.frames += 1;
  for (const view of Object.values(views)) view[message.kind]?.(message);
}

function bridge({ state, distro, text: printed }) {
  if (distro) document.getElementById("distro").textContent = distro;
  status(state === "ready" ? "connected" : state, text(state === "ready" ? "connected" : "bridge_ended"));
  trouble(state === "failed" ? `${text("bridge_failed")}\n${printed}` : "");
}

function connection(state) {
  status(state, text(state));
  if (state === "lost") {
    lost ||= setTimeout(() => trouble(text("lost_long")), LOST); // said once, however often it is tried
  } else {
    clearTimeout(lost);
    lost = 0;
    trouble("");
  }
}

function status(state, words) {
  const element = document.getElementById("status");
  element.dataset.state = state;
  element.textContent = words;
}

function trouble(words) {
  const element = document.getElementById("trouble");
  if (element.textContent === words) return;
  element.textContent = words;
  element.hidden = !words;
}

function watch() {
  socket.watch(shown, views.plot.wanted());
}

function show() {
  const [name, ...rest] = location.hash.slice(1).split("?");
  const next = views[name] ? name : "turtle";
  const changed = next !== shown;
  shown = next;
  for (const section of document.querySelectorAll("section")) section.hidden = section.id !== shown;
  for (const link of document.querySelectorAll("nav a")) {
    if (link.hash === `#${shown}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  if (changed) watch();
  views[shown].show?.(decodeURIComponent(rest.join("?")));
}

addEventListener("hashchange", show);
show();
