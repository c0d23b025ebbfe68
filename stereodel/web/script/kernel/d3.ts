/**
 * `geoDelaunay`, `geoVoronoi` and `geoContour` with the methods of d3-geo-voronoi, on the exact kernel: places are pairs [longitude,
 * latitude] in degrees, results plain arrays and GeoJSON wound as d3-geo wants it, clockwise. Call `load` of the package
 * before. What differs from d3-geo-voronoi, and why, is said in the documentation, docs/javascript.md.
 */

import { lonlatToXyz } from "./coordinates.ts";
import { SphericalDelaunay } from "./delaunay.ts";
import { lazy } from "./lazy.ts";
import { cornersAs, halfedgesOf, MOST, preceding, sweepHull } from "./sweep_hull.ts";
import { following } from "./topology.ts";
import { SphericalVoronoi } from "./voronoi.ts";

export { geoContour, type ContourPolygon, type Contours } from "./contours.ts";

/** Longitude and latitude in degrees. */
export type Place = [number, number];

type Geometry = { type: string; coordinates?: Place[][] | Place[] };

/** What is drawn: an object of GeoJSON. */
type Feature<Properties> = { type: "Feature"; geometry: Geometry | null; properties: Properties };
type Collection<Properties> = { type: "FeatureCollection"; features: Feature<Properties>[] };
type MultiLineString = { type: "MultiLineString"; coordinates: [Place, Place][] };

/** A method that says a value, or with an argument sets it. */
export type Setting<Value, Owner> = { (): Value; (value: Value): Owner };

/** @internal */
export function setting<Value, Owner>(owner: Owner, value: Value): Setting<Value, Owner> {
  const method = (given?: Value): Value | Owner => {
    if (given === undefined) return value;
    value = given;
    return owner;
  };
  return method as Setting<Value, Owner>;
}

/** The exact triangulation, and what d3-delaunay has of it besides. */
export class ListedDelaunay extends SphericalDelaunay {
  private around: Cells | null = null;
  private unlisted: Float64Array | null;

  constructor(lonlat: Float64Array) {
    super(lonlatToXyz(lonlat));
    this.unlisted = this.dimension === 2 && this.size <= MOST ? lonlat : null;
  }

  /** @internal Itself in the order of d3-geo-voronoi, which takes as long again as all before. */
  listed(): this {
    if (this.unlisted !== null) this.list(cornersAs(theirTriangles(this.unlisted), this.simplices));
    this.unlisted = null;
    return this;
  }

  /** @internal What lies around each site. */
  get cells(): Cells {
    return (this.around ??= cellsOf(this));
  }

  /** Three sites each, counterclockwise. */
  get triangles(): Int32Array {
    return this.simplices;
  }

  /** Of each side of a triangle, from its first site on, the same side of the triangle beyond it. */
  get halfedges(): Int32Array {
    return halfedgesOf(this.simplices, this.neighbors);
  }
}

/** An angle as d3-geo turns it, within half a turn. */
const wrapped = (angle: number): number =>
  Math.abs(angle) > Math.PI ? angle - Math.round(angle / TURN) * TURN : angle;

/** Triangles as delaunator makes them of the sites seen from the first one, which is its point far away; those of less than three are left in. */
function theirTriangles(lonlat: Float64Array): Int32Array {
  const size = lonlat.length;
  // Each number as d3-geo has it, since rounding decides which of equal distances is less.
  const [east, north] = [lonlat[0] / DEGREES, lonlat[1] / DEGREES];
  const opposite = [Math.atan2(Math.sin(Math.PI), -Math.cos(north)), Math.asin(Math.sin(north))];
  const [turn, rise] = [wrapped(opposite[0] - (east % TURN)), opposite[1]].map((x) => ((x * DEGREES) % 360) / DEGREES);
  const [across, upright] = [Math.sin(rise), Math.cos(rise)];
  const xy = new Float64Array(size + 6);
  const far: number[] = [];
  let most = 1;
  for (let k = 0; k < size; k += 2) {
    const moved = wrapped(lonlat[k] / DEGREES + (turn % TURN));
    const lat = lonlat[k + 1] / DEGREES;
    const x = Math.cos(moved) * Math.cos(lat);
    const z = Math.sin(lat);
    const up = Math.asin(Math.max(-1, Math.min(1, z * upright + x * across)));
    const along = Math.atan2(Math.sin(moved) * Math.cos(lat), x * upright - z * across);
    const scale = 1 + Math.cos(along) * Math.cos(up);
    xy[k] = (Math.cos(up) * Math.sin(along)) / scale;
    xy[k + 1] = -Math.sin(up) / scale;
    const square = xy[k] * xy[k] + xy[k + 1] * xy[k + 1];
    if (square <= 1e32) most = Math.max(most, square);
    else far.push(k);
  }
  // Three more places as far as the first one make a square around all.
  const edge = 1e6 * Math.sqrt(most);
  for (const k of far) xy.set([edge, 0], k);
  xy.set([0, edge, -edge, 0, 0, -edge], size);
  return sweepHull(xy).triangles.map((site) => (2 * site < size ? site : 0));
}

/** Triangulation and cells as indices of places and centers. */
export interface GeoDelaunay {
  /** The triangulation itself. */
  delaunay: ListedDelaunay;
  /** Edges of triangles that are smaller than a hemisphere: [from, to]. */
  edges: [number, number][];
  /** Triangles, clockwise. */
  triangles: [number, number, number][];
  /** Circumcentres of the triangles, then what cells of fewer than three vertices need besides. */
  centers: Place[];
  /** Neighbours of each site. */
  neighbors: number[][];
  /** Centers around each site, clockwise; undefined where a site has no cell. */
  polygons: (number[] | undefined)[];
  /** Sides of the polygons, each once. */
  mesh: [number, number][];
  /** Sites around those that lie in a hemisphere, clockwise; empty if they do not. */
  hull: number[];
  /** Whether each edge, by its length, is in the Urquhart graph: is not the longest one of a triangle. */
  urquhart(distances: ArrayLike<number>): boolean[];
  /** The nearest site. */
  find(lon: number, lat: number, node?: number): number;
}

/** Polygons as one array: of each site the centers from its start to before the next one's. */
interface Cells extends Pick<GeoDelaunay, "centers" | "neighbors"> {
  starts: Int32Array;
  ring: Int32Array;
}

/** The triangulation of places [longitude, latitude]; what is not asked for is not made. */
export function geoDelaunay(places: readonly (readonly [number, number])[]): GeoDelaunay {
  const lonlat = new Float64Array(2 * places.length);
  for (let k = 0; k < places.length; ++k) {
    lonlat[2 * k] = places[k][0];
    lonlat[2 * k + 1] = places[k][1];
  }
  const delaunay = new ListedDelaunay(lonlat);
  const geo: GeoDelaunay = lazy<GeoDelaunay>({
    delaunay: () => delaunay.listed(),
    edges: () => edgesOf(geo.delaunay),
    triangles: () => clockwise(geo.delaunay.simplices),
    centers: () => geo.delaunay.cells.centers,
    neighbors: () => geo.delaunay.cells.neighbors,
    polygons: () => polygonsOf(geo.delaunay.cells),
    mesh: () => meshOf(geo.polygons),
    hull: () => hullOf(geo.delaunay),
    urquhart: () => (distances) => urquhart(geo.delaunay, geo.edges, distances),
    find: () => (lon, lat) => delaunay.nearest(lonlatToXyz([lon, lat]))[0],
  });
  return geo;
}

function clockwise(corners: Int32Array): [number, number, number][] {
  const rows: [number, number, number][] = [];
  for (let k = 0; k < corners.length; k += 3) rows.push([corners[k], corners[k + 2], corners[k + 1]]);
  return rows;
}

/** Sides of triangles given counterclockwise, triangle by triangle, clockwise from the first corner. */
const clockwiseSides = (corners: Int32Array): [number, number][] =>
  clockwise(corners).flatMap(([a, c, b]): [number, number][] => [[a, c], [c, b], [b, a]]); // prettier-ignore

/** Longitudes and latitudes of unit vectors, by the engine's own arctangent: within some 3e-14 degrees, in a third of the kernel's time. */
export function placesOf(xyz: Float64Array): Place[] {
  const places: Place[] = new Array(xyz.length / 3);
  for (let k = 0; k < places.length; ++k) {
    const x = xyz[3 * k];
    const y = xyz[3 * k + 1];
    places[k] = [Math.atan2(y, x) * DEGREES, Math.atan2(xyz[3 * k + 2], Math.sqrt(x * x + y * y)) * DEGREES];
  }
  return places;
}

const DEGREES = 180 / Math.PI;
const TURN = 2 * Math.PI;

/** Those of triangles smaller than a hemisphere, triangle by triangle; without triangles neighbours on the great circle. */
function edgesOf(delaunay: ListedDelaunay): [number, number][] {
  const edges: [number, number][] = [];
  const { simplices, neighbors, closing } = delaunay;
  const add = (i: number, j: number): void => void edges.push(i < j ? [i, j] : [j, i]);
  if (delaunay.dimension < 2) {
    const circle = delaunay.flatOrder;
    circle.forEach((i, k) => (k > 0 || circle.length > 2) && add(i, circle.at(k - 1)!));
  }
  for (let row = 0; row < simplices.length; row += 3) {
    if (closing[row / 3] === 1) continue;
    for (let k = 0; k < 3; ++k) {
      const opposite = row + (k === 2 ? 2 : 1 - k);
      const other = neighbors[opposite]; // has the edge already if it comes earlier
      if (other >= row / 3 || closing[other] === 1) add(simplices[following(opposite)], simplices[preceding(opposite)]);
    }
  }
  return edges;
}

/** Cells clockwise, one center a triangle, and the sites beyond their sides: around each site triangles lie near in memory. */
function cellsOf(delaunay: ListedDelaunay): Cells {
  const { simplices: corners, neighbors: beyond, size } = delaunay;
  if (corners.length <= 6) return lunesOf(delaunay);
  const first = new Int32Array(size);
  const starts = new Int32Array(size + 1);
  for (let e = corners.length - 1; e >= 0; --e) {
    first[corners[e]] = e;
    ++starts[corners[e] + 1];
  }
  const ring = new Int32Array(corners.length);
  const neighbors: number[][] = new Array(size);
  for (let site = 0; site < size; ++site) {
    const around: number[] = new Array(starts[site + 1]);
    starts[site + 1] += starts[site];
    for (let k = 0, face = Math.floor(first[site] / 3); k < around.length; ++k) {
      ring[starts[site] + k] = face;
      const e = 3 * face;
      const before = corners[e] === site ? e + 2 : corners[e + 1] === site ? e : e + 1;
      around[k] = corners[before];
      face = beyond[before];
    }
    neighbors[site] = around;
  }
  if (size <= MOST) {
    first.fill(0);
    corners.forEach((site, e) => (neighbors[site][first[site]++] = corners[preceding(e)]));
  }
  return { centers: placesOf(delaunay.circumcenters), neighbors, starts, ring };
}

/** Of sites on one circle: each cell between its two poles, by way of a middle on either side. */
function lunesOf(delaunay: ListedDelaunay): Cells {
  const { points, size, dimension, simplices } = delaunay;
  const neighbors = Array.from({ length: size }, (): number[] => []);
  const polygons = neighbors.map((): number[] => []);
  const flat = dimension < 2;
  const circle = dimension < 1 ? [] : Array.from(flat ? delaunay.flatOrder : simplices.subarray(0, 3));
  const xyz = flat ? new SphericalVoronoi(delaunay).vertices : delaunay.circumcenters;
  let centers: Vector[] = dimension < 1 ? [] : [vector(xyz, 0), vector(xyz, 1)];
  const sides = flat ? edgesOf(delaunay).flatMap(([i, j]) => [[i, j], [j, i]]) : clockwiseSides(simplices); // prettier-ignore
  for (const [i, j] of sides) neighbors[i].push(j);
  // The middle between each site of the circle, which is counterclockwise about the first pole, and the next one.
  const middles = circle.map((i, k) => {
    const [a, b] = [i, circle[(k + 1) % circle.length]].map((site) => vector(points, site));
    const quarter = cross(centers[0], a);
    const sum = a.map((x, axis) => x + b[axis]) as Vector;
    const side = dot(sum, quarter);
    const length = Math.sign(side) * Math.hypot(...sum);
    return Math.abs(side) < 1e-9 * Math.abs(length) || length === 0 ? quarter : (sum.map((x) => x / length) as Vector);
  });
  if (circle.length === 2) {
    const near = dot(middles[0], vector(points, circle[0])) < 0 ? 1 : 0;
    const axis = cross(middles[near], centers[near]);
    centers = [middles[near]];
    while (centers.length < 4) centers.push(cross(centers[centers.length - 1], axis)); // quarter turns
    [polygons[circle[near]], polygons[circle[1 - near]]] = [[0, 1, 2, 3], [3, 2, 1, 0]]; // prettier-ignore
  } else {
    const numbers: number[] = [];
    const number = (k: number): number => (numbers[k] ??= centers.push(middles[k]) - 1);
    for (const site of circle.slice().sort((i, j) => i - j)) {
      const k = circle.indexOf(site);
      const last = number((k || circle.length) - 1);
      polygons[site] = [0, number(k), 1, last];
    }
  }
  const starts = new Int32Array(size + 1);
  polygons.forEach((polygon, site) => (starts[site + 1] = starts[site] + polygon.length));
  const ring = Int32Array.from(polygons.flat());
  return { centers: placesOf(Float64Array.from(centers.flat())), neighbors, starts, ring };
}

const polygonsOf = ({ neighbors, starts, ring }: Cells): GeoDelaunay["polygons"] =>
  neighbors.map((_, k) => {
    return starts[k] < starts[k + 1] ? Array.from(ring.subarray(starts[k], starts[k + 1])) : undefined;
  });

function meshOf(polygons: GeoDelaunay["polygons"]): [number, number][] {
  const sides: [number, number][] = [];
  for (const ring of polygons) ring?.reduce((p, q) => (q > p && sides.push([p, q]), q), ring[ring.length - 1]);
  return sides;
}

/** Closer to its longest side, in radians, a site of a triangle is on it as far as doubles can tell: two ulps of coordinates. */
const FLAT = 2 ** -51;

export const vector = (xyz: Float64Array, k: number): Vector => [xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]];
const dot = ([x, y, z]: Vector, [u, v, w]: Vector): number => x * u + y * v + z * w;
const difference = ([x, y, z]: Vector, [u, v, w]: Vector): Vector => [x - u, y - v, z - w];
const cross = ([x, y, z]: Vector, [u, v, w]: Vector): Vector => [y * w - z * v, z * u - x * w, x * v - y * u];

type Vector = [number, number, number];

/** Sides of the triangles that close the hull, and of flat ones beside them, clockwise; the last one begins, as there. */
function hullOf({ points, simplices, neighbors, closing }: ListedDelaunay): number[] {
  const outside = closing.slice();
  const faces = Array.from(closing.keys()).filter((face) => closing[face] === 1);
  for (const face of faces) {
    for (const inner of neighbors.subarray(3 * face, 3 * face + 3)) {
      const [a, b, c] = [0, 1, 2].map((k) => vector(points, simplices[3 * inner + k]));
      const sides = [difference(b, a), difference(c, a), difference(c, b)];
      const longest = Math.max(...sides.map((side) => Math.hypot(...side)));
      if (outside[inner] === 1 || Math.abs(dot(cross(sides[0], sides[1]), a)) > FLAT * longest) continue;
      outside[inner] = 1;
      faces.push(inner);
    }
  }
  const border = new Map<number, [number, number]>();
  for (const face of faces.sort((i, j) => i - j)) {
    for (const [to, from] of clockwiseSides(simplices.subarray(3 * face, 3 * face + 3))) {
      if (!border.delete(from * 2 ** 26 + to)) border.set(to * 2 ** 26 + from, [from, to]);
    }
  }
  const next = new Map(border.values());
  const hull = new Set<number>();
  for (let at = [...next.keys()].pop(); at !== undefined && !hull.has(at); at = next.get(at)) hull.add(at);
  return [...hull];
}

function urquhart(
  { simplices, closing }: ListedDelaunay,
  edges: [number, number][],
  distances: ArrayLike<number>,
): boolean[] {
  const lengths = new Map(edges.map(([i, j], k) => [key(i, j), distances[k]]));
  const longest = new Set<number>();
  closing.forEach((flag, face) => {
    const sides = clockwiseSides(simplices.subarray(3 * face, 3 * face + 3)).map(([i, j]) => key(i, j));
    if (flag === 0) longest.add(sides.reduce((most, side) => (lengths.get(side)! > lengths.get(most)! ? side : most)));
  });
  return edges.map(([i, j]) => !longest.has(key(i, j)));
}

/** An edge as one number: points have numbers below 2^26. */
const key = (i: number, j: number): number => Math.min(i, j) * 2 ** 26 + Math.max(i, j);

// GeoJSON ------------------------------------------------------------------------------------------------------------

type Accessor<Datum> = (datum: Datum) => number;

/** Data of one kind, or a collection of features. */
export type GeoData<Datum> = readonly Datum[] | { type: "FeatureCollection"; features: readonly Datum[] };

interface OfSite<Datum> {
  site: Datum;
  sitecoordinates: Place;
  neighbours: number[];
}

/** The Voronoi diagram of data as GeoJSON; call it with data, or give data to its methods. */
export interface GeoVoronoi<Datum> {
  (data: GeoData<Datum>): GeoVoronoi<Datum>;
  /** The places of the data whose coordinates are finite, those data, and their triangulation. */
  points: Place[];
  valid: Datum[];
  delaunay: GeoDelaunay | null;
  /** Where a datum lies; by default its two first numbers, or a point of GeoJSON. */
  x: Setting<Accessor<Datum>, GeoVoronoi<Datum>>;
  y: Setting<Accessor<Datum>, GeoVoronoi<Datum>>;
  polygons(data?: GeoData<Datum>): Collection<OfSite<Datum>> | false;
  triangles(data?: GeoData<Datum>): Collection<{ circumcenter: Place }> | false;
  links(data?: GeoData<Datum>): Collection<{ source: Datum; target: Datum; length: number; urquhart: boolean }> | false;
  mesh(data?: GeoData<Datum>): MultiLineString | false;
  cellMesh(data?: GeoData<Datum>): MultiLineString | false;
  /** The nearest site, undefined if it is farther than `radius` degrees. */
  find(lon: number, lat: number, radius?: number): number | undefined;
  hull(data?: GeoData<Datum>): { type: "Polygon"; coordinates: Place[][] } | null;
}

/** The Voronoi diagram of places, of GeoJSON features, or, with accessors, of anything. */
export function geoVoronoi<Datum = Place>(data?: GeoData<Datum>): GeoVoronoi<Datum> {
  const [first, second]: Accessor<Datum>[] = [(datum) => placeOf(datum)[0], (datum) => placeOf(datum)[1]];

  const diagram = ((given: GeoData<Datum>) => {
    const items: readonly Datum[] = "features" in given ? given.features : given;
    const [x, y] = [diagram.x(), diagram.y()];
    const places = items.map((datum): Place => (x === first && y === second ? placeOf(datum) : [x(datum), y(datum)]));
    const isValid = (_: unknown, k: number): boolean => Number.isFinite(places[k][0]) && Number.isFinite(places[k][1]);
    Object.assign(diagram, { points: places.filter(isValid), valid: items.filter(isValid) });
    diagram.delaunay = geoDelaunay(diagram.points);
    return diagram;
  }) as GeoVoronoi<Datum>;

  /** A method that may get data, and is false without any. */
  const method =
    <T>(make: (made: GeoDelaunay) => T) =>
    (given?: GeoData<Datum>): T | false => {
      if (given !== undefined) diagram(given);
      return diagram.delaunay !== null && make(diagram.delaunay);
    };
  const mesh = (ends: [number, number][], places: Place[]): MultiLineString => {
    return { type: "MultiLineString", coordinates: ends.map(([i, j]) => [places[i], places[j]]) };
  };
  Object.assign(diagram, { points: [], valid: [], delaunay: null });
  [diagram.x, diagram.y] = [setting(diagram, first), setting(diagram, second)];

  diagram.polygons = method(({ delaunay }) => {
    const { points, valid } = diagram;
    const { centers, neighbors, starts, ring } = delaunay.cells;
    const features = points.map((sitecoordinates, k) => {
      const [start, size] = [starts[k], starts[k + 1] - starts[k]];
      let geometry: Geometry | null = delaunay.dimension === 0 && k === 0 ? { type: "Sphere" } : null;
      if (size > 0) {
        const places: Place[] = new Array(size + 1); // of known length: half as fast again as one that grows
        for (let corner = 0; corner < size; ++corner) places[corner] = centers[ring[start + corner]];
        places[size] = places[0];
        geometry = { type: "Polygon", coordinates: [places] };
      }
      return feature(geometry, { site: valid[k], sitecoordinates, neighbours: neighbors[k] });
    });
    return collection(features);
  });
  diagram.triangles = method(({ triangles, centers, delaunay: { closing } }) => {
    const features = triangles.map((corners, t) =>
      feature(polygon(corners.map((site) => diagram.points[site])), { circumcenter: centers[t] }),
    );
    return collection(features.filter((_, t) => closing[t] === 0));
  });
  diagram.links = method(({ edges, urquhart: kept, delaunay: { points: xyz } }) => {
    const { points, valid } = diagram;
    const lengths = edges.map(([i, j]) => angle(vector(xyz, i), vector(xyz, j)));
    const urquhart = kept(lengths);
    const features = edges.map(([i, j], k) => {
      const properties = { source: valid[i], target: valid[j], length: lengths[k], urquhart: urquhart[k] };
      return feature({ type: "LineString", coordinates: [points[i], points[j]] }, properties);
    });
    return collection(features);
  });
  diagram.mesh = method(({ edges }) => mesh(edges, diagram.points));
  diagram.cellMesh = method((made) => mesh(made.mesh, made.centers));
  diagram.find = (lon, lat, radius) => {
    const found = diagram.delaunay?.find(lon, lat);
    if (found === undefined || !radius) return found;
    const xyz = lonlatToXyz([lon, lat, ...diagram.points[found]]);
    return angle(vector(xyz, 0), vector(xyz, 1)) * DEGREES < radius ? found : undefined;
  };
  diagram.hull = (given) => {
    if (given !== undefined) diagram(given);
    const ring = diagram.delaunay?.hull.map((site) => diagram.points[site]) ?? [];
    return ring.length > 0 ? polygon(ring) : null;
  };
  return data === undefined ? diagram : diagram(data);
}

const collection = <T>(features: Feature<T>[]): Collection<T> => ({ type: "FeatureCollection", features });

const feature = <T>(geometry: Geometry | null, properties: T): Feature<T> => ({
  type: "Feature",
  geometry,
  properties,
});

const polygon = (ring: Place[]) => ({ type: "Polygon" as const, coordinates: [[...ring, ring[0]]] });

/** The angle between two unit vectors in radians. */
export function angle(a: Vector, b: Vector): number {
  return 2 * Math.atan2(Math.hypot(...difference(a, b)), Math.hypot(a[0] + b[0], a[1] + b[1], a[2] + b[2]));
}

/** The first two numbers of an array, of a point of GeoJSON or of a feature that is one. */
function placeOf(datum: unknown): Place {
  let found = datum as { geometry?: unknown; coordinates?: unknown } | null;
  if (found?.geometry !== undefined) found = found.geometry as typeof found;
  const at = (found?.coordinates ?? found ?? []) as readonly (number | null)[];
  return [numberOf(at[0]), numberOf(at[1])];
}

const numberOf = (value: number | null): number => (value === null ? NaN : Number(value));
