/** Where a ball is seen from: turns of it, north up or free. Vectors in the axes of the view: x right, y up, z to the reader. */

import { Rotation } from "../kernel/api.ts";
import { cross, dot, lonLatOf, unit } from "../rooms/space.ts";
import type { Vector } from "../rooms/space.ts";

/** w, x, y, z, of length 1. */
export type Quaternion = readonly [number, number, number, number];

const DEGREE = Math.PI / 180;

/** First q, then p. */
export function product(p: Quaternion, q: Quaternion): Quaternion {
  const [a, b, c, d] = p;
  const [e, f, g, h] = q;
  return normalized([
    a * e - b * f - c * g - d * h,
    a * f + b * e + c * h - d * g,
    a * g - b * h + c * e + d * f,
    a * h + b * g - c * f + d * e,
  ]);
}

/** Of length 1 again: products drift. */
export function normalized(q: Quaternion): Quaternion {
  const size = Math.hypot(...q);
  return [q[0] / size, q[1] / size, q[2] / size, q[3] / size];
}

export function inverse([w, x, y, z]: Quaternion): Quaternion {
  return [w, -x, -y, -z];
}

/** Counterclockwise about a unit vector, radians. */
export function about(axis: Vector, angle: number): Quaternion {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]];
}

/** The shortest turn from one unit vector to another. */
export function between(a: Vector, b: Vector): Quaternion {
  const total: Vector = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const length = Math.hypot(...total);
  if (length === 0) return about(unit(Math.abs(a[2]) < 0.9 ? [-a[1], a[0], 0] : [0, -a[2], a[1]]), Math.PI);
  const middle: Vector = [total[0] / length, total[1] / length, total[2] / length];
  return normalized([dot(a, middle), ...cross(a, middle)]);
}

/** A vector turned. */
export function turned([w, x, y, z]: Quaternion, v: Vector): Vector {
  const t = cross([x, y, z], v);
  const u: Vector = [2 * t[0], 2 * t[1], 2 * t[2]];
  const s = cross([x, y, z], u);
  return [v[0] + w * u[0] + s[0], v[1] + w * u[1] + s[1], v[2] + w * u[2] + s[2]];
}

/** Between two turns, the short way: p at t = 0, q at 1. */
export function partWay(p: Quaternion, q: Quaternion, t: number): Quaternion {
  const [w, x, y, z] = product(q, inverse(p));
  const sign = w < 0 ? -1 : 1;
  const sine = Math.hypot(x, y, z);
  if (sine === 0) return p;
  const angle = 2 * Math.atan2(sine, sign * w);
  return product(about([(sign * x) / sine, (sign * y) / sine, (sign * z) / sine], t * angle), p);
}

/** From the axes of the Earth to those of the view above 0° N, 0° E. */
const FRONT: Quaternion = [0.5, -0.5, -0.5, -0.5];

/** A ball seen from afar. */
export class View {
  /** From the ball's axes to the view's. */
  readonly turn: Quaternion;

  constructor(turn: Quaternion) {
    this.turn = turn;
  }

  /** From above a place, degrees, north up but for a roll counterclockwise. */
  static above(lon: number, lat: number, roll = 0): View {
    const level = product(FRONT, about([0, 0, 1], -lon * DEGREE));
    return new View(product(about([0, 0, 1], roll * DEGREE), product(about([1, 0, 0], lat * DEGREE), level)));
  }

  /** For maps of the kernel. */
  get rotation(): Rotation {
    return new Rotation([...this.turn]);
  }

  /** A direction of the ball, in the axes of the view. */
  seen(direction: Vector): Vector {
    return turned(this.turn, direction);
  }

  /** A point of the view, as a direction of the ball. */
  onBall(point: Vector): Vector {
    return turned(inverse(this.turn), point);
  }

  /** Longitude and latitude of the middle, degrees. */
  get middle(): [number, number] {
    return lonLatOf(this.onBall([0, 0, 1]));
  }

  /** Degrees by which the picture is turned counterclockwise from north up. */
  get roll(): number {
    const [lon, lat] = this.middle;
    const [x, y] = turned(product(View.above(lon, lat).turn, inverse(this.turn)), [1, 0, 0]);
    return -Math.atan2(y, x) / DEGREE;
  }

  /** The view without its roll. */
  get northUp(): View {
    return View.above(...this.middle);
  }

  /** The view that turns a held point of the view to another one, the short way. */
  dragged(from: Vector, to: Vector): View {
    return new View(product(between(from, to), this.turn));
  }

  /**
   * The view with north up that has a held direction of the ball at a point of the view, or as near to it as there is one:
   * a place at latitude β is never farther than cos β from the axis.
   */
  holding(direction: Vector, to: Vector): View {
    const [lon, lat] = lonLatOf(direction);
    const reach = Math.cos(lat * DEGREE);
    const sine = Math.max(-1, Math.min(1, to[0] / reach));
    const [oldLon, oldLat] = this.middle;
    // The place may be on this or the far side of the pole; the view that is nearer to this one.
    const views = [Math.asin(sine), Math.PI - Math.asin(sine)].map((east) => {
      const across = reach * Math.cos(east);
      const up = Math.atan2(direction[2], across) - Math.atan2(to[1], to[2]);
      const turn = up - 2 * Math.PI * Math.round(up / (2 * Math.PI));
      return {
        lon: lon - east / DEGREE,
        lat: Math.max(-90, Math.min(90, turn / DEGREE)),
        excess: Math.abs(turn / DEGREE),
      };
    });
    const cost = (view: { lon: number; lat: number; excess: number }): number => {
      const apart = Math.abs(((((view.lon - oldLon + 180) % 360) + 360) % 360) - 180);
      return apart * Math.cos(oldLat * DEGREE) + Math.abs(view.lat - oldLat) + 10 * Math.max(0, view.excess - 90);
    };
    const best = views.reduce((a, b) => (cost(b) < cost(a) ? b : a));
    return View.above(best.lon, best.lat);
  }

  /** Turned by degrees: the middle goes east and north; with north up it stops at the poles. */
  stepped(east: number, north: number, isNorthUp: boolean): View {
    if (isNorthUp) {
      const [lon, lat] = this.middle;
      return View.above(lon + east, Math.max(-90, Math.min(90, lat + north)));
    }
    const turn = product(about([1, 0, 0], north * DEGREE), about([0, 1, 0], -east * DEGREE));
    return new View(product(turn, this.turn));
  }
}

/** The point of the ball under a place of the drawing, axes of the view; beside the ball the nearest point of its limb. */
export function pointUnder(disc: { x: number; y: number; r: number }, at: readonly [number, number]): Vector {
  const [x, y] = [(at[0] - disc.x) / disc.r, (disc.y - at[1]) / disc.r];
  const square = x * x + y * y;
  if (square < 1) return [x, y, Math.sqrt(1 - square)];
  const size = Math.sqrt(square);
  return [x / size, y / size, 0];
}
