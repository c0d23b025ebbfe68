/**
 * What the page carries with it: the kernel, land, sets of points, and points that its maker gave.
 *
 * Each is a text by name that `stereodel/web/contents.py` wrote: base64 of deflated bytes.
 */

import type { Latitude } from "./kernel/api.ts";
import type { Column, Owner } from "./rooms/owner.ts";

/** Regions by rings that have them on their left; joined where maps are cut, at ±180° and along the poles. */
export interface Rings {
  /** Longitude and latitude in turn, degrees. */
  readonly lonlat: Float64Array;
  /** Ring i has the points from `offsets[i]` up to `offsets[i + 1]`; the first one is not repeated at its end. */
  readonly offsets: Uint32Array;
}

/** Points that the page's maker gave. */
export interface Given {
  /** What the maker says of them. */
  readonly owner: Owner | null;
  readonly values: ReadonlyMap<string, Column>;
  /** Lines of equal values, rows of places. */
  readonly isolines: Rings | null;
  /** What they are called, such as "cities.csv". */
  readonly name: string;
  /** Longitude and latitude in turn, degrees, to the bit. */
  readonly lonlat: Float64Array;
  readonly names: readonly string[] | null;
}

/** What a page, or a widget, carries with it. */
export class Contents {
  readonly #blocks: (name: string) => string | null;

  /** @param blocks gets the text of a name, or null where the page does not have it. */
  constructor(blocks: (name: string) => string | null) {
    this.#blocks = blocks;
  }

  /** What stands in the document's own elements `<script type="text/plain" id="block-NAME">`. */
  static ofDocument(): Contents {
    return new Contents((name) => document.getElementById(`block-${name}`)?.textContent ?? null);
  }

  /** The kernel, as bytes of WebAssembly. */
  kernel(): Promise<Uint8Array<ArrayBuffer>> {
    return this.#needed("kernel");
  }

  /** The text of a script that is compiled at first need. */
  async script(name: string): Promise<string> {
    return new TextDecoder().decode(await this.#needed(name));
  }

  /** Land for maps of 1 : 50 or 1 : 110 million; null where the page does not have it, which may be so of the former. */
  async land(resolution: "50m" | "110m"): Promise<Rings | null> {
    return this.#rings(`land-${resolution}`);
  }

  async #rings(name: string): Promise<Rings | null> {
    const bytes = await this.#bytes(name);
    return bytes && places(bytes);
  }

  /** The points of a set: longitude and latitude in turn, degrees, or x and y of the sheet. */
  async set(name: string): Promise<Float64Array> {
    return (await this.#rings(name))?.lonlat ?? new Float64Array(0);
  }

  /** The points that the page was made for, or null. */
  async given(): Promise<Given | null> {
    const [name, bytes, names] = [
      await this.#text("given-name"),
      await this.#bytes("given"),
      await this.#text("given-names"),
    ];
    if (name === null || bytes === null) return null;
    const owner = JSON.parse((await this.#text("owner")) ?? "null") as Owner | null;
    return {
      name: String(JSON.parse(name)),
      lonlat: doubles(bytes),
      names: JSON.parse(names ?? "null") as string[] | null,
      owner,
      values: new Map(owner?.columns),
      isolines: await this.#rings("isolines"),
    };
  }

  /** The state of a page that was saved by its reader, as a link without its `#`; empty on any other page. */
  async state(): Promise<string> {
    return (await this.#text("state")) ?? "";
  }

  /** What latitudes of places are on this page: those of the ellipsoid with equal areas, if it does not say. */
  async latitude(): Promise<Latitude> {
    return ((await this.#text("latitude")) as Latitude | null) ?? "authalic";
  }

  async #needed(name: string): Promise<Uint8Array<ArrayBuffer>> {
    const bytes = await this.#bytes(name);
    if (bytes === null) throw new Error(`the page has no ${name}`);
    return bytes;
  }

  async #text(name: string): Promise<string | null> {
    const bytes = await this.#bytes(name);
    return bytes && new TextDecoder().decode(bytes);
  }

  async #bytes(name: string): Promise<Uint8Array<ArrayBuffer> | null> {
    const text = this.#blocks(name);
    return text === null ? null : inflated(text);
  }
}

async function inflated(text: string): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([fromBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Rows of places: digits, number of rows, their sizes, steps of all longitudes, steps of all latitudes. */
function places(bytes: Uint8Array): Rings {
  const [digits, rows, ...numbers] = wholeNumbers(bytes);
  const offsets = new Uint32Array(rows + 1);
  for (let row = 0; row < rows; ++row) offsets[row + 1] = offsets[row] + numbers[row];
  const [count, unit] = [offsets[rows], 10 ** digits];
  const lonlat = new Float64Array(2 * count);
  for (let axis = 0; axis < 2; ++axis) {
    let place = 0;
    for (let k = 0; k < count; ++k) {
      const step = numbers[rows + axis * count + k]; // its sign is the last bit
      place += step % 2 === 1 ? -(step + 1) / 2 : step / 2;
      lonlat[2 * k + axis] = place / unit;
    }
  }
  return { lonlat, offsets };
}

/** Doubles, whose bytes are sorted by their places in the number. */
function doubles(bytes: Uint8Array): Float64Array {
  const count = bytes.length / 8;
  const sorted = new Uint8Array(bytes.length);
  for (let k = 0; k < count; ++k)
    for (let place = 0; place < 8; ++place) sorted[8 * k + place] = bytes[place * count + k];
  return new Float64Array(sorted.buffer);
}

/** The bytes of base64. */
function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

/** Numbers of seven bits a byte, the lowest first. */
function wholeNumbers(bytes: Uint8Array): number[] {
  const numbers: number[] = [];
  let [number, weight] = [0, 1];
  for (const byte of bytes) {
    number += (byte % 128) * weight; // products and not shifts, which end at 32 bits
    weight *= 128;
    if (byte >= 128) continue;
    numbers.push(number);
    [number, weight] = [0, 1];
  }
  return numbers;
}
