/** A picture of the whole sphere on a globe, through a lens, pixel by pixel. */

import { asCount } from "./checks.ts";
import { filled, Kept, run } from "./instance.ts";
import type { MoebiusMap } from "./moebius.ts";

const EDGES = Float64Array.of(-Math.PI, -Math.PI / 2, Math.PI, Math.PI / 2); // west, south, east, north in radians
const MOST_ACROSS = 2 ** 15;

/** Pixels of a page: the left and the upper edge, width and height of one in radii of the disc about its centre, y up. */
export type PixelPlace = readonly [left: number, top: number, width: number, height: number];

/**
 * A picture in longitude and latitude, twice as wide as high: a panorama, a map of the world. Pixels are those of the
 * Python class of the same name.
 */
export class Raster {
  readonly width: number;
  readonly height: number;
  private readonly texels: Kept;
  private readonly levels: Kept;

  /**
   * @param pixels sRGB and opacity, not premultiplied, as in `ImageData`; rows from the north, longitude -180 first.
   * @param width In pixels.
   */
  constructor(pixels: Uint8Array | Uint8ClampedArray, width: number) {
    this.width = asCount(width, "width", 2, 2 ** 20);
    this.height = width / 2;
    if (pixels.length !== 4 * this.width * this.height) {
      const whole = `four for each of ${width} × ${this.height} pixels: a picture of the whole globe`;
      throw new RangeError(`pixels has ${pixels.length} numbers, and not ${whole} is twice as wide as high`);
    }
    this.texels = new Kept(premultiplied(pixels));
    const size = run((session) => session.call("raster_levels_size", this.width, this.height));
    const given = [this.texels, this.width, this.height, EDGES];
    this.levels = new Kept(filled(Uint8Array, size, "raster_levels", ...given));
  }

  /**
   * The globe, seen from afar, which touches all four sides of the picture.
   *
   * @param map From the sphere of the picture to that of the view: the lens, then the rotation to x right, y up, z toward
   * the viewer.
   * @param size Pixels across the globe.
   * @returns sRGB and opacity, not premultiplied, rows from the top; opacity is also the part of a pixel in the globe.
   */
  warp(map: MoebiusMap, size: number): Uint8ClampedArray<ArrayBuffer> {
    return this.painted(map, [-1, 1, 2 / size, 2 / size], size, size);
  }

  /**
   * The same for `width` by `height` pixels anywhere on the page.
   *
   * @param covered Whether opacity says how much of a pixel lies in the globe; without, pixels on the limb are as opaque
   * as the picture, for one that is then cut along the limb.
   */
  painted(
    map: MoebiusMap,
    place: PixelPlace,
    width: number,
    height: number,
    covered = true,
  ): Uint8ClampedArray<ArrayBuffer> {
    asCount(width, "width", 1, MOST_ACROSS);
    asCount(height, "height", 1, MOST_ACROSS);
    // From the view back to the picture: rotation, fisheye, rotation; the last number stands for a ball seen from afar.
    const back = map.inverse();
    const page = Float64Array.of(...back.right.matrix, back.magnification, ...back.left.matrix, 0);
    const source = [this.texels, this.levels, this.width, this.height, EDGES];
    const given = [...source, page, Float64Array.of(...place), width, height, covered ? 1 : 0];
    return filled(Uint8ClampedArray, 4 * width * height, "warp_raster", ...given) as Uint8ClampedArray<ArrayBuffer>;
  }
}

/** Colours times opacity, which is what means are taken of. */
function premultiplied(pixels: Uint8Array | Uint8ClampedArray): Uint8Array {
  const texels = Uint8Array.from(pixels);
  for (let k = 0; k < texels.length; ++k) {
    if (k % 4 !== 3) texels[k] = Math.floor((texels[k] * texels[k | 3] + 127) / 255);
  }
  return texels;
}
