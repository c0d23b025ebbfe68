/** Cells of columns as coordinates and as numbers; rows in which they are wrong are noted, by their indices. */

import type { TextTable } from "./delimited.ts";
import { angle, isMissing, LETTERED, NUMBER, pointOf, typed } from "./words.ts";

/** A number whose mark may be decimal or separate thousands. */
const GROUPED = /^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/;

/** Digits that are a name, such as 007. */
const CODE = /^[-+]?0[0-9]/;

/** Columns of a plane: x and y in any case, or the only two; null where they must be asked. */
export function findXY(names: readonly string[]): [string, string] | null {
  const [x, y] = ["x", "y"].map((letter) => names.filter((name) => name.trim().toLowerCase() === letter));
  if (x.length === 1 && y.length === 1) return [x[0], y[0]];
  return names.length === 2 ? [names[0], names[1]] : null;
}

/** Longitude and latitude as places (n, 2). */
export function lonLatPlaces(table: TextTable, lon: string, lat: string): Float64Array {
  const [longitudes, latitudes] = [degrees(table, lon, "longitude"), degrees(table, lat, "latitude")];
  return onEarth(places(longitudes, latitudes), table.wrong);
}

/** Places, of which those that are none of a sphere are noted. */
export function onEarth(lonlat: Float64Array, wrong: TextTable["wrong"]): Float64Array {
  for (let row = 0; row < lonlat.length / 2; ++row) {
    const [lon, lat] = [lonlat[2 * row], lonlat[2 * row + 1]];
    if (wrong.has(row)) continue;
    if (Math.abs(lat) > 90)
      wrong.set(row, `latitude ${lat} is outside [-90, 90]; is it the longitude, or not in degrees?`);
    else if (Math.abs(lon) > 360) wrong.set(row, `longitude ${lon} is outside [-360, 360]`);
  }
  return lonlat;
}

/** Two columns of a plane as places (n, 2). A mark that may separate thousands must be decimal elsewhere in the table. */
export function planePlaces(table: TextTable, first: string, second: string): Float64Array {
  const mark = decimalMark(table.columns);
  const pair = [first, second].map((name) =>
    numbers(table, name, table.columns.get(name)!, (cell) =>
      isUnsure(cell, mark) ? "may have a decimal mark or thousands; write thousands without one" : plain(cell),
    ),
  );
  return places(pair[0], pair[1]);
}

/** The other columns whose values are all numbers, NaN where one is missing. */
export function numberColumns(columns: TextTable["columns"], others: ReadonlySet<string>): Map<string, Float64Array> {
  const mark = decimalMark(columns);
  const isNumber = (cell: string): boolean => NUMBER.test(cell) && !CODE.test(cell) && !isUnsure(cell, mark);
  const known = (cell: string): boolean => isMissing(cell) || isNumber(cell.trim());
  const kept = [...columns].filter(
    ([name, cells]) => !others.has(name) && cells.every(known) && !cells.every(isMissing),
  );
  const value = (cell: string): number => (isMissing(cell) ? NaN : decimal(cell.trim()));
  return new Map(kept.map(([name, cells]) => [name, Float64Array.from(cells, value)]));
}

/** The decimal mark by numbers that have no other reading; a point if there is none, both if they disagree. */
function decimalMark(columns: TextTable["columns"]): string {
  const marked = [...columns.values()].flatMap((cells) => cells.filter((cell) => /[.,]/.test(cell)));
  const sure = marked.map((cell) => cell.trim()).filter((cell) => NUMBER.test(cell) && !GROUPED.test(cell));
  return [...new Set(sure.map(markOf))].join("") || ".";
}

const markOf = (cell: string): string => (cell.includes(",") ? "," : ".");
const isUnsure = (cell: string, mark: string): boolean => GROUPED.test(cell) && markOf(cell) !== mark;

function places(first: Float64Array, second: Float64Array): Float64Array {
  return Float64Array.from({ length: 2 * first.length }, (_, k) => (k % 2 === 0 ? first : second)[k >> 1]);
}

/** A comma is a decimal mark. */
const decimal = (cell: string): number => Number(cell.replace(",", "."));

/** A column of angles, in degrees or with minutes, seconds and points of the compass. */
function degrees(table: TextTable, name: string, axis: "longitude" | "latitude"): Float64Array {
  return numbers(table, axis, lettered(table, name, axis), (cell) => {
    const found = NUMBER.test(cell) ? null : angle(cell);
    if (found === null) return plain(cell);
    const said = found.point === "" ? axis : /[NS]/.test(found.point) ? "latitude" : "longitude";
    if (said !== axis) return `is a ${said}`;
    if (found.point === "O") return "has an O, which is east in German and west in French; write E or W in its place";
    return found.degrees;
  });
}

/** Cells of a column with the points of the compass of the column behind it, where there is such a one. */
function lettered({ columns }: TextTable, name: string, axis: string): readonly string[] {
  const [cells, names] = [columns.get(name)!, [...columns.keys()]];
  const beside = names[names.indexOf(name) + 1] ?? "";
  if (!LETTERED.test(beside)) return cells;
  const letters = columns.get(beside)!.map((cell) => (isMissing(typed(cell)) ? "" : typed(cell)));
  const points = letters.filter(Boolean).map((letter) => pointOf(letter) ?? "?");
  const isAxis = points.length > 0 && points.every((point) => (axis === "latitude" ? "NS" : "EWO").includes(point));
  if (!isAxis || cells.some((cell) => typed(cell).includes("-") && !isMissing(cell))) return cells;
  return cells.map((cell, row) => (isMissing(cell) ? "" : `${cell} ${letters[row]}`.trim()));
}

const plain = (cell: string): number => (NUMBER.test(cell) ? decimal(cell) : NaN);

/** A column as numbers; NaN, and a note, in wrong rows. @param read A number, or why a cell is none if that is known. */
function numbers(
  { wrong }: TextTable,
  axis: string,
  cells: readonly string[],
  read: (cell: string) => number | string,
): Float64Array {
  return Float64Array.from(cells, (given, row) => {
    const cell = given.trim();
    const value = read(cell);
    if (typeof value === "number" && Number.isFinite(value)) return value;
    const why = typeof value === "string" ? value : "is not a number";
    if (!wrong.has(row)) wrong.set(row, `the ${axis} ${isMissing(cell) ? "is missing" : `'${cell}' ${why}`}`);
    return NaN;
  });
}
