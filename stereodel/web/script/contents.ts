/**
 * What the page carries with it: the kernel, land, sets of points, and points that its maker gave.
 *
 * Each is a text by name that `stereodel/web/contents.py` wrote: base64 of deflated bytes. In the page it stands in an
 * element `<script type="text/plain" id="block-NAME">`.
 */

import type { Owner } from "./rooms/owner.ts";
import type { Places } from "./rooms/globe_scene.ts";

/** Regions by rings that have them on their left; joined where maps are cut, at ±180° and along the poles. */
export interface Rings {
  /** Longitude and latitude in turn, degrees. */
  readonly lonlat: Float64Array;
  /** Ring i has the points from `offsets[i]` up to `offsets[i + 1]`; the first one is not repeated at its end. */
  readonly offsets: Uint32Array;
}

/** What a page, or a widget, carries with it. */
export class Contents {
  readonly #blocks: (name: string) => string | null;

  /** @param blocks gets the text of a name, or null where the page does not have it. */
  constructor(blocks: (name: string) => string | null) {
    this.#blocks = blocks;
  }

  /** The kernel, as bytes of WebAssembly. */
  async kernel(): Promise<Uint8Array<ArrayBuffer>> {
    const bytes = await this.#bytes("kernel");
    if (bytes === null) throw new Error("the page has no kernel");
    return bytes;
  }

  /** Land for maps of 1 : 50 or 1 : 110 million, lines, or the points of a set, by name; null where the page has none. */
  async rings(name: string): Promise<Rings | null> {
    const bytes = await this.#bytes(name);
    return bytes && places(bytes);
  }

  /** The points that the page was made for, or null. */
  async given(): Promise<Places | null> {
    const bytes = await this.#bytes("given");
    if (bytes === null) return null;
    const parsed = async (name: string): Promise<unknown> => JSON.parse((await this.text(name)) ?? "null");
    const owner = (await parsed("owner")) as Owner | null;
    return {
      name: String(await parsed("given-name")),
      lonlat: doubles(bytes),
      names: (await parsed("given-names")) as string[] | null,
      owner,
      values: new Map(owner?.columns),
      isolines: await this.rings("isolines"),
    };
  }

  /** A script that is compiled at first need, or what else is said of the page in a word. */
  async text(name: string): Promise<string | null> {
    const bytes = await this.#bytes(name);
    return bytes && new TextDecoder().decode(bytes);
  }

  async #bytes(name: string): Promise<Uint8Array<ArrayBuffer> | null> {
    const text = this.#blocks(name);
    if (text === null) return null;
    const stream = new Blob([fromBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }
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
