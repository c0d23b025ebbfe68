/** Sites of the Lift room: the sheet that bends onto a ball (P10, P13), what the kernel and the room say of them, the sets. */

import { ridgeSegments } from "../drawing/ball.ts";
import { PlanarDelaunay, SphericalDelaunay } from "../kernel/api.ts";
import { once } from "../kernel/lazy.ts";
import type { SiteSet } from "../sets.ts";
import { angle, DEGREES, type Vector } from "../space.ts";
import { counted, fixed } from "../words.ts";
import { bubbleSigns, chained } from "./sphere_sites.ts";

type Place = [number, number];

export class LiftSites {
  /** x and y in turn, in any unit. */
  readonly places: Float64Array;
  readonly rectangle: ReturnType<typeof rectangleAround>;
  readonly delaunay: PlanarDelaunay;
  /**
   * The facets of the lifted sites that see the pole, (m, 3): those whose circle in the plane has no site outside, of the
   * hull of the rays (2u, 2v, 1 − u² − v²) through them. They are the same however far the sheet is bent. The unit is a
   * power of two, so that a grid of small whole numbers is lifted without rounding and its squares stay squares.
   */
  readonly closing: Int32Array;

  /** @param sides Width and height of the sheet, where it is not the smallest rectangle round the sites. */
  constructor(places: Float64Array, sides?: readonly [number, number]) {
    this.places = places;
    this.rectangle = rectangleAround(places, sides);
    this.delaunay = new PlanarDelaunay(places);
    this.closing = this.#facetsThatSee();
  }

  get count(): number {
    return this.places.length / 2;
  }

  place(site: number): Place {
    return [this.places[2 * site], this.places[2 * site + 1]];
  }

  /** Sites of the convex hull, counterclockwise. */
  get hull(): number[] {
    return chained(this.delaunay.convexHull)[0];
  }

  /** Sides of the cells of the plane as x, y, x, y in turn. */
  readonly ridges = once(() =>
    ridgeSegments(this.delaunay, 2 * Math.hypot(this.rectangle.width, this.rectangle.height)),
  );

  /**
   * The sheet, bent so that its corners stand at `corner` degrees from the point of contact: 0 is the plane, 90 the
   * hemisphere. Lengths are in diagonals of the rectangle; the point of contact is on top, at the origin.
   */
  sheet(corner: number) {
    const { middle, width, height } = this.rectangle;
    const isFlat = corner === 0;
    /** In units of the plane; 1 where all places are one. */
    const diagonal = Math.hypot(width, height) || 1;
    /** Of the ball, in diagonals. */
    const radius = isFlat ? Infinity : 1 / (4 * Math.tan((corner * Math.PI) / 360));
    const pole: Vector = [0, 0, -2 * radius];
    /** A place of the plane in the sheet before it is bent, in diagonals. */
    const flat = (x: number, y: number): Vector => [(x - middle[0]) / diagonal, (y - middle[1]) / diagonal, 0];
    /** The direction from the ball's centre to the image of a place; straight up in the plane. */
    const direction = (x: number, y: number): Vector => {
      const [u, v] = flat(x, y);
      const [s, t] = [u / (2 * radius), v / (2 * radius)];
      const square = s * s + t * t;
      return [(2 * s) / (1 + square), (2 * t) / (1 + square), (1 - square) / (1 + square)];
    };
    /** Where the image of a place is in space, in diagonals. */
    const image = (x: number, y: number): Vector => {
      if (isFlat) return flat(x, y);
      const [u, v, w] = direction(x, y);
      return [radius * u, radius * v, radius * (w - 1)];
    };
    /** Length on the ball over length in the sheet at a place: 1 at the middle, least at the corners. */
    const scale = (x: number, y: number): number => {
      const [u, v] = flat(x, y);
      return 1 / (1 + (u * u + v * v) / (4 * radius * radius));
    };
    const leastScale = 1 / (1 + 1 / (16 * radius * radius));
    return { corner, isFlat, diagonal, radius, pole, flat, direction, image, scale, leastScale };
  }

  #facetsThatSee(): Int32Array {
    const { middle, width, height } = this.rectangle;
    const unit = 2 ** -Math.round(Math.log2(Math.hypot(width, height) || 1));
    const rays = new Float64Array(3 * this.count);
    for (let k = 0; k < this.count; ++k) {
      const [u, v] = this.place(k).map((value, axis) => (value - middle[axis]) * unit);
      rays.set([2 * u, 2 * v, 1 - u * u - v * v], 3 * k);
    }
    const { simplices } = new SphericalDelaunay(rays);
    const signs = bubbleSigns(rays, simplices, [0, 0, -1]);
    return simplices.filter((_, k) => signs[Math.floor(k / 3)] >= 0);
  }
}

/** The smallest rectangle along the axes around places (n, 2), or one about the origin with given sides. */
function rectangleAround(places: Float64Array, sides?: readonly [number, number]) {
  if (sides || places.length === 0) return { middle: [0, 0], width: sides?.[0] ?? 3, height: sides?.[1] ?? 2 };
  const [[left, right], [low, high]] = [0, 1].map((axis) => {
    const values = places.filter((_, k) => k % 2 === axis);
    return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  });
  const [width, height] = [right - left, high - low];
  return { middle: [left + width / 2, low + height / 2], width, height };
}

export type Sheet = ReturnType<LiftSites["sheet"]>;

/**
 * Between which angles images on the hemisphere lie of two points whose distance is this fraction of the diagonal:
 * 2 arcsin of it, of two corners, and 4 arctan of it, of pairs symmetric about the middle. What is promised are the
 * lower bound with the paper's constant ½, and the upper one with its 4/π.
 */
export function separationBounds(fraction: number): { low: number; high: number; promised: [number, number] } {
  const t = Math.min(1, fraction);
  return {
    low: 2 * Math.asin(t) * DEGREES,
    high: 4 * Math.atan(t) * DEGREES,
    promised: [90 * t, (720 / Math.PI) * t],
  };
}

/** How far apart two sites are, and the bounds of it on the hemisphere. */
export type Separation = ReturnType<typeof separation>;

/** In the plane, in its unit and as a part of the diagonal; on the ball in degrees, null in the plane. */
export function separation(sites: LiftSites, sheet: Sheet, p: number, q: number) {
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
  return fixed(value, decimals).replace(/\d+/, (whole) => counted(Number(whole)));
}

/** What there is to say of sites without triangles, by their dimension. */
export const WITHOUT_TRIANGLES: Readonly<Record<number, string>> = {
  [-1]: "No sites yet. Open a file.",
  0: "All sites lie at one place: there are no triangles.",
  1: "All sites lie on one line: there are no triangles.",
};

export function ofBend(sheet: Sheet): string {
  if (sheet.isFlat) return "flat: an infinite radius";
  return `radius ${fixed(sheet.radius, 3)} of the diagonal, scale 1 to ${fixed(sheet.leastScale, 2)}`;
}

/** Decimals of metres to which places are rounded. */
const DECIMALS = 4;

/** The sets of the sheet. @param sheet The places of the first one. */
export function sheetSets(sheet: Float64Array): SiteSet[] {
  return [
    { name: "sheet", words: "Scattered over a sheet of 3 by 2", make: () => sheet },
    {
      name: "grid",
      words: "A square grid",
      make: () => Float64Array.from({ length: 108 }, (_, k) => (k % 2 === 0 ? (k >> 1) % 9 : Math.floor(k / 18))),
    },
    { name: "flat", words: "Nearly flat, where the plain test fails", make: () => nearlyFlat(sheet) },
  ];
}

/** Corners of the rectangle that a set of the sheet stands on, where it is not the smallest one: width and height. */
export const SHEET_SIDES: Readonly<Record<string, readonly [number, number]>> = { sheet: [3, 2] };

/** A sheet of 30 by 20 centimetres in metres of a country's grid: squares of its coordinates leave no digits for it. */
function nearlyFlat(sheet: Float64Array): Float64Array {
  const origin = [4_500_000, 5_300_000];
  return sheet.map((value, k) => Number((origin[k % 2] + value / 10).toFixed(DECIMALS)));
}
