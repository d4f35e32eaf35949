// The graph where it must not be wide: nodes on the left, what connects them on the right.
// Every line leads from a node to something that is none, so two columns are enough.

const MARGIN = 10; // px, around the drawing
const GAP = 12; // px, between two boxes of a column
const WIDEST = 280; // px, of a box
const HEAD = 18; // px, of the line with the box's kind
const LINE = 16; // px, of a line of the name
const PORT = 9; // px, between two lines at a box
const BETWEEN = 0.16; // of the width, for the lines between the columns
const ROUNDS = 3;

/**
 * Boxes with their places (`x` and `y` of the middle, `width`, `height`, `lines` of the name), and for
 * each edge its `path` and the middle of it. `letter` is the width of a letter in px.
 */
export function columns(boxes, edges, total, letter) {
  const between = Math.max(44, total * BETWEEN);
  const width = Math.min(WIDEST, (total - 2 * MARGIN - between) / 2);
  const places = new Map();
  for (const [id, box] of boxes) {
    const lines = wrap(box.name, Math.floor((width - 12) / letter));
    places.set(id, { id, width, lines, height: HEAD + LINE * lines.length + 8, left: box.kind === "node", to: [] });
  }
  edges.forEach((edge, i) => {
    places.get(edge.from).to.push([places.get(edge.to), i]);
    places.get(edge.to).to.push([places.get(edge.from), i]);
  });
  for (const place of places.values()) place.height = Math.max(place.height, PORT * (place.to.length + 1));
  const sides = [true, false].map((left) => [...places.values()].filter((place) => place.left === left));
  for (let round = 0; round < ROUNDS; round += 1) for (const side of [sides[1], sides[0]]) order(side, sides);
  order(sides[1], sides);
  const xs = [MARGIN + width / 2, total - MARGIN - width / 2];
  sides.forEach((side, i) => { for (const place of side) place.x = xs[i]; });
  stack(sides[1], () => 0);
  stack(sides[0], (place) => mean(place.to.map(([other]) => other.y)) - place.height / 2);
  const bottom = Math.max(...[...places.values()].map((place) => place.y + place.height / 2));
  return { places, lines: edges.map((edge, i) => curve(places.get(edge.from), places.get(edge.to), i)), width: total, height: bottom + MARGIN };
}

/** Parts of a name of at most `most` letters, broken after a slash or an underscore if possible. */
function wrap(name, most) {
  const lines = [""];
  for (const part of name.match(/[^/_]*[/_]?/g).filter(Boolean).flatMap((part) => pieces(part, most))) {
    if (lines.at(-1).length + part.length > most && lines.at(-1)) lines.push("");
    lines[lines.length - 1] += part;
  }
  return lines;
}

function pieces(part, most) {
  return part.match(new RegExp(`.{1,${Math.max(most, 4)}}`, "gu"));
}

/** Sort a column by the places of what its boxes are connected with. */
function order(side, sides) {
  sides.forEach((each) => each.forEach((place, i) => { place.rank = i / each.length; }));
  const wanted = new Map(side.map((place) => [place, place.to.length ? mean(place.to.map(([other]) => other.rank)) : place.rank]));
  side.sort((a, b) => wanted.get(a) - wanted.get(b));
}

function stack(side, wanted) {
  let top = MARGIN;
  for (const place of side) {
    place.y = Math.max(top, wanted(place) || 0) + place.height / 2;
    top = place.y + place.height / 2 + GAP;
  }
}

function mean(values) {
  return values.reduce((sum, value) => sum + value, 0) / (values.length || 1);
}

function curve(from, to, edge) {
  const [start, end] = [port(from, edge), port(to, edge)];
  const middle = { x: (start.x + end.x) / 2, y: (start.y + end.y) / 2 };
  return { path: `M${start.x} ${start.y}C${middle.x} ${start.y} ${middle.x} ${end.y} ${end.x} ${end.y}`, ...middle };
}

/** Where an edge touches a box: they are spread over its inner side. */
function port(place, edge) {
  const sorted = place.to.slice().sort(([a, i], [b, j]) => a.y - b.y || i - j);
  const share = (sorted.findIndex(([, i]) => i === edge) + 1) / (sorted.length + 1);
  return { x: place.x + (place.left ? 1 : -1) * (place.width / 2), y: place.y - place.height / 2 + place.height * share };
}
