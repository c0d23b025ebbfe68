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
  const pair = (["lon", "lat"] as const).map((axis) => {
    const [sure, unsure] = [WORDS[axis], WORDS[`unsure_${axis}`]];
    const plain = (name: string): string => name.trim().toLowerCase();
    const isPart = (word: string, name: string): boolean =>
      plain(name).includes(word) && (word > IDEOGRAPHS || wordsOf(name).includes(word));
    const own = (name: string): string[] => wordsOf(name).filter((word) => !WORDS.beside.includes(word));
    const ways: ((name: string) => boolean)[] = [
      (name) => sure.includes(plain(name)),
      (name) => sure.some((word) => isPart(word, name)),
      (name) => unsure.includes(plain(name)) || (own(name).length > 0 && own(name).every((w) => unsure.includes(w))),
    ];
    const found = ways.slice(0, isSure ? 2 : 3).map((fits) => names.filter(fits));
    const matching = found.find((some) => some.length > 0);
    return matching?.length === 1 ? matching[0] : null;
  });
  const [lon, lat] = pair;
  return lon === null || lat === null || lon === lat ? null : [lon, lat];
}

/** Words of a column's name in lower case, split at signs and where a capital follows a small letter. */
function wordsOf(name: string): string[] {
  const parted = name.replace(/(?<=[a-z])(?=[A-Z])/g, " ").toLowerCase();
  return parted.split(/[^\p{L}]+/u).filter(Boolean);
}

/** A column that holds the letters of the points of the compass for the one before it. */
export const LETTERED = new RegExp(`^(?:${WORDS.lettered})$`, "iu");

const UNPRINTED = new RegExp(`[${WORDS.printed}${WORDS.unseen}]|\\p{Nd}`, "gu");

/** A cell with the characters of the keyboard in place of those of printers and of other scripts. */
export function typed(cell: string): string {
  const plain = (sign: string): string => {
    const zero = [...WORDS.zeros].find((zero) => sign >= zero && sign.charCodeAt(0) - zero.charCodeAt(0) < 10);
    if (zero !== undefined) return String(sign.charCodeAt(0) - zero.charCodeAt(0));
    const at = WORDS.printed.indexOf(sign);
    return at < 0 ? (WORDS.unseen.includes(sign) ? "" : sign) : WORDS.typed[at];
  };
  return cell.replace(UNPRINTED, plain).trim().replace(/\s+/g, " ");
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
  const point = (before ?? after) ? pointOf((before ?? after)!) : "";
  const isWhole = parts.slice(0, -1).every((part) => /^[0-9]+$/.test(part));
  const numbers = parts.map((part) => part.replace(",", ".").replace(/\.$/, ""));
  const isWrong = point === undefined || (before && after) || (point && sign) || !isWhole;
  if (isWrong || numbers.slice(1).some((part) => Number(part) >= 60)) return null;
  const isNegative = point === "W" || point === "S" || sign === "-";
  return { degrees: (isNegative ? -1 : 1) * (point === "O" ? NaN : sexagesimal(numbers)), point };
}

/** The double nearest to degrees, minutes and seconds. */
function sexagesimal(parts: readonly string[]): number {
  if (parts.length === 1) return Number(parts[0]);
  const digits = parts[parts.length - 1].split(".")[1]?.length ?? 0;
  const [degrees, minutes, seconds = 0n] = parts.map((part, k) => {
    const isLast = k === parts.length - 1;
    return BigInt(part.replace(".", "")) * (isLast ? 1n : 10n ** BigInt(digits));
  });
  const [above, below] = [(degrees * 60n + minutes) * 60n + seconds, 3600n * 10n ** BigInt(digits)];
  // More digits than a double has, and one behind them that tells whether there are others.
  const shift = 128 + below.toString(2).length;
  const scaled = above << BigInt(shift);
  return Number((scaled / below) | (scaled % below === 0n ? 0n : 1n)) / 2 ** shift;
}
