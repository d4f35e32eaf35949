// The frame of the page: the panes, the connections, and what is wrong with them.

import "./nonce.js";
import { Graph } from "./graph.js";
import { Log } from "./log.js";
import { Panes } from "./panes.js";
import { Parameters } from "./parameters.js";
import { Plot } from "./plot.js";
import { Socket } from "./socket.js";
import { Turtle } from "./turtle.js";
import { loadTexts, text } from "./words.js";

const LOST = 4000; // ms without connection after which the page says what to do

history.replaceState(null, "", location.pathname + location.hash); // the token is in the cookie
await loadTexts();
const hasTurtle = Boolean(text("has_turtlesim"));
const hasLab = Boolean(text("has_lab"));
const names = [
  ...(hasLab ? ["guide", "editor", "terminal", "check"] : []),
  ...(hasTurtle ? ["turtle"] : []), "graph", "log", "plot", "parameters",
];

const socket = new Socket(receive, connection);
const views = {
  ...(hasTurtle && { turtle: new Turtle(socket) }),
  graph: new Graph(socket),
  log: new Log(),
  plot: new Plot(socket, () => watch()),
  parameters: new Parameters(socket),
};
let panes = null;
let work = null;
let lost = 0;
let seen = "";

panes = new Panes(names, show, () => work?.keepLayout());
if (hasLab) work = new (await import("./desk.js")).Desk(panes, notice);
document.addEventListener("visibilitychange", watch);
show();

function receive(message) {
  if (message.kind === "bridge") return bridge(message);
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

function notice(words) {
  document.getElementById("notice").textContent = words;
}

/** Say what is looked at: nothing while the page is in the background, except by the guide. */
function watch() {
  if (!panes) return;
  const shown = document.hidden ? [] : Object.keys(views).filter((name) => panes.sees(name));
  socket.watch(hasLab ? [...shown, "guide"] : shown, views.plot.wanted(), views.plot.seeks);
}

/** What is seen has changed; `what` is asked of a view, if it was gone to with more words. */
function show(name, what = "") {
  if (!panes) return;
  watch();
  const shown = Object.keys(views).filter((view) => panes.sees(view));
  for (const view of shown) if (!seen.split(" ").includes(view) || view === name) views[view].show?.(view === name ? what : "");
  seen = shown.join(" ");
  work?.show();
}
