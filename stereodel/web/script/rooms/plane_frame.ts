/** The square frame of the plane beside the ball: which part of the plane it shows, and where on the picture. */

import type { SphereSites } from "./sphere_sites.ts";
import type { Twin } from "./twin.ts";

/** Sites of the plane that may lie outside its frame: one in so many. */
const OUTSIDE = 20;

/** Room around the sites in the frame. */
const ROOM = 1.07;

export class PlaneFrame {
  /** The upper left corner and the side, px. */
  readonly x: number;
  readonly y: number;
  readonly size: number;
  /** Half the side, ball radii. */
  readonly reach: number;

  constructor(x: number, y: number, size: number, reach: number) {
    [this.x, this.y, this.size, this.reach] = [x, y, size, reach];
  }

  /** Pixels of a ball radius. */
  get scale(): number {
    return this.size / 2 / this.reach;
  }

  /** Where a point of the plane is on the picture. */
  place([u, v]: readonly [number, number]): [number, number] {
    const { x, y, size, scale } = this;
    return [x + size / 2 + scale * u, y + size / 2 - scale * v];
  }

  /** The point of the plane at a place of the picture. */
  point([px, py]: readonly [number, number]): [number, number] {
    const { x, y, size, scale } = this;
    return [(px - x - size / 2) / scale, (y + size / 2 - py) / scale];
  }
}

/** Half the side of a frame that holds nearly all sites, ball radii, and the number of sites that lie outside. */
export function reachAround(sites: SphereSites, twin: Twin): { reach: number; outside: number } {
  const sizes = Array.from({ length: sites.count }, (_, k) =>
    Math.max(...twin.forward(sites.site(k)).map(Math.abs)),
  ).sort((a, b) => a - b);
  const nearly = sizes[Math.floor(((OUTSIDE - 1) / OUTSIDE) * (sizes.length - 1))] ?? 1;
  const all = sizes[sizes.length - 1] ?? 1;
  const reach = ROOM * (all < 2 * nearly ? all : nearly) || 1;
  return { reach, outside: sizes.filter((size) => size > reach).length };
}
