/** A drawing as a file: its size, and what draws it. */

import { CanvasPen } from "./canvas_pen.ts";
import { colours } from "./colours.ts";
import type { Pen } from "./pen.ts";
import { SvgPen } from "./svg_pen.ts";

/** A picture of a size in pixels of the screen. */
export interface Sheet {
  readonly title: string;
  readonly width: number;
  readonly height: number;
  /** Factor of the widths of lines. */
  readonly weight: number;
  readonly paint: (pen: Pen) => void;
}

/** The picture as SVG, in the colours of the screen. */
export function sheetSvg({ title, width, height, weight, paint }: Sheet): string {
  const pen = new SvgPen(width, height, colours(), weight);
  paint(pen);
  return pen.text(title);
}

/** The picture as PNG with so many pixels for one of the screen. */
export function sheetPng({ width, height, weight, paint }: Sheet, scale: number): Promise<Blob> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [Math.round(width * scale), Math.round(height * scale)];
  const context = canvas.getContext("2d")!;
  context.fillStyle = colours().paper;
  context.fillRect(0, 0, canvas.width, canvas.height);
  paint(new CanvasPen(context, width, height, scale, colours(), weight));
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob === null ? reject(new Error("the picture is too large")) : resolve(blob)));
  });
}
