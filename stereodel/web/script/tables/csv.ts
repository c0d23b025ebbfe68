/** Tables as text, as `stereodel.io.csv_text` takes them apart: separators and headers are found out. */

import { TableError } from "./error.ts";
import { hasLonLat } from "./columns.ts";
import { NUMBER } from "./numbers.ts";
import { quoted } from "./python.ts";

const SEPARATORS = [",", ";", "\t", "|"];

/** Lines from which the separator is found. */
const LOOKED_AT = 50;

/** Rows that are taken apart before their widths are looked at. */
const BLOCK = 20_000;

/** Lines on top that begin with a hash. */
const COMMENTS = /^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;

/** Columns of text by name; row k of all of them is row k + 1 of the data. */
export interface TextTable {
  readonly columns: ReadonlyMap<string, string[]>;
  readonly length: number;
  /** Whether a comma may be a decimal mark. */
  readonly comma: boolean;
}

/**
 * Columns of a table as text; a first line that has one of the names `wanted` is known for a header.
 *
 * @throws TableError naming the row or the line.
 */
export function splitColumns(given: string, wanted: readonly string[] = []): TextTable {
  const above = COMMENTS.exec(given)?.[0] ?? "";
  const text = given.slice(above.length);
  const separator = separatorOf(text);
  const rows = dataRows(text, separator, linesOf(above).length);
  const first = rows.next();
  if (first.done) throw new TableError("the table is empty: there is not even a line with the names of the columns");
  const { names, data } = header(first.value, wanted);
  const columns = names.map((): string[] => []);
  let count = 0;
  const take = (block: string[][]): void => {
    block.forEach((row, k) => {
      if (row.length !== names.length) {
        throw new TableError(`row ${count + k + 1} has ${row.length} fields, but there are ${names.length} columns`);
      }
    });
    for (const row of block) row.forEach((cell, k) => columns[k].push(cell));
    count += block.length;
  };
  take(data);
  for (let block = taken(rows, BLOCK); block.length > 0; block = taken(rows, BLOCK)) take(block);
  const named = new Map<string, string[]>();
  names.forEach((name, k) => {
    const values = columns[k];
    if (name || values.some((value) => value !== "")) named.set(name || `column_${k + 1}`, values);
  });
  return { columns: named, length: count, comma: separator !== "," };
}

function taken(rows: Iterator<string[]>, most: number): string[][] {
  const block: string[][] = [];
  while (block.length < most) {
    const next = rows.next();
    if (next.done) break;
    block.push(next.value);
  }
  return block;
}

/** Rows that hold something. */
function* dataRows(text: string, mark: string | null, above: number): Generator<string[]> {
  for (const row of mark === null ? blankRows(text) : markedRows(linesOf(text), mark, above)) {
    if (row.some((cell) => cell !== "") && (row.length > 1 || row[0].trim() !== "")) yield row;
  }
}

function* blankRows(text: string): Generator<string[]> {
  for (const line of linesOf(text)) yield line.split(/\s+/).filter((cell) => cell !== "");
}

/** Lines with what ends them. */
function linesOf(text: string, most = Infinity): string[] {
  const lines: string[] = [];
  const end = /\r\n|\n|\r/g;
  let begin = 0;
  while (begin < text.length && lines.length < most) {
    const found = end.exec(text);
    const stop = found === null ? text.length : found.index + found[0].length;
    lines.push(text.slice(begin, stop));
    begin = stop;
  }
  return lines;
}

/** The mark that gives all the first lines the same number of fields, the largest one; null for blanks. */
function separatorOf(text: string): string | null {
  const lines = linesOf(text, LOOKED_AT);
  const lengths = new Map(SEPARATORS.map((mark) => [mark, fieldCounts(lines, mark)]));
  const largest = (mark: string): number => Math.max(0, ...lengths.get(mark)!);
  const several = SEPARATORS.filter((mark) => largest(mark) > 1);
  const even = several.filter((mark) => lengths.get(mark)!.size === 1);
  const blanks = new Set(
    [...lines].filter((line) => line.trim() !== "").map((line) => line.trim().split(/\s+/).length),
  );
  if (several.length === 0 || (even.length === 0 && blanks.size === 1 && !blanks.has(1))) return null;
  const among = even.length > 0 ? even : several;
  return among.reduce((best, mark) => (largest(mark) > largest(best) ? mark : best));
}

/** How many fields lines have, without the last one, which may end amid a quoted field. */
function fieldCounts(lines: string[], mark: string): Set<number> {
  const counts = [...markedRows(lines, mark, null)].map((row) => row.length).filter((count) => count > 0);
  return new Set(counts.length > 1 ? counts.slice(0, -1) : counts);
}

/**
 * Fields of each row, after the rules of Python's csv module; `above` lines stand before, for messages.
 *
 * A quotation mark that nothing closes is an error, or passed over where `above` is null.
 */
function* markedRows(lines: string[], mark: string, above: number | null): Generator<string[]> {
  let row: string[] = [];
  let field = "";
  let state: "start" | "plain" | "quoted" | "closed" = "start";
  let begun = 0;
  const wrong = (what: string): TableError =>
    new TableError(
      `line ${above! + begun + 1}: a field begins with a quotation mark but does not end with one (${what}); ` +
        "inside such a field write it twice",
    );
  for (let number = 0; number < lines.length; ++number) {
    const line = lines[number];
    const body = line.replace(/[\r\n]+$/, "");
    if (row.length === 0 && state === "start" && body === "") {
      yield [];
      begun = number + 1;
      continue;
    }
    for (const letter of body) {
      if (state === "quoted") {
        if (letter === '"') state = "closed";
        else field += letter;
      } else if (letter === '"' && state === "start") state = "quoted";
      else if (letter === '"' && state === "closed") {
        field += letter;
        state = "quoted";
      } else if (letter === mark) {
        row.push(field);
        field = "";
        state = "start";
      } else {
        if (state === "closed" && above !== null) throw wrong(`'${mark}' expected after '"'`);
        field += letter;
        state = "plain";
      }
    }
    if (state === "quoted") {
      field += line.slice(body.length);
      continue;
    }
    row.push(field);
    yield row;
    row = [];
    field = "";
    state = "start";
    begun = number + 1;
  }
  if (state !== "quoted") return;
  if (above !== null) throw wrong("unexpected end of data");
  row.push(field);
  yield row;
}

/**
 * Names of the columns, empty where there is none, and the row if it is data.
 *
 * It is data where most of its fields are numbers, unless names of coordinates are among them. Two columns without names
 * are longitude and latitude.
 */
function header(row: string[], wanted: readonly string[]): { names: string[]; data: string[][] } {
  const first = row.map((cell) => cell.trim());
  const numbers = first.filter((cell) => NUMBER.test(cell)).length;
  const isData = 2 * numbers > first.filter((cell) => cell !== "").length;
  if (isData && !(wanted.some((name) => first.includes(name)) || hasLonLat(first))) {
    return { names: first.length === 2 ? ["lon", "lat"] : first.map((_, k) => `column_${k + 1}`), data: [row] };
  }
  const repeated = [...new Set(first.filter((name, k) => name !== "" && first.indexOf(name) !== k))].sort();
  if (repeated.length > 0) {
    throw new TableError(`there are several columns with the name ${repeated.map(quoted).join(", ")}`);
  }
  return { names: first, data: [] };
}
