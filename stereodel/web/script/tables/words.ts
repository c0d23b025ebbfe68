/** What people write in tables: names of columns, signs of places and numbers, by the list that the library reads, too. */

import WORDS from "../../../io/formats/words.json" with { type: "json" };

/** What people and programs write as a number. */
export const NUMBER = /^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i;

const MISSING = new Set(WORDS.missing);
export const isMissing = (cell: string): boolean => MISSING.has(cell.trim().toLowerCase());

/** What text in windows-1252 hardly has: other signs than letters and quotes, and three of them in a row. */
export const NOT_WESTERN = new RegExp(`\\0|[^\\x00-\\x7f${WORDS.western}]|[^\\x00-\\x7f]{3}`);

/** From here on a name is not written in words. */
const IDEOGRAPHS = "\u3040";

/**
 * The columns of longitude and latitude: by their names, by a word in these, or by a word that may be something else;
 * null where they must be asked.
 */
export function findLonLat(names: readonly string[], isSure = false): [string, string] | null {
  const [lon, lat] = (["lon", "lat"] as const).map((axis) => {
    const [sure, unsure] = [WORDS[axis], WORDS[`unsure_${axis}`]];
    const ways: ((name: string, words: readonly string[]) => boolean)[] = [
      (name) => sure.includes(name),
      (name, words) => sure.some((word) => words.includes(word) || (word > IDEOGRAPHS && name.includes(word))),
      (_, words) => words.length > 0 && words.every((word) => unsure.includes(word)),
    ];
    const fitting = ways
      .slice(0, isSure ? 2 : 3)
      .map((fits) => names.filter((name) => fits(name.trim().toLowerCase(), wordsOf(name))));
    const found = fitting.find((some) => some.length > 0);
    return found?.length === 1 ? found[0] : null;
  });
  return lon === null || lat === null || lon === lat ? null : [lon, lat];
}

/** Words of a column's name in lower case, split at signs and where a capital follows a small letter, but for "deg" and the like. */
function wordsOf(name: string): string[] {
  const parted = name.replace(/(?<=[a-z])(?=[A-Z])/g, " ").toLowerCase();
  return parted.split(/[^\p{L}]+/u).filter((word) => word !== "" && !WORDS.beside.includes(word));
}

/** A column that holds the letters of the points of the compass for the one before it. */
export const LETTERED = new RegExp(`^(?:${WORDS.lettered})$`, "iu");

const UNTYPED = new RegExp(`[${WORDS.printed}${WORDS.unseen}]`, "gu");

/** A cell with the characters of the keyboard in place of those of printers. */
export function typed(cell: string): string {
  const plain = cell.replace(UNTYPED, (sign) => WORDS.typed[WORDS.printed.indexOf(sign)] ?? "");
  return plain.trim().replace(/\s+/g, " ");
}

const POINTS = new Map(
  Object.entries({ ...WORDS.compass, O: "O" }).flatMap(([letter, words]) =>
    [letter, ...words.toLowerCase().split(" ")].map((word): [string, string] => [word, letter]),
  ),
);

/** The letter that a word of the compass begins with in English, O where it may be east or west; undefined of others. */
export const pointOf = (word: string): string | undefined => POINTS.get(word.length > 1 ? word.toLowerCase() : word);

const PART = "[0-9]+(?:[.,][0-9]*)?";
/** An angle, such as `10°59'07"E`, `170 41.4 W`, `-12:30` and `9,5° Ost`. */
const ANGLE = new RegExp(
  `^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)` +
    `(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${PART})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*` +
    `(?:(?<seconds>${PART})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,
  "u",
);

/** The angle that a cell says, as the nearest double, and its point of the compass, "" where it has none; or null. */
export function angle(cell: string): { degrees: number; point: string } | null {
  const found = cell.length > 200 ? null : ANGLE.exec(typed(cell))?.groups;
  if (!found) return null;
  const { before, after, sign } = found;
  const parts = [found["degrees"], found["minutes"], found["seconds"]].filter((part) => part !== undefined);
  const numbers = parts.map((part) => part.replace(",", ".").replace(/\.$/, ""));
  const point = (before ?? after) ? pointOf((before ?? after)!) : "";
  const isWhole = parts.slice(0, -1).every((part) => /^[0-9]+$/.test(part));
  const isWrong = point === undefined || (before && after) || (point && sign) || !isWhole;
  if (isWrong || numbers.slice(1).some((part) => Number(part) >= 60)) return null;
  const isNegative = point === "W" || point === "S" || sign === "-";
  return { degrees: (isNegative ? -1 : 1) * (point === "O" ? NaN : sexagesimal(numbers)), point };
}

/** The double nearest to degrees, minutes and seconds: one division of whole numbers, if these have at most 15 digits. */
function sexagesimal(parts: readonly string[]): number {
  if (parts.length === 1) return Number(parts[0]);
  const unit = 10 ** (parts[parts.length - 1].split(".")[1]?.length ?? 0);
  return parts.reduce((sum, part) => 60 * sum + Math.round(Number(part) * unit), 0) / (unit * 60 ** (parts.length - 1));
}
