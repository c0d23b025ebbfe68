/** Pictures of a page with an owner: its title above them, its legend and the source below. Of the second script. */

import type { Sheet } from "../drawing/pen.ts";
import { SERIF, type LabelStyle } from "../drawing/styles.ts";

const TITLE: LabelStyle = { ink: "ink", halo: "paper", size: 24, align: "center" };
const SOURCE: LabelStyle = { ...TITLE, ink: "ink-2", size: 13 };

/** A picture with what its owner says round it. @param ink Of the legend. */
export async function framed(sheet: Sheet, ink: string): Promise<Sheet> {
  const { width, paint, owner } = sheet;
  if (!owner) return sheet;
  const lines = brokenLines(owner.title, (1.9 * width) / TITLE.size);
  const top = lines.length * 30 + (lines.length > 0 ? 6 : 0);
  const legend = new Image();
  if (owner.legend) {
    const svg = owner.legend.replace("<svg ", `<svg color="${ink}" font-family='${SERIF}' `);
    legend.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
    await legend.decode();
  }
  const below = top + sheet.height + 8;
  const notes = brokenLines(owner.source, (2.1 * width) / SOURCE.size);
  const foot = below + legend.height;
  return {
    ...sheet,
    title: owner.title ? `${owner.title}. ${sheet.title}` : sheet.title,
    height: foot + (notes.length > 0 ? notes.length * 17 + 10 : 0),
    paint(pen) {
      lines.forEach((line, k) => pen.label(line, width / 2, 26 + 30 * k, TITLE));
      pen.within({ corner: [0, top] }, () => paint(pen));
      if (owner.legend) pen.picture(legend, (width - legend.width) / 2, below, legend.width, legend.height);
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
