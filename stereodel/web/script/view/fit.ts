/** The sight that shows places: a lens at their mean, strong enough for nearly all of them. */

import { angle, DEGREE, directionOf, lonLatOf, unit, type Vector } from "../space.ts";
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
  const away = places.map((place) => angle(place, mean)).sort((a, b) => a - b);
  const [most, all] = [KEPT, 1].map((share) => away[Math.ceil(share * away.length) - 1]);
  const radius = (SMALLER * most < all ? most : all) || OF_A_POINT;
  const [lon, lat] = lonLatOf(mean).map((degrees) => Number(degrees.toFixed(digits)));
  const size = Math.tan((SEEN * DEGREE) / 2) / Math.tan((radius * DEGREE) / 2);
  const magnification = Number(Math.max(1, Math.min(strongest, size)).toFixed(2));
  return { lens: { focus: directionOf(lon, lat), magnification }, view: View.above(lon, lat) };
}
