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
  const bytes = await unpacked(content);
  const isJson = JSON_TEXT.test(file) || (!TEXT.test(file) && beginsAs(bytes, "{"));
  if (!isJson && !TEXT.test(file) && isBinary(bytes))
    throw new TableError("this is not a table, GeoJSON or a 2 : 1 picture");
  const text = decoded(bytes);
  const found = isJson ? ofGeojson(text, kind) : ofText(text, kind, chosen);
  const count = found.places.length / 2;
  if (count > MOST_POINTS) {
    const most = `the page takes up to ${counted(MOST_POINTS)}; for more there is the Python library`;
    throw new TableError(`there are ${counted(count)} points; ${most}`);
  }
  return { file, ...found };
}

function ofGeojson(text: string, kind: Kind): Omit<Points, "file"> {
  if (kind === "plane") throw new TableError("columns of a plane are those of tables, not of GeoJSON");
  return geojsonPoints(text);
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

function beginsAs(bytes: Uint8Array, mark: string): boolean {
  const start = new TextDecoder("latin1").decode(bytes.subarray(0, 64)).replace(/^(\u00ef\u00bb\u00bf|\s|\x1e)+/, "");
  return start.startsWith(mark);
}

/** Whether the first bytes are no text: a zero that no mark of UTF-16 explains. */
function isBinary(bytes: Uint8Array): boolean {
  return !isUtf16(bytes) && bytes.subarray(0, 1024).includes(0);
}

function isUtf16(bytes: Uint8Array): boolean {
  return (bytes[0] === 0xff && bytes[1] === 0xfe) || (bytes[0] === 0xfe && bytes[1] === 0xff);
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
  if (isUtf16(bytes)) return new TextDecoder(bytes[0] === 0xff ? "utf-16le" : "utf-16be").decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    throw new TableError("the file is not text in UTF-8; save it in that encoding");
  }
}

const UNCHANGED = "Nothing has changed.";

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
    if (error instanceof ColumnsError && error.names.length > 1) {
      const kinds: [string, string] = kind === "lonlat" ? ["Longitude", "Latitude"] : ["x", "y"];
      askColumns(file.name, error.names, kinds, messages, (names) => {
        void openPoints(file, kind, messages, opened, names);
      });
    } else {
      messages.show(...complaint(file.name, error));
    }
    return;
  }
  messages.close();
  opened(points);
}

/** Asks which columns of a file are meant; `chosen` gets two names. */
function askColumns(
  file: string,
  names: readonly string[],
  kinds: readonly [string, string],
  messages: Messages,
  chosen: (names: [string, string]) => void,
): void {
  const selects = kinds.map((_, k) => {
    const select = make("select", "", ...names.map((name) => make("option", "", name)));
    select.selectedIndex = Math.min(k, names.length - 1);
    return select;
  });
  const open = { words: "Open", act: () => chosen([selects[0].value, selects[1].value]) };
  const inputs = kinds.map((kind, k) => make("label", "field column", `${kind} `, selects[k]));
  messages.show(`Which columns of ${file}?`, "", open, inputs);
}

/** A message's beginning and its words: the file, the row where there is one, then what is wrong. */
function complaint(file: string, error: unknown): [string, string] {
  if (!(error instanceof TableError)) return [`${file}:`, `the file cannot be read. ${UNCHANGED}`];
  const [, place, rest] = /^((?:row|line) \d+): (.*)$/s.exec(error.message) ?? [];
  const words = rest ?? error.message;
  const stop = /[.?!]$/.test(words) ? "" : ".";
  return [place === undefined ? `${file}:` : `${file}, ${place}:`, `${words}${stop} ${UNCHANGED}`];
}
