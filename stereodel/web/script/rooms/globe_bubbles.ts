/** Two globes: the bubble that is taken, and the one that it fills; rims and insides are dragged in either. */

import { circle, pointAt, type Circle } from "../drawing/arcs.ts";
import { circlePoints, placeOf } from "../drawing/ball.ts";
import { traceCap } from "../drawing/arcs.ts";
import { drawHandle, type Pen } from "../drawing/pen.ts";
import type { Reason } from "../drawing/plate.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { MoebiusMap, Rotation } from "../kernel/api.ts";
import { angle, cross, row, type Vector } from "../space.ts";
import { arrowed, grabBall } from "../view/ball_hand.ts";
import { distance, type Gestures, type Hold, type Place } from "../view/hand.ts";
import { capToCap, seenThrough, type Cap } from "../view/lens.ts";
import { pointUnder, type View } from "../view/view.ts";
import { fixed } from "../words.ts";
import { GlobePlate, LABEL, type GlobeHost } from "./globe_plate.ts";
import { BEGINNING, LEAST_RADIUS, MOST_RADIUS } from "./globe_state.ts";

/** Where a rim has its handle: the point of the rim that lies farthest this way in the drawing. */
const TOWARD = [0.8, -1] as const;

/** Points of a rim that are tried for the handle. */
const TRIED = 180;

/** Degrees by which a pointer of a link may be off the one that it names. */
const UNMOVED = 1e-6;

type Which = "before" | "after";

export class BubbleGlobe extends GlobePlate {
  readonly #which: Which;

  constructor(canvas: HTMLCanvasElement, which: Which, host: GlobeHost) {
    super(canvas, host);
    this.#which = which;
  }

  get view(): View {
    return this.host.shown[this.#which];
  }

  protected get map(): MoebiusMap {
    const { from, to } = this.host.shown;
    return seenThrough(this.isMagnified ? capToCap(from, to) : MoebiusMap.identity(), this.view);
  }

  protected override get isPointed(): boolean {
    return angle(this.host.shown.pointer, BEGINNING.pointer) > UNMOVED;
  }

  protected override get isMagnified(): boolean {
    return this.#which === "after";
  }

  turn(view: View, reason: Reason): void {
    this.host.set({ [this.#which]: view }, reason);
  }

  get #end(): "from" | "to" {
    return this.#which === "before" ? "from" : "to";
  }

  get #cap(): Cap {
    return this.host.shown[this.#end];
  }

  /** The bubble's rim, axes of the view. */
  get #rim(): Circle {
    const { center, radius } = this.#cap;
    return circle(this.view.seen(center), Math.cos((radius * Math.PI) / 180));
  }

  #setCap(cap: Cap): void {
    const radius = Math.max(LEAST_RADIUS, Math.min(MOST_RADIUS, cap.radius));
    this.host.set({ [this.#end]: { ...cap, radius } }, "hand");
  }

  protected paintHeld(pen: Pen): void {
    const { disc } = this;
    const cap = this.#cap;
    const rim = this.#rim;
    pen.draw(this.#which === "before" ? "bubble" : "bubble-open", (path) => traceCap(path, disc, rim));
    const handle = this.#handle();
    if (handle === null) return;
    const [x, y] = placeOf(disc, handle);
    drawHandle(pen, x, y, "rim");
    const isRight = handle[0] < 0.55;
    // Near the lower limb the label stands above its handle: below there is no drawing.
    const isLow = handle[1] < -0.5 && handle[2] < 0.4;
    const style: LabelStyle = { ...LABEL, align: isRight ? "left" : "right" };
    pen.label(`${fixed(cap.radius, 1)}°`, x + (isRight ? 9 : -9), y + (isLow ? -6 : 14), style);
  }

  /** The handle's point of the view, or null while the rim is behind. */
  #handle(): Vector | null {
    const rim = this.#rim;
    let best: Vector | null = null;
    for (let k = 0; k < TRIED; ++k) {
      const point = pointAt(rim, (2 * Math.PI * k) / TRIED);
      if (point[2] >= 0 && (best === null || toward(point) > toward(best))) best = point;
    }
    return best;
  }

  protected gestures(): Gestures {
    return {
      take: (at, reach) => this.#take(at, reach),
      key: (event) => {
        const view = event.key === "0" ? BEGINNING[this.#which] : arrowed(this, event);
        if (view === null) return false;
        this.motion.stop();
        this.turn(view, "hand");
        return true;
      },
    };
  }

  #take(at: Place, reach: number): Hold | null {
    if (!this.isOnBall(at)) return null;
    const start = this.#cap;
    const point = pointUnder(this.disc, at);
    const center = this.view.seen(start.center);
    const apart = angle(center, point);
    const handle = this.#handle();
    // Near the rim, in the drawing: one degree of it is not so many pixels everywhere.
    const rim = this.#nearestOfRim(center, start.radius, point);
    const isRim = rim[2] >= 0 && distance(at, placeOf(this.disc, rim)) <= reach;
    if (isRim || (handle !== null && distance(at, placeOf(this.disc, handle)) <= reach)) {
      this.motion.stop();
      return { move: (to) => this.#setCap({ ...start, radius: angle(center, pointUnder(this.disc, to)) }) };
    }
    if (apart > start.radius) return grabBall(this, this.motion, at);
    this.motion.stop();
    return {
      move: (to) => {
        const moved = row(Rotation.between(point, pointUnder(this.disc, to)).apply(center), 0);
        this.#setCap({ ...start, center: this.view.onBall(moved) });
      },
    };
  }

  /** The point of the rim that is nearest to another point of the ball. */
  #nearestOfRim(center: Vector, radius: number, point: Vector): Vector {
    const axis = cross(center, point);
    if (Math.hypot(...axis) === 0) return circlePoints(center, radius)[0];
    return row(Rotation.about(axis, radius).apply(center), 0);
  }
}

function toward([x, y]: Vector): number {
  return TOWARD[0] * x + TOWARD[1] * y;
}
