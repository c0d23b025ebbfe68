/** Tables as delimited text: what separates the fields and whether there is a header is found out. */

import { findLonLat, NUMBER } from "./coordinates.ts";

/** A comma comes last, as it may also be a decimal mark. */
const SEPARATORS = ["\t", ";", "|", ","];

/** Lines from which the separator is found. */
const LOOKED_AT = 50;

const LINE_END = /\r\n|\n|\r/;

/** Lines on top that begin with a hash. */
const COMMENTS = /^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;

/** Columns of text by name; row k of all of them is row k + 1 of the data. */
export type TextTable = ReadonlyMap<string, readonly string[]>;

/** @throws TableError naming the row. */
export function readTable(given: string): TextTable {
  const text = given.replace(COMMENTS, "");
  const separator = separatorOf(text);
  const rows = separator === null ? blankRows(text) : markedRows(text, separator);
  let names: string[] | null = null;
  let columns: string[][] = [];
  for (const row of rows) {
    if (row.every((cell) => cell.trim() === "")) continue;
    if (names === null) {
      names = header(row);
      columns = row.map(() => []);
      if (!isData(row)) continue;
    }
    if (row.length !== names.length) {
      const number = columns[0].length + 1;
      throw new TableError(`row ${number}: has ${row.length} fields, but there are ${names.length} columns`);
    }
    row.forEach((cell, k) => columns[k].push(cell));
  }
  if (names === null)
    throw new TableError("the table is empty: there is not even a line with the names of the columns");
  const repeated = names.find((name, k) => name !== "" && names.indexOf(name) !== k);
  if (repeated !== undefined) throw new TableError(`there are several columns with the name '${repeated}'`);
  const named = names.map((name, k): [string, string[]] => [name || `column_${k + 1}`, columns[k]]);
  return new Map(named.filter(([, cells], k) => names[k] !== "" || cells.some((cell) => cell !== "")));
}

/** The mark that gives the first lines the same number of fields, else one that the first line has; null for blanks. */
function separatorOf(text: string): string | null {
  const lines = text.split(LINE_END, LOOKED_AT).filter((line) => line.trim() !== "");
  const bare = lines.map((line) => line.replace(/"[^"]*"/g, ""));
  const widths = (mark: string): number[] => bare.map((line) => line.split(mark).length);
  const present = SEPARATORS.filter((mark) => widths(mark)[0] > 1);
  return present.find((mark) => new Set(widths(mark)).size === 1) ?? present[0] ?? null;
}

function* blankRows(text: string): Generator<string[]> {
  for (const line of text.split(LINE_END)) yield line.trim().split(/\s+/);
}

/** Fields may stand in quotation marks, with those inside written twice, and then hold separators and ends of lines. */
function* markedRows(text: string, mark: string): Generator<string[]> {
  const plain = `[^"\\${mark}\\r\\n][^\\${mark}\\r\\n]*`;
  const field = new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${plain})?)(\\${mark}|\\r\\n|\\n|\\r|$)`, "y");
  let row: string[] = [];
  let count = 0;
  while (field.lastIndex < text.length) {
    const found = field.exec(text);
    if (found === null) {
      throw new TableError(
        `line ${count + 1}: a field begins with a quotation mark but does not end with one; inside such a field write it twice`,
      );
    }
    row.push(found[1]?.replaceAll('""', '"') ?? found[2] ?? "");
    if (found[3] === mark) continue;
    yield row;
    row = [];
    ++count;
  }
  if (row.length > 0) yield [...row, ""];
}

/** Whether a first row is data: most of its fields are numbers, and no names of coordinates are among them. */
function isData(row: readonly string[]): boolean {
  const cells = row.map((cell) => cell.trim()).filter((cell) => cell !== "");
  return 2 * cells.filter((cell) => NUMBER.test(cell)).length > cells.length && findLonLat(cells) === null;
}

/** Names of the columns, empty where there is none. Two columns without names are longitude and latitude. */
function header(row: readonly string[]): string[] {
  if (!isData(row)) return row.map((cell) => cell.trim());
  return row.length === 2 ? ["lon", "lat"] : row.map((_, k) => `column_${k + 1}`);
}

/** A table that cannot be read; the message begins with the row where there is one. */
export class TableError extends Error {}

/** No column, or several, look like what is needed: the reader is asked which. */
export class ColumnsError extends TableError {
  /** The columns there are. */
  readonly names: readonly string[];

  constructor(names: readonly string[]) {
    super("the table has no two columns of coordinates");
    this.names = names;
  }
}
