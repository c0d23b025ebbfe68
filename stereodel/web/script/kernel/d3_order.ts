/** The order of d3-geo-voronoi: that in which delaunator makes triangles of the sites seen from the first one. */

import type { SphericalDelaunay } from "./delaunay.ts";
import { lazy } from "./lazy.ts";
import { sweepHull } from "./sweep_hull.ts";

const RADIANS = Math.PI / 180;
const TURN = 2 * Math.PI;

type Angles = [longitude: number, latitude: number];
const wrapped = (angle: number): number =>
  Math.abs(angle) > Math.PI ? angle - Math.round(angle / TURN) * TURN : angle;

/** The rotation of d3-geo by two angles, and the angles that take the point opposite to the first site to the middle. */
function turned([lon, lat]: Angles, [east, north]: Angles): Angles {
  const moved = wrapped(lon + (east % TURN));
  if (north === 0) return [moved, lat];
  const [x, y, z] = [Math.cos(moved) * Math.cos(lat), Math.sin(moved) * Math.cos(lat), Math.sin(lat)];
  const up = z * Math.cos(north) + x * Math.sin(north);
  return [Math.atan2(y, x * Math.cos(north) - z * Math.sin(north)), Math.asin(Math.max(-1, Math.min(1, up)))];
}

function opposite([east, north]: Angles): Angles {
  const [x, y] = [-1, Math.sin(Math.PI)];
  const place: Angles =
    north === 0 ? [Math.PI, 0] : [Math.atan2(y, x * Math.cos(north)), Math.asin(-x * Math.sin(north))];
  place[0] = wrapped(place[0] - (east % TURN));
  return place.map((angle) => (((angle * 180) / Math.PI) % 360) * RADIANS) as Angles;
}

/** Stereographic images of the sites, the first one's far away, and three more places as far: a square around all. */
function images(lonlat: Float64Array): Float64Array {
  const angles = lonlat.map((degrees) => degrees * RADIANS);
  const count = lonlat.length / 2;
  const xy = new Float64Array(lonlat.length + 6);
  const rotation = opposite([angles[0], angles[1]]);
  const far: number[] = [];
  let most = 1;
  for (let i = 0; i < count; ++i) {
    const [lon, lat] = turned([angles[2 * i], angles[2 * i + 1]], rotation);
    const scale = 1 + Math.cos(lon) * Math.cos(lat);
    xy.set([(Math.cos(lat) * Math.sin(lon)) / scale, -Math.sin(lat) / scale], 2 * i);
    const square = xy[2 * i] ** 2 + xy[2 * i + 1] ** 2;
    if (!(square <= 1e32)) far.push(i);
    else most = Math.max(most, square);
  }
  const edge = 1e6 * Math.sqrt(most);
  for (const i of far) xy.set([edge, 0], 2 * i);
  xy.set([0, edge, -edge, 0, 0, -edge], 2 * count);
  return xy;
}

/** Its triangles, three sites each; those of less than three are left in. */
export function theirTriangles(lonlat: Float64Array): Int32Array {
  const { triangles, halfedges } = sweepHull(images(lonlat));
  const count = lonlat.length / 2;
  for (let e = 0; e < triangles.length; ++e) {
    if (halfedges[e] >= 0) {
      if (triangles[e] >= count) triangles[e] = 0;
      continue;
    }
    // A side of the square: the triangle goes, and its neighbours become each other's.
    const row = e - (e % 3);
    const [one, other] = [row + ((e + 1) % 3), row + ((e + 2) % 3)];
    const [a, b] = [halfedges[one], halfedges[other]];
    if (a >= 0) halfedges[a] = b;
    if (b >= 0) halfedges[b] = a;
    halfedges[one] = halfedges[other] = -1;
    triangles.fill(0, row, row + 3);
    e = row + 2;
  }
  return triangles;
}

/** Where each triangle begins in `simplices`, rows from their lowest site on, in their order; those they do not have come first. */
export function orderLike(theirs: Int32Array, simplices: Int32Array): Int32Array {
  const count = simplices.length / 3;
  const [head, following] = [new Map<number, number>(), new Int32Array(count)]; // rows by their lowest sites
  for (let row = 0; row < count; ++row) {
    following[row] = head.get(simplices[3 * row]) ?? -1;
    head.set(simplices[3 * row], row);
  }
  const listed = new Uint8Array(count);
  const order = new Int32Array(count);
  let size = 0;
  for (let e = 0; e < theirs.length; e += 3) {
    const [a, b, c] = [theirs[e], theirs[e + 1], theirs[e + 2]];
    const turn = a < b ? (a < c ? 0 : 2) : b < c ? 1 : 2;
    const [low, second, third] = turn === 0 ? [a, b, c] : turn === 1 ? [b, c, a] : [c, a, b];
    for (let row = head.get(low) ?? -1; row >= 0; row = following[row]) {
      if (simplices[3 * row + 1] !== second || simplices[3 * row + 2] !== third || listed[row] === 1) continue;
      listed[row] = 1;
      order[size++] = 3 * row + ((3 - turn) % 3);
    }
  }
  order.copyWithin(count - size, 0, size);
  let others = 0;
  listed.forEach((known, row) => known === 0 && (order[others++] = 3 * row));
  return order;
}

/** More sites than these come as the kernel lists them: to follow the other order would take as long as to triangulate them. */
const MOST = 4096;

/** Facets in the order of results: three sites each, the facet opposite each, whether it closes, and its center. */
export interface Faces {
  corners: Int32Array;
  beyond: Int32Array;
  closing: Uint8Array;
  centers: Float64Array;
  /** Whether this is the order of d3-geo-voronoi. */
  listed: boolean;
}

export function ordered(delaunay: SphericalDelaunay, lonlat: Float64Array): Faces {
  const { simplices, neighbors } = delaunay;
  if (delaunay.dimension < 2 || delaunay.size > MOST) {
    return lazy<Faces>({
      corners: () => simplices,
      beyond: () => neighbors,
      listed: () => false,
      closing: () => delaunay.closing,
      centers: () => delaunay.circumcenters,
    });
  }
  const order = orderLike(theirTriangles(lonlat), simplices);
  const rank = new Int32Array(order.length);
  order.forEach((first, face) => (rank[Math.floor(first / 3)] = face));
  const rows = order.map((first) => Math.floor(first / 3));
  /** The corners of each facet, from its first one on. */
  const from = simplices.map((_, e) => 3 * rows[Math.floor(e / 3)] + ((order[Math.floor(e / 3)] + e) % 3));
  return lazy<Faces>({
    corners: () => from.map((at) => simplices[at]),
    beyond: () => from.map((at) => rank[neighbors[at]]),
    listed: () => true,
    closing: () => Uint8Array.from(rows, (row) => delaunay.closing[row]),
    centers: () => delaunay.circumcenters.map((_, k, all) => all[3 * rows[Math.floor(k / 3)] + (k % 3)]),
  });
}
