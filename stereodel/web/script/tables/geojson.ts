/** Points of GeoJSON: a collection, a feature alone, or a sequence of features. */

import { onEarth } from "./coordinates.ts";
import { TableError } from "./delimited.ts";

/** Places (n, 2) of points, and their names where features have a property `name`. */
export function geojsonPoints(text: string): { places: Float64Array; names: string[] | null } {
  const collection = document(text);
  const features = member(collection, "type") === "Feature" ? [collection] : member(collection, "features");
  if (!Array.isArray(features)) throw new TableError("the file is not a GeoJSON FeatureCollection of points");
  refuseOtherSystems(collection);
  const places = onEarth(Float64Array.from(features.flatMap((feature, k) => position(feature, k + 1))));
  const names = features.map((feature) => member(member(feature, "properties"), "name"));
  return {
    places,
    names: names.some((name) => typeof name === "string") ? names.map((name) => String(name ?? "")) : null,
  };
}

/** What an object of JSON has by a name; undefined of anything else. */
function member(value: unknown, name: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[name] : undefined;
}

/** A document of JSON, or a sequence of features (RFC 8142, or one a line) as a collection. */
function document(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    const lines = text.split("\n").map((line) => line.replace(/^[\x1e \t\r]+|[\x1e \t\r]+$/g, ""));
    try {
      if (!lines[0].endsWith("}")) throw error;
      return { features: lines.filter((line) => line !== "").map((line) => JSON.parse(line) as unknown) };
    } catch {
      throw new TableError(`the file is not JSON: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
}

/** The place of a feature, which is a point or several points of which there is one. */
function position(feature: unknown, row: number): number[] {
  const geometry = member(feature, "geometry");
  const [kind, coordinates] = [member(geometry, "type"), member(geometry, "coordinates")];
  const isOneOfMany = kind === "MultiPoint" && Array.isArray(coordinates) && coordinates.length === 1;
  if (kind !== "Point" && !isOneOfMany) {
    throw new TableError(`row ${row}: a Point is needed, not ${typeof kind === "string" ? kind : "no geometry"}`);
  }
  const place: unknown = isOneOfMany ? coordinates[0] : coordinates;
  const pair = Array.isArray(place) ? place.slice(0, 2) : [];
  if (pair.length < 2 || !pair.every(Number.isFinite)) {
    throw new TableError(`row ${row}: a Point has two or three numbers, not ${JSON.stringify(place)}`);
  }
  return pair;
}

/** Coordinate systems as GeoJSON named them before RFC 7946: the page has none but degrees. */
function refuseOtherSystems(collection: unknown): void {
  const crs = member(collection, "crs") ?? null;
  if (crs === null) return;
  const name = String(member(member(crs, "properties"), "name"));
  if (/(CRS84|EPSG::4326|EPSG:4326)$/i.test(name)) return;
  throw new TableError(
    `the file is in ${name}; the page reads longitude and latitude, the Python library transforms others`,
  );
}
