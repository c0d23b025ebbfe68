/** A picture that is no canvas of the page: several drawings beside each other, as a file. */

import { CanvasPen } from "./canvas_pen.ts";
import { colours } from "./colours.ts";
import type { Pen } from "./pen.ts";
import { SvgPen } from "./svg_pen.ts";

/** A picture of a size in pixels of the screen, and what draws it. */
export interface Sheet {
  readonly width: number;
  readonly height: number;
  readonly paint: (pen: Pen) => void;
}

/** The picture as SVG, in the colours of the screen. */
export function sheetSvg({ width, height, paint }: Sheet, title: string): string {
  const pen = new SvgPen(width, height, colours(), 1);
  paint(pen);
  return pen.text(title);
}

/** The picture as PNG with so many pixels for one of the screen. */
export function sheetPng({ width, height, paint }: Sheet, scale: number): Promise<Blob> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [Math.round(width * scale), Math.round(height * scale)];
  const context = canvas.getContext("2d")!;
  context.fillStyle = colours().paper;
  context.fillRect(0, 0, canvas.width, canvas.height);
  paint(new CanvasPen(context, width, height, scale, colours(), 1));
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob === null ? reject(new Error("the picture is too large")) : resolve(blob)));
  });
}
