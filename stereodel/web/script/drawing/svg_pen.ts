/** The pen of SVG: the same trace as on the screen, with true arcs of ellipses. */

import { writeNumber } from "../link.ts";
import { LIGHT, Pen, textParts, type Bounds, type Disc, type Gradient, type Picture, type Trace } from "./pen.ts";
import { HALO_WIDTH, SERIF, STYLES } from "./styles.ts";
import type { DotName, DotStyle, LabelStyle, Style, StyleName } from "./styles.ts";

/** Decimals of a coordinate, pixels of the screen. */
const DECIMALS = 3;

/** Longest piece of an arc, radians: below half a turn its ends tell which of two arcs is meant. */
const LONGEST_PIECE = 3;

export class SvgPen extends Pen {
  readonly #definitions: string[] = [];
  readonly #parts: string[] = [];

  /** The whole drawing, on paper. */
  text(title: string): string {
    const [w, h] = [number(this.width), number(this.height)];
    const lines = [
      `<svg xmlns="http://www.w3.org/2000/svg" width="${w}" height="${h}" viewBox="0 0 ${w} ${h}">`,
      `<title>${escaped(title)}</title>`,
      ...(this.#definitions.length > 0 ? [`<defs>${this.#definitions.join("")}</defs>`] : []),
      `<rect width="${w}" height="${h}" ${paint("fill", this.colours.paper)}/>`,
      `<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${SERIF}'>`,
      ...this.#parts,
    ];
    return `${lines.join("\n")}\n</g>\n</svg>\n`;
  }

  protected path(name: StyleName, trace: Trace, ink: string | undefined, style: Style): void {
    const d = pathData(trace);
    if (d === "") return;
    const looks: string[] = [];
    if (style.fill !== undefined) looks.push(paint("fill", ink ?? this.colours[style.fill], style.fillOpacity));
    if (style.stroke !== undefined) looks.push(this.#line(style, ink));
    this.#parts.push(`<path class="${name}" ${looks.join(" ")} d="${d}"/>`);
  }

  within({ opacity = 1, region, corner }: Bounds, body: () => void): void {
    const id = `clip-${this.#definitions.length}`;
    if (region) this.#definitions.push(`<clipPath id="${id}"><path d="${pathData(region)}"/></clipPath>`);
    const clip = region ? ` clip-path="url(#${id})"` : "";
    const seen = opacity < 1 ? ` opacity="${opacity}"` : "";
    const place = corner ? ` transform="translate(${corner.map(number).join(" ")})"` : "";
    this.#parts.push(`<g${clip}${seen}${place}>`);
    body();
    this.#parts.push("</g>");
  }

  protected discs(name: DotName, style: DotStyle, places: ArrayLike<number>): void {
    const { radius, fill, rim, rimWidth, opacity } = style;
    const r = number(radius - rimWidth / 2);
    const id = `dots-${this.#definitions.length}`;
    const dots: string[] = [];
    for (let k = 0; k < places.length; k += 2) {
      dots.push(`<circle cx="${number(places[k])}" cy="${number(places[k + 1])}" r="${r}"/>`);
    }
    this.#definitions.push(`<g id="${id}">${dots.join("")}</g>`);
    const rims = `fill="none" ${paint("stroke", this.colours[rim], opacity)} stroke-width="${number(2 * rimWidth)}"`;
    this.#parts.push(`<use class="${name}-rim" href="#${id}" ${rims}/>`);
    this.#parts.push(`<use class="${name}" href="#${id}" ${paint("fill", this.colours[fill], opacity)}/>`);
  }

  spots(places: ArrayLike<number>, inks: readonly string[]): void {
    const line = this.#line(STYLES["spot-line"]);
    inks.forEach((ink, k) => {
      const [x, y, r] = [places[3 * k], places[3 * k + 1], places[3 * k + 2]].map(number);
      this.#parts.push(`<circle class="spot" cx="${x}" cy="${y}" r="${r}" ${paint("fill", ink)} ${line}/>`);
    });
  }

  label(text: string, x: number, y: number, style: LabelStyle): void {
    const anchor = { left: "start", center: "middle", right: "end" }[style.align ?? "left"];
    const words = textParts(text, style.italic ?? false)
      .map((part) => (part.italic ? `<tspan font-style="italic">${escaped(part.text)}</tspan>` : escaped(part.text)))
      .join("");
    const halo = `paint-order="stroke" ${paint("stroke", this.inkOf(style.halo))} stroke-width="${HALO_WIDTH}"`;
    const place = `x="${number(x)}" y="${number(y)}" font-size="${style.size}" text-anchor="${anchor}"`;
    this.#parts.push(`<text ${place} ${paint("fill", this.inkOf(style.ink))} ${halo}>${words}</text>`);
  }

  picture(picture: Picture, x: number, y: number, width: number, height: number): void {
    if (picture instanceof HTMLImageElement) {
      const svg = decodeURIComponent(picture.src.slice(picture.src.indexOf(",") + 1));
      return this.within({ corner: [x, y] }, () => this.#parts.push(svg));
    }
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [picture.width, picture.height];
    canvas.getContext("2d")!.drawImage(picture, 0, 0);
    const place = `x="${number(x)}" y="${number(y)}" width="${number(width)}" height="${number(height)}"`;
    this.#parts.push(`<image ${place} preserveAspectRatio="none" href="${canvas.toDataURL("image/png")}"/>`);
  }

  #line(style: Style, ink = this.colours[style.stroke ?? "ink"]): string {
    const dash = style.dash === undefined ? "" : ` stroke-dasharray="${style.dash.join(" ")}"`;
    return `${paint("stroke", ink, style.strokeOpacity)} stroke-width="${number(style.width ?? 1)}"${dash}`;
  }

  /** Places of a gradient are those of the square round a disc, of side 1. */
  protected fillDisc({ x, y, r }: Disc, fill: string | Gradient): void {
    const looks = typeof fill === "string" ? paint("fill", fill) : `fill="url(#${fill.id})"`;
    this.#parts.push(`<circle ${looks} cx="${number(x)}" cy="${number(y)}" r="${number(r)}"/>`);
    if (typeof fill === "string") return;
    const rows = fill.stops.map(([at, ink]) => `<stop offset="${at}" ${paint("stop-color", ink, 1, "stop-opacity")}/>`);
    const places = Object.entries(LIGHT).map(([name, at]) => `${name}="${number((at + (name === "r" ? 0 : 1)) / 2)}"`);
    const text = `<radialGradient id="${fill.id}" ${places.join(" ")}>${rows.join("")}</radialGradient>`;
    if (!this.#definitions.includes(text)) this.#definitions.push(text);
  }
}

/** What a trace lays down, as the attribute `d`. */
function pathData(trace: Trace): string {
  let d = "";
  trace({
    moveTo: (x, y) => (d += `M${number(x)} ${number(y)}`),
    lineTo: (x, y) => (d += `L${number(x)} ${number(y)}`),
    ellipse(x, y, rx, ry, rotation, from, to, counterclockwise = false) {
      const [c, s] = [Math.cos(rotation), Math.sin(rotation)];
      const at = (t: number): [number, number] => {
        const [u, v] = [rx * Math.cos(t), ry * Math.sin(t)];
        return [x + u * c - v * s, y + u * s + v * c];
      };
      if (d === "") this.moveTo(...at(from));
      else this.lineTo(...at(from));
      const pieces = Math.ceil(Math.abs(to - from) / LONGEST_PIECE);
      const looks = `${number(rx)} ${number(ry)} ${number((rotation * 180) / Math.PI)} 0 ${counterclockwise ? 0 : 1}`;
      for (let k = 1; k <= pieces; ++k) {
        const [px, py] = at(from + ((to - from) * k) / pieces);
        d += `A${looks} ${number(px)} ${number(py)}`;
      }
    },
    closePath: () => (d += "Z"),
  });
  return d;
}

/** A coordinate with few digits and no more zeros than it takes. */
function number(value: number): string {
  return writeNumber(value, DECIMALS);
}

/** A colour as attributes: those of CSS with an opacity of their own are not known to all readers of SVG. */
function paint(attribute: string, colour: string, opacity = 1, opacityName = `${attribute}-opacity`): string {
  const [red, green, blue, alpha = 1] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  const seen = alpha * opacity;
  const tail = seen === 1 ? "" : ` ${opacityName}="${number(seen)}"`;
  return `${attribute}="rgb(${red}, ${green}, ${blue})"${tail}`;
}

function escaped(text: string): string {
  return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
}
