/** Columns of text as coordinates, as `stereodel.io.tables` makes them; what is wrong is told with its row. */

import { TableError } from "./error.ts";
import { floatText, quoted, str } from "./python.ts";

/** What people and programs write as a number. */
export const NUMBER = /^[-+]?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?|inf|infinity)$/i;

/** What stands for no value, in any case. */
const MISSING = new Set(["", "na", "n/a", "nan", "null", "none", "<na>", "-"]);

/** A column of coordinates, and its name in messages. */
export interface NamedColumn {
  readonly name: string;
  readonly values: readonly unknown[];
}

/** Two columns as places (n, 2); the first wrong row is told. */
export function places(first: NamedColumn, second: NamedColumn): Float64Array {
  const pair = [numbers(first), numbers(second)] as const;
  const result = new Float64Array(2 * pair[0].length);
  for (let k = 0; k < pair[0].length; ++k) {
    result[2 * k] = pair[0][k];
    result[2 * k + 1] = pair[1][k];
  }
  return result;
}

/** Longitude and latitude as places, latitude in [−90, 90]. */
export function lonLatPlaces(lon: readonly unknown[], lat: readonly unknown[]): Float64Array {
  const result = places({ name: "longitude", values: lon }, { name: "latitude", values: lat });
  const outside: number[] = [];
  for (let row = 0; 2 * row < result.length; ++row) if (Math.abs(result[2 * row + 1]) > 90) outside.push(row);
  if (outside.length > 0) {
    const row = outside[0];
    throw new TableError(
      `row ${row + 1}: latitude ${floatText(result[2 * row + 1])} is outside [-90, 90]${more(outside)}; ` +
        "is it the longitude, or not in degrees?",
    );
  }
  return result;
}

function numbers({ name, values }: NamedColumn): Float64Array {
  const result = new Float64Array(values.length);
  const wrong: number[] = [];
  const bad: number[] = [];
  values.forEach((value, row) => {
    const number = typeof value === "number" ? value : parsed(value);
    if (number === null) wrong.push(row);
    else if (!Number.isFinite(number)) bad.push(row);
    result[row] = number ?? NaN;
  });
  if (wrong.length > 0) {
    const said = str(values[wrong[0]]).trim();
    throw new TableError(`row ${wrong[0] + 1}: the ${name} ${quoted(said)} is not a number${more(wrong)}`);
  }
  if (bad.length > 0) {
    const value = result[bad[0]];
    const [what, advice] = Number.isNaN(value)
      ? ["is missing", "leave such rows out with skip_missing=True"]
      : [`is ${floatText(value)}, but must be finite`, "correct or drop such rows first"];
    throw new TableError(`row ${bad[0] + 1}: the ${name} ${what}${more(bad)}; ${advice}`);
  }
  return result;
}

/** Text as the nearest double, NaN where there is no value, null where it is no number. A comma is a decimal sign. */
function parsed(value: unknown): number | null {
  const said = value === null || value === undefined ? "" : str(value).trim();
  if (!NUMBER.test(said)) return MISSING.has(said.toLowerCase()) ? NaN : null;
  if (/inf/i.test(said)) return said.startsWith("-") ? -Infinity : Infinity;
  return Number(said.replace(",", "."));
}

function more(rows: readonly number[]): string {
  return rows.length > 1 ? ` (and ${rows.length - 1} more rows like it)` : "";
}
