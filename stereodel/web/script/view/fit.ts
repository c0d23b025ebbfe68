/** The sight that shows places: a lens at the middle of the smallest cap about nearly all of them. */

import { angle, DEGREE, directionOf, dot, lonLatOf, unit, type Vector } from "../space.ts";
import { MOST, type Cap, type Sight } from "./lens.ts";
import { View } from "./view.ts";

/** Degrees from the middle of the globe up to which the places are seen, and of a cap that is a point. */
const SEEN = 56;
const OF_A_POINT = 5;

/** Places that are looked at, and steps toward the middle of the smallest cap. */
const MOST_PLACES = 5000;
const STEPS = 100;

/** The share of places that may not be left out, and how much smaller the cap must be without the others. */
const KEPT = 0.95;
const SMALLER = 1.5;

/**
 * @param lonlat Longitude and latitude in turn, degrees; null without a place.
 * @param most The largest magnification.
 * @param digits Behind the point of degrees.
 */
export function fitted(lonlat: Float64Array, most = MOST, digits = 3): Sight | null {
  const count = lonlat.length / 2;
  const step = Math.ceil(count / MOST_PLACES);
  const places = Array.from({ length: Math.ceil(count / step) || 0 }, (_, k): Vector => {
    return directionOf(lonlat[2 * k * step], lonlat[2 * k * step + 1]);
  });
  if (places.length === 0) return null;
  const cap = capOf(places);
  const near = [...places].sort((a, b) => dot(b, cap.center) - dot(a, cap.center));
  const nearly = capOf(near.slice(0, Math.ceil(KEPT * near.length)));
  const { center, radius } = SMALLER * nearly.radius < cap.radius ? nearly : cap;
  const [lon, lat] = lonLatOf(center).map((degrees) => Number(degrees.toFixed(digits)));
  const size = Math.tan((SEEN * DEGREE) / 2) / Math.tan(((radius || OF_A_POINT) * DEGREE) / 2);
  const magnification = Number(Math.max(1, Math.min(most, size)).toFixed(2));
  return { lens: { focus: directionOf(lon, lat), magnification }, view: View.above(lon, lat) };
}

/** The smallest cap about directions, nearly: its middle goes toward the farthest, less in every step. */
function capOf(places: readonly Vector[]): Cap {
  const sum = places.reduce(([x, y, z], [a, b, c]): Vector => [x + a, y + b, z + c], [0, 0, 0]);
  let center = Math.hypot(...sum) > 1e-9 * places.length ? unit(sum) : places[0];
  let farthest = places[0];
  for (let step = 2; step < STEPS; ++step) {
    farthest = places.reduce((a, b) => (dot(a, center) <= dot(b, center) ? a : b));
    if (dot(farthest, center) < 0) break; // more than half the sphere: the mean is as good as any
    center = unit(center.map((value, k) => value + (farthest[k] - value) / step) as unknown as Vector);
  }
  return { center, radius: places.reduce((most, place) => Math.max(most, angle(place, center)), 0) };
}
