/** Which columns are coordinates, and their cells as numbers; what is wrong is told with its row. */

import { TableError, type TextTable } from "./delimited.ts";

/** What people and programs write as a number. */
export const NUMBER = /^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i;

/** A number whose mark may be decimal or separate thousands. */
const GROUPED = /^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/;

/** What stands for no value, in any case. */
const MISSING = /^(?:na|n\/a|nan|null|none|<na>|-)?$/i;

/** Words for each, surest first. */
const LON = { sure: ["lon", "lng", "long", "longitude"], unsure: "x" };
const LAT = { sure: ["lat", "latitude"], unsure: "y" };

/** The columns of longitude and latitude: by their names, by a word in these, or x and y; null where they must be asked. */
export function findLonLat(names: readonly string[]): [string, string] | null {
  const found = [LON, LAT].map(({ sure, unsure }) => {
    const matches = [
      names.filter((name) => sure.includes(name.trim().toLowerCase())),
      names.filter((name) => words(name).some((word) => sure.includes(word))),
      names.filter((name) => name.trim().toLowerCase() === unsure),
    ].find((matching) => matching.length > 0);
    return matches?.length === 1 ? matches[0] : null;
  });
  const [lon, lat] = found;
  return lon === null || lat === null || lon === lat ? null : [lon, lat];
}

/** Columns of a plane: x and y in any case, or the only two; null where they must be asked. */
export function findXY(names: readonly string[]): [string, string] | null {
  const [x, y] = ["x", "y"].map((letter) => names.filter((name) => name.trim().toLowerCase() === letter));
  if (x.length === 1 && y.length === 1) return [x[0], y[0]];
  return names.length === 2 ? [names[0], names[1]] : null;
}

/** Words of a column's name in lower case, split at signs and where a capital follows a small letter. */
function words(name: string): string[] {
  return name
    .replace(/(?<=[a-z])(?=[A-Z])/g, " ")
    .toLowerCase()
    .split(/[^a-z]+/);
}

/** Longitude and latitude as places (n, 2). */
export function lonLatPlaces(table: TextTable, lon: string, lat: string): Float64Array {
  return onEarth(places(numbers(table.get(lon)!, "longitude"), numbers(table.get(lat)!, "latitude")));
}

/** Places, whose latitudes must be those of a sphere. */
export function onEarth(lonlat: Float64Array): Float64Array {
  refuse(
    lonlat.length / 2,
    (row) => Math.abs(lonlat[2 * row + 1]) > 90,
    (row) => `latitude ${lonlat[2 * row + 1]} is outside [-90, 90]`,
    "; is it the longitude, or not in degrees?",
  );
  return lonlat;
}

/** Two columns of a plane as places (n, 2). A mark that may separate thousands must be decimal elsewhere in the table. */
export function planePlaces(table: TextTable, first: string, second: string): Float64Array {
  const markOf = (cell: string): string => (cell.includes(",") ? "," : ".");
  const decimal = new Set<string>();
  for (const cells of table.values()) {
    for (const cell of cells.map((each) => each.trim())) {
      if (/[.,]/.test(cell) && NUMBER.test(cell) && !GROUPED.test(cell)) decimal.add(markOf(cell));
    }
  }
  const known = decimal.size === 0 ? "." : [...decimal].join("");
  const pair = [first, second].map((name) => {
    const cells = table.get(name)!;
    const unsure = (cell: string): boolean => GROUPED.test(cell) && markOf(cell) !== known;
    refuse(
      cells.length,
      (row) => unsure(cells[row].trim()),
      (row) => `the ${name} '${cells[row].trim()}' may have a decimal mark or thousands`,
      "; write thousands without a separator",
    );
    return numbers(cells, name);
  });
  return places(pair[0], pair[1]);
}

function places(first: Float64Array, second: Float64Array): Float64Array {
  return Float64Array.from({ length: 2 * first.length }, (_, k) => (k % 2 === 0 ? first : second)[k >> 1]);
}

/** A comma is a decimal mark. */
function numbers(cells: readonly string[], name: string): Float64Array {
  const said = (row: number): string => cells[row].trim();
  const values = Float64Array.from(cells, (cell) => {
    const text = cell.trim();
    return NUMBER.test(text) ? Number(text.replace(",", ".")) : NaN;
  });
  refuse(
    cells.length,
    (row) => !Number.isFinite(values[row]),
    (row) => `the ${name} ${MISSING.test(said(row)) ? "is missing" : `'${said(row)}' is not a number`}`,
  );
  return values;
}

/** Tells the first row that is wrong, and how many there are. */
function refuse(count: number, isWrong: (row: number) => boolean, words: (row: number) => string, advice = ""): void {
  const rows: number[] = [];
  for (let row = 0; row < count; ++row) if (isWrong(row)) rows.push(row);
  if (rows.length === 0) return;
  const more = rows.length === 1 ? "" : ` (and ${rows.length - 1} more ${rows.length === 2 ? "row" : "rows"} like it)`;
  throw new TableError(`row ${rows[0] + 1}: ${words(rows[0])}${more}${advice}`);
}
