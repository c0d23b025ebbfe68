/**
 * Files of points that the reader picks or drops: read here, sent nowhere.
 * Delimited text and GeoJSON, in which `stereodel.io.read_points` finds the same places.
 */

import { find, make } from "./dom.ts";
import type { RoomName } from "./link.ts";
import type { RoomHost } from "./room.ts";
import { findXY, numberColumns, placesOf } from "./tables/coordinates.ts";
import { readTable, TableError, type PlacedTable, type TextTable } from "./tables/delimited.ts";
import { geojsonPoints } from "./tables/geojson.ts";
import { findLonLat, NOT_WESTERN } from "./tables/words.ts";
import { counted } from "./words.ts";

/** Points that the page takes. */
export const MOST_POINTS = 1_000_000;

/** Points of a file: (n, 2), longitude and latitude in degrees or x and y; rows without a place are left out. */
export interface Points {
  readonly file: string;
  readonly places: Float64Array;
  /** Those of a column `name`. */
  readonly names: readonly string[] | null;
  /** Other columns of numbers, NaN where one is missing. */
  readonly values: ReadonlyMap<string, Float64Array>;
  /** How many rows are left out, and in words what is wrong with the first. */
  readonly leftOut: number;
  readonly wrong: string;
}

/** Which coordinates are wanted: of the Earth or of a plane. */
export type Kind = "lonlat" | "plane";

/** Another room shows what the file has. @see RoomHost.pass */
interface Elsewhere {
  readonly room: RoomName;
  readonly columns?: [string, string];
}

/**
 * Reads points from the bytes of a file.
 * @param chosen names of the two columns, where they are known.
 * @throws TableError in words for the reader.
 */
export function readPoints(
  file: string,
  content: Uint8Array,
  kind: Kind,
  chosen?: [string, string],
): Points | Elsewhere {
  const text = decoded(content, file);
  const isJson = /^\s*[{[]/.test(text);
  if (isJson && kind === "plane") return { room: "globe" };
  const read = isJson ? geojsonPoints(text) : ofText(text, kind, chosen);
  if ("room" in read) return read;
  const { places, table, axes = [] } = read;
  const { count, wrong } = table;
  if (count === 0) throw new TableError("there are no points");
  if (count > MOST_POINTS) {
    const most = `the page takes up to ${counted(MOST_POINTS)}; for more there is the Python library`;
    throw new TableError(`there are ${counted(count)} points; ${most}`);
  }
  const said = wrong.size === 0 ? "" : wrongWords(table);
  if (wrong.size === count) throw new TableError(said);
  const isKept = (_: unknown, row: number): boolean => !wrong.has(row);
  const columns = new Map([...table.columns].map(([name, cells]) => [name, cells.filter(isKept)]));
  const name = [...columns.keys()].find((each) => each.trim().toLowerCase() === "name") ?? "";
  return {
    file,
    places: places.filter((_, k) => isKept(0, k >> 1)),
    names: columns.get(name) ?? null,
    values: numberColumns(columns, new Set([...axes, name])),
    leftOut: wrong.size,
    wrong: said,
  };
}

/** How many rows are wrong, and why the first is. */
function wrongWords({ count, wrong }: TextTable): string {
  const first = [...wrong.keys()].reduce((least, row) => Math.min(least, row));
  const many = wrong.size === count ? "No row can" : `${counted(wrong.size)} of ${counted(count)} rows cannot`;
  return `${many} be placed. Row ${counted(first + 1)}: ${wrong.get(first)}`;
}

function ofText(text: string, kind: Kind, chosen?: [string, string]): Elsewhere | PlacedTable {
  const table = readTable(text);
  const all = [...table.columns.keys()];
  const sure = table.isHeaded ? findLonLat(all, true) : null;
  const axes = chosen ?? (kind === "lonlat" ? findLonLat(all) : findXY(all));
  if (axes === null && sure !== null) return { room: "globe" };
  if (axes === null) throw new TableError("the table has no two columns of coordinates", all);
  const places = placesOf(table, kind, axes);
  // Numbers of a plane, where no name says that they are degrees.
  const beyond = [...table.wrong.keys()].filter((row) => Number.isFinite(places[2 * row] + places[2 * row + 1]));
  if (kind === "lonlat" && sure === null && 2 * beyond.length > table.count) return { room: "lift", columns: axes };
  return { places, table, axes };
}

/** Text in UTF-8, UTF-16 or, by its letters, windows-1252; all else is for the library. */
function decoded(bytes: Uint8Array, file: string): string {
  const head = String.fromCharCode(...bytes.subarray(0, 2));
  const utf16 = /^(\xff\xfe|[^\0]\0)/.test(head) ? "utf-16le" : /^(\xfe\xff|\0)/.test(head) ? "utf-16be" : null;
  const tried = utf16 === null ? ["utf-8", "windows-1252"] : [utf16];
  for (const encoding of tried) {
    try {
      const text = new TextDecoder(encoding, { fatal: true }).decode(bytes);
      const isGuess = encoding === "windows-1252";
      if (!/\0|^\s*</.test(text) && !(isGuess && NOT_WESTERN.test(text))) return text; // XML, or no text
    } catch {} // not in this encoding
  }
  const typed = /^[\w.-]+$/.test(file) ? file : `"${file}"`;
  const what = "neither a picture nor a table in text that the page can read";
  throw new TableError(`${what}; to make a page of it, type: stereodel web ${typed}`);
}

/** Calls `opened` with the points of a file, or says why not; the reader may be asked for columns, or about wrong rows. */
export async function openPoints(
  file: File,
  kind: Kind,
  host: RoomHost,
  opened: (points: Points) => void,
  chosen?: [string, string],
): Promise<void> {
  if (file.type.startsWith("image/")) return host.pass("globe", file);
  const { messages } = host;
  const named = `${file.name}:`;
  const unchanged = (said: string): string => `${said}${/[.?!]$/.test(said) ? "" : "."} Nothing has changed.`;
  try {
    const points = readPoints(file.name, new Uint8Array(await file.arrayBuffer()), kind, chosen);
    if ("room" in points) return host.pass(points.room, file, points.columns);
    const { leftOut, wrong } = points;
    const open = (): void => {
      messages.close();
      opened(points);
    };
    if (leftOut === 0) return open();
    const rows = leftOut === 1 ? "this row" : `these ${counted(leftOut)} rows`;
    messages.show(named, unchanged(wrong), { words: `Open without ${rows}`, act: open });
  } catch (error) {
    if (!(error instanceof TableError)) throw error;
    const { message, columns } = error;
    if (columns.length < 2) return messages.show(named, unchanged(message));
    const labels = (kind === "lonlat" ? ["Longitude", "Latitude"] : ["x", "y"]).map((axis, k) => {
      const select = make("select", "", ...columns.map((name) => make("option", "", name)));
      select.selectedIndex = k;
      return make("label", "field column", `${axis} `, select);
    });
    const open = (): Promise<void> => {
      const [first, second] = labels.map((label) => find<HTMLSelectElement>(label, "select").value);
      return openPoints(file, kind, host, opened, [first, second]);
    };
    messages.show(`Which columns of ${file.name}?`, "", { words: "Open", act: () => void open() }, labels);
  }
}
