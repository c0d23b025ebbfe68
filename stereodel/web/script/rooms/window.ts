/**
 * What of a triangulation is seen in windows of a picture, so that they alone are drawn anew where one site has moved.
 *
 * A facet and its side of the Voronoi diagram lie in the circle round it. So the sites of all facets whose circles meet a
 * window have, by themselves, the very triangles and cells that are seen there.
 */

import type { Point } from "../drawing/pen.ts";
import type { Vector } from "../space.ts";
import { SphereSites } from "./sphere_sites.ts";

/** A rectangle of a picture: left, top, right, bottom, pixels. */
export type Window = readonly [number, number, number, number];

/** A window that holds what is seen of the circle round a facet. */
export type RoundFacet = (facet: number) => Window;

/** Beyond a circle, pixels: half a line, a dot. */
const LINE = 4;

const EVERYWHERE: Window = [-Infinity, -Infinity, Infinity, Infinity];
const NOWHERE: Window = [Infinity, Infinity, -Infinity, -Infinity];

/** @param p Directions of the sites. @param seen The square about what is seen of a circle of the sphere. */
export function roundFacets(
  p: Float64Array,
  { delaunay: { simplices } }: SphereSites,
  seen: (center: Vector, cosine: number) => Window,
): RoundFacet {
  return (facet) => {
    const [a, b, c] = [3 * simplices[3 * facet], 3 * simplices[3 * facet + 1], 3 * simplices[3 * facet + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const size = Math.sqrt(nx * nx + ny * ny + nz * nz); // in a tenth of the time of hypot
    return seen([nx / size, ny / size, nz / size], (nx * p[a] + ny * p[a + 1] + nz * p[a + 2]) / size);
  };
}

/** About a circle of the picture; one of no or an infinite radius is seen nowhere or everywhere. */
export function squareAbout([x, y]: Point, r: number): Window {
  return r < Infinity ? (r > 0 ? [x - r, y - r, x + r, y + r] : NOWHERE) : EVERYWHERE;
}

/** The window of all that has to do with a site, in a picture of a size. */
export function windowOf({ delaunay }: SphereSites, site: number, round: RoundFacet, size: Point): Window {
  let all = delaunay.dimension < 2 ? EVERYWHERE : NOWHERE;
  delaunay.simplices.forEach((corner, at) => {
    if (corner === site) all = hullOf(all, round(Math.floor(at / 3)));
  });
  const [left, top] = [0, 1].map((k) => Math.max(0, Math.floor(all[k] - LINE)));
  const [right, bottom] = [0, 1].map((k) => Math.min(size[k], Math.ceil(all[k + 2] + LINE)));
  return [left, top, right, bottom];
}

function hullOf(a: Window, b: Window): Window {
  return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
}

/** Windows as rectangles apart from each other, which are clipped in a fraction of the time; those of nothing left out. */
export function united(a: Window, b: Window): Window[] {
  const isApart = a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];
  return (isApart ? [a, b] : [hullOf(a, b)]).filter(([left, , right]) => left < right);
}

/** The sites that make what is seen in a window. */
export function sitesIn(sites: SphereSites, [left, top, right, bottom]: Window, round: RoundFacet): SphereSites {
  const { simplices, dimension } = sites.delaunay;
  if (dimension < 2) return sites;
  const isIn = new Uint8Array(sites.count);
  for (let facet = 0; facet < sites.facetCount; ++facet) {
    const [x0, y0, x1, y1] = round(facet);
    if (x0 > right || x1 < left || y0 > bottom || y1 < top) continue;
    for (let k = 0; k < 3; ++k) isIn[simplices[3 * facet + k]] = 1;
  }
  return new SphereSites(sites.lonlat.filter((_, k) => isIn[k >> 1] === 1));
}
