/** The script of files: points and pictures that are opened, drawings and data that are taken along. */

import { make } from "./dom.ts";
import { CanvasPen } from "./drawing/canvas_pen.ts";
import type { Sheet } from "./drawing/pen.ts";
import { colours } from "./drawing/styles.ts";
import { SvgPen } from "./drawing/svg_pen.ts";
import { openPoints } from "./files.ts";
import { geojson } from "./geojson.ts";
import { openPanorama } from "./panorama.ts";
import { framed } from "./rooms/framed.ts";
import { globePython, liftPython, spherePython } from "./rooms/python.ts";
import { writeTable } from "./tables/delimited.ts";

/** Saves a file under the reader's downloads. */
function download(name: string, content: Blob | string): void {
  const blob = new Blob([content]);
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000); // browsers read it after the click
}

/** The picture as SVG, in the colours of the screen. */
async function sheetSvg(sheet: Sheet): Promise<string> {
  const { title, width, height, paint } = await framed(sheet, colours().ink);
  const pen = new SvgPen(width, height, colours());
  paint(pen);
  return pen.text(title);
}

/** The picture as PNG with so many pixels for one of the screen. */
async function sheetPng(sheet: Sheet, scale: number): Promise<Blob> {
  const { width, height, paint } = await framed(sheet, colours().ink);
  const canvas = make("canvas", { width: Math.round(width * scale), height: Math.round(height * scale) });
  const context = canvas.getContext("2d")!;
  context.fillStyle = colours().paper;
  context.fillRect(0, 0, canvas.width, canvas.height);
  paint(new CanvasPen(context, width, height, scale, colours()));
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob === null ? reject(new Error("the picture is too large")) : resolve(blob)));
  });
}

/**
 * The page as a file with a state in it: its own source, in which the state of any length is one more text.
 * @param source The document as it was before its script ran. @param state As a link without its `#`.
 */
async function savedPage(source: Node, state: string): Promise<Blob> {
  const page = source.cloneNode(true) as HTMLElement;
  page.querySelector("#block-state")?.remove();
  const stream = new Blob([state]).stream().pipeThrough(new CompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const text = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")); // as `Contents` reads it
  page.querySelector("#block-kernel")!.before(make("script", { type: "text/plain", id: "block-state" }, text), "\n");
  return new Blob(["<!doctype html>\n", page.outerHTML, "\n"], { type: "text/html" });
}

const exchange = {
  csv: writeTable,
  download,
  geojson,
  globePython,
  liftPython,
  openPanorama,
  openPoints,
  savedPage,
  sheetPng,
  sheetSvg,
  spherePython,
};

export type Exchange = typeof exchange;

Object.assign(document.currentScript!, { offers: exchange });
