/** A picture of the whole sphere on a globe: drawn by the graphics processor while it moves, by the kernel at rest. */

import type { Disc, Pen } from "./drawing/pen.ts";
import type { Messages } from "./messages.ts";
import { Raster } from "./kernel/api.ts";
import type { MoebiusMap } from "./kernel/api.ts";
import { PanoramaShader } from "./panorama_shader.ts";

/** Widest picture that is kept, pixels; larger ones are made smaller. */
const WIDEST = 4096;

/** Pixels of the kernel's picture for one of the screen, at rest and, without a graphics processor, while it moves. */
const SHARP = 2;
const ROUGH = 0.25;

/** How far width and height may be from two to one. */
const RATIO_ERROR = 0.01;

/** A file that is no picture, or one that is not twice as wide as high. */
class PictureError extends Error {}

/** Calls `opened` with the picture of a file, or says why there is none. */
export async function openPanorama(file: File, messages: Messages, opened: (picture: Painted) => void): Promise<void> {
  let picture: Painted;
  try {
    picture = await Painted.read(file);
  } catch (error) {
    if (!(error instanceof PictureError)) throw error;
    messages.show(`${file.name}:`, `${error.message}. Nothing has changed.`);
    return;
  }
  messages.close();
  opened(picture);
}

export class Painted {
  readonly name: string;
  readonly #raster: Raster;
  readonly #shader: PanoramaShader | null;

  private constructor(name: string, pixels: ImageData) {
    this.name = name;
    this.#raster = new Raster(pixels.data, pixels.width);
    this.#shader = PanoramaShader.of(pixels);
  }

  /** @throws PictureError for what is no picture of the whole sphere. */
  static async read(file: File): Promise<Painted> {
    let bitmap: ImageBitmap;
    try {
      bitmap = await createImageBitmap(file);
    } catch {
      throw new PictureError("the picture cannot be read");
    }
    const { width, height } = bitmap;
    if (Math.abs(width / height - 2) > RATIO_ERROR) {
      throw new PictureError(`the picture is ${width} × ${height}; one of the whole sphere is twice as wide as high`);
    }
    const canvas = document.createElement("canvas");
    canvas.width = 2 * Math.round(Math.min(width, WIDEST) / 2);
    canvas.height = canvas.width / 2;
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
    bitmap.close();
    return new Painted(file.name, context.getImageData(0, 0, canvas.width, canvas.height));
  }

  draw(pen: Pen, disc: Disc, map: MoebiusMap, isMoving: boolean): void {
    const scale = isMoving && this.#shader === null ? ROUGH : Math.min(SHARP, devicePixelRatio);
    const size = Math.max(1, Math.ceil(2 * disc.r * scale));
    const picture = isMoving && this.#shader !== null ? this.#shader.draw(map, size) : this.#exact(map, size);
    pen.clipped(
      (path) => path.ellipse(disc.x, disc.y, disc.r, disc.r, 0, 0, 2 * Math.PI),
      () => pen.picture(picture, disc.x - disc.r, disc.y - disc.r, 2 * disc.r, 2 * disc.r),
    );
  }

  #exact(map: MoebiusMap, size: number): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = size;
    const image = new ImageData(this.#raster.painted(map, [-1, 1, 2 / size, 2 / size], size, size, false), size, size);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    return canvas;
  }
}
