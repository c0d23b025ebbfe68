/** The one interface through which rooms draw: the same trace becomes pixels or SVG. Pixels of the screen, y down. */

import type { Owner } from "../rooms/owner.ts";
import { Ink, SQUARE } from "./density.ts";
import { DOTS, HATCH_STEP, STYLES } from "./styles.ts";
import type { Colours, DotName, DotStyle, LabelStyle, Style, StyleName, Token } from "./styles.ts";

/** What a trace is laid into: a part of the canvas's own interface. */
export type Path = Pick<CanvasPath, "moveTo" | "lineTo" | "ellipse" | "closePath">;

export type Trace = (path: Path) => void;

/** A place of the drawing, or of a plane. */
export type Point = readonly [number, number];

/** A disc of the drawing: a ball seen from afar. */
export interface Disc {
  readonly x: number;
  readonly y: number;
  readonly r: number;
}

/** A picture that is laid into the drawing; an image is one of SVG with its text in its address. */
export type Picture = HTMLCanvasElement | OffscreenCanvas | HTMLImageElement;

/** Where the light falls on a ball of radius 1, as on those of the library (`stereodel/render/vector/paper.py`): the
 * focus of the gradient, middle and radius of its last circle, y down; and how much of its fall lies before some places. */
export const LIGHT = { fx: -0.5065, fy: -0.6512, cx: -0.0756, cy: -0.0972, r: 1.1231 };
const FALL = [0.249, 0, 0.462, 0.015, 0.64, 0.056, 0.716, 0.096, 0.782, 0.153, 0.84, 0.229];
FALL.push(0.889, 0.325, 0.929, 0.445, 0.96, 0.585, 0.982, 0.735, 1, 1);

/** Colours from the light outward, at places from 0 to 1 between which they are even. */
export interface Gradient {
  readonly id: string;
  readonly stops: readonly (readonly [number, string])[];
}

/** Light that falls off from a colour to another one. */
function falling(id: string, ...ends: [string, string]): Gradient {
  const [from, to] = ends.map((colour) => [...(colour.match(/[\d.]+/g) ?? []).map(Number), 1]);
  const mixed = (share: number): string => [0, 1, 2, 3].map((k) => from[k] + share * (to[k] - from[k])).join(" ");
  const stops = FALL.flatMap((at, k): [number, string][] => (k % 2 === 0 ? [[at, mixed(FALL[k + 1])]] : []));
  return { id, stops: stops.map(([at, inks]) => [at, `rgb(${inks.replace(/ (\S+)$/, " / $1")})`]) };
}

/** Parts of the ground that lines of one net, and dots, may cover. */
const [MOST_LINES, MOST_DOTS] = [0.16, 0.07];

/** The finest lines and the smallest dots, as parts of the usual. */
const [FINEST, SMALLEST] = [0.55, 0.4];

/** Arcs of ellipses in one path: browsers need quadratic time for paths of thousands. */
export const MOST_ARCS = 256;

/** How something is drawn: faintly, inside a region alone, or with its corner elsewhere. */
export interface Bounds {
  readonly opacity?: number | undefined;
  readonly region?: Trace;
  readonly corner?: Point;
}

export abstract class Pen {
  /** Of the drawing, pixels of the screen. */
  readonly width: number;
  readonly height: number;
  protected readonly colours: Colours;
  /** How densely nets and dots lie, by their styles; what is drawn of a part of a picture takes what is known of the whole. */
  readonly inks = new Map<string, Ink>();
  known: ReadonlyMap<string, Ink> | null = null;

  constructor(width: number, height: number, colours: Colours) {
    [this.width, this.height, this.colours] = [width, height, colours];
  }

  /** Draws a path in a style, or in an ink of the data; regions are those about which the path winds. */
  draw(name: StyleName, trace: Trace, ink?: string, style: Style = STYLES[name]): void {
    if (style.hatch === undefined) return this.path(name, trace, ink, style);
    const { width, height } = this;
    const lines = (path: Path): void => {
      for (let x = HATCH_STEP / 2; x < width + height; x += HATCH_STEP) {
        traceSegment(path, [x, 0], [x - height, height]);
        if (style.hatch === "crossed") traceSegment(path, [x - height, 0], [x, height]);
      }
    };
    this.within({ region: trace }, () => this.path(name, lines, ink, style));
  }
  protected abstract path(name: StyleName, trace: Trace, ink: string | undefined, style: Style): void;
  /** Draws lines by their ends, x and y in turn, those of nets weaker where they are dense. @param lay Lays what is not straight. */
  lines(name: StyleName, ends: ArrayLike<number>, lay?: (path: Path, k: number) => void, ink?: string): void {
    const style: Style = STYLES[name];
    const { width = 1 } = style;
    const end = (at: number): Point => [ends[at], ends[at + 1]];
    const length = (at: number): number => Math.hypot(ends[at + 2] - ends[at], ends[at + 3] - ends[at + 1]);
    const area = (k: number): number => width * Math.min(SQUARE, length(4 * k)); // what is longer lies apart
    const straight = (path: Path, k: number): void => traceSegment(path, end(4 * k), end(4 * k + 2));
    const middles = new Float64Array(ends.length / 2);
    for (let at = 0; at < middles.length; ++at) {
      const from = 2 * at - (at & 1);
      middles[at] = (ends[from] + ends[from + 2]) / 2;
    }
    this.#ink(name).each(middles, area, style.isNet ? MOST_LINES : Infinity, (part, numbers) => {
      const size = Math.max(FINEST, Math.sqrt(part));
      const thin: Style = { ...style, width: size * width, strokeOpacity: part / size };
      for (let from = 0; from < numbers.length; from += MOST_ARCS) {
        const those = numbers.slice(from, from + MOST_ARCS);
        this.draw(name, (path) => those.forEach((k) => (lay ?? straight)(path, k)), ink, thin);
      }
    });
  }
  /** Draws something within bounds. */
  abstract within(bounds: Bounds, body: () => void): void;
  /** Dots at x, y in turn; where they are dense, smaller and weaker. */
  dots(name: DotName, places: ArrayLike<number>): void {
    const { radius, rimWidth, ...inks }: DotStyle = DOTS[name];
    const area = (): number => Math.PI * radius * radius;
    this.#ink(name).each(places, area, MOST_DOTS, (part, numbers) => {
      const size = Math.max(SMALLEST, Math.sqrt(part));
      const style = { ...inks, radius: size * radius, rimWidth: size * rimWidth, opacity: part / size ** 2 };
      const those = new Float64Array(2 * numbers.length);
      for (let at = 0; at < those.length; ++at) those[at] = places[2 * numbers[at >> 1] + (at & 1)];
      this.discs(name, style, those);
    });
  }
  /** Dots with radii and inks of their own, x, y, r in turn, the lowest first, each with a line around it. */
  abstract spots(places: ArrayLike<number>, inks: readonly string[]): void;
  /** Text at a point of its baseline. */
  abstract label(text: string, x: number, y: number, style: LabelStyle): void;
  /** A picture, fitted into a rectangle. */
  abstract picture(picture: Picture, x: number, y: number, width: number, height: number): void;
  #ink(name: string): Ink {
    const ink = this.known?.get(name) ?? new Ink(this);
    this.inks.set(name, ink);
    return ink;
  }

  protected inkOf(colour: LabelStyle["ink"]): string {
    return this.colours[colour as Token] ?? colour;
  }

  /** First all rims: where dots lie close, none is hidden by the rim of another. */
  protected abstract discs(name: DotName, style: DotStyle, places: ArrayLike<number>): void;
  protected abstract fillDisc(disc: Disc, fill: string | Gradient): void;

  /** The ground of a ball, lit from the upper left: the pale one of geometry, or water. */
  ball(disc: Disc, ground: "ball" | "ocean"): void {
    const { ball: inner, "ball-rim": outer, ocean } = this.colours;
    this.fillDisc(disc, ground === "ocean" ? ocean : falling("ball", inner, outer));
  }

  /** The shade that makes a disc of land and water round. */
  shade(disc: Disc): void {
    this.fillDisc(disc, falling("shade", "rgb(27 39 48 / 0)", "rgb(27 39 48 / 0.175)"));
  }
}

/** A drawing as a file: a picture of a size in pixels of the screen, and what draws it. */
export interface Sheet {
  readonly title: string;
  readonly width: number;
  readonly height: number;
  readonly paint: (pen: Pen) => void;
  /** What the owner of the data says, to be written round it. */
  readonly owner?: Owner | null;
}

/** A whole circle, clockwise to the eye if it is not said otherwise. */
export function traceDisc(path: Path, { x, y, r }: Disc, counterclockwise = false): void {
  path.moveTo(x + r, y);
  path.ellipse(x, y, r, r, 0, 0, counterclockwise ? -2 * Math.PI : 2 * Math.PI, counterclockwise);
  path.closePath();
}

/** A straight line. */
export function traceSegment(path: Path, a: Point, b: Point): void {
  path.moveTo(...a);
  path.lineTo(...b);
}

/** A closed line of straight sides. */
export function traceCorners(path: Path, corners: readonly Point[]): void {
  corners.forEach(([x, y], k) => (k === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  if (corners.length > 0) path.closePath();
}

/** The corners of a rectangle, counterclockwise where y points up. */
export function cornersOf(left: number, low: number, right: number, high: number): [number, number][] {
  return [
    [left, low],
    [right, low],
    [right, high],
    [left, high],
  ];
}

/** A ring to drag: filled and crossed in front, empty behind the ball, filled on a rim. */
export function drawHandle(pen: Pen, x: number, y: number, kind: "front" | "behind" | "rim"): void {
  const [r, c] = [5, 2]; // of the ring, and half of the cross
  pen.draw(kind === "behind" ? "handle-behind" : "handle", (path) => traceDisc(path, { x, y, r }));
  if (kind !== "front") return;
  pen.draw("handle-cross", (path) => {
    traceSegment(path, [x - c, y], [x + c, y]);
    traceSegment(path, [x, y - c], [x, y + c]);
  });
}

/** Lines of text with italics between stars. */
export function textParts(text: string, italic: boolean): { text: string; italic: boolean }[] {
  return text
    .split(/\*([^*]+)\*/)
    .map((part, k) => ({ text: part, italic: k % 2 === 1 ? !italic : italic }))
    .filter((part) => part.text !== "");
}
