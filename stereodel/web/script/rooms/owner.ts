/** What the owner of a page says of its places: title, source, values, colours, sizes, legend. As `looks.py` wrote it. */

import { cornersOf, traceCorners, traceSegment, type Pen, type Point, type Sheet } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { counted, fixed, latitude, longitude } from "../words.ts";
import type { GlobeScene } from "./globe_scene.ts";

/** A number or a place on a scale, and its text. */
type Tick = readonly [number, string];

/** A bar of colours with numbers, circles with theirs, or a dot. */
interface Entry {
  readonly title: string;
  readonly ink?: string | null;
  readonly bar?: readonly string[];
  readonly ticks?: readonly Tick[];
  readonly missing?: readonly [string, string] | "";
  readonly circles?: readonly Tick[];
}

export interface Owner {
  readonly title: string;
  readonly source: string;
  readonly legend?: readonly Entry[];
  /** Colours, of each place the number of its own, and the radii of its dot in pixels. */
  readonly inks?: readonly string[];
  readonly ink?: readonly number[];
  readonly radii?: readonly number[];
  /** Values of the places, null where one is missing; the title ends with their unit after a comma. */
  readonly columns?: readonly { readonly title: string; readonly values: readonly (number | string | null)[] }[];
}

/** A value as the page writes it. */
export function valueWords(value: number | string | null): string {
  if (typeof value !== "number") return value ?? "no value";
  const text = Number.isInteger(value) ? counted(Math.abs(value)) : String(Math.abs(value));
  return value < 0 ? `\u2212${text}` : text;
}

/** Square kilometres: whole ones, or three digits of what is smaller. */
export function area(size: number): string {
  return size >= 100 ? counted(Math.round(size)) : size.toPrecision(3);
}

/** All that there is to say of a place, as `say` takes it. */
export function placeSentence(scene: GlobeScene, place: number): string {
  const { lonlat, names, owner } = scene.places!;
  // The letters that are marks for `say` look as others do.
  const plain = (text: string): string => text.replaceAll("*", "\u2217").replaceAll("_", "\u02cd");
  const name = (site: number): string => plain(names?.[site] || `Place ${site + 1}`);
  const at = `_${latitude(lonlat[2 * place + 1], 2)} ${longitude(lonlat[2 * place], 2)}_`;
  const values = (owner?.columns ?? []).map(({ title, values }) => {
    const [, what, unit] = /^(.*?)(?:, ([^,]*))?$/s.exec(title) ?? [];
    return `${plain(what)} _${plain(valueWords(values[place]))}_${unit ? ` ${plain(unit)}` : ""}`;
  });
  const { neighbours, nearest, kilometres } = scene.around(place);
  const away = fixed(kilometres, kilometres < 100 ? 1 : 0);
  const cell = `its cell has _${area(scene.area(place))}_ km² and _${neighbours}_ ${neighbours === 1 ? "neighbour" : "neighbours"}`;
  const next = nearest === null ? "" : `, the nearest is ${name(nearest)}, _${away}_ km away`;
  return `${name(place)}, ${at}${values.map((each) => `, ${each}`).join("")}; ${cell}${next}.`;
}

const LABEL: LabelStyle = { ink: "ink", halo: "paper", size: 14 };
const TITLE: LabelStyle = { ...LABEL, size: 24, align: "center" };
const SOURCE: LabelStyle = { ...LABEL, ink: "ink-2", size: 13, align: "center" };

/** Widths of a column of a legend and of its bar; heights of a row and of a bar, pixels. */
const COLUMN = 286;
const BAR = 270;
const ROW = 20;
const HIGH = 11;

/** A part of a legend: its height, and what draws it from its left upper corner. */
interface Block {
  readonly height: number;
  draw(pen: Pen, x: number, y: number): void;
}

/** A legend in as many columns as have room: its height, and what draws it. */
export function legendBlock(entries: readonly Entry[], width: number): Block {
  const blocks = entries.map((entry) =>
    entry.bar ? barBlock(entry) : entry.circles ? circlesBlock(entry) : dotBlock(entry),
  );
  const columns = Math.max(1, Math.min(blocks.length, Math.floor(width / COLUMN)));
  const places: { block: Block; x: number; y: number }[] = [];
  const heights = new Array<number>(columns).fill(0);
  for (const block of blocks) {
    const column = heights.indexOf(Math.min(...heights));
    places.push({
      block,
      x: Math.max(0, (width - columns * COLUMN + COLUMN - BAR) / 2) + column * COLUMN,
      y: heights[column],
    });
    heights[column] += block.height;
  }
  return {
    height: Math.max(...heights),
    draw: (pen, x, y) => places.forEach((place) => place.block.draw(pen, x + place.x, y + place.y)),
  };
}

function barBlock({ title, bar = [], ticks = [], missing }: Entry): Block {
  return {
    height: (missing ? 4.2 : 3.2) * ROW,
    draw(pen, x, y) {
      pen.label(title, x, y + 0.7 * ROW, LABEL);
      const [top, foot] = [y + ROW, y + ROW + HIGH];
      const box = (from: number, to: number, low: number, ink: string): void =>
        pen.draw("swatch", (path) => traceCorners(path, cornersOf(from, low, to, low + HIGH)), ink);
      // Each to the end, so that no seam is seen between two.
      bar.forEach((ink, k) => box(x + (BAR * k) / bar.length, x + BAR, top, ink));
      for (const [at, text] of ticks) {
        const mark = x + BAR * at;
        pen.draw("tick", (path) => traceSegment(path, [mark, foot], [mark, foot + 4]));
        const align = at < 0.04 ? "left" : at > 0.96 ? "right" : "center";
        pen.label(text, mark, foot + 18, { ...LABEL, align });
      }
      if (!missing) return;
      box(x, x + 2 * HIGH, foot + 27, missing[1]);
      pen.label(missing[0], x + 2 * HIGH + 8, foot + 37, LABEL);
    },
  };
}

/** Circles that touch at their feet, with lines from their tops to their numbers. */
function circlesBlock({ title, circles = [], ink }: Entry): Block {
  const largest = Math.max(...circles.map(([radius]) => radius));
  const low = 1.3 * ROW + 2 * largest;
  return {
    height: low + ROW,
    draw(pen, x, y) {
      pen.label(title, x, y + 0.7 * ROW, LABEL);
      const foot = y + low;
      let free = -Infinity;
      for (const [radius, text] of circles) {
        pen.spots([x + largest, foot - radius, radius], [ink ?? "transparent"]);
        const head = foot - 2 * radius;
        free = Math.max(head, free + 15);
        const ends: Point[] = [
          [x + largest, head],
          [x + 2 * largest, head],
          [x + 2 * largest + 12, free],
        ];
        pen.draw("tick", (path) => {
          traceSegment(path, ends[0], ends[1]);
          path.lineTo(...ends[2]);
        });
        pen.label(text, ends[2][0] + 4, free + 4.5, LABEL);
      }
    },
  };
}

function dotBlock({ title, ink }: Entry): Block {
  return {
    height: ROW,
    draw(pen, x, y) {
      pen.spots([x + 6, y + 10, 5], [ink ?? "transparent"]);
      pen.label(title, x + 20, y + 14.5, LABEL);
    },
  };
}

/** What a legend says, for those who do not see it. */
export function legendWords(entries: readonly Entry[]): string {
  return entries
    .map(({ title, ticks, circles }) => [title, ...(ticks ?? circles ?? []).map(([, text]) => text)].join(" "))
    .join("; ");
}

/** A picture with the owner's title above it, and the legend and the source below. */
export function framed(sheet: Sheet, owner: Owner | null | undefined): Sheet {
  if (!owner) return sheet;
  const { width, paint } = sheet;
  const lines = brokenLines(owner.title, (1.9 * width) / TITLE.size);
  const top = lines.length * 30 + (lines.length > 0 ? 6 : 0);
  const legend = owner.legend?.length ? legendBlock(owner.legend, width) : null;
  const below = top + sheet.height + 8;
  const notes = brokenLines(owner.source, (2.1 * width) / SOURCE.size);
  const foot = below + (legend?.height ?? 0);
  return {
    ...sheet,
    title: owner.title ? `${owner.title}. ${sheet.title}` : sheet.title,
    height: foot + (notes.length > 0 ? notes.length * 17 + 10 : 0),
    paint(pen) {
      lines.forEach((line, k) => pen.label(line, width / 2, 26 + 30 * k, TITLE));
      pen.lowered(top, () => paint(pen));
      legend?.draw(pen, 0, below);
      notes.forEach((line, k) => pen.label(line, width / 2, foot + 14 + 17 * k, SOURCE));
    },
  };
}

/** A text in lines of at most so many letters. */
function brokenLines(text: string, letters: number): string[] {
  const lines: string[] = [];
  for (const word of text.split(/\s+/).filter(Boolean)) {
    const last = lines[lines.length - 1];
    if (last !== undefined && last.length + word.length < letters) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines;
}
