/**
 * Files of points that the reader picks or drops: read here, sent nowhere.
 * Delimited text and GeoJSON, in which `stereodel.io.read_points` finds the same places.
 */

import { make } from "./dom.ts";
import type { Messages } from "./messages.ts";
import { findLonLat, findXY, lonLatPlaces, planePlaces } from "./tables/coordinates.ts";
import { ColumnsError, readTable, TableError } from "./tables/delimited.ts";
import { geojsonPoints } from "./tables/geojson.ts";
import { counted } from "./words.ts";

/** Points that the page takes. */
export const MOST_POINTS = 1_000_000;

const TEXT = /\.(csv|tsv|txt)(\.gz)?$/i;
const JSON_TEXT = /\.(geojson|json|geojsonl|geojsons)(\.gz)?$/i;

/** Points of a file: (n, 2), longitude and latitude in degrees or x and y, with names if it has such a column. */
export interface Points {
  readonly file: string;
  readonly places: Float64Array;
  readonly names: readonly string[] | null;
}

/** Which coordinates are wanted: of the Earth or of a plane. */
export type Kind = "lonlat" | "plane";

/**
 * Reads points from the bytes of a file.
 * @param chosen names of the two columns, where the reader was asked.
 * @throws TableError in words for the reader; ColumnsError where the columns must be chosen.
 */
export async function readPoints(
  file: string,
  content: Uint8Array,
  kind: Kind,
  chosen?: [string, string],
): Promise<Points> {
  const text = decoded(await unpacked(content));
  const isJson = JSON_TEXT.test(file) || (!TEXT.test(file) && /^[\s\x1e]*\{/.test(text));
  if (isJson && kind === "plane") throw new TableError("columns of a plane are those of tables, not of GeoJSON");
  const found = isJson ? geojsonPoints(text) : ofText(text, kind, chosen);
  const count = found.places.length / 2;
  if (count > MOST_POINTS) {
    const most = `the page takes up to ${counted(MOST_POINTS)}; for more there is the Python library`;
    throw new TableError(`there are ${counted(count)} points; ${most}`);
  }
  return { file, ...found };
}

function ofText(text: string, kind: Kind, chosen?: [string, string]): Omit<Points, "file"> {
  const table = readTable(text);
  const all = [...table.keys()];
  const pair = chosen ?? (kind === "lonlat" ? findLonLat(all) : findXY(all));
  if (pair === null) throw new ColumnsError(all);
  const places = kind === "lonlat" ? lonLatPlaces(table, ...pair) : planePlaces(table, ...pair);
  const named = all.find((name) => name.trim().toLowerCase() === "name");
  return { places, names: (named !== undefined && table.get(named)) || null };
}

async function unpacked(bytes: Uint8Array): Promise<Uint8Array> {
  if (!(bytes[0] === 0x1f && bytes[1] === 0x8b)) return bytes;
  try {
    const stream = new Blob([bytes.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new TableError("the compressed file is damaged");
  }
}

function decoded(bytes: Uint8Array): string {
  const mark = (bytes[0] << 8) | bytes[1];
  const encoding = mark === 0xfffe ? "utf-16le" : mark === 0xfeff ? "utf-16be" : "utf-8";
  try {
    return new TextDecoder(encoding, { fatal: true }).decode(bytes);
  } catch {
    throw new TableError("the file is neither text in UTF-8 nor a 2 : 1 picture; save tables in that encoding");
  }
}

/** Calls `opened` with the points of a file, or says why there are none; the reader may be asked for the columns. */
export async function openPoints(
  file: File,
  kind: Kind,
  messages: Messages,
  opened: (points: Points) => void,
  chosen?: [string, string],
): Promise<void> {
  let points: Points;
  try {
    points = await readPoints(file.name, new Uint8Array(await file.arrayBuffer()), kind, chosen);
  } catch (error) {
    const again = (...both: [string, string]): Promise<void> => openPoints(file, kind, messages, opened, both);
    if (error instanceof ColumnsError && error.names.length > 1)
      return askColumns(file.name, error.names, kind, messages, again);
    const said = error instanceof TableError ? error.message : "the file cannot be read";
    return messages.show(`${file.name}:`, `${said}${/[.?!]$/.test(said) ? "" : "."} Nothing has changed.`);
  }
  messages.close();
  opened(points);
}

/** Asks which columns of a file are meant; `chosen` gets two names. */
function askColumns(
  file: string,
  names: readonly string[],
  kind: Kind,
  messages: Messages,
  chosen: (first: string, second: string) => void,
): void {
  const kinds = kind === "lonlat" ? ["Longitude", "Latitude"] : ["x", "y"];
  const selects = kinds.map((_, k) => {
    const select = make("select", "", ...names.map((name) => make("option", "", name)));
    select.selectedIndex = Math.min(k, names.length - 1);
    return select;
  });
  const open = { words: "Open", act: () => chosen(selects[0].value, selects[1].value) };
  const inputs = kinds.map((kind, k) => make("label", "field column", `${kind} `, selects[k]));
  messages.show(`Which columns of ${file}?`, "", open, inputs);
}
