/** What lies on a ball or a plane: layers whose directions stay in the kernel, each drawn as its images under a map are. */

import type { Rings as Places } from "../contents.ts";
import { Directions, lonlatToXyz, PlanarVoronoi } from "../kernel/api.ts";
import type { MoebiusMap, PlanarDelaunay, SphericalVoronoi } from "../kernel/api.ts";
import { angle, cross, DEGREE, directionOf, dot, row, unit, type Vector } from "../space.ts";
import { arcThrough, bentRings, holdsHidden, traceArc, traceCap, traceOutlines, traceRegions } from "./arcs.ts";
import type { Side } from "./arcs.ts";
import { traceCorners, traceDisc } from "./pen.ts";
import type { Disc, Path, Pen, Point, Trace } from "./pen.ts";
import type { DotName, StyleName } from "./styles.ts";

/** The longest arc of a circle that is drawn by three points, radians: they are well apart, and tell its sense. */
const LONGEST_ARC = (2 * Math.PI) / 3;

/** The place of the sea that is farthest from all land. */
const AT_SEA = directionOf(-123.4, -48.9);

export interface Layer {
  readonly directions: Directions;
  /** Draws images of the directions under a map, in the axes of the view. */
  draw(pen: Pen, disc: Disc, images: Float64Array, map: MoebiusMap): void;
  /** The outlines of its regions alone. */
  readonly outlines?: Layer;
}

/** Draws layers one over the other; `map` takes them to the axes of the view: x right, y up, z toward the reader. */
export function drawLayers(pen: Pen, disc: Disc, map: MoebiusMap, layers: readonly (Layer | null)[]): void {
  for (const layer of layers) {
    if (layer !== null && layer.directions.xyz.length > 0) layer.draw(pen, disc, map.apply(layer.directions), map);
  }
}

function layerOf(points: Float64Array, draw: Layer["draw"]): Layer {
  return { directions: new Directions(points), draw };
}

/** Lines: arcs of three points each, an end, a point between, the other end; an ink is of the data. */
export function arcLayer(style: StyleName, points: Float64Array, ink?: string): Layer {
  return layerOf(points, (pen, disc, images) => drawArcs(pen, disc, style, images, "front", ink));
}

/** Draws arcs of three points each, axes of the view. */
export function drawArcs(
  pen: Pen,
  disc: Disc,
  style: StyleName,
  p: ArrayLike<number>,
  side: Side = "front",
  ink?: string,
): void {
  const sign = side === "front" ? 1 : -1;
  const ends = new Float64Array((4 * p.length) / 9);
  for (let i = 0, at = 0; i < p.length; i += 9, at += 4) {
    const j = sign * p[i + 2] >= 0 || sign * p[i + 8] >= 0 ? i + 6 : i; // what is hidden has no ink
    ends[at] = disc.x + disc.r * p[i];
    ends[at + 1] = disc.y - disc.r * p[i + 1];
    ends[at + 2] = disc.x + disc.r * p[j];
    ends[at + 3] = disc.y - disc.r * p[j + 1];
  }
  pen.lines(style, ends, (path, k) => traceArc(path, disc, p, 3 * k, side), ink);
}

/** Caps by three points of each circle, counterclockwise about the cap. */
export function capLayer(style: StyleName, points: Float64Array): Layer {
  return layerOf(points, (pen, disc, images) => {
    // One after the other: where they overlap, both are seen.
    for (let k = 0; 3 * k < images.length; k += 3) {
      const circle = arcThrough(images, k, true);
      if (circle !== null) pen.draw(style, (path) => traceCap(path, disc, circle));
    }
  });
}

/** Dots, those that are seen. */
export function dotLayer(style: DotName, points: Float64Array): Layer {
  return layerOf(points, (pen, disc, images) => {
    const places: number[] = [];
    for (let i = 0; i < images.length; i += 3) {
      if (images[i + 2] >= 0) places.push(disc.x + disc.r * images[i], disc.y - disc.r * images[i + 1]);
    }
    pen.dots(style, places);
  });
}

/** Dots with radii and inks of their own: the largest lowest, and those of one ink together. */
export function spotLayer(points: Float64Array, radii: ArrayLike<number>, inks: readonly string[]): Layer {
  const order = Array.from(inks.keys()).filter((k) => radii[k] > 0);
  order.sort((a, b) => radii[b] - radii[a] || (inks[a] < inks[b] ? -1 : inks[a] > inks[b] ? 1 : a - b));
  return layerOf(Float64Array.from(order.flatMap((k) => row(points, k))), (pen, disc, images) => {
    const seen = [...order.keys()].filter((i) => images[3 * i + 2] >= 0);
    const places = seen.flatMap((i) => [...placeOf(disc, row(images, i)), radii[order[i]]]);
    const shown = seen.map((i) => inks[order[i]]);
    // The margin has no room for large ones.
    pen.within({ region: (path) => traceDisc(path, disc) }, () => pen.spots(places, shown));
  });
}

/**
 * Regions on the left of rings, filled and outlined, such as land with its coast.
 * @param outline Style of the rings as lines, if they are drawn.
 * @param place A direction far from all rings, and whether it is in the regions.
 * @param ink Of the data, in place of that of the style.
 */
export function regionLayer(
  fill: StyleName,
  outline: StyleName | null,
  points: Float64Array,
  offsets: ArrayLike<number>,
  place: Vector,
  inside: boolean,
  ink?: string,
): Layer {
  const withPlace = new Float64Array(points.length + 3);
  withPlace.set(points);
  withPlace.set(place, points.length);
  const directions = new Directions(withPlace);
  const drawn = (isFilled: boolean): Layer["draw"] => {
    return (pen, disc, images, map) => {
      const rings = bentRings(points, { points: images.subarray(0, points.length), offsets }, map, disc.r);
      const holds = holdsHidden(rings, row(images, points.length / 3), inside);
      if (isFilled) pen.draw(fill, (path) => traceRegions(path, disc, rings, holds), ink);
      if (outline !== null) pen.draw(outline, (path) => traceOutlines(path, disc, rings));
    };
  };
  return { directions, draw: drawn(true), outlines: { directions, draw: drawn(false) } };
}

/** Land with its coast. */
export function landLayer({ lonlat, offsets }: Places): Layer {
  return regionLayer("land", "coast", lonlatToXyz(lonlat), offsets, AT_SEA, false);
}

/** The shorter arcs between points, two of them by their numbers for each. */
export function arcsBetween(points: Float64Array, pairs: ArrayLike<number>): Float64Array {
  const arcs: number[] = [];
  for (let k = 0; k < pairs.length; k += 2) {
    const [a, b] = [row(points, pairs[k]), row(points, pairs[k + 1])];
    pushAll(arcs, a, unit([a[0] + b[0], a[1] + b[1], a[2] + b[2]]), b);
  }
  return Float64Array.from(arcs);
}

/** Sides of Voronoi cells as arcs; those of more than 120° in two pieces. */
export function ridgeArcs(voronoi: SphericalVoronoi): Float64Array {
  const { vertices, ridgeVertices } = voronoi;
  const normals = voronoi.ridgeNormals();
  const arcs: number[] = [];
  for (let k = 0; 2 * k < ridgeVertices.length; ++k) {
    const [a, b] = [row(vertices, ridgeVertices[2 * k]), row(vertices, ridgeVertices[2 * k + 1])];
    const swept = angle(a, b) * DEGREE; // never more than half a turn
    const [n, pieces] = [row(normals, k), swept > LONGEST_ARC ? 2 : 1];
    for (let piece = 0; piece < pieces; ++piece) {
      const [begin, middle, end] = [0, 1, 2].map((step) => turned(n, a, (swept * (2 * piece + step)) / (2 * pieces)));
      pushAll(arcs, piece === 0 ? a : begin, middle, piece + 1 === pieces ? b : end);
    }
  }
  return Float64Array.from(arcs);
}

/** Sides of the cells of a plane as x, y, x, y in turn, none without triangles; those that do not end go on for `far`. */
export function ridgeSegments(points: ArrayLike<number> | PlanarDelaunay, far: number): number[] {
  const { points: sites, vertices, ridgePoints, ridgeVertices } = new PlanarVoronoi(points);
  const place = (places: Float64Array, k: number): Point => [places[2 * k], places[2 * k + 1]];
  if (vertices.length === 0) return [];
  return Array.from({ length: ridgePoints.length / 2 }, (_, k) => {
    const [a, b] = [place(sites, ridgePoints[2 * k]), place(sites, ridgePoints[2 * k + 1])];
    const ends = [ridgeVertices[2 * k], ridgeVertices[2 * k + 1]];
    const [x, y] = place(vertices, Math.max(...ends));
    // Site a is on the left of the way from start to end.
    const away = (far + Math.hypot(x - a[0], y - a[1])) / Math.hypot(b[0] - a[0], b[1] - a[1]);
    const [u, v] = [away * (a[1] - b[1]), away * (b[0] - a[0])];
    return ends.map((end, k) => (end < 0 ? [x + (k ? u : -u), y + (k ? v : -v)] : place(vertices, end)));
  }).flat(2);
}

/** A direction turned counterclockwise about one at a right angle to it, radians. */
function turned(n: Vector, a: Vector, by: number): Vector {
  const [c, s, side] = [Math.cos(by), Math.sin(by), cross(n, a)];
  return [c * a[0] + s * side[0], c * a[1] + s * side[1], c * a[2] + s * side[2]];
}

function pushAll(arcs: number[], ...points: Vector[]): void {
  for (const [x, y, z] of points) arcs.push(x, y, z);
}

/** A direction at a right angle to another. */
export function perpendicular(n: Vector): Vector {
  return unit(Math.abs(n[2]) < 0.9 ? [-n[1], n[0], 0] : [0, -n[2], n[1]]);
}

/** Meridians and parallels, so many degrees apart, as arcs. */
export function graticuleArcs(step: number): Float64Array {
  const arcs: number[] = [];
  for (let lon = -180; lon < 180; lon += step) {
    for (const lat of [-90, 0]) pushAll(arcs, ...[0, 45, 90].map((up) => directionOf(lon, lat + up)));
  }
  for (let lat = step - 90; lat < 90; lat += step) {
    for (const lon of [-180, -60, 60]) pushAll(arcs, ...[0, 60, 120].map((east) => directionOf(lon + east, lat)));
  }
  return Float64Array.from(arcs);
}

/** Three points of a circle about a direction, counterclockwise; its radius in degrees. */
export function circlePoints(center: Vector, radius: number): Vector[] {
  const side = perpendicular(center);
  const [c, s] = [Math.cos(radius * DEGREE), Math.sin(radius * DEGREE)];
  return [0, 1, 2].map((k) => {
    const out = turned(center, side, k * LONGEST_ARC);
    return unit([c * center[0] + s * out[0], c * center[1] + s * out[1], c * center[2] + s * out[2]]);
  });
}

/** Lines through places, rows of longitude and latitude in degrees, as arcs. */
export function lineArcs({ lonlat, offsets }: Places): Float64Array {
  const pairs: number[] = [];
  for (let line = 0; line + 1 < offsets.length; ++line)
    for (let k = offsets[line] + 1; k < offsets[line + 1]; ++k) pairs.push(k - 1, k);
  return arcsBetween(lonlatToXyz(lonlat), pairs);
}

/** Where a direction is on the picture. */
export function placeOf(disc: Disc, point: Vector): [number, number] {
  return [disc.x + disc.r * point[0], disc.y - disc.r * point[1]];
}

/** Where a picture has sites, and lines and regions between them. */
export interface Surface {
  place(site: number): Point;
  isSeen(site: number): boolean;
  /** From sites to others, in turn. */
  lines(pen: Pen, style: StyleName, sites: ArrayLike<number>, side?: Side): void;
  /** The region on the left of a closed line. @param holds Whether it holds the middle of the far side, or infinity. */
  region(path: Path, sites: readonly number[], holds: boolean): void;
}

/** The sites of a closed line, as lines have them. */
export function sidesOf(sites: readonly number[]): number[] {
  return sites.flatMap((a, k) => [a, sites[(k + 1) % sites.length]]);
}

/** A ball. @param look Directions of the sites, before `map`, which takes them to the axes of the view; without one there. */
export function ballSurface(disc: Disc, look: (site: number) => Vector, map: MoebiusMap | null = null): Surface {
  const seen = (directions: Float64Array): Float64Array => map?.apply(directions) ?? directions;
  const image = (site: number): Vector => (map === null ? look(site) : row(map.apply(look(site)), 0));
  return {
    place: (site) => placeOf(disc, image(site)),
    isSeen: (site) => image(site)[2] >= 0,
    lines(pen, style, sites, side) {
      const points = Float64Array.from(Array.from(sites, look).flat());
      drawArcs(pen, disc, style, seen(arcsBetween(points, [...Array(sites.length).keys()])), side);
    },
    region(path, sites, holds) {
      const points = sites.flatMap((a, k) => along(look(a), look(sites[(k + 1) % sites.length])));
      const directions = Float64Array.from(points.flat());
      const rings = { points: seen(directions), offsets: [0, points.length] };
      traceRegions(path, disc, map === null ? rings : bentRings(directions, rings, map, disc.r), holds);
    },
  };
}

/** A plane, as far as its frame goes. @param place Of the sites on the picture. */
export function planeSurface(place: (site: number) => Point, frame: Trace): Surface {
  return {
    place,
    isSeen: () => true,
    lines: (pen, style, sites) => pen.lines(style, Array.from(sites).flatMap(place)),
    region(path, sites, holds) {
      if (holds) frame(path);
      traceCorners(path, sites.map(place));
    },
  };
}

/** Those of the sites that are seen, as dots. */
export function drawDots(pen: Pen, surface: Surface, style: DotName, sites: Iterable<number>): void {
  pen.dots(style, [...sites].filter(surface.isSeen).flatMap(surface.place));
}

/** Points of a great-circle side, a degree apart at the most, from its first corner on, without its last. */
export function along(a: Vector, b: Vector): Vector[] {
  const n = cross(a, b);
  const sine = Math.hypot(n[0], n[1], n[2]);
  const whole = Math.atan2(sine, dot(a, b));
  const count = Math.max(1, Math.ceil((whole * 180) / Math.PI));
  return Array.from({ length: count }, (_, k) => {
    const t = (whole * k) / count;
    const [s, u] = sine === 0 ? [1, 0] : [Math.sin(whole - t) / sine, Math.sin(t) / sine];
    return unit([s * a[0] + u * b[0], s * a[1] + u * b[1], s * a[2] + u * b[2]]);
  });
}
