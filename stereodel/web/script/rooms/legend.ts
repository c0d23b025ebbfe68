/** The legend of a page's owner, beside the drawing and in pictures, which have title and source, too. Of the second script. */

import { cornersOf, traceCorners, traceSegment, type Pen, type Point, type Sheet } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import type { Entry } from "./owner.ts";

const LABEL: LabelStyle = { ink: "ink", halo: "paper", size: 14 };
const TITLE: LabelStyle = { ...LABEL, size: 24, align: "center" };
const SOURCE: LabelStyle = { ...LABEL, ink: "ink-2", size: 13, align: "center" };

/** Widths of a column of a legend and of its bar; heights of a row and of a bar, pixels. */
const COLUMN = 286;
const BAR = 270;
const ROW = 20;
const HIGH = 11;

/** A part of a legend: its height, and what draws it from its left upper corner. */
export interface Block {
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
export function framed(sheet: Sheet): Sheet {
  const { width, paint, owner } = sheet;
  if (!owner) return sheet;
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
      pen.within({ lower: top }, () => paint(pen));
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
