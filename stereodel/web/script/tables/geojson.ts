/** Points of GeoJSON: a collection, or a feature alone. */

import { onEarth } from "./coordinates.ts";
import { TableError, type PlacedTable } from "./delimited.ts";

/** Places (n, 2) of points, and the properties of the features as columns. */
export function geojsonPoints(text: string): PlacedTable {
  const collection = document(text);
  const features = member(collection, "type") === "Feature" ? [collection] : member(collection, "features");
  if (!Array.isArray(features)) throw new TableError("the file is not a GeoJSON FeatureCollection of points");
  const wrong = new Map<number, string>();
  const positions = features.map((feature, row) => {
    const found = position(feature);
    if (typeof found === "string") wrong.set(row, found);
    return typeof found === "string" ? [NaN, NaN] : found;
  });
  const places = onEarth(Float64Array.from(positions.flat()), wrong);
  const properties = features.map((feature) => member(feature, "properties"));
  const names = new Set(properties.flatMap((each) => Object.keys(each ?? {})));
  const columns = new Map([...names].map((name) => [name, properties.map((each) => cell(member(each, name)))]));
  return { places, table: { columns, count: features.length, isHeaded: true, wrong } };
}

function cell(value: unknown): string {
  return typeof value === "object" ? (JSON.stringify(value ?? undefined) ?? "") : String(value ?? "");
}

/** What an object of JSON has by a name; undefined of anything else. */
function member(value: unknown, name: string): unknown {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>)[name] : undefined;
}

function document(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new TableError(`the file is not JSON: ${error instanceof Error ? error.message : String(error)}`);
  }
}

/** The place of a feature, which is a point or several points of which there is one; or what is wrong with it. */
function position(feature: unknown): number[] | string {
  const geometry = member(feature, "geometry");
  const [kind, coordinates] = [member(geometry, "type"), member(geometry, "coordinates")];
  const isOneOfMany = kind === "MultiPoint" && Array.isArray(coordinates) && coordinates.length === 1;
  if (kind !== "Point" && !isOneOfMany)
    return `a Point is needed, not ${typeof kind === "string" ? kind : "no geometry"}`;
  const place: unknown = isOneOfMany ? coordinates[0] : coordinates;
  const pair = Array.isArray(place) ? place.slice(0, 2) : [];
  const isPair = pair.length === 2 && pair.every(Number.isFinite);
  return isPair ? pair : `a Point has two or three coordinates, not ${JSON.stringify(place)}`;
}
