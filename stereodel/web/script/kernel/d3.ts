/**
 * `geoDelaunay` and `geoVoronoi` with the methods of d3-geo-voronoi, on the exact kernel: places are pairs [longitude,
 * latitude] in degrees, results plain arrays and GeoJSON wound as d3-geo wants it, clockwise. Call `load` of the package
 * before.
 *
 * Where d3-geo-voronoi has no answer there is one: sites within a city, on one great circle, opposite ones, and equal
 * ones, of which the later have neither cell nor neighbours.
 */

import { lonlatToXyz, xyzToLonlat } from "./coordinates.ts";
import { SphericalDelaunay } from "./delaunay.ts";
import { lazy } from "./lazy.ts";
import { adjacencyOf } from "./topology.ts";
import { SphericalVoronoi } from "./voronoi.ts";

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

/** Triangulation and cells as indices of places and centers. */
export interface GeoDelaunay {
  /** The triangulation itself. */
  delaunay: SphericalDelaunay;
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

type Cells = Pick<GeoDelaunay, "centers" | "polygons">;

/** The triangulation of places [longitude, latitude]; what is not asked for is not made. */
export function geoDelaunay(places: readonly (readonly [number, number])[]): GeoDelaunay {
  const lonlat = new Float64Array(2 * places.length);
  places.forEach(([lon, lat], k) => lonlat.set([lon, lat], 2 * k));
  const delaunay = SphericalDelaunay.fromLonlat(lonlat);
  const cells = lazy({ all: () => cellsOf(delaunay) });
  const geo: GeoDelaunay = lazy<GeoDelaunay>({
    delaunay: () => delaunay,
    edges: () => edgesOf(delaunay),
    triangles: () => clockwise(delaunay.simplices),
    centers: () => cells.all.centers,
    neighbors: () => neighborsOf(delaunay),
    polygons: () => cells.all.polygons,
    mesh: () => meshOf(cells.all.polygons),
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

const placesOf = (xyz: ArrayLike<number>): Place[] => pairs(xyzToLonlat(xyz));

/** Those of triangles smaller than a hemisphere; without triangles neighbours on the great circle. */
function edgesOf(delaunay: SphericalDelaunay): [number, number][] {
  if (delaunay.dimension < 2) {
    const around = pairs(new SphericalVoronoi(delaunay).ridgePoints);
    return around.filter(([i, j], k) => k === 0 || around[k - 1][0] !== i || around[k - 1][1] !== j);
  }
  const edges = pairs(delaunay.edges);
  if (delaunay.closing.every((flag) => flag === 0)) return edges;
  const open = new Set<number>();
  for (const sides of openTriangles(delaunay)) for (const side of sides) open.add(side);
  return edges.filter(([i, j]) => open.has(key(i, j)));
}

/** An edge as one number: points have numbers below 2^26. */
const key = (i: number, j: number): number => Math.min(i, j) * 2 ** 26 + Math.max(i, j);

/** Sides, as numbers, of the triangles that are smaller than a hemisphere. */
function* openTriangles({ simplices, closing }: SphericalDelaunay): Generator<number[]> {
  for (let t = 0; t < closing.length; ++t) {
    const [a, b, c] = [simplices[3 * t], simplices[3 * t + 1], simplices[3 * t + 2]];
    if (closing[t] === 0) yield [key(a, b), key(b, c), key(c, a)];
  }
}

function neighborsOf(delaunay: SphericalDelaunay): number[][] {
  const edges = delaunay.dimension < 2 ? Int32Array.from(edgesOf(delaunay).flat()) : delaunay.edges;
  const { indptr, indices } = adjacencyOf(edges, delaunay.size);
  const neighbors: number[][] = [];
  for (let k = 0; k < delaunay.size; ++k) {
    const row: number[] = [];
    for (let at = indptr[k]; at < indptr[k + 1]; ++at) row.push(indices[at]);
    neighbors.push(row);
  }
  return neighbors;
}

/** Clockwise, one center a triangle; where a cell has only two, the middles of its sides between them. */
function cellsOf(delaunay: SphericalDelaunay): Cells {
  const polygons: Cells["polygons"] = new Array(delaunay.size).fill(undefined);
  if (delaunay.dimension < 1) return { centers: [], polygons };
  if (delaunay.simplices.length <= 6) return lunes(delaunay, polygons);
  const { simplices, neighbors } = delaunay;
  for (let first = 0; first < simplices.length; ++first) {
    const site = simplices[first];
    if (polygons[site] !== undefined) continue;
    const cell: number[] = [];
    for (let t = Math.floor(first / 3), at = first % 3; cell.length === 0 || t !== cell[0];) {
      cell.push(t);
      t = neighbors[3 * t + ((at + 2) % 3)]; // beyond the edge from the site: the next one clockwise
      at = simplices[3 * t] === site ? 0 : simplices[3 * t + 1] === site ? 1 : 2;
    }
    polygons[site] = cell;
  }
  return { centers: placesOf(delaunay.circumcenters), polygons };
}

/** All sites on one circle: cells between its two poles. */
function lunes(delaunay: SphericalDelaunay, polygons: Cells["polygons"]): Cells {
  const diagram = new SphericalVoronoi(delaunay);
  const [ridges, ends, normals] = [pairs(diagram.ridgePoints), pairs(diagram.ridgeVertices), diagram.ridgeNormals()];
  // Triangles count their centers first: those of three sites are both poles.
  const poles = delaunay.dimension === 2 ? Array.from(diagram.simplexVertex) : [0, 1];
  const points = poles.flatMap((pole) => [...diagram.vertices.subarray(3 * pole, 3 * pole + 3)]);
  ends.forEach(([start], k) => {
    const [x, y, z] = diagram.vertices.subarray(3 * start, 3 * start + 3);
    const [a, b, c] = normals.subarray(3 * k, 3 * k + 3);
    points.push(b * z - c * y, c * x - a * z, a * y - b * x); // a quarter turn along the ridge
  });
  ridges.forEach(([i, j], k) => {
    // The ridge runs counterclockwise around i and clockwise around j, backwards in a polygon that is clockwise.
    const [start, end] = ends[k].map((vertex) => poles.indexOf(vertex));
    polygons[i] = joined(polygons[i], [end, 2 + k, start]);
    polygons[j] = joined(polygons[j], [start, 2 + k, end]);
  });
  return { centers: placesOf(points), polygons };
}

/** A polygon of two chains, each from pole to pole. */
function joined(first: number[] | undefined, second: number[]): number[] {
  return first === undefined ? second : [...first.slice(0, 2), ...second.slice(0, 2)];
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

function hullOf(delaunay: SphericalDelaunay): number[] {
  const before = new Map(pairs(delaunay.convexHull).map(([from, to]) => [to, from]));
  const hull: number[] = [];
  for (let next = before.keys().next().value; next !== undefined && !hull.includes(next); next = before.get(next)) {
    hull.push(next);
  }
  return hull;
}

function urquhart(delaunay: SphericalDelaunay, edges: [number, number][], distances: ArrayLike<number>): boolean[] {
  const lengths = new Map(edges.map(([i, j], k) => [key(i, j), distances[k]]));
  const longest = new Set<number>();
  for (const sides of openTriangles(delaunay)) {
    longest.add(sides.reduce((most, side) => (lengths.get(side)! > lengths.get(most)! ? side : most)));
  }
  return edges.map(([i, j]) => !longest.has(key(i, j)));
}

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
  const at: Accessor<Datum>[] = [(datum) => placeOf(datum)[0], (datum) => placeOf(datum)[1]];

  const diagram = ((given: GeoData<Datum>) => {
    const items = "features" in given ? given.features : given;
    const located = items.map((datum) => ({ datum, place: at.map((accessor) => accessor(datum)) as Place }));
    const valid = located.filter(({ place }) => place.every(Number.isFinite));
    diagram.points = valid.map(({ place }) => place);
    diagram.valid = valid.map(({ datum }) => datum);
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

  diagram.polygons = method(({ polygons, centers, neighbors, delaunay }) =>
    collection(
      diagram.points.map((place, k) => {
        const ring = polygons[k]?.map((center) => centers[center]);
        const alone = delaunay.dimension === 0 && k === 0;
        return {
          type: "Feature",
          geometry: ring ? polygon(ring) : alone ? { type: "Sphere" } : null,
          properties: { site: diagram.valid[k], sitecoordinates: place, neighbours: neighbors[k] },
        };
      }),
    ),
  );
  diagram.triangles = method(({ triangles, centers, delaunay: { closing } }) => {
    const features = triangles.map((corners, t): Feature<{ circumcenter: Place }> => {
      const geometry = polygon(corners.map((corner) => diagram.points[corner]));
      return { type: "Feature", properties: { circumcenter: centers[t] }, geometry };
    });
    return collection(features.filter((_, t) => closing[t] === 0));
  });
  diagram.links = method(({ edges, urquhart: kept }) => {
    const lengths = edges.map(([i, j]) => distance(diagram.points[i], diagram.points[j]));
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
    return distance([lon, lat], diagram.points[found]) * (180 / Math.PI) < radius ? found : undefined;
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

/** The angle between two places in radians. */
function distance(a: Place, b: Place): number {
  const [x, y, z, u, v, w] = lonlatToXyz([...a, ...b]);
  return 2 * Math.atan2(Math.hypot(x - u, y - v, z - w), Math.hypot(x + u, y + v, z + w));
}

/** The first two numbers of an array, of a point of GeoJSON or of a feature that is one. */
function placeOf(datum: unknown): Place {
  if (datum === null || typeof datum !== "object") return [NaN, NaN];
  const { geometry = datum } = datum as { geometry?: unknown };
  const { coordinates = geometry } = (geometry ?? {}) as { coordinates?: unknown };
  if (!Array.isArray(coordinates)) return [NaN, NaN];
  const [lon, lat] = (coordinates as unknown[]).slice(0, 2).map((value) => (value === null ? NaN : Number(value)));
  return [lon ?? NaN, lat ?? NaN];
}
