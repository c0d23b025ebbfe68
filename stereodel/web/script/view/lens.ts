/** Conformal lenses over a view: the fisheye, magnified about a point, on its way to another one; bubble to bubble. */

import { MoebiusMap, Rotation } from "../kernel/api.ts";
import { DEGREE, row, unit, type Vector } from "../space.ts";
import { wrap } from "../words.ts";
import { View } from "./view.ts";

/** The largest magnification that the page shows. */
export const MOST = 100;

/** The fisheye: where it magnifies, a unit vector, and how many times. */
export interface Lens {
  readonly focus: Vector;
  readonly magnification: number;
}

/** What is seen of the Earth: through a lens, from a place above the ball that the lens makes of it. */
export interface Sight {
  readonly lens: Lens;
  readonly view: View;
}

export function lensMap({ focus, magnification }: Lens): MoebiusMap {
  return MoebiusMap.fisheye(focus, magnification);
}

/** A map of the Earth, to the axes of a view. */
export function seenThrough(map: MoebiusMap, view: View): MoebiusMap {
  return new MoebiusMap(view.rotation.after(map.left), map.magnification, map.right);
}

/** From the Earth to the axes of the view. */
export function sightMap({ lens, view }: Sight): MoebiusMap {
  return seenThrough(lensMap(lens), view);
}

/** The direction of the Earth that is seen at a point of the view. */
export function sourceOf(map: MoebiusMap, point: Vector): Vector {
  return row(map.inverse().apply(point), 0);
}

/** The image of one direction. */
export function imageOf(map: MoebiusMap, direction: Vector): Vector {
  return row(map.apply(direction), 0);
}

/** The scale at one direction. */
export function scaleAt(map: MoebiusMap, direction: Vector): number {
  return map.scaleFactor(direction)[0];
}

/**
 * Magnified by a factor about a point of the view, which stays where it is.
 * Above 1 the map goes on with a fisheye at the point, which moves the focus there little by little. Below 1 the lens is
 * weakened where it is, so that the way back always ends at the plain ball.
 */
export function magnified(sight: Sight, point: Vector, factor: number, isNorthUp: boolean, most = MOST): Sight {
  const { lens, view } = sight;
  if (factor >= 1) {
    // Magnifications multiply at the most, so that none is above the largest one.
    const strength = Math.min(factor, most / lens.magnification);
    const map = lensMap({ focus: point, magnification: strength }).after(sightMap(sight));
    const free = new View(map.left.after(map.right));
    const magnification = Math.max(1, Math.min(most, map.magnification));
    const focus = magnification > 1 ? row(map.focus, 0) : lens.focus;
    return { lens: { focus, magnification }, view: isNorthUp ? free.northUp.holding(free.onBall(point), point) : free };
  }
  const source = sourceOf(sightMap(sight), point);
  const weaker = { focus: lens.focus, magnification: Math.max(1, lens.magnification * factor) };
  return { lens: weaker, view: view.holding(imageOf(lensMap(weaker), source), point, isNorthUp) };
}

/** With another focus, while a direction of the Earth stays where it is seen. */
export function focused(sight: Sight, focus: Vector, isNorthUp: boolean): Sight {
  const lens = { ...sight.lens, focus };
  const point = imageOf(sightMap(sight), focus);
  return { lens, view: sight.view.holding(focus, point, isNorthUp) };
}

/** Part of the way from one sight to another: logarithms of magnifications go straight, views the short way. */
export function betweenSights(a: Sight, b: Sight, t: number, isNorthUp: boolean): Sight {
  return t === 1 ? b : { lens: betweenLenses(a.lens, b.lens, t), view: betweenViews(a.view, b.view, t, isNorthUp) };
}

function betweenLenses(a: Lens, b: Lens, t: number): Lens {
  const [p, q] = [(1 - t) * Math.log(a.magnification), t * Math.log(b.magnification)];
  const vector = a.focus.map((value, k) => p * value + q * b.focus[k]) as unknown as Vector;
  const size = Math.hypot(...vector);
  return { focus: size === 0 ? b.focus : unit(vector), magnification: Math.exp(size) };
}

function betweenViews(a: View, b: View, t: number, isNorthUp: boolean): View {
  if (isNorthUp) {
    const [[lon, lat], [toLon, toLat]] = [a.middle, b.middle];
    return View.above(lon + t * wrap(toLon - lon), lat + t * (toLat - lat));
  }
  const [w, ...axis] = b.rotation.after(a.rotation.inverse()).quaternion;
  const sine = Math.hypot(...axis);
  return sine === 0 ? a : a.turned(Rotation.about(axis, t * wrap((2 * Math.atan2(sine, w)) / DEGREE)));
}

/** A cap of the sphere: its middle and its radius in degrees. */
export interface Cap {
  readonly center: Vector;
  readonly radius: number;
}

/** The map that takes one cap onto another, middle to middle, along the great circle between them. */
export function capToCap(from: Cap, to: Cap): MoebiusMap {
  const strength = Math.tan((to.radius * DEGREE) / 2) / Math.tan((from.radius * DEGREE) / 2);
  const lens = MoebiusMap.fisheye(from.center, strength);
  return new MoebiusMap(Rotation.between(from.center, to.center).after(lens.left), lens.magnification, lens.right);
}
