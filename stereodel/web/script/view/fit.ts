/** The sight that shows places: a lens in the middle of their smallest cap, strong enough for nearly all of them. */

import { angle, DEGREE, directionOf, dot, lonLatOf, unit, type Vector } from "../space.ts";
import { MOST, type Sight } from "./lens.ts";
import { View } from "./view.ts";

/** Degrees from the middle of the globe up to which the places are seen, and of a cap that is a point. */
const SEEN = 56;
const OF_A_POINT = 5;

/** Places that are looked at. */
const MOST_PLACES = 5000;

/** The share of places that may not be left out, and how much smaller their cap must be than that of all. */
const KEPT = 0.95;
const SMALLER = 1.5;

/**
 * @param lonlat Longitude and latitude in turn, degrees; null without a place.
 * @param strongest The largest magnification.
 * @param digits Behind the point of degrees.
 */
export function fitted(lonlat: Float64Array, strongest = MOST, digits = 3): Sight | null {
  const places: Vector[] = [];
  const step = 2 * Math.ceil(lonlat.length / 2 / MOST_PLACES);
  for (let k = 0; k < lonlat.length; k += step) places.push(directionOf(lonlat[k], lonlat[k + 1]));
  if (places.length === 0) return null;
  const sum = places.reduce(([x, y, z], [a, b, c]): Vector => [x + a, y + b, z + c]);
  const mean = Math.hypot(...sum) > 1e-9 * places.length ? unit(sum) : places[0];
  places.sort((a, b) => dot(b, mean) - dot(a, mean));
  const kept = places.slice(0, Math.ceil(KEPT * places.length));
  const reach = (some: readonly Vector[], from: Vector): number => Math.max(...some.map((place) => angle(place, from)));
  const shown = SMALLER * reach(kept, mean) < reach(places, mean) ? kept : places;
  // To the middle of their smallest cap: towards the farthest, by less each time (Bădoiu and Clarkson 2003).
  let middle = mean;
  for (let k = 2; k < 200; ++k) {
    const far = shown.reduce((a, b) => (dot(b, middle) < dot(a, middle) ? b : a));
    middle = unit([0, 1, 2].map((axis) => middle[axis] + (far[axis] - middle[axis]) / k) as unknown as Vector);
  }
  const radius = reach(shown, middle) || OF_A_POINT;
  const [lon, lat] = lonLatOf(middle).map((degrees) => Number(degrees.toFixed(digits)));
  const size = Math.tan((SEEN * DEGREE) / 2) / Math.tan((radius * DEGREE) / 2);
  const magnification = Number(Math.max(1, Math.min(strongest, size)).toFixed(2));
  return { lens: { focus: directionOf(lon, lat), magnification }, view: View.above(lon, lat) };
}
