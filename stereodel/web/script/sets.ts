/** Sets of sites to begin with: those that come with the page, and those that are made here. */

import type { Given } from "./contents.ts";
import { lonLatOf, type Vector } from "./space.ts";

/** A set: its name in links, its words in the list, its places (n, 2). */
export interface SiteSet {
  readonly name: string;
  readonly words: string;
  readonly make: () => Float64Array;
  /** Of the sites, where they have any. */
  readonly names?: readonly string[] | null;
}

/** Decimals of a degree to which places that are made here are rounded: links stay short. */
const DECIMALS = 3;

/** Longitudes and latitudes in turn by the names of sets. */
export type Stored = Readonly<Record<string, Float64Array>>;

/** The sets of the sphere: those that the page was made for and carries, and those that are made here. */
export function sphereSets(stored: Stored, given: Given | null): SiteSet[] {
  const kept = (name: string, words: string): SiteSet[] => {
    const places = stored[name];
    return places === undefined || places.length === 0 ? [] : [{ name, words, make: () => places }];
  };
  return [
    ...(given === null || given.lonlat.length === 0
      ? []
      : [{ name: "given", words: given.name, names: given.names, make: () => given.lonlat }]),
    ...kept("gap", "Scattered, with a gap round P"),
    { name: "everywhere", words: "Scattered everywhere", make: () => scatteredOnSphere(72, 90) },
    { name: "hemisphere", words: "In one hemisphere", make: () => scatteredOnSphere(40, 75) },
    ...kept("cities", "Cities"),
    ...kept("airports", "Airports"),
    ...kept("stars", "Stars"),
    { name: "dodecahedron", words: "Corners of a dodecahedron", make: dodecahedron },
  ];
}

/** Sites over the cap about (0° E, 0° N) that reaches so many degrees, or everywhere from 90 on. */
function scatteredOnSphere(count: number, reach: number): Float64Array {
  const random = randomNumbers(count + reach);
  const low = reach < 90 ? Math.cos((reach * Math.PI) / 180) : -1;
  const draw = (): Vector => {
    const x = low + (1 - low) * random();
    const turn = 2 * Math.PI * random();
    const h = Math.sqrt(1 - x * x);
    return [x, h * Math.cos(turn), h * Math.sin(turn)];
  };
  return rounded(spread(count, draw).flatMap(lonLatOf));
}

/** A site after the other, each the farthest from those before of so many drawn. */
function spread(count: number, draw: () => Vector, drawn = 14): Vector[] {
  const sites = [draw()];
  const apart = (a: Vector, b: Vector): number => Math.hypot(...a.map((x, k) => x - b[k]));
  const alone = (site: Vector): number => Math.min(...sites.map((other) => apart(site, other)));
  while (sites.length < count) {
    const candidates = Array.from({ length: drawn }, draw);
    sites.push(candidates.reduce((best, site) => (alone(site) > alone(best) ? site : best)));
  }
  return sites;
}

/** The same numbers in [0, 1) on every machine: the generator mulberry32. */
function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

function rounded(values: number[]): Float64Array {
  return Float64Array.from(values, (value) => Number(value.toFixed(DECIMALS)));
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
