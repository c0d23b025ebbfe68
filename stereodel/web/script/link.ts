/**
 * The state of the page as the fragment of its address: `#v=1&room=sphere&lat=20&…`, or the name of a room alone.
 * What a link says is checked here and by the rooms before anything is drawn: whatever cannot be read is a `LinkError`,
 * and the page shows the room as it begins.
 */

import { fromBase64, signed, wholeNumbers } from "./bytes.ts";

export const ROOMS = ["sphere", "lift", "globe"] as const;
export type RoomName = (typeof ROOMS)[number];

/** Sites that a link holds; more are named but not held. */
export const MOST_SITES = 2000;

/** Letters of the longest link that is read: 2 000 places as doubles, and room for everything else. */
const LONGEST = 65536;

/** Steps of a degree, or of the unit of a plane, in which places are stored as whole numbers. */
const STEP = 1e7;

/** Largest coordinate of a plane that a link holds: in steps it is still a whole number of a double. */
const FARTHEST = 4e8;

/** A link that says nothing that can be shown. */
export class LinkError extends Error {}

/** What a link says: a room and its values by name. */
export interface Link {
  readonly room: RoomName;
  readonly values: LinkValues;
}

/** Values of a room by name, as text, with readers that check. */
export class LinkValues {
  readonly #values: ReadonlyMap<string, string>;

  constructor(values: Iterable<readonly [string, string]> | Record<string, string> = []) {
    this.#values = new Map(Symbol.iterator in values ? values : Object.entries(values));
  }

  has(name: string): boolean {
    return this.#values.has(name);
  }

  entries(): [string, string][] {
    return [...this.#values];
  }

  /** Text, or `otherwise` where the link does not say. */
  text(name: string, otherwise: string): string {
    return this.#values.get(name) ?? otherwise;
  }

  /** One of some words. */
  word<T extends string>(name: string, words: readonly T[], otherwise: T): T {
    const text = this.#values.get(name);
    if (text === undefined) return otherwise;
    const word = words.find((word) => word === text);
    if (word === undefined) throw new LinkError(`${name} is not one of ${words.join(", ")}`);
    return word;
  }

  /** A number in [low, high]: digits, a sign and a point, as `writeNumber` writes them. */
  number(name: string, low: number, high: number, otherwise: number): number {
    const text = this.#values.get(name);
    if (text === undefined) return otherwise;
    const value = /^-?\d{1,16}(\.\d{1,16})?(e-?\d{1,2})?$/.test(text) ? Number(text) : NaN;
    if (!(value >= low && value <= high)) throw new LinkError(`${name} is not a number from ${low} to ${high}`);
    return value;
  }

  /** A whole number in [low, high]. */
  whole(name: string, low: number, high: number, otherwise: number): number {
    const value = this.number(name, low, high, otherwise);
    if (!Number.isInteger(value)) throw new LinkError(`${name} is not a whole number`);
    return value;
  }

  /** A longitude and a latitude, degrees, whose names begin alike. */
  place(name: string, [lon, lat]: readonly [number, number]): [number, number] {
    return [this.number(`${name}lon`, -360, 360, lon), this.number(`${name}lat`, -90, 90, lat)];
  }

  /** Pairs of coordinates, (n, 2); null where the link holds none. */
  places(name: string): Float64Array | null {
    const text = this.#values.get(name);
    return text === undefined ? null : unpackPlaces(text);
  }

  /** Those of the Earth: longitude and latitude in degrees. */
  lonlat(name: string): Float64Array | null {
    const lonlat = this.places(name);
    if (lonlat?.some((value, k) => k % 2 === 1 && Math.abs(value) > 90)) {
      throw new LinkError("the link holds sites beyond the poles");
    }
    return lonlat;
  }
}

/**
 * Reads the fragment of an address, with or without its `#`.
 * @throws LinkError where it is neither empty, nor the name of a room, nor a state of this version.
 */
export function readLink(hash: string): Link {
  const text = hash.replace(/^#/, "");
  if (text.length > LONGEST) throw new LinkError("the link is too long");
  if (text === "") return { room: "sphere", values: new LinkValues() };
  const alone = ROOMS.find((room) => room === text);
  if (alone !== undefined) return { room: alone, values: new LinkValues() };
  const values = new Map<string, string>();
  for (const part of text.split("&")) {
    const [name, value] = split(part);
    if (values.has(name)) throw new LinkError(`${name} stands twice in the link`);
    values.set(name, value);
  }
  if (values.get("v") !== "1") throw new LinkError("the link is of no known version");
  const room = ROOMS.find((room) => room === values.get("room"));
  if (room === undefined) throw new LinkError("the link names no room");
  values.delete("v");
  values.delete("room");
  return { room, values: new LinkValues(values) };
}

function split(part: string): [string, string] {
  const at = part.indexOf("=");
  try {
    if (at > 0) return [decodeURIComponent(part.slice(0, at)), decodeURIComponent(part.slice(at + 1))];
  } catch {
    // a percent sign without its digits: told below
  }
  throw new LinkError("the link has a part that is not name=value");
}

/** The fragment of a state, without its `#`. */
export function writeLink(room: RoomName, values: Record<string, string>): string {
  const parts = Object.entries(values).map(([name, value]) => `${encode(name)}=${encode(value)}`);
  return ["v=1", `room=${room}`, ...parts].join("&");
}

/** Percent signs only where they are needed, so that a link can be read by people, too. */
function encode(text: string): string {
  return encodeURIComponent(text).replace(/%(2C|2F|3A|20)/g, (code) =>
    code === "%20" ? "%20" : decodeURIComponent(code),
  );
}

/** A number with at most so many decimals and no more zeros than it takes. */
export function writeNumber(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  const short = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return short === "-0" ? "0" : short;
}

/** A longitude and a latitude as values of a link. */
export function writePlace(
  name: string,
  [lon, lat]: readonly [number, number],
  decimals: number,
): Record<string, string> {
  return { [`${name}lon`]: writeNumber(lon, decimals), [`${name}lat`]: writeNumber(lat, decimals) };
}

/**
 * Pairs of coordinates as text of a link.
 * Places that are whole steps of 1e-7 are "d" and the differences from place to place, zigzag coded, seven bits a byte;
 * others are "f" and the doubles as they stand. Nothing is rounded.
 */
export function packPlaces(places: Float64Array): string {
  const steps = Array.from(places, (value) => Math.round(value * STEP));
  const whole = steps.every((step, k) => step / STEP === places[k] && Number.isSafeInteger(step));
  return whole ? "d" + toBase64(deltas(steps)) : "f" + toBase64(new Uint8Array(places.slice().buffer));
}

/** The places of `packPlaces`. */
export function unpackPlaces(text: string): Float64Array {
  const bytes = bytesOf(text.slice(1));
  let places: Float64Array;
  if (text[0] === "d") places = Float64Array.from(sums(bytes), (step) => step / STEP);
  else if (text[0] === "f" && bytes.length % 16 === 0) places = new Float64Array(bytes.slice().buffer);
  else throw new LinkError("the link holds sites that cannot be read");
  if (places.length % 2 !== 0 || places.length > 2 * MOST_SITES)
    throw new LinkError("the link holds half a site, or too many");
  if (!places.every((value) => Math.abs(value) <= FARTHEST))
    throw new LinkError("the link holds sites that are nowhere");
  return places;
}

function deltas(steps: number[]): Uint8Array {
  const bytes: number[] = [];
  steps.forEach((step, k) => {
    const difference = step - (steps[k - 2] ?? 0);
    let rest = difference < 0 ? -2 * difference - 1 : 2 * difference;
    for (; rest >= 128; rest = Math.floor(rest / 128)) bytes.push(128 + (rest % 128)); // beyond 32 bits: no shifts
    bytes.push(rest);
  });
  return Uint8Array.from(bytes);
}

function sums(bytes: Uint8Array): number[] {
  const numbers = wholeNumbers(bytes);
  if (!numbers.every(Number.isSafeInteger))
    throw new LinkError("the link ends amid a site, or holds one that is nowhere");
  const steps: number[] = [];
  numbers.forEach((number, k) => steps.push(signed(number) + (steps[k - 2] ?? 0)));
  return steps;
}

function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

function bytesOf(text: string): Uint8Array {
  try {
    if (/^[\w-]*$/.test(text)) return fromBase64(text.replace(/-/g, "+").replace(/_/g, "/"));
  } catch {
    // a letter too many: told below
  }
  throw new LinkError("the link holds sites that cannot be read");
}
