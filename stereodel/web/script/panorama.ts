/** A picture of the whole sphere on a globe, drawn by the kernel: with fewer pixels while it moves. */

import { make } from "./dom.ts";
import type { Disc, Pen } from "./drawing/pen.ts";
import { Raster, type MoebiusMap } from "./kernel/api.ts";
import type { Messages } from "./messages.ts";

/** Widest picture that is kept, pixels; larger ones are made smaller. */
const WIDEST = 4096;

/** Pixels of the kernel's picture for one of the screen, at rest and while it moves. */
const SHARP = 2;
const ROUGH = 0.5;

/** How far width and height may be from two to one. */
const RATIO_ERROR = 0.01;

/** Calls `opened` with the picture of a file, or says why there is none. */
export async function openPanorama(file: File, messages: Messages, opened: (picture: Painted) => void): Promise<void> {
  const picture = await Painted.read(file);
  if (typeof picture === "string") messages.show(`${file.name}:`, `${picture}. Nothing has changed.`);
  else {
    messages.close();
    opened(picture);
  }
}

export class Painted {
  readonly name: string;
  readonly #raster: Raster;

  private constructor(name: string, pixels: ImageData) {
    this.name = name;
    this.#raster = new Raster(pixels.data, pixels.width);
  }

  /** The picture, or why there is none of the whole sphere. */
  static async read(file: File): Promise<Painted | string> {
    const bitmap = await createImageBitmap(file).catch(() => null);
    if (bitmap === null) return "the picture cannot be read";
    const { width, height } = bitmap;
    if (Math.abs(width / height - 2) > RATIO_ERROR) {
      return `the picture is ${width} × ${height}; one of the whole sphere is twice as wide as high`;
    }
    const half = Math.round(Math.min(width, WIDEST) / 2);
    const canvas = make("canvas", { width: 2 * half, height: half });
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
    bitmap.close();
    return new Painted(file.name, context.getImageData(0, 0, canvas.width, canvas.height));
  }

  draw(pen: Pen, disc: Disc, map: MoebiusMap, isMoving: boolean): void {
    const size = Math.max(1, Math.ceil(2 * disc.r * (isMoving ? ROUGH : Math.min(SHARP, devicePixelRatio))));
    const canvas = make("canvas", { width: size, height: size });
    const image = new ImageData(this.#raster.painted(map, [-1, 1, 2 / size, 2 / size], size, size, false), size, size);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    pen.clipped(
      (path) => path.ellipse(disc.x, disc.y, disc.r, disc.r, 0, 0, 2 * Math.PI),
      () => pen.picture(canvas, disc.x - disc.r, disc.y - disc.r, 2 * disc.r, 2 * disc.r),
    );
  }
}
