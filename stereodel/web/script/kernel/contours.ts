/** `geoContour`: where values at sites of the sphere reach thresholds, by linear interpolation along the edges of triangles. */

import { angle, geoDelaunay, placesOf, setting, vector, type ListedDelaunay, type Place, type Setting } from "./d3.ts";
import { following } from "./topology.ts";

/** Where values are at least `value`, and below `valueMax` if that is given; wound as d3-geo wants it. */
export interface ContourPolygon {
  type: "MultiPolygon";
  /** One polygon of all rings; without any where the boundary is empty: nowhere or everywhere. */
  coordinates: Place[][][];
  value: number;
  valueMax?: number;
}

type Accessor<Datum> = (datum: Datum, index: number) => number;

/** Contours of data; call it with them. */
export interface Contours<Datum> {
  (data: readonly Datum[]): ContourPolygon[];
  /** Where a datum lies and what it is worth: by default its first three numbers. */
  x: Setting<Accessor<Datum>, Contours<Datum>>;
  y: Setting<Accessor<Datum>, Contours<Datum>>;
  value: Setting<Accessor<Datum>, Contours<Datum>>;
  /** Thresholds, or about how many; round numbers, some ten, unless set. */
  thresholds: Setting<readonly number[] | number | undefined, Contours<Datum>>;
  /** One threshold after the other. */
  contours(data: readonly Datum[]): Generator<ContourPolygon>;
  contour(data: readonly Datum[], threshold: number): ContourPolygon;
  /** What lies between each threshold and the next one. */
  isobands(data: readonly Datum[]): Generator<ContourPolygon>;
}

/** Contours of values at places. */
export function geoContour<Datum = [number, number, number]>(): Contours<Datum> {
  const number = (datum: Datum, axis: number): number => Number((datum as ArrayLike<number>)[axis]);

  /** The rings of a threshold, and the thresholds. */
  function surface(data: readonly Datum[]): { rings: (threshold: number) => Place[][]; thresholds: readonly number[] } {
    const [x, y, value, thresholds] = [contours.x(), contours.y(), contours.value(), contours.thresholds()];
    const values = data.map(value);
    const wrong = values.findIndex((each) => !Number.isFinite(each));
    if (wrong >= 0)
      throw new RangeError(`the value of datum ${wrong} is ${values[wrong]}, which is not a finite number`);
    const delaunay = geoDelaunay(data.map((d, k) => [x(d, k), y(d, k)])).delaunay;
    return {
      rings: (threshold) => ringsAt(delaunay, values, threshold),
      thresholds: typeof thresholds === "object" ? thresholds : roundThresholds(values, thresholds ?? 10),
    };
  }
  const region = (rings: Place[][], value: number): ContourPolygon => {
    return { type: "MultiPolygon", coordinates: [rings], value };
  };

  function* regions(data: readonly Datum[]): Generator<ContourPolygon> {
    const { rings, thresholds } = surface(data);
    for (const value of thresholds) yield region(rings(value), value);
  }
  const contours = ((data: readonly Datum[]) => [...regions(data)]) as Contours<Datum>;
  contours.contours = regions;
  contours.contour = (data, threshold) => region(surface(data).rings(threshold), threshold);
  contours.isobands = function* (data) {
    const { rings, thresholds } = surface(data);
    let low: Place[][] = [];
    for (const [k, valueMax] of thresholds.entries()) {
      const high = rings(valueMax);
      const band = [...low, ...high.map((ring) => [...ring].reverse())];
      if (k > 0) yield { ...region(band, thresholds[k - 1]), valueMax };
      low = high;
    }
  };
  const by = (accessor: Accessor<Datum>) => setting(contours, accessor);
  contours.x = by((datum) => number(datum, 0));
  contours.y = by((datum) => number(datum, 1));
  contours.value = by((datum) => (Number.isFinite(number(datum, 2)) ? number(datum, 2) : 0));
  contours.thresholds = setting(contours, undefined as readonly number[] | number | undefined);
  return contours;
}

/** Rings around what is at least a threshold: from triangle to triangle, each by the side that goes up, once. */
function ringsAt(delaunay: ListedDelaunay, values: number[], threshold: number): Place[][] {
  const { triangles, halfedges } = delaunay;
  const up = (e: number): boolean => values[triangles[e]] < threshold && values[triangles[following(e)]] >= threshold;
  const visited = new Uint8Array(triangles.length);
  const rings: Place[][] = [];
  for (let first = 0; first < triangles.length; ++first) {
    const ring: number[] = [];
    for (let e = first; visited[e] === 0 && up(e);) {
      visited[e] = 1;
      ring.push(e);
      e = following(halfedges[e]);
      if (!up(e)) e = following(e);
    }
    if (ring.length === 0) continue;
    const xyz = ring.flatMap((e) => {
      const [i, j] = [triangles[e], triangles[following(e)]];
      return between(delaunay.points, i, j, (threshold - values[i]) / (values[j] - values[i]));
    });
    const places = placesOf(Float64Array.from(xyz));
    rings.push([...places, places[0]].reverse());
  }
  return rings;
}

/** The point at a part of the way between two. */
function between(points: Float64Array, i: number, j: number, part: number): number[] {
  const [a, b] = [vector(points, i), vector(points, j)];
  const whole = angle(a, b);
  const [one, other] = [1 - part, part].map((fraction) => Math.sin(fraction * whole) / Math.sin(whole));
  return a.map((x, axis) => one * x + other * b[axis]);
}

/** About so many round numbers from below the least value to above the greatest one. */
function roundThresholds(values: number[], count: number): number[] {
  let [low, high] = values.reduce(([least, most], x) => [Math.min(least, x), Math.max(most, x)], [Infinity, -Infinity]);
  if (!(low < high)) return low === high ? [low] : [];
  for (let [step, last] = [roundStep((high - low) / 10), NaN]; step !== last;) {
    [low, high] = [multiple(Math.floor(parts(low, step)), step), multiple(Math.ceil(parts(high, step)), step)];
    [step, last] = [roundStep((high - low) / 10), step];
  }
  const step = roundStep((high - low) / count);
  const [from, to] = [Math.ceil(parts(low, step)), Math.floor(parts(high, step))];
  return Array.from({ length: to - from + 1 }, (_, k) => multiple(from + k, step));
}

/** 1, 2 or 5 times a power of ten near a number. */
function roundStep(width: number): number {
  const power = 10 ** Math.floor(Math.log10(width));
  const error = width / power;
  return power * (error >= Math.sqrt(50) ? 10 : error >= Math.sqrt(10) ? 5 : error >= Math.SQRT2 ? 2 : 1);
}

// Steps below 1 have inverses that are whole numbers, and they are not.
const multiple = (k: number, step: number): number => (step < 1 ? k / Math.round(1 / step) : k * step);
const parts = (value: number, step: number): number => (step < 1 ? value * Math.round(1 / step) : value / step);
