/** Cells of columns as coordinates and as numbers; rows in which they are wrong are noted, by their indices. */

import type { TextTable } from "./delimited.ts";
import { angle, isMissing, LETTERED, NUMBER, pointOf, typed } from "./words.ts";

/** A number whose mark may be decimal or separate thousands. */
const GROUPED = /^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/;

/** Digits that are a name, such as 007. */
const CODE = /^[-+]?0[0-9]/;

/** Points of the compass by axes; an O is east in German and west in French, and has no degrees. */
const POINTS = { longitude: "EWO", latitude: "NS" };

/** Columns of a plane: x and y in any case, or the only two; null where they must be asked. */
export function findXY(names: readonly string[]): [string, string] | null {
  const [x, y] = ["x", "y"].map((letter) => names.filter((name) => name.trim().toLowerCase() === letter));
  if (x.length === 1 && y.length === 1) return [x[0], y[0]];
  return names.length === 2 ? [names[0], names[1]] : null;
}

/** Two columns as places (n, 2): longitude and latitude, or numbers of a plane that have one reading alone. */
export function placesOf(table: TextTable, kind: "lonlat" | "plane", axes: readonly [string, string]): Float64Array {
  const mark = kind === "plane" ? decimalMark(table.columns) : "";
  const sure = (cell: string): number => (isUnsure(cell, mark) ? NaN : plain(cell));
  const [first, second] = axes.map((name, k) =>
    kind === "lonlat"
      ? degrees(table, name, (["longitude", "latitude"] as const)[k])
      : numbers(table, name, table.columns.get(name)!, "a number without a mark between thousands", sure),
  );
  const places = Float64Array.from({ length: 2 * first.length }, (_, k) => (k % 2 === 0 ? first : second)[k >> 1]);
  return kind === "lonlat" ? onEarth(places, table.wrong) : places;
}

/** Longitudes and latitudes, of which those that are none of a sphere are noted. */
export function onEarth(lonlat: Float64Array, wrong: TextTable["wrong"]): Float64Array {
  for (let row = 0; row < lonlat.length / 2; ++row) {
    const [lon, lat] = lonlat.subarray(2 * row, 2 * row + 2);
    if (wrong.has(row) || (Math.abs(lat) <= 90 && Math.abs(lon) <= 360)) continue;
    wrong.set(row, `longitude ${lon}, latitude ${lat} is not on Earth; are they swapped, or not in degrees?`);
  }
  return lonlat;
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

/** A comma is a decimal mark. */
const decimal = (cell: string): number => Number(cell.replace(",", "."));

/** A column of angles, in degrees or with minutes, seconds and points of the compass. */
function degrees(table: TextTable, name: string, axis: keyof typeof POINTS): Float64Array {
  const letters = POINTS[axis];
  const needed = `degrees with a sign, ${letters[0]} or ${letters[1]}`;
  return numbers(table, axis, lettered(table, name, letters), needed, (cell) => {
    const found = NUMBER.test(cell) ? null : angle(cell);
    if (found === null) return plain(cell);
    return letters.includes(found.point) ? found.degrees : NaN;
  });
}

/** Cells of a column with the points of the compass of the column behind it, where there is such a one. */
function lettered({ columns }: TextTable, name: string, its: string): readonly string[] {
  const [cells, names] = [columns.get(name)!, [...columns.keys()]];
  const beside = names[names.indexOf(name) + 1] ?? "";
  if (!LETTERED.test(beside)) return cells;
  const letters = columns.get(beside)!.map((cell) => (isMissing(typed(cell)) ? "" : typed(cell)));
  const points = letters.filter(Boolean).map((letter) => pointOf(letter) ?? "?");
  const isAxis = points.length > 0 && points.every((point) => its.includes(point));
  if (!isAxis || cells.some((cell) => typed(cell).includes("-") && !isMissing(cell))) return cells;
  return cells.map((cell, row) => (isMissing(cell) ? "" : `${cell} ${letters[row]}`.trim()));
}

const plain = (cell: string): number => (NUMBER.test(cell) ? decimal(cell) : NaN);

/** A column as numbers; NaN, and a note, in wrong rows. @param needed What should be there. */
function numbers(
  { wrong }: TextTable,
  axis: string,
  cells: readonly string[],
  needed: string,
  read: (cell: string) => number,
): Float64Array {
  return Float64Array.from(cells, (given, row) => {
    const cell = given.trim();
    const value = read(cell);
    if (Number.isFinite(value)) return value;
    if (!wrong.has(row)) wrong.set(row, `the ${axis} is ${isMissing(cell) ? "missing" : `'${cell}', not ${needed}`}`);
    return NaN;
  });
}
