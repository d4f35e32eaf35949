// The ROS graph: nodes, topics, services and actions; dashed where something does not fit.

import { Graph as Layout, layout } from "./vendor/dagre.esm.js";
import { columns } from "./columns.js";
import { reasons, short } from "./misfits.js";
import { draw, make, onceAFrame, text } from "./words.js";

const CHAR = 7.4; // px, the width of a letter of 13 px
const HEIGHT = 38;
const SMALLEST = 0.75; // of the drawing; a graph that is too wide for it is drawn in two columns
const SHARE = 0.6; // of the pane's height, for the drawing in a narrow pane (see style.css)

export class Graph {
  constructor(socket) {
    this.socket = socket;
    this.state = null;
    this.chosen = "";
    this.drawing = document.getElementById("drawing");
    this.options = ["with-services", "with-plumbing"].map((id) => document.getElementById(id));
    for (const option of this.options) option.onchange = () => this.paint();
    this.paint = onceAFrame(() => this.paintNow());
    new ResizeObserver(() => this.paint()).observe(this.drawing);
  }

  show() { this.paint(); }

  graph(state) {
    this.state = state;
    this.paint();
  }

  paintNow() {
    if (!this.state || this.drawing.closest("section").hidden) return;
    const focused = document.activeElement?.dataset?.id;
    const { boxes, edges } = model(this.state, this.options[0].checked, this.options[1].checked);
    this.boxes = boxes;
    this.edges = edges;
    if (!boxes.size) this.drawing.replaceChildren(make("p", {}, text("graph_empty")));
    else this.drawing.replaceChildren(this.svg(boxes, edges));
    if (focused) this.drawing.querySelector(`[data-id="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
    this.paintProblems();
    this.choose(boxes.has(this.chosen) ? this.chosen : "");
  }

  svg(boxes, edges) {
    const plan = new Layout({ multigraph: true });
    plan.setGraph({ rankdir: this.drawing.clientWidth < 600 ? "TB" : "LR", nodesep: 18, ranksep: 55, marginx: 16, marginy: 16 });
    plan.setDefaultEdgeLabel(() => ({}));
    for (const [id, box] of boxes) plan.setNode(id, { width: Math.max(90, width(box.name) + 26), height: HEIGHT });
    edges.forEach((edge, i) => {
      const label = edge.short ? { width: width(edge.short) + 14, height: 20, labelpos: "c" } : {};
      plan.setEdge(edge.from, edge.to, label, String(i));
    });
    layout(plan);
    const { width: wide, height: high } = plan.graph();
    const across = (this.drawing.clientWidth - 4) / wide;
    const isTall = across < SMALLEST;
    this.drawing.classList.toggle("tall", isTall);
    if (isTall) return this.inColumns(boxes, edges);
    const room = this.drawing.clientWidth < 600 ? SHARE * this.drawing.closest(".content").clientHeight : this.drawing.clientHeight;
    const scale = Math.max(SMALLEST, Math.min(across, (room - 4) / high, 1.25));
    const svg = canvas(wide, high, scale);
    edges.forEach((edge, i) => svg.append(...line(edge, plan.edge(edge.from, edge.to, String(i)))));
    for (const [id, box] of boxes) svg.append(this.box(id, box, plan.node(id)));
    return svg;
  }

  inColumns(boxes, edges) {
    const plan = columns(boxes, edges, this.drawing.clientWidth, CHAR);
    const svg = canvas(plan.width, plan.height, 1);
    edges.forEach((edge, i) => svg.append(stroke(edge, plan.lines[i].path)));
    for (const [id, box] of boxes) svg.append(this.box(id, box, plan.places.get(id)));
    edges.forEach((edge, i) => { if (edge.short) svg.append(reason("!", { ...plan.lines[i], width: 18, height: 20 })); });
    return svg;
  }

  box(id, { kind, name, lonely }, { x, y, width: wide, height, lines = [name] }) {
    const group = draw("g", { class: `box ${kind}${lonely ? " lonely" : ""}`, "data-id": id, tabindex: 0, role: "button", "aria-label": `${text(kind)} ${name}`, transform: `translate(${x} ${y})` });
    const radius = { node: 5, topic: 19, service: 10, action: 10 }[kind];
    const top = -9 - 8 * (lines.length - 1);
    group.append(
      draw("rect", { class: "shape", x: -wide / 2, y: -height / 2, width: wide, height, rx: radius }),
      draw("text", { class: "kind", y: top }, text(kind)),
      ...lines.map((part, i) => draw("text", { y: top + 15 + 16 * i }, part)));
    group.onclick = () => this.choose(id === this.chosen ? "" : id);
    group.onkeydown = (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      this.choose(id === this.chosen ? "" : id);
    };
    return group;
  }

  choose(id) {
    this.chosen = id;
    for (const box of this.drawing.querySelectorAll("g.box")) box.classList.toggle("chosen", box.dataset.id === id);
    for (const path of this.drawing.querySelectorAll("path.edge")) {
      path.classList.toggle("dim", Boolean(id) && path.dataset.from !== id && path.dataset.to !== id);
    }
    this.paintDetails(this.boxes.get(id));
  }

  paintProblems() {
    const found = problems(this.state);
    const list = document.getElementById("problems");
    const items = found.length ? found : [text("no_problem")];
    if ([...list.children].map((item) => item.textContent).join("\n") === items.join("\n")) return;
    list.replaceChildren(...items.map((words) => make("li", { class: found.length ? "" : "fine" }, words)));
  }

  paintDetails(box) {
    const details = document.getElementById("details");
    if (!box) return details.replaceChildren();
    const list = make("dl");
    for (const [name, values] of rows(box, this.state)) {
      list.append(make("dt", {}, text(name)), ...(values.length ? values : [text("none")]).map((value) => make("dd", {}, value)));
    }
    details.replaceChildren(make("h4", {}, box.name), list, ...next(box));
  }
}

function width(words) {
  return [...words].reduce((sum, letter) => sum + (letter > "\u1100" ? 13 : CHAR), 0);
}

/** The boxes by id, and the edges between them. */
function model(state, withServices, withPlumbing) {
  const boxes = new Map();
  const edges = [];
  const hidden = new Set(state.nodes.filter((node) => node.hidden && !withPlumbing).map((node) => node.name));
  for (const node of state.nodes) if (!hidden.has(node.name)) boxes.set(`node ${node.name}`, { kind: "node", ...node });
  const ends = (list) => new Set(list.map((end) => end.node ?? end).filter((name) => boxes.has(`node ${name}`)));
  for (const topic of state.topics) {
    if (topic.plumbing && !withPlumbing) continue;
    const [from, to] = [ends(topic.publishers), ends(topic.subscriptions)];
    if (!from.size && !to.size) continue;
    const id = `topic ${topic.name}`;
    boxes.set(id, { kind: "topic", lonely: !from.size || !to.size, ...topic });
    for (const name of from) edges.push({ from: `node ${name}`, to: id });
    for (const name of to) edges.push({ from: id, to: `node ${name}`, ...topicMisfit(topic, name) });
  }
  for (const [kind, list] of [["service", state.services], ["action", state.actions]]) {
    for (const service of withServices ? list : list.filter((one) => one.misfits.length)) {
      const [servers, clients] = [ends(service.servers), ends(service.clients)];
      if (!servers.size && !clients.size) continue;
      const id = `${kind} ${service.name}`;
      boxes.set(id, { kind, lonely: !servers.size, ...service });
      for (const name of servers) edges.push({ from: id, to: `node ${name}` });
      for (const name of clients) {
        const misfit = service.misfits.find((pair) => pair.client === name);
        edges.push({ from: `node ${name}`, to: id, short: misfit && short(misfit.reasons) });
      }
    }
  }
  return { boxes, edges };
}

/** Why a node does not get messages of a topic: that of its first pair that does not fit. */
function topicMisfit(topic, node) {
  const pair = topic.misfits.find(({ subscription }) => topic.subscriptions[subscription].node === node);
  return pair ? { short: short(pair.reasons) } : {};
}

function problems(state) {
  const found = state.twice.map((node) => text("twice", { node }));
  for (const topic of state.topics) {
    for (const pair of topic.misfits) {
      found.push(text("no_message", {
        subscriber: topic.subscriptions[pair.subscription].node, publisher: topic.publishers[pair.publisher].node,
        topic: topic.name, reasons: reasons(pair.reasons),
      }));
    }
  }
  for (const service of [...state.services, ...state.actions]) {
    for (const { client, server, reasons: why } of service.misfits) {
      found.push(text("no_answer_from", { client, server, service: service.name, reasons: reasons(why) }));
    }
  }
  return [...new Set(found)];
}

function rows(box, state) {
  const quality = (end) => `${end.node} (${text(end.qos.reliability)}, ${text(end.qos.durability)})`;
  const named = (list) => list.map((one) => one.name);
  if (box.kind === "topic") {
    return [["type", box.types], ["publishers", box.publishers.map(quality)], ["subscriptions", box.subscriptions.map(quality)]];
  }
  if (box.kind !== "node") return [["type", box.types], ["servers", box.servers], ["clients", box.clients]];
  const all = [...state.services, ...state.actions];
  return [
    ["publishes", named(state.topics.filter((topic) => topic.publishers.some((end) => end.node === box.name)))],
    ["subscribes", named(state.topics.filter((topic) => topic.subscriptions.some((end) => end.node === box.name)))],
    ["offers", named(all.filter((service) => service.servers.includes(box.name)))],
    ["calls", named(all.filter((service) => service.clients.includes(box.name)))],
  ];
}

/** Buttons that lead from a box to another view. */
function next(box) {
  const to = (view, words) => {
    const button = make("button", { type: "button" }, text(words));
    button.onclick = () => { location.hash = `${view}?${encodeURIComponent(box.name)}`; };
    return button;
  };
  if (box.kind === "topic" && box.publishers.length) return [to("plot", "plot_this")];
  if (box.kind === "node" && box.parameters) return [to("parameters", "see_parameters")];
  return [];
}

function marker(id, kind) {
  return draw("marker", { id, class: kind, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 8, markerHeight: 8, markerUnits: "userSpaceOnUse", orient: "auto" },
    draw("path", { d: "M0 0L8 4L0 8z" }));
}

function line(edge, { points, x, y, width: wide, height }) {
  const [start, ...rest] = points;
  const middle = rest.slice(0, -1).map((point, i) => {
    const after = rest[i + 1];
    const end = i === rest.length - 2 ? after : { x: (point.x + after.x) / 2, y: (point.y + after.y) / 2 };
    return `Q${point.x} ${point.y} ${end.x} ${end.y}`;
  });
  const path = stroke(edge, `M${start.x} ${start.y}${middle.join("")}`);
  return edge.short ? [path, reason(edge.short, { x, y, width: wide, height })] : [path];
}

function stroke(edge, d) {
  const bad = Boolean(edge.short);
  return draw("path", { class: `edge${bad ? " misfit" : ""}`, "data-from": edge.from, "data-to": edge.to, d, "marker-end": `url(#${bad ? "end-bad" : "end"})` });
}

function reason(words, { x, y, width: wide, height }) {
  return draw("g", { class: "reason", transform: `translate(${x} ${y})` },
    draw("rect", { x: -wide / 2, y: -height / 2, width: wide, height, rx: 6 }), draw("text", {}, words));
}

function canvas(wide, high, scale) {
  const svg = draw("svg", { viewBox: `0 0 ${wide} ${high}`, width: wide * scale, height: high * scale, role: "group", "aria-label": text("graph_drawing") });
  svg.append(draw("defs", {}, marker("end", ""), marker("end-bad", "bad")));
  return svg;
}
