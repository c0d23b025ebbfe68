/** Names of columns: which are longitude and latitude, as `stereodel.io.columns` finds them. */

import { ColumnsError } from "./error.ts";
import { quoted } from "./python.ts";

/** Columns, and letters of the name of one, that a message lists. */
const NAMES_SHOWN = 30;
const NAME_SHOWN = 40;

/** Words for each, surest first; what it is called; the keyword of `read_points`. */
const KINDS = {
  lon: { sure: ["lon", "lng", "long", "longitude"], unsure: ["x"], meant: "longitude" },
  lat: { sure: ["lat", "latitude"], unsure: ["y"], meant: "latitude" },
} as const;

/**
 * Names of the columns of longitude and latitude: a name that is a word for it, in any case, comes before one that has
 * such a word in it, and that before `x` and `y`.
 *
 * @throws ColumnsError where there is none or more than one.
 */
export function findLonLat(names: readonly string[]): [string, string] {
  const lon = findOne(names, "lon");
  const lat = findOne(names, "lat");
  if (lon === lat) {
    throw new ColumnsError(`lon and lat are both the column ${quoted(lon)}; the columns are ${listed(names)}`, names);
  }
  return [lon, lat];
}

/** Whether names are those of longitude and latitude without asking. */
export function hasLonLat(names: readonly string[]): boolean {
  try {
    findLonLat(names);
    return true;
  } catch {
    return false;
  }
}

function findOne(names: readonly string[], kind: keyof typeof KINDS): string {
  const { sure, unsure, meant } = KINDS[kind];
  const isOne = (words: readonly string[], name: string): boolean => words.includes(name.trim().toLowerCase());
  const matches = [
    names.filter((name) => isOne(sure, name)),
    names.filter((name) => words(name).some((word) => (sure as readonly string[]).includes(word))),
    names.filter((name) => isOne(unsure, name)),
  ];
  for (const matching of matches) {
    if (matching.length === 1) return matching[0];
    if (matching.length > 1) {
      throw new ColumnsError(`${listed(matching)} may all be the ${meant}; say which with ${kind}=`, names);
    }
  }
  throw new ColumnsError(
    `no column looks like the ${meant}; say which with ${kind}=, the columns are ${listed(names)}`,
    names,
  );
}

/** Words of a column's name in lower case, split at signs and where a capital follows a small letter. */
function words(name: string): string[] {
  return name
    .replace(/(?<=[a-z])(?=[A-Z])/g, " ")
    .toLowerCase()
    .split(/[^a-z]+/);
}

/** Names for a message, which has room for so many of such lengths. */
export function listed(names: readonly string[]): string {
  if (names.length === 0) return "none at all";
  const shown = names.slice(0, NAMES_SHOWN).map((name) => {
    const letters = Array.from(name);
    return quoted(letters.length <= NAME_SHOWN ? name : `${letters.slice(0, NAME_SHOWN - 1).join("")}…`);
  });
  if (names.length > NAMES_SHOWN) shown.push(`and ${names.length - NAMES_SHOWN} more`);
  return shown.join(", ");
}
