/** The plane beside the sphere: stereographic projection from a pole to the plane that touches opposite it, and its frame. */

import type { Point } from "../drawing/pen.ts";
import { dot, lonLatOf, type Vector } from "../space.ts";
import type { SphereSites } from "./sphere_sites.ts";

/** Cosines nearer to each other than this are those of a circle through the pole: its radius would be 1e12 ball radii. */
const THROUGH_POLE = 1e-12;

/** Where the plane ends, ball radii. */
const FAR = 1e9;

/**
 * The projection from `pole`, in ball radii, with the axes of the library's `Stereographic`: u east and v north at the
 * point of contact.
 */
export class Twin {
  readonly pole: Vector;
  readonly #south: Vector;
  readonly #east: Vector;
  readonly #north: Vector;

  constructor(pole: Vector) {
    this.pole = pole;
    const south: Vector = [0 - pole[0], 0 - pole[1], 0 - pole[2]]; // no zeros below 0, whose longitude would be 180°
    const [lon, lat] = lonLatOf(south).map((degrees) => (degrees * Math.PI) / 180) as [number, number];
    this.#south = south;
    this.#east = [-Math.sin(lon), Math.cos(lon), 0];
    this.#north = [-Math.sin(lat) * Math.cos(lon), -Math.sin(lat) * Math.sin(lon), Math.cos(lat)];
  }

  /** The image of a point of the sphere; that of the pole is `FAR` away. */
  forward(point: Vector): [number, number] {
    const [x, y, z] = this.pole;
    const away: Vector = [point[0] - x, point[1] - y, point[2] - z]; // of the pole itself without rounding
    const stretch = 4 / dot(away, away);
    return stretch === Infinity ? [FAR, FAR] : [stretch * dot(away, this.#east), stretch * dot(away, this.#north)];
  }

  /** The point of the sphere with this image. */
  inverse(u: number, v: number): Vector {
    const square = u * u + v * v;
    const along = (4 - square) / (4 + square);
    const across = 4 / (4 + square);
    const part = (k: 0 | 1 | 2): number => along * this.#south[k] + across * (u * this.#east[k] + v * this.#north[k]);
    return [part(0), part(1), part(2)];
  }

  /**
   * The image of the circle of points x with center·x = cosine: a circle, or a line where it goes through the pole.
   * With c the centre, s the point of contact and d the cosine, 2 tan(χ/2) = |X| turns c·x = d into
   * |X|²(d + c·s) − 4 X·c + 4(d − c·s) = 0.
   */
  circle(center: Vector, cosine: number) {
    const along = dot(center, this.#south);
    const across: Point = [dot(center, this.#east), dot(center, this.#north)];
    const lead = cosine + along || THROUGH_POLE / 2; // no division by 0
    return {
      isLine: Math.abs(lead) < THROUGH_POLE, // of points X with normal·X = offset
      normal: across,
      offset: cosine - along,
      middle: [(2 * across[0]) / lead, (2 * across[1]) / lead] as Point,
      radius: (2 * Math.sqrt(Math.max(0, 1 - cosine * cosine))) / Math.abs(lead),
      holdsPole: lead < 0,
    };
  }
}

/** Sites of the plane that may lie outside its frame: one in so many. */
const OUTSIDE = 20;

/** Room around the sites in the frame. */
const ROOM = 1.07;

export type PlaneFrame = ReturnType<typeof planeFrame>;

/** What a frame shows of the plane: half its side and its middle, ball radii; and how many sites lie outside. */
export type Around = Readonly<{ reach: number; middle: Point; outside: number }>;

/** A square of a picture, from its upper left corner, px, and what it shows. */
export function planeFrame(x: number, y: number, size: number, { reach, middle }: Around) {
  const scale = size / 2 / reach;
  const [left, top] = [x + size / 2, y + size / 2];
  const place = ([u, v]: Point): Point => [left + scale * (u - middle[0]), top - scale * (v - middle[1])];
  const point = ([px, py]: Point): Point => [middle[0] + (px - left) / scale, middle[1] + (top - py) / scale];
  return { x, y, size, reach, middle, scale, place, point };
}

/** Sites that need less than this part of a frame about the point of contact have one of their own. */
const OWN_FRAME = 0.5;

/** The frame that holds nearly all sites. */
export function reachAround(sites: SphereSites, twin: Twin): Around {
  const images = Array.from({ length: sites.count }, (_, k) => twin.forward(sites.site(k)));
  const frameAbout = (middle: Point): Around => {
    const away = ([u, v]: Point): number => Math.max(Math.abs(u - middle[0]), Math.abs(v - middle[1]));
    const sizes = Float64Array.from(images.map(away).filter((size) => size < FAR / 2)).sort();
    const nearly = sizes[Math.floor(((OUTSIDE - 1) / OUTSIDE) * (sizes.length - 1))] ?? 1;
    const all = sizes[sizes.length - 1] ?? 1;
    const reach = ROOM * (all < 2 * nearly ? all : nearly) || 1;
    return { reach, middle, outside: images.length - sizes.filter((size) => size <= reach).length };
  };
  const half = (k: 0 | 1): number => Float64Array.from(images, (image) => image[k]).sort()[images.length >> 1] ?? 0;
  const [about, own] = [frameAbout([0, 0]), frameAbout([half(0), half(1)])];
  return own.reach < OWN_FRAME * about.reach && images.length > 1 ? own : about;
}
