/** A rectangle that bends onto a ball: the inverse stereographic projection of a sheet that touches the ball (P10, P13). */

import type { Vector } from "./space.ts";

/** A rectangle along the axes: its middle and its sides. */
export interface Rectangle {
  readonly middle: readonly [number, number];
  readonly width: number;
  readonly height: number;
}

/** The smallest rectangle around places (n, 2), or one about the origin with given sides. */
export function rectangleAround(places: Float64Array, sides?: readonly [number, number]): Rectangle {
  if (sides) return { middle: [0, 0], width: sides[0], height: sides[1] };
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  places.forEach((value, k) => {
    low[k % 2] = Math.min(low[k % 2], value);
    high[k % 2] = Math.max(high[k % 2], value);
  });
  if (places.length === 0) return { middle: [0, 0], width: 3, height: 2 };
  const [width, height] = [high[0] - low[0], high[1] - low[1]];
  return { middle: [low[0] + width / 2, low[1] + height / 2], width, height };
}

/** Angles in degrees between which the images of two points lie. */
export interface Bounds {
  readonly low: number;
  readonly high: number;
  /** The lower bound with the paper's constant ½, and the upper one with its 4/π. */
  readonly promised: readonly [number, number];
}

/**
 * The sheet, bent so that its corners stand at `corner` degrees from the point of contact: 0 is the plane, 90 the
 * hemisphere. Lengths are in diagonals of the rectangle; the point of contact is on top, at the origin.
 */
export class Sheet {
  readonly rectangle: Rectangle;
  readonly corner: number;
  /** Of the ball, in diagonals; infinite in the plane. */
  readonly radius: number;

  constructor(rectangle: Rectangle, corner: number) {
    this.rectangle = rectangle;
    this.corner = corner;
    this.radius = corner === 0 ? Infinity : 1 / (4 * Math.tan((corner * Math.PI) / 360));
  }

  /** The diagonal in units of the plane; 1 where all places are one. */
  get diagonal(): number {
    return Math.hypot(this.rectangle.width, this.rectangle.height) || 1;
  }

  /** Whether nothing is bent. */
  get isFlat(): boolean {
    return this.corner === 0;
  }

  /** A place of the plane in the sheet before it is bent, in diagonals. */
  flat(x: number, y: number): Vector {
    const { middle } = this.rectangle;
    return [(x - middle[0]) / this.diagonal, (y - middle[1]) / this.diagonal, 0];
  }

  /** The direction from the ball's centre to the image of a place; straight up in the plane. */
  direction(x: number, y: number): Vector {
    const [u, v] = this.flat(x, y);
    const [s, t] = [u / (2 * this.radius), v / (2 * this.radius)];
    const square = s * s + t * t;
    return [(2 * s) / (1 + square), (2 * t) / (1 + square), (1 - square) / (1 + square)];
  }

  /** Where the image of a place is in space, in diagonals. */
  image(x: number, y: number): Vector {
    return this.isFlat ? this.flat(x, y) : this.onBall(this.direction(x, y));
  }

  /** Where a direction from the ball's centre meets the ball. */
  onBall(direction: Vector): Vector {
    return [this.radius * direction[0], this.radius * direction[1], this.radius * (direction[2] - 1)];
  }

  /** The projection pole. */
  get pole(): Vector {
    return [0, 0, -2 * this.radius];
  }

  /** Length on the ball over length in the sheet at a place: 1 at the middle, least at the corners. */
  scale(x: number, y: number): number {
    const [u, v] = this.flat(x, y);
    return 1 / (1 + (u * u + v * v) / (4 * this.radius * this.radius));
  }

  /** Scale at the corners. */
  get leastScale(): number {
    return 1 / (1 + 1 / (16 * this.radius * this.radius));
  }
}

/**
 * Between which angles images on the hemisphere lie of two points whose distance is this fraction of the diagonal:
 * 2 arcsin of it, of two corners, and 4 arctan of it, of pairs symmetric about the middle.
 */
export function separationBounds(fraction: number): Bounds {
  const t = Math.min(1, fraction);
  const degrees = 180 / Math.PI;
  return {
    low: 2 * Math.asin(t) * degrees,
    high: 4 * Math.atan(t) * degrees,
    promised: [90 * t, (720 / Math.PI) * t],
  };
}
