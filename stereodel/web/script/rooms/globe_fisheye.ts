/** The large globe through the fisheye: turned, magnified and focused by hand; the circle at the pointer. */

import { circlePoints } from "../drawing/ball.ts";
import { arcThrough } from "../drawing/arcs.ts";
import { traceCap } from "../drawing/fill.ts";
import { Plate } from "../drawing/plate.ts";
import type { Reason } from "../drawing/plate.ts";
import { traceDisc } from "../drawing/pen.ts";
import type { Disc, Pen } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { arrowed, grabBall } from "../view/ball_hand.ts";
import type { Turnable } from "../view/ball_hand.ts";
import { distance, follow } from "../view/hand.ts";
import type { Gestures, Hold, Place } from "../view/hand.ts";
import {
  betweenSights,
  focused,
  holding,
  imageOf,
  magnified,
  MOST,
  scaleAt,
  sightMap,
  sourceOf,
  turnedAbout,
} from "../view/lens.ts";
import type { Sight } from "../view/lens.ts";
import { Motion } from "../view/motion.ts";
import { pointUnder, View } from "../view/view.ts";
import { scale } from "../words.ts";
import { CIRCLE_RADIUS } from "./globe_scene.ts";
import type { GlobeScene } from "./globe_scene.ts";
import { BEGINNING } from "./globe_state.ts";
import type { GlobeState } from "./globe_state.ts";
import type { Vector } from "./space.ts";

/** Factor of the keys + and −. */
const KEY_FACTOR = 1.25;

export const LABEL: LabelStyle = { ink: "accent-text", halo: "halo", size: 14 };
const LETTER: LabelStyle = { ...LABEL, size: 15, italic: true };

/** What the room does for its globes. */
export interface GlobeHost {
  readonly scene: GlobeScene;
  readonly state: GlobeState;
  /** Shows another state. */
  set(change: Partial<GlobeState>, reason: Reason, isStep?: boolean): void;
  run(body: () => void): void;
}

export class FisheyeGlobe implements Turnable {
  readonly plate: Plate;
  readonly #host: GlobeHost;
  readonly #motion = new Motion();
  readonly #unfollow: () => void;

  constructor(canvas: HTMLCanvasElement, host: GlobeHost) {
    this.#host = host;
    this.plate = new Plate(
      canvas,
      (pen, isMoving) => this.#paint(pen, isMoving),
      (body) => host.run(body),
      document.documentElement,
      (pen) => this.#paintHeld(pen),
    );
    this.#unfollow = follow(this.plate, this.#gestures());
  }

  get disc(): Disc {
    return this.plate.disc;
  }

  get view(): View {
    return this.#sight.view;
  }

  get isNorthUp(): boolean {
    return this.#host.state.isNorthUp;
  }

  get #sight(): Sight {
    return this.#host.state.sight;
  }

  turn(view: View, reason: Reason): void {
    this.#host.set({ sight: { ...this.#sight, view } }, reason);
  }

  /** Goes to another sight, on the way that a flight takes. */
  fly(to: Sight): void {
    const from = this.#sight;
    this.#motion.fly((t) => {
      const sight = betweenSights(from, to, t, this.isNorthUp);
      this.#host.set({ sight }, t < 1 ? "flight" : "state", t === 1);
    });
  }

  stop(): void {
    this.#motion.stop();
  }

  dispose(): void {
    this.stop();
    this.#unfollow();
    this.plate.dispose();
  }

  #paint(pen: Pen, isMoving: boolean): void {
    this.#host.scene.draw(pen, this.disc, sightMap(this.#sight), this.#host.state.drawn, isMoving);
    pen.draw("limb", (path) => traceDisc(path, this.disc));
  }

  /** The circle at the pointer with its scale, and the focus. */
  #paintHeld(pen: Pen): void {
    const { disc } = this;
    const map = sightMap(this.#sight);
    const { pointer } = this.#host.state;
    const images = map.apply(Float64Array.from(circlePoints(pointer, CIRCLE_RADIUS).flat()));
    const circle = arcThrough(images, 0, 1, 2, true);
    const at = imageOf(map, pointer);
    if (circle !== null && at[2] > 0) {
      pen.draw("bubble", (path) => traceCap(path, disc, circle));
      this.#label(pen, `${scale(scaleAt(map, pointer))}×`, at, circle.r);
    }
    const focus = this.view.seen(this.#sight.lens.focus);
    const [x, y] = placeOf(disc, focus);
    pen.handle(x, y, focus[2] >= 0 ? "front" : "behind");
    const isRight = focus[0] <= 0.75;
    const place: [number, number] = isRight ? [x + 9, y - 7] : [x - 9, y - 7];
    const words = focus[2] >= 0 ? "focus" : "focus*, behind*";
    pen.label(words, ...place, { ...LETTER, align: isRight ? "left" : "right" });
  }

  /** Below the circle at the pointer, or above it near the lower limb. */
  #label(pen: Pen, words: string, at: Vector, radius: number): void {
    const [x, y] = placeOf(this.disc, at);
    const away = radius * this.disc.r;
    const isBelow = y + away + 20 < this.disc.y + this.disc.r * Math.sqrt(Math.max(0, 1 - at[0] ** 2));
    const inward = this.disc.x + (x - this.disc.x) * 0.98;
    pen.label(words, inward, isBelow ? y + away + 17 : y - away - 7, { ...LABEL, align: "center" });
  }

  #gestures(): Gestures {
    return {
      take: (at, reach) => this.#take(at, reach),
      hover: (at) => this.#point(at),
      click: (at) => {
        this.#motion.stop();
        this.#point(at);
      },
      doubleClick: (at) => {
        if (!this.#isOnBall(at)) return;
        const focus = sourceOf(sightMap(this.#sight), pointUnder(this.disc, at));
        this.fly(focused(this.#sight, focus, this.isNorthUp));
      },
      pinch: (middle, spread) => {
        this.#motion.stop();
        const start = this.#sight;
        const from = pointUnder(this.disc, middle);
        let turnedBefore: number | null = null;
        return {
          move: (now, nowSpread, turn) => {
            turnedBefore ??= turn;
            const sight = magnified(start, from, nowSpread / spread, this.isNorthUp);
            const to = pointUnder(this.disc, now);
            let view = holding(sight.view, sight.view.onBall(from), to, this.isNorthUp);
            if (!this.isNorthUp) view = turnedAbout(view, to, turnedBefore - turn);
            this.#host.set({ sight: { ...sight, view } }, "hand");
          },
        };
      },
      wheel: (at, factor) => {
        this.#motion.stop();
        const point = this.#isOnBall(at) ? pointUnder(this.disc, at) : ([0, 0, 1] as const);
        this.#host.set({ sight: magnified(this.#sight, point, factor, this.isNorthUp) }, "hand");
      },
      key: (event) => this.#key(event),
    };
  }

  #isOnBall(at: Place): boolean {
    return distance(at, [this.disc.x, this.disc.y]) <= this.disc.r;
  }

  #take(at: Place, reach: number): Hold | null {
    const focus = this.view.seen(this.#sight.lens.focus);
    if (distance(at, placeOf(this.disc, focus)) > reach) return grabBall(this, this.#motion, at);
    this.#motion.stop();
    return {
      move: (to) => {
        // The fisheye leaves its focus where it is: the ring is at the pointer where the view stays as it is.
        const place = this.view.onBall(pointUnder(this.disc, to));
        this.#host.set({ sight: { ...this.#sight, lens: { ...this.#sight.lens, focus: place } } }, "hand");
      },
    };
  }

  #point(at: Place | null): void {
    if (at === null || !this.#isOnBall(at)) return;
    this.#host.set({ pointer: sourceOf(sightMap(this.#sight), pointUnder(this.disc, at)) }, "pointer");
  }

  #key(event: KeyboardEvent): boolean {
    const view = arrowed(this, event);
    const sight = view === null ? this.#keyed(event.key) : { ...this.#sight, view };
    if (sight === null || event.ctrlKey) return false;
    this.#motion.stop();
    this.#host.set({ sight }, "hand");
    return true;
  }

  #keyed(key: string): Sight | null {
    const { lens, view } = this.#sight;
    const sized = (factor: number): Sight => ({
      lens: { ...lens, magnification: Math.max(1, Math.min(MOST, lens.magnification * factor)) },
      view,
    });
    if (key === "+" || key === "=") return sized(KEY_FACTOR);
    if (key === "-") return sized(1 / KEY_FACTOR);
    if (key === "0") return BEGINNING.sight;
    if (key === "f" || key === "F") {
      return focused(this.#sight, sourceOf(sightMap(this.#sight), [0, 0, 1]), this.isNorthUp);
    }
    return null;
  }
}

/** A point of the view, as a place of the drawing. */
export function placeOf(disc: Disc, point: Vector): [number, number] {
  return [disc.x + disc.r * point[0], disc.y - disc.r * point[1]];
}
