/** The colours of the page, from its style sheet: one table for text and drawings, light and dark. */

export const TOKENS = [
  "paper",
  "ink",
  "ink-2",
  "ink-3",
  "accent",
  "accent-text",
  "accent-wash",
  "ball",
  "ball-rim",
  "delaunay",
  "voronoi",
  "limb",
  "graticule",
  "hatch",
  "hull",
  "sheet",
  "ocean",
  "land",
  "halo",
  "coast",
  "tissot",
] as const;

export type Token = (typeof TOKENS)[number];

/** Colours as CSS writes them, by token. */
export type Colours = Readonly<Record<Token, string>>;

/** What the colours depend on, besides the reader's choice on the page. */
const QUERIES = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "print"];

const known = new WeakMap<Element, { key: string; probe: HTMLElement; colours: Colours }>();

/** The colours that hold now in a part of the document. */
export function colours(within: HTMLElement = document.documentElement): Colours {
  const choice = [within, document.documentElement].map((element) => getComputedStyle(element).colorScheme);
  const key = [...QUERIES.map((query) => matchMedia(query).matches), ...choice].join();
  const read = known.get(within);
  if (read?.key === key) return read.colours;
  const probe = read?.probe ?? hiddenIn(within);
  const found = readColours(probe);
  known.set(within, { key, probe, colours: found });
  return found;
}

function hiddenIn(within: HTMLElement): HTMLElement {
  const probe = document.createElement("span");
  probe.hidden = true;
  probe.style.setProperty("forced-color-adjust", "none"); // drawings keep their inks
  within.append(probe);
  return probe;
}

/** Calls back when the system's colours change, until the function that is returned is called. */
export function onColours(changed: () => void): () => void {
  const lists = QUERIES.map((query) => matchMedia(query));
  for (const list of lists) list.addEventListener("change", changed);
  return () => {
    for (const list of lists) list.removeEventListener("change", changed);
  };
}

/** Custom properties come as they were written; the colour of an element that uses one comes resolved. */
function readColours(probe: HTMLElement): Colours {
  const style = getComputedStyle(probe);
  const entries = TOKENS.map((token): [Token, string] => {
    probe.style.color = `var(--${token})`;
    return [token, style.color];
  });
  return Object.fromEntries(entries) as Record<Token, string>;
}
