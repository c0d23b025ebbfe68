/** What the owner of a page says of its places: title, source, values, colours, sizes, legend. As `looks.py` wrote it. */

import { counted, fixed, latitude, longitude } from "../words.ts";
import type { GlobeScene, Places } from "./globe_scene.ts";

export interface Owner {
  readonly title: string;
  readonly source: string;
  /** SVG. */
  readonly legend?: string;
  /** Colours, of each place the number of its own, and the radii of its dot in pixels. */
  readonly inks?: readonly string[];
  readonly ink?: readonly number[];
  readonly radii?: readonly number[];
  /** Parts of lines of Python, by their names in `globe.txt`. */
  readonly lines?: Readonly<Record<string, string>>;
  /** Of the places. */
  readonly columns?: readonly (readonly [string, Column])[];
}

/** Values, null or NaN where one is missing; the title ends with their unit after a comma. */
export type Column = ArrayLike<number | string | null>;

/** Columns of a table that are told of a place. */
const MOST_COLUMNS = 4;

/** What is told of places, by titles. */
export function toldOf({ values }: Places): (readonly [string, Column])[] {
  return [...(values ?? [])].slice(0, MOST_COLUMNS);
}

/** A value as the page writes it. */
export function valueWords(value: number | string | null): string {
  if (typeof value !== "number" || Number.isNaN(value)) return value ? String(value) : "no value";
  const text = Number.isInteger(value) ? counted(Math.abs(value)) : String(Math.abs(value));
  return value < 0 ? `\u2212${text}` : text;
}

/** Square kilometres: whole ones, or three digits of what is smaller. */
export function area(size: number): string {
  return size >= 100 ? counted(Math.round(size)) : size.toPrecision(3);
}

/** All that there is to say of a place, as `say` takes it. */
export function placeSentence(scene: GlobeScene, place: number): string {
  const { lonlat, names } = scene.places!;
  // The letters that are marks for `say` look as others do.
  const plain = (text: string): string => text.replaceAll("*", "\u2217").replaceAll("_", "\u02cd");
  const name = (site: number): string => plain(names?.[site] || `Place ${site + 1}`);
  const at = `_${latitude(lonlat[2 * place + 1], 2)} ${longitude(lonlat[2 * place], 2)}_`;
  const values = toldOf(scene.places!).map(([title, values]) => {
    const [, what, unit] = /^(.*?)(?:, ([^,]*))?$/s.exec(title) ?? [];
    return `${plain(what)} _${plain(valueWords(values[place]))}_${unit ? ` ${plain(unit)}` : ""}`;
  });
  const { neighbours, nearest, kilometres } = scene.around(place);
  const away = fixed(kilometres, kilometres < 100 ? 1 : 0);
  const cell = `its cell has _${area(scene.area(place))}_ km² and _${neighbours}_ ${neighbours === 1 ? "neighbour" : "neighbours"}`;
  const next = nearest === null ? "" : `, the nearest is ${name(nearest)}, _${away}_ km away`;
  return `${name(place)}, ${at}${values.map((each) => `, ${each}`).join("")}; ${cell}${next}.`;
}
