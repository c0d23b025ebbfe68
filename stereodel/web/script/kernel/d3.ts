/**
 * `geoDelaunay`, `geoVoronoi` and `geoContour` with the methods of d3-geo-voronoi, on the exact kernel: places are pairs [longitude,
 * latitude] in degrees, results plain arrays and GeoJSON wound as d3-geo wants it, clockwise. Call `load` of the package
 * before. What differs from d3-geo-voronoi, and why, is said in the documentation, docs/javascript.md.
 */

import { lonlatToXyz } from "./coordinates.ts";
import { SphericalDelaunay } from "./delaunay.ts";
import { ordered, type Faces } from "./d3_order.ts";
import { lazy } from "./lazy.ts";
import { SphericalVoronoi } from "./voronoi.ts";

export { geoContour, type ContourPolygon, type Contours } from "./contours.ts";

/** Longitude and latitude in degrees. */
export type Place = [number, number];

/** What is drawn: an object of GeoJSON. */
interface Feature<Properties> {
  type: "Feature";
  geometry: { type: string; coordinates?: Place[][] | Place[] } | null;
  properties: Properties;
}

interface Collection<Properties> {
  type: "FeatureCollection";
  features: Feature<Properties>[];
}

interface MultiLineString {
  type: "MultiLineString";
  coordinates: [Place, Place][];
}

/** The exact triangulation, and what d3-delaunay has of it besides: triangles in the order of all results here. */
export class ListedDelaunay extends SphericalDelaunay {
  private readonly lonlat: Float64Array;
  private listed: Faces | null = null;
  private around: Cells | null = null;

  constructor(lonlat: Float64Array) {
    super(lonlatToXyz(lonlat));
    this.lonlat = lonlat;
  }

  /** @internal Triangles, what lies beyond them, and their centers. */
  get faces(): Faces {
    return (this.listed ??= ordered(this, this.lonlat));
  }

  /** @internal What lies around each site. */
  get cells(): Cells {
    return (this.around ??= cellsOf(this));
  }

  /** Three sites each, counterclockwise. */
  get triangles(): Int32Array {
    return this.faces.corners;
  }

  /** Of each side of a triangle, from its first site on, the same side of the triangle beyond it. */
  get halfedges(): Int32Array {
    const { corners, beyond } = this.faces;
    return corners.map((_, e) => {
      const row = 3 * beyond[before(e)];
      return row + corners.subarray(row, row + 3).indexOf(corners[after(e)]);
    });
  }
}

/** @internal The corner after one of a triangle. */
export const after = (corner: number): number => (corner % 3 === 2 ? corner - 2 : corner + 1);
const before = (corner: number): number => (corner % 3 === 0 ? corner + 2 : corner - 1);

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
    delaunay: () => delaunay,
    edges: () => edgesOf(delaunay),
    triangles: () => clockwise(delaunay.triangles),
    centers: () => delaunay.cells.centers,
    neighbors: () => delaunay.cells.neighbors,
    polygons: () => polygonsOf(delaunay.cells),
    mesh: () => meshOf(geo.polygons),
    hull: () => hullOf(delaunay),
    urquhart: () => (distances) => urquhart(delaunay, geo.edges, distances),
    find: () => (lon, lat) => delaunay.nearest(lonlatToXyz([lon, lat]))[0],
  });
  return geo;
}

// Loops rather than Array.from, which takes several times as long.

function clockwise(numbers: Int32Array): [number, number, number][] {
  const rows: [number, number, number][] = [];
  for (let k = 0; k < numbers.length; k += 3) rows.push([numbers[k], numbers[k + 2], numbers[k + 1]]);
  return rows;
}

function pairs(numbers: ArrayLike<number>): [number, number][] {
  const rows: [number, number][] = [];
  for (let k = 0; k < numbers.length; k += 2) rows.push([numbers[k], numbers[k + 1]]);
  return rows;
}

/** Sides of triangles given counterclockwise, triangle by triangle, clockwise from the first corner. */
function clockwiseSides(corners: Int32Array): [number, number][] {
  const sides: [number, number][] = [];
  for (let row = 0; row < corners.length; row += 3) {
    const [a, b, c] = [corners[row], corners[row + 1], corners[row + 2]];
    sides.push([a, c], [c, b], [b, a]);
  }
  return sides;
}

/** Longitudes and latitudes of unit vectors, by the engine's own arctangent: within some 3e-14 degrees, in a third of the kernel's time. */
export function placesOf(xyz: Float64Array): Place[] {
  const places: Place[] = new Array(xyz.length / 3);
  for (let k = 0; k < places.length; ++k) {
    const [x, y, z] = [xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]];
    places[k] = [Math.atan2(y, x) * DEGREES, Math.atan2(z, Math.sqrt(x * x + y * y)) * DEGREES];
  }
  return places;
}

const DEGREES = 180 / Math.PI;

/** Those of triangles smaller than a hemisphere, triangle by triangle; without triangles neighbours on the great circle. */
function edgesOf(delaunay: ListedDelaunay): [number, number][] {
  if (delaunay.dimension < 2) {
    const around = pairs(new SphericalVoronoi(delaunay).ridgePoints);
    return around.filter(([i, j], k) => k === 0 || around[k - 1][0] !== i || around[k - 1][1] !== j);
  }
  const { corners, beyond, closing } = delaunay.faces;
  const edges: [number, number][] = [];
  for (let row = 0; row < corners.length; row += 3) {
    if (closing[row / 3] === 1) continue;
    for (const opposite of [row + 1, row, row + 2]) {
      const other = beyond[opposite]; // has the edge already if it comes earlier
      if (other < row / 3 && closing[other] === 0) continue;
      const [i, j] = [corners[after(opposite)], corners[before(opposite)]];
      edges.push(i < j ? [i, j] : [j, i]);
    }
  }
  return edges;
}

/** Cells clockwise, one center a triangle, and the sites beyond their sides: around each site triangles lie near in memory. */
function cellsOf(delaunay: ListedDelaunay): Cells {
  const { corners, beyond, centers, listed } = delaunay.faces;
  if (corners.length <= 6) return lunesOf(delaunay);
  const first = new Int32Array(delaunay.size);
  const starts = new Int32Array(delaunay.size + 1);
  for (let e = corners.length - 1; e >= 0; --e) {
    first[corners[e]] = e;
    ++starts[corners[e] + 1];
  }
  const ring = new Int32Array(corners.length);
  const neighbors: number[][] = new Array(delaunay.size);
  for (let site = 0; site < first.length; ++site) {
    const around: number[] = new Array(starts[site + 1]);
    starts[site + 1] += starts[site];
    for (let k = 0, row = first[site] - (first[site] % 3); k < around.length; ++k) {
      const at = corners[row] === site ? 0 : corners[row + 1] === site ? 1 : 2;
      ring[starts[site] + k] = row / 3;
      const last = row + (at === 0 ? 2 : at - 1);
      around[k] = corners[last];
      row = 3 * beyond[at === 2 ? row + 1 : at === 1 ? row : row + 2];
    }
    neighbors[site] = around;
  }
  if (listed) {
    const filled = first.fill(0);
    for (const [i, j] of clockwiseSides(corners)) neighbors[i][filled[i]++] = j;
  }
  return { centers: placesOf(centers), neighbors, starts, ring };
}

/** Without triangles, or with three sites: each cell between two poles, by way of a middle on either side. */
function lunesOf(delaunay: ListedDelaunay): Cells {
  const neighbors = Array.from({ length: delaunay.size }, (): number[] => []);
  const polygons = neighbors.map((): number[] => []);
  const cells = (centers: number[][]): Cells => {
    const starts = new Int32Array(delaunay.size + 1);
    polygons.forEach((polygon, site) => (starts[site + 1] = starts[site] + polygon.length));
    return {
      centers: placesOf(Float64Array.from(centers.flat())),
      neighbors,
      starts,
      ring: Int32Array.from(polygons.flat()),
    };
  };
  if (delaunay.dimension < 1) return cells([]);
  const flat = delaunay.dimension < 2;
  const sides = flat
    ? edgesOf(delaunay).flatMap(([i, j]) => [
        [i, j],
        [j, i],
      ])
    : clockwiseSides(delaunay.triangles);
  for (const [i, j] of sides) neighbors[i].push(j);
  const diagram = new SphericalVoronoi(delaunay);
  const [ridges, ends, normals] = [pairs(diagram.ridgePoints), pairs(diagram.ridgeVertices), diagram.ridgeNormals()];
  const row = (rows: Float64Array, k: number): Float64Array => rows.subarray(3 * k, 3 * k + 3);
  const poles = [row(diagram.vertices, 0), row(diagram.vertices, 1)];
  // The middle between two sites if it lies well on their ridge, or that of the ridge.
  const middles = ridges.map(([i, j], k) => {
    const quarter = cross(row(normals, k), poles[ends[k][0]]);
    const sum = row(delaunay.points, i).map((x, axis) => x + delaunay.points[3 * j + axis]);
    const side = dot(sum, quarter);
    const length = Math.sign(side) * Math.hypot(...sum);
    return Math.abs(side) < 1e-9 * Math.abs(length) || length === 0 ? quarter : [...sum].map((x) => x / length);
  });
  if (ridges.length === 2) {
    const [[i, j]] = ridges;
    const near = dot(middles[0], row(delaunay.points, i)) < 0 ? 1 : 0;
    const axis = cross(middles[near], poles[ends[near][1]]);
    const corners = [middles[near]];
    while (corners.length < 4) corners.push(cross(corners[corners.length - 1], axis)); // quarter turns
    [polygons[i], polygons[j]] = [
      [0, 1, 2, 3],
      [3, 2, 1, 0],
    ];
    return cells(corners);
  }
  // Of three sites the poles are the centers of both triangles in their order.
  const far = flat || delaunay.faces.centers[0] === poles[0][0] ? 0 : 1;
  ridges.forEach(([i, j], k) => {
    // The ridge runs counterclockwise around i and clockwise around j, backwards in a polygon that is clockwise.
    for (const [site, start] of [
      [i, ends[k][1]],
      [j, ends[k][0]],
    ]) {
      if (polygons[site].length === 0) polygons[site] = [0, 0, 1, 0];
      polygons[site][start === far ? 1 : 3] = k;
    }
  });
  const points = [poles[far], poles[1 - far]].map((pole) => [...pole]);
  const numbers = new Map<number, number>();
  for (const ring of polygons) {
    for (const at of ring.length === 0 ? [] : [3, 1]) {
      const middle = ring[at];
      if (!numbers.has(middle)) numbers.set(middle, points.push(middles[middle]) - 1);
      ring[at] = numbers.get(middle)!;
    }
  }
  return cells(points);
}

function polygonsOf({ starts, ring }: Cells): GeoDelaunay["polygons"] {
  const polygons: GeoDelaunay["polygons"] = [];
  for (let k = 0; k + 1 < starts.length; ++k) {
    const cell = Array.from(ring.subarray(starts[k], starts[k + 1]));
    polygons.push(cell.length > 0 ? cell : undefined);
  }
  return polygons;
}

function meshOf(polygons: (number[] | undefined)[]): [number, number][] {
  const mesh: [number, number][] = [];
  for (const polygon of polygons) {
    if (polygon === undefined) continue;
    let p = polygon[polygon.length - 1];
    for (const q of polygon) {
      if (q > p) mesh.push([p, q]);
      p = q;
    }
  }
  return mesh;
}

/** Closer to a side of the hull, in radians, a site is on it as far as doubles can tell: two ulps of its coordinates. */
const ON_SIDE = 2 ** -51;

/** The facets that are no triangles of the hull: those that close it, and slivers of three sites on one of its sides. */
function outsideOf({ points, faces: { corners, beyond, closing } }: ListedDelaunay): Uint8Array {
  const outside = closing.slice();
  const onHull = new Uint8Array(points.length / 3);
  const open: number[] = [];
  closing.forEach((flag, face) => flag === 1 && open.push(face));
  for (const face of open) for (let e = 3 * face; e < 3 * face + 3; ++e) onHull[corners[e]] = 1;
  for (let face = open.pop(); face !== undefined; face = open.pop()) {
    for (let e = 3 * face; e < 3 * face + 3; ++e) {
      const [u, v, inner] = [corners[after(e)], corners[before(e)], beyond[e]];
      if (outside[inner] === 1) continue;
      const apex = corners.subarray(3 * inner, 3 * inner + 3).find((corner) => corner !== u && corner !== v)!;
      if (onHull[apex] === 1 || height(points, u, v, apex) > ON_SIDE) continue;
      outside[inner] = onHull[apex] = 1;
      open.push(inner);
    }
  }
  return outside;
}

/** The sine of the angle between the third point and the great circle through two. */
function height(points: Float64Array, i: number, j: number, k: number): number {
  const row = (at: number): Float64Array => points.subarray(3 * at, 3 * at + 3);
  const a = row(i);
  const [b, c] = [j, k].map((at) => row(at).map((x, axis) => x - a[axis]));
  const normal = cross(a, b);
  return Math.abs(dot(normal, c)) / Math.hypot(...normal);
}

const dot = ([x, y, z]: Float64Array | number[], [u, v, w]: Float64Array | number[]): number => x * u + y * v + z * w;

function cross(
  [x, y, z]: ArrayLike<number> & Iterable<number>,
  [u, v, w]: ArrayLike<number> & Iterable<number>,
): Vector {
  return [y * w - z * v, z * u - x * w, x * v - y * u];
}

type Vector = [number, number, number];

/** Clockwise; the outer facets add their sides one by one, which settles the first corner. */
function hullOf(delaunay: ListedDelaunay): number[] {
  const { corners } = delaunay.faces;
  const border = new Map<string, [number, number]>();
  outsideOf(delaunay).forEach((flag, face) => {
    if (flag === 0) return;
    const [a, b, c] = corners.subarray(3 * face, 3 * face + 3);
    for (const [from, to] of [
      [c, a],
      [b, c],
      [a, b],
    ]) {
      if (!border.delete(`${to} ${from}`)) border.set(`${from} ${to}`, [from, to]);
    }
  });
  const next = new Map(border.values());
  const first = [...next.keys()].pop();
  const hull: number[] = [];
  for (let at = first; at !== undefined && (at !== first || hull.length === 0); at = next.get(at)) hull.push(at);
  return hull;
}

function urquhart(delaunay: ListedDelaunay, edges: [number, number][], distances: ArrayLike<number>): boolean[] {
  const lengths = new Map(edges.map(([i, j], k) => [key(i, j), distances[k]]));
  const longest = new Set<number>();
  const { corners, closing } = delaunay.faces;
  closing.forEach((flag, face) => {
    const [a, b, c] = corners.subarray(3 * face, 3 * face + 3);
    const sides = [key(a, c), key(c, b), key(b, a)];
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
  x(): Accessor<Datum>;
  x(accessor: Accessor<Datum>): GeoVoronoi<Datum>;
  y(): Accessor<Datum>;
  y(accessor: Accessor<Datum>): GeoVoronoi<Datum>;
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
  const at = [first, second];

  const diagram = ((given: GeoData<Datum>) => {
    const items = "features" in given ? given.features : given;
    const [x, y] = at;
    [diagram.points, diagram.valid] = [[], []];
    for (const datum of items) {
      const place: Place = x === first && y === second ? placeOf(datum) : [x(datum), y(datum)];
      if (!Number.isFinite(place[0]) || !Number.isFinite(place[1])) continue;
      diagram.points.push(place);
      diagram.valid.push(datum);
    }
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
  const accessor = (axis: 0 | 1): GeoVoronoi<Datum>["x"] =>
    ((given?: Accessor<Datum>) => {
      if (given === undefined) return at[axis];
      at[axis] = given;
      return diagram;
    }) as GeoVoronoi<Datum>["x"];
  const segments = (ends: [Place, Place][]): MultiLineString => ({ type: "MultiLineString", coordinates: ends });
  const collection = <T>(features: Feature<T>[]): Collection<T> => ({ type: "FeatureCollection", features });

  diagram.points = [];
  diagram.valid = [];
  diagram.delaunay = null;
  [diagram.x, diagram.y] = [accessor(0), accessor(1)];

  // Plain loops over arrays of known length: functions per feature take half as long again.
  diagram.polygons = method(({ delaunay }) => {
    const { points, valid } = diagram;
    const { centers, neighbors, starts, ring } = delaunay.cells;
    const features: Feature<OfSite<Datum>>[] = new Array(points.length);
    for (let k = 0; k < points.length; ++k) {
      const [start, size] = [starts[k], starts[k + 1] - starts[k]];
      let geometry: Feature<unknown>["geometry"] = delaunay.dimension === 0 && k === 0 ? { type: "Sphere" } : null;
      if (size > 0) {
        const places: Place[] = new Array(size + 1);
        for (let corner = 0; corner < size; ++corner) places[corner] = centers[ring[start + corner]];
        places[size] = places[0];
        geometry = { type: "Polygon", coordinates: [places] };
      }
      const properties = { site: valid[k], sitecoordinates: points[k], neighbours: neighbors[k] };
      features[k] = { type: "Feature", geometry, properties };
    }
    return collection(features);
  });
  diagram.triangles = method(({ triangles, centers, delaunay: { faces } }) => {
    const features = triangles.map((corners, t): Feature<{ circumcenter: Place }> => {
      const geometry = polygon(corners.map((corner) => diagram.points[corner]));
      return { type: "Feature", properties: { circumcenter: centers[t] }, geometry };
    });
    const { closing } = faces;
    return collection(features.filter((_, t) => closing[t] === 0));
  });
  diagram.links = method(({ edges, urquhart: kept, delaunay: { points } }) => {
    const lengths = edges.map(([i, j]) => angle(points.subarray(3 * i, 3 * i + 3), points.subarray(3 * j, 3 * j + 3)));
    const urquhart = kept(lengths);
    return collection(
      edges.map(([i, j], k) => ({
        type: "Feature",
        properties: { source: diagram.valid[i], target: diagram.valid[j], length: lengths[k], urquhart: urquhart[k] },
        geometry: { type: "LineString", coordinates: [diagram.points[i], diagram.points[j]] },
      })),
    );
  });
  diagram.mesh = method(({ edges }) => segments(edges.map(([i, j]) => [diagram.points[i], diagram.points[j]])));
  diagram.cellMesh = method(({ mesh, centers }) => segments(mesh.map(([p, q]) => [centers[p], centers[q]])));
  diagram.find = (lon, lat, radius) => {
    const found = diagram.delaunay?.find(lon, lat);
    if (found === undefined || !radius) return found;
    const xyz = lonlatToXyz([lon, lat, ...diagram.points[found]]);
    return angle(xyz.subarray(0, 3), xyz.subarray(3)) * DEGREES < radius ? found : undefined;
  };
  const hull = method((made) => made.hull.map((site) => diagram.points[site]));
  diagram.hull = (given) => {
    const ring = hull(given);
    return ring && ring.length > 0 ? polygon(ring) : null;
  };
  return data === undefined ? diagram : diagram(data);
}

const polygon = (ring: Place[]): { type: "Polygon"; coordinates: Place[][] } => {
  return { type: "Polygon", coordinates: [[...ring, ring[0]]] };
};

/** The angle between two unit vectors in radians. */
function angle([x, y, z]: Float64Array, [u, v, w]: Float64Array): number {
  return 2 * Math.atan2(Math.hypot(x - u, y - v, z - w), Math.hypot(x + u, y + v, z + w));
}

/** The first two numbers of an array, of a point of GeoJSON or of a feature that is one. */
function placeOf(datum: unknown): Place {
  if (Array.isArray(datum) && typeof datum[0] === "number" && typeof datum[1] === "number") return [datum[0], datum[1]];
  if (datum === null || typeof datum !== "object") return [NaN, NaN];
  const { geometry = datum } = datum as { geometry?: unknown };
  const { coordinates = geometry } = (geometry ?? {}) as { coordinates?: unknown };
  if (!Array.isArray(coordinates)) return [NaN, NaN];
  const [lon, lat] = (coordinates as unknown[]).slice(0, 2).map((value) => (value === null ? NaN : Number(value)));
  return [lon ?? NaN, lat ?? NaN];
}
