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
  const closed = turn === 0 ? ring : aroundPole(ring, turn);
  const digits = (degrees: number): number => Number(degrees.toFixed(DECIMALS));
  const pieces = windows(closed).map((polygon): Polygon => [polygon.map(([lon, lat]) => [digits(lon), digits(lat)])]);
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

/** A ring that goes once round the Earth, from −180 to 180, closed along the pole that lies inside. */
function aroundPole(ring: readonly Position[], turn: number): Position[] {
  const pole = turn > 0 ? 90 : -90; // eastward with the region on the left: the North Pole
  const east = turn > 0 ? [...ring] : [...ring].reverse();
  const begin = 360 * Math.ceil((east[0][0] - 180) / 360) + 180; // the first ±180° on the way
  const k = east.findIndex(([lon]) => lon >= begin);
  const at = crossing(east[Math.max(0, k - 1)], east[k === -1 ? east.length - 1 : k], begin);
  const rest = east.slice(Math.max(k, 0), -1).map(([lon, lat]): Position => [lon - begin - 180, lat]);
  const first = east.slice(0, Math.max(k, 0)).map(([lon, lat]): Position => [lon - begin + 180, lat]);
  const across: Position[] = [[-180, at], ...rest, ...first, [180, at]];
  const line = turn > 0 ? across : across.reverse();
  return [...line, [line[line.length - 1][0], pole], [line[0][0], pole], line[0]];
}

function crossing(a: Position, b: Position, lon: number): number {
  return a[0] === b[0] ? a[1] : a[1] + ((lon - a[0]) / (b[0] - a[0])) * (b[1] - a[1]);
}

/** The parts of a closed ring in each window of 360°, each moved to [−180, 180]. */
function windows(ring: readonly Position[]): Position[][] {
  const longitudes = ring.map(([lon]) => lon);
  const low = Math.floor((Math.min(...longitudes) + 180) / 360);
  const high = Math.ceil((Math.max(...longitudes) + 180) / 360);
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
