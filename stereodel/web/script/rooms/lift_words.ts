/** What the Lift room says: sentences whose numbers change. */

import { angle } from "../space.ts";
import { counted, fixed } from "../words.ts";
import { separationBounds, type Bounds, type LiftSites, type Sheet } from "./lift_sites.ts";

/** How far apart two sites are, and the bounds of it on the hemisphere. */
export interface Separation extends Bounds {
  /** In the plane, in its unit and in diagonals. */
  readonly distance: number;
  readonly diagonal: number;
  readonly fraction: number;
  /** On the ball, degrees; null in the plane. */
  readonly angle: number | null;
}

export function separation(sites: LiftSites, sheet: Sheet, p: number, q: number): Separation {
  const [a, b] = [sites.place(p), sites.place(q)];
  const distance = Math.hypot(a[0] - b[0], a[1] - b[1]);
  const fraction = Math.min(1, distance / sheet.diagonal);
  const between = sheet.isFlat ? null : angle(sheet.direction(...a), sheet.direction(...b));
  return { distance, diagonal: sheet.diagonal, fraction, angle: between, ...separationBounds(fraction) };
}

/** The distances of a pair in the sheet and on the ball. */
export function ofPair({ distance, diagonal, fraction, angle }: Separation, corner: number): string {
  const inSheet = `In the sheet _${measured(distance, diagonal)}_, which is _${fixed(fraction, 3)}_ of the diagonal.`;
  if (angle === null) return `${inSheet} Bend it for an angle.`;
  const on = `_${fixed(angle, 1)}°_`;
  return corner === 90
    ? `${inSheet} On the hemisphere ${on}, never outside this span:`
    : `${inSheet} On the ball ${on}. The bounds are those of the hemisphere.`;
}

/** The paper's bounds, and the best ones. */
export function ofBounds({ low, high, promised }: Separation): string {
  return (
    `The paper promises _${fixed(promised[0], 1)}°_ to _${fixed(Math.min(180, promised[1]), 1)}°_, with the constants ½ and 4/π. ` +
    `The best bounds are 2\u202farcsin and 4\u202farctan of the fraction: _${fixed(low, 1)}°_ to _${fixed(high, 1)}°_.`
  );
}

/** Digits behind the point beyond which a sheet is too small to be written without a power of ten. */
const MOST_DECIMALS = 12;

/** A length or a coordinate in the plane's unit: four digits of the sheet's diagonal, whole numbers in groups of three. */
export function measured(value: number, diagonal: number): string {
  const size = diagonal || Math.abs(value) || 1;
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(size)));
  if (decimals > MOST_DECIMALS || Math.abs(value) >= 1e15) return value.toPrecision(4).replace(/-/g, "\u2212");
  const [whole, rest] = fixed(Math.abs(value), decimals).split(".");
  const text = rest === undefined ? counted(Number(whole)) : `${counted(Number(whole))}.${rest}`;
  return value < 0 && /[1-9]/.test(text) ? `\u2212${text}` : text;
}

/** What there is to say of sites without triangles; null where there are triangles. */
export function withoutTriangles(sites: LiftSites): string | null {
  if (sites.delaunay.dimension === 2) return null;
  if (sites.count === 0) return "No sites yet. Open a file.";
  if (sites.delaunay.dimension === 0) return "All sites lie at one place: there are no triangles.";
  return "All sites lie on one line: there are no triangles.";
}

/** How far the sheet is bent. */
export function ofBend(sheet: Sheet): string {
  if (sheet.isFlat) return "flat: an infinite radius";
  return `radius ${fixed(sheet.radius, 3)} of the diagonal, scale 1 to ${fixed(sheet.leastScale, 2)}`;
}
