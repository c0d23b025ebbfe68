/** Sets of sites to begin with: those that come with the page, and those that are made here. */

import type { Places } from "./rooms/globe_scene.ts";
import { lonLatOf, type Vector } from "./space.ts";

/** A set: its name in links, its words in the list, its places (n, 2). */
export interface SiteSet {
  readonly name: string;
  readonly words: string;
  readonly make: () => Float64Array;
  /** Of the sites, where they have any. */
  readonly names?: readonly string[] | null;
}

/** Longitudes and latitudes in turn by the names of sets. */
export type Stored = Readonly<Record<string, Float64Array>>;

/** The sets of the sphere: those that the page was made for and carries, and a dodecahedron. */
export function sphereSets(stored: Stored, given: Places | null): SiteSet[] {
  const kept = (name: string, words: string, places = stored[name], names: SiteSet["names"] = null): SiteSet[] =>
    places?.length > 0 ? [{ name, words, names, make: () => places }] : [];
  return [
    ...(given === null ? [] : kept("given", given.name, given.lonlat, given.names)),
    ...kept("gap", "Scattered, with a gap round P"),
    ...kept("everywhere", "Scattered everywhere"),
    ...kept("hemisphere", "In one hemisphere"),
    ...kept("cities", "Cities"),
    ...kept("airports", "Airports"),
    ...kept("stars", "Stars"),
    { name: "dodecahedron", words: "Corners of a dodecahedron", make: dodecahedron },
  ];
}

/** Longitude and latitude of the twenty corners, as near as doubles come. */
function dodecahedron(): Float64Array {
  const golden = (1 + Math.sqrt(5)) / 2;
  const corners: Vector[] = [];
  for (const s of [-1, 1]) {
    for (const t of [-1, 1]) {
      for (const u of [-1, 1]) corners.push([s, t, u]);
      corners.push([0, s / golden, t * golden], [s / golden, t * golden, 0], [t * golden, 0, s / golden]);
    }
  }
  return Float64Array.from(corners.flatMap(lonLatOf));
}
