/** Points of GeoJSON, as `stereodel.io.read_points` takes them. */

import { TableError } from "./error.ts";
import { lonLatPlaces } from "./numbers.ts";
import { repr } from "./python.ts";

type Json = Record<string, unknown>;

function isObject(value: unknown): value is Json {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Places (n, 2) of a collection of points, and their names where features have a property `name`. */
export function geojsonPoints(text: string): { lonlat: Float64Array; names: string[] | null } {
  const collection = document(text);
  const alone = isObject(collection) && collection["type"] === "Feature";
  const features = alone ? [collection] : isObject(collection) ? collection["features"] : undefined;
  if (!Array.isArray(features)) throw new TableError("the file is not a GeoJSON FeatureCollection of points");
  features.forEach((feature, k) => {
    const known = isObject(feature) && (!("type" in feature) || feature["type"] === "Feature");
    if (!known || !isObject(feature["properties"] || {})) {
      throw new TableError(`row ${k + 1}: is not a GeoJSON Feature with properties by name; see RFC 7946`);
    }
  });
  const positions = (features as Json[]).map((feature, k) => position(feature["geometry"], k + 1));
  refuseOtherSystems(collection as Json);
  const lonlat = lonLatPlaces(
    positions.map(([lon]) => lon),
    positions.map(([, lat]) => lat),
  );
  const names = (features as Json[]).map((feature) => ((feature["properties"] ?? {}) as Json)["name"]);
  return {
    lonlat,
    names: names.some((name) => typeof name === "string") ? names.map((name) => String(name ?? "")) : null,
  };
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

function position(geometry: unknown, row: number): [unknown, unknown] {
  let kind = isObject(geometry) ? geometry["type"] : "no geometry";
  let coordinates = isObject(geometry) ? geometry["coordinates"] : null;
  if (kind === "MultiPoint" && Array.isArray(coordinates) && coordinates.length === 1) {
    kind = "Point";
    coordinates = coordinates[0];
  }
  if (kind !== "Point") {
    const advice = kind === "no geometry" ? "; leave such rows out with skip_missing" : "; take e.g. centroids first";
    throw new TableError(`row ${row}: a Point is needed, not ${typeof kind === "string" ? kind : repr(kind)}${advice}`);
  }
  if (isEmpty(coordinates)) return [null, null];
  const isText = (value: unknown): boolean => typeof value === "string";
  if (!Array.isArray(coordinates) || coordinates.length < 2 || coordinates.slice(0, 2).some(isText)) {
    throw new TableError(`row ${row}: a Point has two or three coordinates, not ${repr(coordinates)}`);
  }
  return [coordinates[0], coordinates[1]];
}

function isEmpty(value: unknown): boolean {
  if (Array.isArray(value)) return value.length === 0;
  return !value || (isObject(value) && Object.keys(value).length === 0);
}

/** Coordinate systems as GeoJSON named them before RFC 7946: the page has none but degrees. */
function refuseOtherSystems(collection: Json): void {
  const crs = collection["crs"];
  if (crs === undefined || crs === null) return;
  const properties = isObject(crs) ? crs["properties"] : null;
  const name = isObject(properties) ? properties["name"] : null;
  if (typeof name !== "string") {
    throw new TableError(`the member crs of the file is ${repr(crs)}, which names no coordinate system`);
  }
  if (/(CRS84|EPSG::4326|EPSG:4326)$/.test(name.toUpperCase())) return;
  throw new TableError(
    `the file is in ${name}; the page reads longitude and latitude, the Python library transforms others`,
  );
}
