/** The looks of the drawings: colours by token, from the style sheet of the page, and lines, grounds, dots and labels by name. */

import { make } from "../dom.ts";

/** How a path is drawn. */
export interface Style {
  readonly stroke?: Token;
  /** Of the line, pixels. */
  readonly width?: number;
  readonly strokeOpacity?: number;
  readonly dash?: readonly number[];
  readonly fill?: Token;
  readonly fillOpacity?: number;
  /** A region is filled with lines, 45° steep; with crossed ones facets that only close the hull. */
  readonly hatch?: "plain" | "crossed";
  /** Lines of a triangulation: many of them are weaker, as `density.ts` has it. */
  readonly isNet?: boolean;
}

export const STYLES = {
  paper: { fill: "paper" },
  graticule: { stroke: "graticule", width: 0.5 },
  coast: { stroke: "coast", width: 0.7 },
  land: { fill: "land" },
  ocean: { fill: "ocean" },
  frame: { stroke: "limb", width: 0.7 },
  limb: { stroke: "limb", width: 1.3 },
  "limb-soft": { stroke: "limb", width: 0.7 },
  "limb-small": { stroke: "limb", width: 1 },
  delaunay: { stroke: "delaunay", width: 1.1, isNet: true },
  voronoi: { stroke: "voronoi", width: 0.9, isNet: true },
  cell: { stroke: "ink", width: 1.1, isNet: true },
  hull: { stroke: "hull", width: 1.3 },
  hatch: { stroke: "hatch", width: 0.8, hatch: "plain" },
  closing: { stroke: "hatch", width: 0.8, hatch: "crossed" },
  bubble: { stroke: "accent", width: 1.8, fill: "accent-wash" },
  "bubble-open": { stroke: "accent", width: 1.8 },
  triangle: { stroke: "accent", width: 1.2 },
  seen: { fill: "accent-wash" },
  horizon: { stroke: "accent", width: 1.8 },
  fan: { stroke: "accent", width: 1, dash: [4, 3] },
  ray: { stroke: "accent", width: 0.8, dash: [5, 4] },
  span: { stroke: "accent", width: 1.8 },
  sheet: { fill: "sheet" },
  "sheet-plane": { fill: "sheet", fillOpacity: 0.35, stroke: "limb", width: 0.7 },
  side: { stroke: "voronoi", width: 1.3 },
  touch: { stroke: "ink", width: 1 },
  tissot: { fill: "tissot", stroke: "coast", width: 0.6 },
  tint: { fill: "paper", stroke: "paper", width: 0.6 },
  line: { stroke: "ink", width: 1.2 },
  "isoline-halo": { stroke: "halo", width: 2.4 },
  isoline: { stroke: "ink", width: 0.8 },
  "spot-line": { stroke: "limb", width: 0.6 },
  patch: { fill: "accent-wash", stroke: "accent", width: 1 },
  handle: { stroke: "accent", width: 1.8, fill: "paper" },
  "handle-behind": { stroke: "accent", width: 1.2 },
  "handle-cross": { stroke: "accent", width: 1 },
} as const satisfies Record<string, Style>;

export type StyleName = keyof typeof STYLES;

/** A dot: its radius, its ink and its rim. */
export interface DotStyle {
  readonly radius: number;
  readonly fill: Token;
  readonly rim: Token;
  readonly rimWidth: number;
  readonly opacity?: number;
}

export const DOTS = {
  site: { radius: 2.2, fill: "ink", rim: "paper", rimWidth: 0.6 },
  held: { radius: 3.2, fill: "accent", rim: "paper", rimWidth: 1 },
  shadow: { radius: 2.2, fill: "paper", rim: "accent", rimWidth: 1.2 },
  pole: { radius: 2, fill: "ink", rim: "paper", rimWidth: 0.6 },
} as const satisfies Record<string, DotStyle>;

export type DotName = keyof typeof DOTS;

/** How a label is set: `*P*` in its text is in italics. */
export interface LabelStyle {
  readonly ink: Token | `rgb(${string})`;
  /** The ground that the letters are kept free with. */
  readonly halo: Token | `rgb(${string})`;
  /** Of the type, pixels. */
  readonly size: number;
  readonly italic?: boolean;
  readonly align?: "left" | "center" | "right";
}

/** Width of the halo round letters, pixels. */
export const HALO_WIDTH = 4;

/** Distance of hatching lines along an edge of the picture, pixels. */
export const HATCH_STEP = 6 * Math.SQRT2;

/** What lies behind. */
export const FAINT = { opacity: 0.38 };

/** The type of the page, as in its style sheet. */
export const SERIF =
  '"STIX Two Text", STIXGeneral, STIX, XITS, "Times New Roman", "Nimbus Roman", "TeX Gyre Termes", "Liberation Serif", Times, serif';

/** The font of a label. */
export function fontOf({ size }: LabelStyle, italic: boolean): string {
  return `${italic ? "italic " : ""}${size}px ${SERIF}`;
}

const INKS = ["paper", "ink", "ink-2", "accent", "accent-text", "accent-wash", "hatch", "halo"] as const;
const OF_BALLS = ["ball", "ball-rim", "delaunay", "voronoi", "limb", "hull", "sheet"] as const;
const OF_MAPS = ["graticule", "ocean", "land", "coast", "tissot"] as const;
const TOKENS = [...INKS, ...OF_BALLS, ...OF_MAPS];

export type Token = (typeof TOKENS)[number];

/** Colours as CSS writes them, by token. */
export type Colours = Readonly<Record<Token, string>>;

/** What the colours depend on, besides the reader's choice on the page. */
const QUERIES = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "print"];

const known = new WeakMap<Element, { key: string; colours: Colours }>();

/** The colours that hold now in a part of the document. */
export function colours(within: HTMLElement = document.documentElement): Colours {
  const choice = [within, document.documentElement].map((element) => getComputedStyle(element).colorScheme);
  const key = [...QUERIES.map((query) => matchMedia(query).matches), ...choice].join();
  const read = known.get(within);
  if (read?.key === key) return read.colours;
  // Custom properties come as they were written; the colour of an element that uses one comes resolved.
  const probe = within.appendChild(make("span", { hidden: true }));
  const { style } = probe;
  style.setProperty("forced-color-adjust", "none"); // drawings keep their inks
  const seen = getComputedStyle(probe);
  const entries = TOKENS.map((token): [Token, string] => {
    style.color = `var(--${token})`;
    return [token, seen.color];
  });
  probe.remove();
  const colours = Object.fromEntries(entries) as Record<Token, string>;
  known.set(within, { key, colours });
  return colours;
}

/** Calls back when the system's colours change, until the function that is returned is called. */
export function onColours(changed: () => void): () => void {
  const end = new AbortController();
  for (const query of QUERIES) matchMedia(query).addEventListener("change", changed, { signal: end.signal });
  return () => end.abort();
}
