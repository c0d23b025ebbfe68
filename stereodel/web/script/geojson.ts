/**
 * Regions of the sphere as GeoJSON (RFC 7946): outer rings counterclockwise, cut at ±180° and led along ±90°
 * around the poles. Sides are great circles, sampled so that no chord is longer than a degree.
 */

import { along } from "./drawing/ball.ts";
import type { Region } from "./drawing/parts.ts";
import { cornersOf } from "./drawing/pen.ts";
import type { Latitude } from "./kernel/api.ts";
import { tableLonlat } from "./kernel/coordinates.ts";
import { lonLatOf, type Vector } from "./space.ts";

/** Digits behind the point of a degree: a centimetre of the Earth. */
const DECIMALS = 7;

type Position = [number, number];
type Polygon = Position[][];

type Geometry = { type: "Polygon"; coordinates: Polygon } | { type: "MultiPolygon"; coordinates: Polygon[] };

/** A collection as text, a feature a line. @param kind Of the latitudes that are written. */
export function geojson(regions: readonly Region[], kind: Latitude = "spherical"): string {
  const rows = regions.map(({ properties, corners }) => {
    const geometry = corners.length === 0 ? WHOLE_SPHERE : sphericalPolygon(corners, kind);
    return JSON.stringify({ type: "Feature", properties, geometry });
  });
  return `{"type":"FeatureCollection","features":[\n${rows.join(",\n")}\n]}\n`;
}

/** All of the sphere, which has no side. */
const WHOLE_SPHERE: Geometry = { type: "Polygon", coordinates: [[...cornersOf(-180, -90, 180, 90), [-180, -90]]] };

/**
 * The region on the left of a ring of great-circle sides, at most a hemisphere.
 * @param corners three or more, counterclockwise seen from outside.
 */
function sphericalPolygon(corners: readonly Vector[], kind: Latitude): Geometry {
  const ring = unwrapped(
    corners.flatMap((corner, k) => along(corner, corners[(k + 1) % corners.length])),
    kind,
  );
  const turn = Math.round((ring[ring.length - 1][0] - ring[0][0]) / 360);
  const digits = (degrees: number): number => Number(degrees.toFixed(DECIMALS));
  const pieces = windows(ring, turn).map((polygon): Polygon => [
    polygon.map(([lon, lat]) => [digits(lon), digits(lat)]),
  ]);
  return pieces.length === 1
    ? { type: "Polygon", coordinates: pieces[0] }
    : { type: "MultiPolygon", coordinates: pieces };
}

/** Longitudes and latitudes of a ring, closed, whose longitudes go on beyond ±180 instead of jumping. */
function unwrapped(points: readonly Vector[], kind: Latitude): Position[] {
  const lonlat = tableLonlat(Float64Array.from([...points, points[0]].flatMap(lonLatOf)), kind);
  const ring: Position[] = [];
  for (let k = 0; k < lonlat.length; k += 2) {
    const before = ring[ring.length - 1]?.[0] ?? lonlat[k];
    ring.push([lonlat[k] + 360 * Math.round((before - lonlat[k]) / 360), lonlat[k + 1]]);
  }
  return ring;
}

function crossing(a: Position, b: Position, lon: number): number {
  return a[0] === b[0] ? a[1] : a[1] + ((lon - a[0]) / (b[0] - a[0])) * (b[1] - a[1]);
}

/**
 * The parts of a ring in each window of 360°, each moved to [−180, 180]. One that goes round the Earth is followed twice
 * and closed along the pole on its left, eastward the North Pole, so that there is one window which it fills.
 */
function windows(once: readonly Position[], turn: number): Position[][] {
  const again = once.slice(1).map(([lon, lat]): Position => [lon + 360 * turn, lat]);
  const [[begin], pole] = [once[0], 90 * turn];
  const ring: readonly Position[] =
    turn === 0 ? once : [...once, ...again, [begin + 720 * turn, pole], [begin, pole], once[0]];
  const ends = turn === 0 ? once.map(([lon]) => lon) : [begin, begin + 720 * turn];
  const least = (Math.min(...ends) + 180) / 360;
  const low = turn === 0 ? Math.floor(least) : Math.ceil(least);
  const high = turn === 0 ? Math.ceil((Math.max(...ends) + 180) / 360) : low + 1;
  const parts: Position[][] = [];
  for (let window = low; window < Math.max(high, low + 1); ++window) {
    const moved = ring.slice(0, -1).map(([lon, lat]): Position => [lon - 360 * window, lat]);
    const part = cut(cut(moved, -180, 1), 180, -1);
    if (part.length > 2) parts.push([...part, part[0]]);
  }
  return parts;
}

/** The part of a ring on one side of a meridian: east of it for `sign` 1, west for −1. */
function cut(ring: readonly Position[], meridian: number, sign: number): Position[] {
  const part: Position[] = [];
  ring.forEach((a, k) => {
    const b = ring[(k + 1) % ring.length];
    const [aIn, bIn] = [sign * (a[0] - meridian) >= 0, sign * (b[0] - meridian) >= 0];
    if (aIn) part.push(a);
    if (aIn !== bIn && a[0] !== meridian && b[0] !== meridian) part.push([meridian, crossing(a, b, meridian)]);
  });
  return part;
}
