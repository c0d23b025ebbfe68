/** Columns of text as coordinates, as `stereodel.io.tables` makes them; what is wrong is told with its row. */

import { TableError } from "./error.ts";
import { floatText, quoted, str } from "./python.ts";

/** What people and programs write as a number. */
export const NUMBER = /^[-+]?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?|inf|infinity)$/i;

/** A number whose mark may be decimal or separate thousands. */
const GROUPED = /^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/;

/** A number that no column of numbers holds: a code that starts with a zero, or one without an end. */
const NO_VALUE = /^[-+]?(?:0[0-9]|inf)/i;

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

/** Two columns of a plane as places; a mark that may separate thousands is decimal where the other numbers say so. */
export function planePlaces(
  table: { readonly columns: ReadonlyMap<string, readonly string[]>; readonly comma: boolean },
  first: string,
  second: string,
): Float64Array {
  const found = new Map([...table.columns].map(([name, cells]) => [name, marksOf(cells, table.comma)]));
  const decimal = new Set([...found.values()].flatMap(({ numeric, sure }) => (numeric ? [...sure] : [])));
  for (const name of [first, second]) {
    const { numeric, sure, unsure } = found.get(name)!;
    const deciding = numeric && sure.size === 0 ? decimal : sure;
    const wrong = unsure.filter(({ mark }) => {
      const isDefault = numeric && deciding.size === 0 && mark === ".";
      return !isDefault && !(deciding.size === 1 && deciding.has(mark));
    });
    if (wrong.length > 0) {
      const { cell, row } = wrong[0];
      const digits = cell.replace(",", ".");
      throw new TableError(
        `row ${row + 1}: the ${name} ${quoted(cell)} may be ${digits} or ${digits.replace(".", "")}; ` +
          `write thousands without a separator${more(wrong.map((each) => each.row))}`,
      );
    }
  }
  const values = (name: string): NamedColumn => ({ name, values: table.columns.get(name)! });
  return places(values(first), values(second));
}

/** Whether a column holds numbers alone, its marks that are surely decimal, and the numbers that have another. */
function marksOf(values: readonly string[], comma: boolean) {
  const sure = new Set<string>();
  const unsure: { cell: string; mark: string; row: number }[] = [];
  const cells = values.map((value) => value.trim());
  const marks = new Set<string>();
  let numeric = true;
  cells.forEach((cell, row) => {
    const mark = cell.includes(".") ? "." : cell.includes(",") ? "," : "";
    if (!NUMBER.test(cell)) numeric &&= MISSING.has(cell.toLowerCase());
    else if (GROUPED.test(cell)) unsure.push({ cell, mark, row });
    else if (mark !== "") sure.add(mark);
    if (NUMBER.test(cell) && NO_VALUE.test(cell)) numeric = false;
    if (NUMBER.test(cell) && mark !== "") marks.add(mark);
  });
  return { numeric: numeric && marks.size < 2 && (comma || !marks.has(",")), sure, unsure };
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
