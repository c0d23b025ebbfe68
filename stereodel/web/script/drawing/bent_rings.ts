/** Rings whose sides are bent by a map: points between where a straight side would be seen to be wrong. */

import type { MoebiusMap } from "../kernel/api.ts";
import { row } from "../space.ts";
import { bow } from "./arcs.ts";
import type { Rings } from "./fill.ts";

/** Sides of images that are shorter are left as they are, pixels. */
const SHORT = 8;

/** Largest distance of an outline from its points' polygon, pixels: less than half the width of a coast. */
const LEAST_BOW = 0.3;

/** Points of one side at the most: of half a circle round the whole ball they are some pixels apart. */
const MOST_PIECES = 128;

/**
 * The images of rings of great-circle arcs, with as many points more as it takes.
 * @param source The rings' points before the map.
 * @param rings Their images, in the axes of the view.
 * @param radius Of the ball, pixels.
 */
export function bentRings(source: Float64Array, rings: Rings, map: MoebiusMap, radius: number): Rings {
  const sides = longSides(rings, radius);
  if (sides.length === 0) return rings;
  const pieces = pieceCounts(source, rings, sides, map, radius);
  const between: number[] = [];
  sides.forEach(([from, to], k) => {
    const [a, b] = [row(source, from), row(source, to)];
    for (let piece = 1; piece < pieces[k]; ++piece) {
      const t = piece / pieces[k];
      for (let axis = 0; axis < 3; ++axis) between.push(a[axis] + t * (b[axis] - a[axis]));
    }
  });
  if (between.length === 0) return rings;
  return merged(rings, sides, pieces, map.apply(Float64Array.from(between)));
}

/** Pairs of rows, start and end of each side. */
function longSides({ points, offsets }: Rings, radius: number): [number, number][] {
  const sides: [number, number][] = [];
  const least = (SHORT / radius) ** 2;
  for (let ring = 0; ring + 1 < offsets.length; ++ring) {
    for (let k = offsets[ring]; k < offsets[ring + 1]; ++k) {
      const next = k + 1 < offsets[ring + 1] ? k + 1 : offsets[ring];
      const [i, j] = [3 * k, 3 * next];
      const [x, y, z] = [points[j] - points[i], points[j + 1] - points[i + 1], points[j + 2] - points[i + 2]];
      if (x * x + y * y + z * z > least) sides.push([k, next]);
    }
  }
  return sides;
}

/** Into how many pieces each side is cut: the distance from the chord falls with the square of their number. */
function pieceCounts(
  source: Float64Array,
  { points }: Rings,
  sides: readonly [number, number][],
  map: MoebiusMap,
  radius: number,
): number[] {
  const middles = new Float64Array(3 * sides.length);
  sides.forEach(([from, to], k) => {
    for (let axis = 0; axis < 3; ++axis) middles[3 * k + axis] = source[3 * from + axis] + source[3 * to + axis];
  });
  const images = map.apply(middles);
  const three = new Float64Array(9);
  return sides.map(([from, to], k) => {
    three.set(points.subarray(3 * from, 3 * from + 3), 0);
    three.set(images.subarray(3 * k, 3 * k + 3), 3);
    three.set(points.subarray(3 * to, 3 * to + 3), 6);
    const pieces = Math.ceil(Math.sqrt((radius * bow(three, 0, 1, 2)) / LEAST_BOW));
    return Math.max(1, Math.min(MOST_PIECES, pieces));
  });
}

function merged(
  { points, offsets }: Rings,
  sides: readonly [number, number][],
  pieces: readonly number[],
  between: Float64Array,
): Rings {
  const more = new Float64Array(points.length + between.length);
  const moved = new Uint32Array(offsets.length);
  let [at, taken, side] = [0, 0, 0];
  for (let ring = 0; ring + 1 < offsets.length; ++ring) {
    for (let k = offsets[ring]; k < offsets[ring + 1]; ++k) {
      more.set(points.subarray(3 * k, 3 * k + 3), at);
      at += 3;
      if (side === sides.length || sides[side][0] !== k) continue;
      const length = 3 * (pieces[side++] - 1);
      more.set(between.subarray(taken, taken + length), at);
      at += length;
      taken += length;
    }
    moved[ring + 1] = at / 3;
  }
  return { points: more.subarray(0, at), offsets: moved };
}
