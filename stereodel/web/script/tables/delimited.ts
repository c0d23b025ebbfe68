/** Tables as delimited text: what separates the fields and which row is the header is found out. */

import type { Column } from "../rooms/owner.ts";
import { findLonLat, NUMBER } from "./words.ts";

/** A comma comes first: where several marks give as many fields, it is the one. */
const SEPARATORS = [",", ";", "\t", "|"];

/** Lines from which the separator is found, and rows among which the header is. */
const LOOKED_AT = 50;
const TITLES = 20;

const LINE_END = /\r\n|\n|\r/;

/** Lines on top that begin with a hash. */
const COMMENTS = /^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;

/** Columns of text, and the rows without a place. */
export interface TextTable {
  /** By name; row k of all of them is row k + 1 of the data. */
  readonly columns: ReadonlyMap<string, readonly string[]>;
  /** How many rows there are. */
  readonly count: number;
  /** Whether a row names the columns. */
  readonly isHeaded: boolean;
  /** What is wrong with rows, by their indices. */
  readonly wrong: Map<number, string>;
}

/** Of all rows, pairs of coordinates; and the columns that they were read from. */
export interface PlacedTable {
  readonly places: Float64Array;
  readonly table: TextTable;
  readonly axes?: [string, string];
}

type Row = readonly string[];

/** @throws TableError where the text is no table; wrong rows are noted. */
export function readTable(given: string): TextTable {
  const text = given.replace(COMMENTS, "");
  const separator = separatorOf(text);
  const all = separator === null ? text.split(LINE_END).map(words) : [...markedRows(text, separator)];
  const rows = all.filter((cells) => cells.some((cell) => cell.trim() !== ""));
  if (rows.length === 0) throw new TableError("the table is empty");
  const { names, data } = headed(rows);
  const isHeaded = data.length < rows.length;
  const repeated = names.find((name, k) => name !== "" && names.indexOf(name) !== k);
  if (repeated !== undefined) throw new TableError(`there are several columns with the name '${repeated}'`);
  const columns = names.map((): string[] => []);
  const wrong = new Map<number, string>();
  const least = names.reduce((most, name, k) => (name === "" ? most : k + 1), 0);
  data.forEach((cells, row) => {
    const isWhole = cells.length >= least && cells.slice(names.length).every((cell) => cell === "");
    if (!isWhole) wrong.set(row, `it has ${cells.length} in place of ${names.length} fields`);
    columns.forEach((column, k) => column.push(cells[k] ?? ""));
  });
  const named = names.map((name, k): [string, string[]] => [name || `column_${k + 1}`, columns[k]]);
  const shown = named.filter(([, cells], k) => names[k] !== "" || cells.some((cell) => cell !== ""));
  return { columns: new Map(shown), count: data.length, isHeaded, wrong };
}

/** The mark that splits most of the first lines into one number of fields, the largest; null for blanks. */
function separatorOf(text: string): string | null {
  const lines = text.split(LINE_END, LOOKED_AT).filter((line) => line.trim() !== "");
  const bare = lines.map((line) => line.replace(/"[^"]*"/g, ""));
  const all = SEPARATORS.map((mark) => ({ mark, widths: bare.map((line) => line.split(mark).length) }));
  const several = all.filter(({ widths }) => Math.max(0, ...widths) > 1);
  const even = several.filter(({ widths }) => new Set(widths).size === 1);
  const blanks = [...new Set(lines.map((line) => words(line).length))];
  if (several.length === 0 || (even.length === 0 && blanks.length === 1 && blanks[0] > 1)) return null;
  const score = ({ widths }: (typeof all)[0]): number =>
    Math.max(...widths.map((n) => (n > 1 ? 1e6 * widths.filter((each) => each === n).length + n : 0)));
  return (even.length > 0 ? even : several).reduce((best, each) => (score(each) > score(best) ? each : best)).mark;
}

const words = (line: string): Row => line.trim().split(/\s+/);

/** Fields may stand in quotation marks, with those inside written twice, and then hold separators and ends of lines. */
function* markedRows(text: string, mark: string): Generator<Row> {
  const plain = `[^"\\${mark}\\r\\n][^\\${mark}\\r\\n]*`;
  const field = new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${plain})?)(\\${mark}|\\r\\n|\\n|\\r|$)`, "y");
  let cells: string[] = [];
  while (field.lastIndex < text.length) {
    const begin = field.lastIndex;
    const found = field.exec(text);
    if (found === null)
      throw new TableError(
        `in ${text.slice(begin, begin + 20)}… a quotation mark does not end a field; write it twice`,
      );
    cells.push(found[1]?.replaceAll('""', '"') ?? found[2] ?? "");
    if (found[3] === mark) continue;
    yield cells;
    cells = [];
  }
  if (cells.length > 0) yield [...cells, ""];
}

/**
 * Names of the columns, empty where there is none, and the rows below. The header is the first row with names of
 * coordinates, else the first one of several fields; or else that is data, if most of its fields are numbers. Two
 * columns without names are longitude and latitude.
 */
function headed(rows: readonly Row[]): { names: string[]; data: readonly Row[] } {
  const top = rows.slice(0, TITLES).map((cells) => cells.map((cell) => cell.trim()));
  const filled = top.map((cells) => cells.filter((cell) => cell !== ""));
  const isNumber = (cell: string): boolean => NUMBER.test(cell);
  const worded = filled.findIndex((cells, k) => findLonLat(cells) !== null && (k === 0 || !cells.some(isNumber)));
  const several = filled.findIndex((cells) => cells.length > 1);
  const at = Math.max(0, worded >= 0 ? worded : several);
  const isData = worded < 0 && 2 * filled[at].filter(isNumber).length > filled[at].length;
  if (!isData) return { names: top[at], data: rows.slice(at + 1) };
  const names = top[at].length === 2 ? ["lon", "lat"] : top[at].map((_, k) => `column_${k + 1}`);
  return { names, data: rows.slice(at) };
}

/** Places, names and columns as a table, with all digits of all numbers. */
export function writeTable(
  axes: readonly [string, string],
  places: Float64Array,
  names: readonly string[] | null = null,
  values: ReadonlyMap<string, Column> = new Map(),
): string {
  const cell = (value: number | string | null): string => {
    if (typeof value === "string") return /[",\r\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
    return Object.is(value, -0) ? "-0.0" : Number.isFinite(value) ? String(value) : "";
  };
  const columns = new Map([...(names ? [["name", names] as const] : []), ...values]);
  const head = [...axes, ...columns.keys()];
  const rows = Array.from({ length: places.length / 2 }, (_, row) => {
    return [places[2 * row], places[2 * row + 1], ...Array.from(columns.values(), (column) => column[row])];
  });
  return [head, ...rows].map((row) => `${row.map(cell).join()}\n`).join("");
}

/** A table that cannot be read; the message begins with the row where there is one. */
export class TableError extends Error {
  /** The columns of which the reader is asked for two. */
  readonly columns: readonly string[];

  constructor(message: string, columns: readonly string[] = []) {
    super(message);
    this.columns = columns;
  }
}
