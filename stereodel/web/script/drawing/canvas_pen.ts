/** The pen of the screen: a canvas with two dimensions. */

import type { Vector } from "../space.ts";
import { LIGHT, MOST_ARCS, Pen, textParts, traceDisc } from "./pen.ts";
import type { Bounds, Disc, Gradient, Picture, Trace } from "./pen.ts";
import * as styles from "./styles.ts";
import type { Colours, DotName, DotStyle, LabelStyle, Style, StyleName } from "./styles.ts";

/** Radius of dots, pixels, that look like squares of their area, which are filled in a tenth of the time. */
const TINY = 1.6;

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

export class CanvasPen extends Pen {
  readonly #context: Context;

  /** @param scale Pixels of the canvas for one of the drawing. */
  constructor(context: Context, width: number, height: number, scale: number, colours: Colours) {
    super(width, height, colours);
    this.#context = context;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.lineCap = context.lineJoin = "round";
    context.imageSmoothingQuality = "high";
  }

  protected path(_: StyleName, trace: Trace, ink: string | undefined, style: Style): void {
    const context = this.#context;
    context.beginPath();
    trace(context);
    if (style.fill !== undefined) {
      context.fillStyle = ink ?? this.colours[style.fill];
      this.within({ opacity: style.fillOpacity }, () => context.fill());
    }
    if (style.stroke !== undefined) {
      this.#line(style, ink);
      this.within({ opacity: style.strokeOpacity }, () => context.stroke());
    }
  }

  within({ opacity = 1, region, corner = [0, 0] }: Bounds, body: () => void): void {
    const context = this.#context;
    context.save();
    context.globalAlpha *= opacity;
    context.translate(...corner);
    if (region) {
      context.beginPath();
      region(context);
      context.clip();
    }
    body();
    context.restore();
  }

  protected discs(_: DotName, { radius: r, fill, rim, rimWidth, opacity }: DotStyle, places: ArrayLike<number>): void {
    const context = this.#context;
    this.within({ opacity }, () => {
      if (r < TINY) {
        const side = Math.sqrt(Math.PI) * r;
        context.fillStyle = this.colours[fill];
        for (let k = 0; k < places.length; k += 2)
          context.fillRect(places[k] - side / 2, places[k + 1] - side / 2, side, side);
        return;
      }
      const circles = (ink: string, size: number): void =>
        this.#circles(ink, 0, places.length / 2, (k) => [places[2 * k], places[2 * k + 1], size]);
      circles(this.colours[rim], r + rimWidth / 2);
      circles(this.colours[fill], r - rimWidth / 2);
    });
  }

  spots(places: ArrayLike<number>, inks: readonly string[]): void {
    this.#line(styles.STYLES["spot-line"]);
    const spot = (k: number): Vector => [places[3 * k], places[3 * k + 1], places[3 * k + 2]];
    for (let from = 0, to = 0; from < inks.length; from = to) {
      do ++to;
      while (inks[to] === inks[from] && inks[from].endsWith("/ 1)")); // of an ink that is seen through, one alone
      this.#circles(inks[from], from, to, spot, true);
    }
  }

  /** Circles by x, y and radius; some at a time, as a call for each takes longer than the circles. */
  #circles(ink: string, from: number, to: number, at: (k: number) => Vector, isRimmed = false): void {
    const context = this.#context;
    context.fillStyle = ink;
    for (let begin = from; begin < to; begin += MOST_ARCS) {
      context.beginPath();
      for (let k = begin; k < Math.min(to, begin + MOST_ARCS); ++k) {
        const [x, y, r] = at(k);
        context.moveTo(x + r, y);
        context.arc(x, y, r, 0, 2 * Math.PI);
      }
      context.fill();
      if (isRimmed) context.stroke();
    }
  }

  label(text: string, x: number, y: number, style: LabelStyle): void {
    const context = this.#context;
    const parts = textParts(text, style.italic ?? false).map((part) => {
      const font = (context.font = styles.fontOf(style, part.italic));
      return { text: part.text, font, width: context.measureText(part.text).width };
    });
    const length = parts.reduce((sum, part) => sum + part.width, 0);
    const start = x - (style.align === "center" ? length / 2 : style.align === "right" ? length : 0);
    context.setLineDash([]);
    context.lineWidth = styles.HALO_WIDTH;
    context.strokeStyle = this.inkOf(style.halo);
    context.fillStyle = this.inkOf(style.ink);
    for (const letters of ["strokeText", "fillText"] as const) {
      let at = start;
      for (const part of parts) {
        context.font = part.font;
        context[letters](part.text, at, y);
        at += part.width;
      }
    }
  }

  picture(picture: Picture, x: number, y: number, width: number, height: number): void {
    this.#context.drawImage(picture, x, y, width, height);
  }

  #line(style: Style, ink = this.colours[style.stroke ?? "ink"]): void {
    this.#context.strokeStyle = ink;
    this.#context.lineWidth = style.width ?? 1;
    this.#context.setLineDash([...(style.dash ?? [])]);
  }

  protected fillDisc(disc: Disc, fill: string | Gradient): void {
    const context = this.#context;
    const { x, y, r } = disc;
    if (typeof fill === "string") context.fillStyle = fill;
    else {
      const [focus, last] = [
        [x + LIGHT.fx * r, y + LIGHT.fy * r, 0],
        [x + LIGHT.cx * r, y + LIGHT.cy * r, LIGHT.r * r],
      ] as const;
      const gradient = context.createRadialGradient(...focus, ...last);
      for (const stop of fill.stops) gradient.addColorStop(...stop);
      context.fillStyle = gradient;
    }
    context.beginPath();
    traceDisc(context, disc);
    context.fill();
  }
}
