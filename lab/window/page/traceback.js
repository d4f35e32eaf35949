// Places in a terminal's output that lead to a line: of a traceback, of a build, of a log.

const PLACES = [
  /File "(?<path>[^"\n]{1,300})", line (?<line>\d{1,6})/g,
  /(?<path>(?:~|\/home\/[\w-]+|\.)?[\w./-]*[\w-]+\.(?:py|xml|cfg|msg|srv|action|yaml)):(?<line>\d{1,6})/g,
];

/** What makes links of xterm's lines; `desk` knows the files and opens them. */
export function links(terminal, desk) {
  return { provideLinks: (row, answer) => answer(found(terminal, desk, row)) };
}

function found(terminal, desk, row) {
  const buffer = terminal.buffer.active;
  let first = row - 1;
  while (first > 0 && buffer.getLine(first)?.isWrapped) first -= 1;
  const rows = [];
  for (let at = first; at === first || buffer.getLine(at)?.isWrapped; at += 1) rows.push(buffer.getLine(at)?.translateToString(false) ?? "");
  const line = rows.join("");
  const place = (index) => ({ x: (index % terminal.cols) + 1, y: first + Math.floor(index / terminal.cols) + 1 });
  return PLACES.flatMap((pattern) => [...line.matchAll(pattern)]).flatMap((match) => {
    const path = desk.locate(match.groups.path);
    if (!path) return [];
    return [{
      text: match[0],
      range: { start: place(match.index), end: place(match.index + match[0].length - 1) },
      activate: () => desk.open(path, Number(match.groups.line)),
    }];
  });
}
