/** The hand on the two pictures of the Sphere room: where it points, and what it takes hold of. */

import type { Disc } from "../drawing/pen.ts";
import { grabBall } from "../view/ball_hand.ts";
import type { Turnable } from "../view/ball_hand.ts";
import { distance } from "../view/hand.ts";
import type { Gestures, Hold, Place } from "../view/hand.ts";
import type { Motion } from "../view/motion.ts";
import { pointUnder } from "../view/view.ts";
import { placeOf } from "./lines.ts";
import type { PlaneFrame } from "./plane_frame.ts";
import type { Vector } from "./space.ts";
import type { SphereSites } from "./sphere_sites.ts";
import type { Twin } from "./twin.ts";

/** Pixels within which a site is caught to be moved: nearer than a handle, so that the ball can be turned between sites. */
const REACH_OF_SITES = 8;

/** What the hand sees of the room, and what it does to it. */
export interface SphereHost extends Turnable {
  readonly motion: Motion;
  readonly sites: SphereSites;
  readonly twin: Twin;
  readonly frame: PlaneFrame;
  /** Whether sites can be dragged. */
  readonly areSitesLoose: boolean;
  /** The pointer is over a direction of the sphere. */
  hover(direction: Vector): void;
  /** @param site The one within reach. */
  click(direction: Vector, site: number | null): void;
  dragPole(direction: Vector): void;
  /** @param isFirst Whether the drag begins. */
  dragSite(site: number, direction: Vector, isFirst: boolean): void;
  /** The hand has let go of the pole or of a site. */
  rest(): void;
  key(event: KeyboardEvent): boolean;
}

export function ballGestures(host: SphereHost): Gestures {
  const direction = (at: Place): Vector => host.view.onBall(pointUnder(host.disc, at));
  return {
    take: (at, reach) => grab(host, at, reach),
    hover: (at) => {
      if (at !== null && isOnBall(host.disc, at)) host.hover(direction(at));
    },
    click: (at, reach) => host.click(direction(at), siteOnBall(host, at, reach)),
    key: (event) => host.key(event),
  };
}

export function planeGestures(host: SphereHost): Gestures {
  const direction = (at: Place): Vector => host.twin.inverse(...host.frame.point(at));
  return {
    take: () => ({ move: () => {} }),
    hover: (at) => {
      if (at !== null) host.hover(direction(at));
    },
    click: (at, reach) => {
      const place = (point: Vector): Place => host.frame.place(host.twin.forward(point));
      host.click(direction(at), siteNear(host.sites, direction(at), at, reach, place));
    },
    key: (event) => host.key(event),
  };
}

function isOnBall(disc: Disc, at: Place, reach = 0): boolean {
  return distance(at, [disc.x, disc.y]) <= disc.r + reach;
}

/** The visible site within reach of a place of the ball, or null. */
function siteOnBall({ sites, view, disc }: SphereHost, at: Place, reach: number): number | null {
  return siteNear(sites, view.onBall(pointUnder(disc, at)), at, reach, (direction) => {
    const point = view.seen(direction);
    return point[2] >= 0 ? placeOf(disc, point) : null;
  });
}

/** The site nearest to a direction, where its place on the picture is within reach. */
function siteNear(
  sites: SphereSites,
  direction: Vector,
  at: Place,
  reach: number,
  place: (direction: Vector) => Place | null,
): number | null {
  if (sites.count === 0) return null;
  const [site] = sites.delaunay.nearest(direction);
  const found = place(sites.site(site));
  return found !== null && distance(found, at) <= reach ? site : null;
}

/** The pole's handle, a site, or the ball; null beside them. */
function grab(host: SphereHost, at: Place, reach: number): Hold | null {
  const { disc } = host;
  if (!isOnBall(disc, at, reach)) return null;
  const pole = host.view.seen(host.twin.pole);
  if (distance(placeOf(disc, pole), at) <= reach) return grabPole(host, pole[2] < 0);
  const site = host.areSitesLoose ? siteOnBall(host, at, Math.min(reach, REACH_OF_SITES, spacing(host) / 3)) : null;
  return site === null ? grabBall(host, host.motion, at) : grabSite(host, site);
}

/** Pixels between sites that are spread evenly: where they lie close, the ball can still be turned between them. */
function spacing({ disc, sites }: SphereHost): number {
  return disc.r * Math.sqrt((4 * Math.PI) / sites.count);
}

/** Over the limb and back in the pole is on the other side. */
function grabPole(host: SphereHost, isBehind: boolean): Hold {
  const { disc } = host;
  let [behind, wasOut] = [isBehind, false];
  return {
    move: (to) => {
      const isOut = !isOnBall(disc, to);
      if (!isOut && wasOut) behind = !behind;
      wasOut = isOut;
      const [x, y, z] = pointUnder(disc, to);
      host.dragPole(host.view.onBall([x, y, behind ? -z : z]));
    },
    end: () => host.rest(),
  };
}

function grabSite(host: SphereHost, site: number): Hold {
  let isFirst = true;
  return {
    move: (to) => {
      host.dragSite(site, host.view.onBall(pointUnder(host.disc, to)), isFirst);
      isFirst = false;
    },
    end: () => host.rest(),
  };
}
