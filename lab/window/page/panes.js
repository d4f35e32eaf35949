// The panes: where they are, which one of an area is shown, how large the areas are.

import { make, text } from "./words.js";

const COLUMNS = [["left"], ["top", "bottom"], ["above", "below"]];
const AREAS = COLUMNS.flat();
const HIDDEN = "hidden";
const USUAL = {
  guide: "left", check: "left", editor: "top", terminal: "bottom",
  turtle: "above", plot: "above", parameters: "above", graph: "below", log: "below",
};
const SHARES = { "column-left": 1, "column-middle": 1.7, "column-right": 1.15, top: 1.2, bottom: 1, above: 1.1, below: 1 };
const NAMES = ["column-left", "column-middle", "column-right"];
const NARROW = matchMedia("(max-width: 50rem)");
const STEP = 0.05; // of two neighbours, for a key on the line between them
const LEAST = 0.12;

export class Panes {
  /** `views` are the ids of the panes there are; `onShow` is called when what is seen has changed. */
  constructor(views, onShow, onLayout) {
    this.views = views;
    this.onShow = onShow;
    this.onLayout = onLayout;
    this.single = !views.includes("guide");
    this.places = { ...USUAL };
    this.chosen = {};
    this.shares = { ...SHARES };
    this.root = document.getElementById("areas");
    this.stock = document.createDocumentFragment();
    for (const section of document.querySelectorAll("main > section")) {
      if (!views.includes(section.id)) section.remove();
    }
    document.getElementById("arrange").hidden = this.single;
    this.dialog();
    NARROW.addEventListener("change", () => this.build());
    addEventListener("keydown", (event) => this.key(event), true);
    addEventListener("hashchange", () => this.follow());
    this.build();
    this.follow();
  }

  get layout() { return { places: this.places, chosen: this.chosen, shares: this.shares }; }

  /** Take a layout as it was kept; what it does not know stays as it is usual. */
  restore({ places = {}, chosen = {}, shares = {} }) {
    for (const view of Object.keys(USUAL)) if ([...AREAS, HIDDEN].includes(places[view])) this.places[view] = places[view];
    for (const [name, share] of Object.entries(shares)) if (SHARES[name] && share > 0 && share < 100) this.shares[name] = share;
    this.chosen = { ...chosen };
    this.build();
  }

  /** The area of a pane now: there is one only where there is no room. */
  area(view) {
    if (this.single) return "left";
    if (NARROW.matches) return this.places[view] === HIDDEN ? HIDDEN : "left";
    return this.places[view];
  }

  build() {
    const sections = this.views.map((view) => document.getElementById(view));
    const focused = document.activeElement;
    this.stock.append(...sections);
    this.root.replaceChildren();
    for (const [i, areas] of COLUMNS.entries()) {
      const used = areas.filter((area) => this.views.some((view) => this.area(view) === area));
      if (!used.length) continue;
      if (this.root.childElementCount) this.root.append(this.line(this.root.lastElementChild.dataset.share, NAMES[i], "vertical"));
      const column = make("div", { class: "column", "data-share": NAMES[i] });
      for (const area of used) {
        if (column.childElementCount) column.append(this.line(used[0], area, "horizontal"));
        column.append(this.box(area));
      }
      this.root.append(column);
    }
    for (const view of this.views) if (this.area(view) === HIDDEN) document.getElementById(view)?.remove();
    this.size();
    for (const area of AREAS) this.mark(area);
    if (focused?.isConnected) focused.focus({ preventScroll: true });
    this.onShow();
  }

  box(area) {
    const views = this.views.filter((view) => this.area(view) === area);
    const tabs = make("nav", { "aria-label": this.single ? text("views") : text(`area_${area}`) });
    const content = make("div", { class: "content" });
    for (const view of views) {
      const tab = make("a", { href: `#${view}`, draggable: "true" }, text(view));
      tab.onclick = (event) => { event.preventDefault(); this.show(view); };
      tab.ondragstart = (event) => event.dataTransfer.setData("text/x-pane", view);
      tabs.append(tab);
      const section = this.stock.getElementById?.(view) ?? [...this.stock.children].find((child) => child.id === view);
      content.append(section);
    }
    tabs.ondragover = (event) => { if (event.dataTransfer.types.includes("text/x-pane")) event.preventDefault(); };
    tabs.ondrop = (event) => this.move(event.dataTransfer.getData("text/x-pane"), area);
    return make("div", { class: "area", "data-share": area, "data-area": area }, tabs, content);
  }

  mark(area) {
    const views = this.views.filter((view) => this.area(view) === area);
    if (!views.length) return;
    if (!views.includes(this.chosen[area])) this.chosen[area] = views[0];
    for (const view of views) {
      const shown = this.chosen[area] === view;
      document.getElementById(view).hidden = !shown;
      const tab = this.root.querySelector(`nav a[href='#${view}']`);
      if (shown) tab.setAttribute("aria-current", "page");
      else tab.removeAttribute("aria-current");
    }
  }

  /** Whether a pane is seen. */
  sees(view) {
    const section = document.getElementById(view);
    return Boolean(section) && !section.hidden;
  }

  /** Show a pane, wherever it is; one that is hidden comes back. */
  show(view, { focus = false } = {}) {
    if (!this.views.includes(view)) return;
    if (this.area(view) === HIDDEN) {
      this.places[view] = USUAL[view];
      this.build();
    }
    const area = this.area(view);
    if (this.chosen[area] !== view) {
      this.chosen[area] = view;
      this.mark(area);
      this.onShow();
      this.onLayout();
    }
    history.replaceState(null, "", `#${view}`);
    if (focus) document.querySelector(`nav a[href='#${view}']`).focus();
  }

  move(view, area) {
    if (!this.views.includes(view) || this.places[view] === area) return;
    this.places[view] = area;
    if (area !== HIDDEN) this.chosen[area] = view;
    this.build();
    this.onLayout();
  }

  follow() {
    const [view, ...rest] = location.hash.slice(1).split("?");
    if (!this.views.includes(view)) return;
    this.show(view);
    this.onShow(view, decodeURIComponent(rest.join("?")));
  }

  size() {
    for (const element of this.root.querySelectorAll("[data-share]")) {
      element.style.flexGrow = this.shares[element.dataset.share];
    }
  }

  /** A line between two neighbours, which the pointer and the arrow keys move. */
  line(before, after, direction) {
    const line = make("div", { role: "slider", tabindex: 0, "aria-orientation": direction, "aria-label": text("divider"), class: `line ${direction}`, "aria-valuemin": 0, "aria-valuemax": 100 });
    const across = direction === "vertical";
    const value = () => line.setAttribute("aria-valuenow", Math.round((100 * this.shares[before]) / (this.shares[before] + this.shares[after])));
    const divide = (share) => {
      const both = this.shares[before] + this.shares[after];
      this.shares[before] = both * Math.min(Math.max(share, LEAST), 1 - LEAST);
      this.shares[after] = both - this.shares[before];
      this.size();
      value();
    };
    line.onkeydown = (event) => {
      const step = { ArrowLeft: -STEP, ArrowRight: STEP, ArrowUp: -STEP, ArrowDown: STEP }[event.key];
      if (!step || across !== event.key.match(/Left|Right/)?.length > 0) return;
      event.preventDefault();
      divide(this.shares[before] / (this.shares[before] + this.shares[after]) + step);
      this.onLayout();
    };
    line.onpointerdown = (event) => {
      line.setPointerCapture(event.pointerId);
      const [first, second] = [line.previousElementSibling, line.nextElementSibling].map((one) => one.getBoundingClientRect());
      line.onpointermove = (moved) => divide(across
        ? (moved.clientX - first.left) / (second.right - first.left)
        : (moved.clientY - first.top) / (second.bottom - first.top));
      line.onpointerup = () => { line.onpointermove = line.onpointerup = null; this.onLayout(); };
    };
    value();
    return line;
  }

  /** F6 goes to the next area, with Shift to the one before; Alt and a digit to a pane. */
  key(event) {
    const digit = event.altKey && !event.ctrlKey && !event.metaKey && event.code.match(/^Digit([1-9])$/)?.[1];
    if (digit && this.views[digit - 1]) {
      event.preventDefault();
      this.show(this.views[digit - 1], { focus: true });
    }
    if (event.key !== "F6") return;
    event.preventDefault();
    const areas = [...this.root.querySelectorAll(".area")];
    const here = areas.findIndex((area) => area.contains(document.activeElement));
    const next = areas[(here + (event.shiftKey ? areas.length - 1 : 1) + areas.length) % areas.length];
    (next.querySelector("nav a[aria-current]") ?? next).focus();
    event.stopPropagation();
  }

  dialog() {
    const dialog = document.getElementById("panes");
    const places = document.getElementById("pane-places");
    document.getElementById("arrange").onclick = () => {
      places.replaceChildren(...this.views.map((view, i) => {
        const choice = make("select", {}, ...[...AREAS, HIDDEN].map((area) => new Option(text(`area_${area}`), area)));
        choice.value = this.places[view];
        choice.onchange = () => this.move(view, choice.value);
        return make("label", {}, make("span", {}, `${text(view)} `, make("kbd", {}, `Alt+${i + 1}`)), choice);
      }));
      dialog.showModal();
    };
    document.getElementById("panes-reset").onclick = () => {
      [this.places, this.shares, this.chosen] = [{ ...USUAL }, { ...SHARES }, {}];
      this.build();
      this.onLayout();
      dialog.close();
    };
  }
}
