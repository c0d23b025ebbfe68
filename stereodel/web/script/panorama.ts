/** A picture of the whole sphere on a globe: from a coarser one while it moves. */

import { make } from "./dom.ts";
import { traceDisc, type Disc, type Pen } from "./drawing/pen.ts";
import { Raster, type MoebiusMap } from "./kernel/api.ts";
import type { Messages } from "./messages.ts";

/** Widest picture that is kept, pixels; larger ones are made smaller. */
const WIDEST = 4096;

/** Width of the picture that is enough for a globe without a lens while it moves. */
const COARSE = 384;

/** Pixels of the drawing for one of the screen, at rest and while it moves. */
const SHARP = 2;
const ROUGH = 0.3;

/** How far width and height may be from two to one. */
const RATIO_ERROR = 0.01;

/** Calls `opened` with the picture of a file, or says why there is none of the whole sphere. */
export async function openPanorama(file: File, messages: Messages, opened: (picture: Painted) => void): Promise<void> {
  const bitmap = await createImageBitmap(file).catch(() => null);
  if (bitmap === null || Math.abs(bitmap.width / bitmap.height - 2) > RATIO_ERROR) {
    const size = bitmap && `is ${bitmap.width} × ${bitmap.height}; one of the whole sphere is twice as wide as high`;
    messages.show(`${file.name}:`, `the picture ${size ?? "cannot be read"}. Nothing has changed.`);
    return;
  }
  const pictures: ImageData[] = [];
  let source: CanvasImageSource = bitmap;
  let half = Math.round(Math.min(bitmap.width, WIDEST) / 2);
  do {
    const canvas = make("canvas", { width: 2 * half, height: half });
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.drawImage(source, 0, 0, 2 * half, half);
    pictures.push(context.getImageData(0, 0, 2 * half, half));
    [source, half] = [canvas, Math.round(half / 2)];
  } while (2 * half >= COARSE);
  bitmap.close();
  messages.close();
  opened(new Painted(file.name, pictures));
}

export class Painted {
  readonly name: string;
  /** Each half as wide as the one before. */
  readonly #rasters: readonly Raster[];
  /** Inks of labels that are read on any picture. */
  readonly letters = { ink: "rgb(255, 255, 255)", accent: "rgb(245, 160, 98)", halo: "rgb(24 26 28 / 0.55)" } as const;

  constructor(name: string, pictures: readonly ImageData[]) {
    this.name = name;
    this.#rasters = pictures.map(({ data, width }) => new Raster(data, width));
  }

  draw(pen: Pen, disc: Disc, map: MoebiusMap, isMoving: boolean): void {
    const size = Math.max(1, Math.ceil(2 * disc.r * (isMoving ? ROUGH : Math.min(SHARP, devicePixelRatio))));
    const isEnough = ({ width }: Raster): boolean => !isMoving || width <= COARSE * map.magnification;
    const raster = this.#rasters.find(isEnough) ?? this.#rasters[this.#rasters.length - 1];
    const image = new ImageData(raster.painted(map, [-1, 1, 2 / size, 2 / size], size, size, false), size, size);
    const canvas = make("canvas", { width: size, height: size });
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    pen.within({ region: (path) => traceDisc(path, disc) }, () =>
      pen.picture(canvas, disc.x - disc.r, disc.y - disc.r, 2 * disc.r, 2 * disc.r),
    );
  }
}
