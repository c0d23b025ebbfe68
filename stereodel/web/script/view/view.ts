/** Where a ball is seen from: turns of it, north up or free. Vectors in the axes of the view: x right, y up, z to the reader. */

import { Rotation } from "../kernel/api.ts";
import { DEGREE, lonLatOf, type Vector } from "../space.ts";
import { wrap } from "../words.ts";

/** Degrees: longitude and latitude of the middle, and the roll. */
type Degrees = readonly [number, number, number];

/** A ball seen from afar. */
export class View {
  /** From the ball's axes to the view's. */
  readonly rotation: Rotation;
  /** What it was made of: read again, no digit differs. */
  readonly #made: Degrees | null;
  #matrix: Float64Array | null = null;

  constructor(rotation: Rotation, made: Degrees | null = null) {
    [this.rotation, this.#made] = [rotation, made];
  }

  /** From above a place, degrees, north up but for a roll counterclockwise. */
  static above(lon: number, lat: number, roll = 0): View {
    const [east, north, turn] = [lon, lat, roll].map((degrees) => (degrees * DEGREE) / 2);
    // The quaternion (1, -1, -1, -1) / 2 of the view above 0° N, 0° E after a turn about the axis; then up, then the roll.
    const [u, v] = [(Math.cos(east) - Math.sin(east)) / 2, -(Math.cos(east) + Math.sin(east)) / 2];
    const [p, q] = [Math.cos(north) + Math.sin(north), Math.cos(north) - Math.sin(north)];
    const [w, x, y, z, c, s] = [u * p, -u * q, v * q, v * p, Math.cos(turn), Math.sin(turn)];
    const made: Degrees | null = Math.abs(lat) <= 90 ? [wrap(lon), lat, roll] : null;
    return new View(new Rotation([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w]), made);
  }

  /** A direction of the ball, in the axes of the view. */
  seen([x, y, z]: Vector): Vector {
    const m = (this.#matrix ??= this.rotation.matrix);
    return [m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z];
  }

  /** A point of the view, as a direction of the ball. */
  onBall([x, y, z]: Vector): Vector {
    const m = (this.#matrix ??= this.rotation.matrix);
    return [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];
  }

  /** Longitude and latitude of the middle, degrees. */
  get middle(): [number, number] {
    return this.#made === null ? lonLatOf(this.onBall([0, 0, 1])) : [this.#made[0], this.#made[1]];
  }

  /** Degrees by which the picture is turned counterclockwise from north up. */
  get roll(): number {
    if (this.#made !== null) return this.#made[2];
    const [lon, lat] = this.middle;
    const [x, y] = View.above(lon, lat).seen(this.onBall([1, 0, 0]));
    return -Math.atan2(y, x) / DEGREE;
  }

  /** The view without its roll. */
  get northUp(): View {
    return View.above(...this.middle);
  }

  /** Turned further, about an axis of the view. */
  turned(by: Rotation): View {
    return new View(by.after(this.rotation));
  }

  /** The view that turns a held point of the view to another one, the short way. */
  dragged(from: Vector, to: Vector): View {
    return this.turned(Rotation.between(from, to));
  }

  /**
   * The view that has a held direction of the ball at a point of the view, from this one by the shortest way; with north
   * up as near to it as there is one: a place at latitude β is never farther than cos β from the axis.
   */
  holding(direction: Vector, to: Vector, isNorthUp = true): View {
    if (!isNorthUp) return this.dragged(this.seen(direction), to);
    const [lon, lat] = lonLatOf(direction);
    const reach = Math.cos(lat * DEGREE);
    const sine = Math.max(-1, Math.min(1, to[0] / reach));
    const [oldLon, oldLat] = this.middle;
    // The place may be on this or the far side of the pole; the view that is nearer to this one.
    const views = [Math.asin(sine), Math.PI - Math.asin(sine)].map((east) => {
      const up = Math.atan2(direction[2], reach * Math.cos(east)) - Math.atan2(to[1], to[2]);
      const turn = (up - 2 * Math.PI * Math.round(up / (2 * Math.PI))) / DEGREE;
      const [newLon, newLat] = [lon - east / DEGREE, Math.max(-90, Math.min(90, turn))];
      const apart = Math.abs(wrap(newLon - oldLon)) * Math.cos(oldLat * DEGREE) + Math.abs(newLat - oldLat);
      return { cost: apart + 10 * Math.max(0, Math.abs(turn) - 90), view: View.above(newLon, newLat) };
    });
    return views.reduce((a, b) => (b.cost < a.cost ? b : a)).view;
  }

  /** Turned by degrees: the middle goes east and north; with north up it stops at the poles. */
  stepped(east: number, north: number, isNorthUp: boolean): View {
    if (isNorthUp) {
      const [lon, lat] = this.middle;
      return View.above(lon + east, Math.max(-90, Math.min(90, lat + north)));
    }
    return this.turned(Rotation.about([0, 1, 0], -east)).turned(Rotation.about([1, 0, 0], north));
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
