/** The large globe through the fisheye: turned, magnified and focused by hand; the circle at the pointer. */

import { placeOf } from "../drawing/ball.ts";
import { drawHandle, type Pen } from "../drawing/pen.ts";
import type { Reason } from "../drawing/plate.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { Rotation, type MoebiusMap } from "../kernel/api.ts";
import { arrowed, grabBall } from "../view/ball_hand.ts";
import { distance, type Gestures, type Hold, type Place } from "../view/hand.ts";
import { betweenSights, focused, holding, magnified, MOST, sightMap, sourceOf, type Sight } from "../view/lens.ts";
import { pointUnder, type View } from "../view/view.ts";
import { GlobePlate, LABEL } from "./globe_plate.ts";
import { BEGINNING } from "./globe_state.ts";

/** Factor of the keys + and −. */
const KEY_FACTOR = 1.25;

const LETTER: LabelStyle = { ...LABEL, size: 15, italic: true };

export class FisheyeGlobe extends GlobePlate {
  get view(): View {
    return this.#sight.view;
  }

  protected get map(): MoebiusMap {
    return sightMap(this.#sight);
  }

  get #sight(): Sight {
    return this.host.shown.sight;
  }

  turn(view: View, reason: Reason): void {
    this.host.set({ sight: { ...this.#sight, view } }, reason);
  }

  /** Goes to another sight, on the way that a flight takes. */
  fly(to: Sight): void {
    const from = this.#sight;
    this.motion.fly((t) => {
      const sight = betweenSights(from, to, t, this.isNorthUp);
      this.host.set({ sight }, t < 1 ? "flight" : "state", t === 1);
    });
  }

  /** The focus. */
  protected paintHeld(pen: Pen): void {
    const focus = this.view.seen(this.#sight.lens.focus);
    const [x, y] = placeOf(this.disc, focus);
    drawHandle(pen, x, y, focus[2] >= 0 ? "front" : "behind");
    const isRight = focus[0] <= 0.75;
    const place: [number, number] = isRight ? [x + 9, y - 7] : [x - 9, y - 7];
    const words = focus[2] >= 0 ? "focus" : "focus*, behind*";
    pen.label(words, ...place, { ...LETTER, align: isRight ? "left" : "right" });
  }

  protected gestures(): Gestures {
    return {
      take: (at, reach) => this.#take(at, reach),
      click: (at) => {
        this.motion.stop();
        this.point(at);
      },
      doubleClick: (at) => {
        if (!this.isOnBall(at)) return;
        const focus = sourceOf(this.map, pointUnder(this.disc, at));
        this.fly(focused(this.#sight, focus, this.isNorthUp));
      },
      pinch: (middle, spread) => {
        this.motion.stop();
        const start = this.#sight;
        const from = pointUnder(this.disc, middle);
        let turnedBefore: number | null = null;
        return {
          move: (now, nowSpread, turn) => {
            turnedBefore ??= turn;
            const sight = magnified(start, from, nowSpread / spread, this.isNorthUp);
            const to = pointUnder(this.disc, now);
            let view = holding(sight.view, sight.view.onBall(from), to, this.isNorthUp);
            if (!this.isNorthUp) view = view.turned(Rotation.about(to, ((turnedBefore - turn) * 180) / Math.PI));
            this.host.set({ sight: { ...sight, view } }, "hand");
          },
        };
      },
      wheel: (at, factor) => {
        this.motion.stop();
        const point = this.isOnBall(at) ? pointUnder(this.disc, at) : ([0, 0, 1] as const);
        this.host.set({ sight: magnified(this.#sight, point, factor, this.isNorthUp) }, "hand");
      },
      key: (event) => this.#key(event),
    };
  }

  #take(at: Place, reach: number): Hold | null {
    const focus = this.view.seen(this.#sight.lens.focus);
    if (distance(at, placeOf(this.disc, focus)) > reach) return grabBall(this, this.motion, at);
    this.motion.stop();
    return {
      move: (to) => {
        // The fisheye leaves its focus where it is: the ring is at the pointer where the view stays as it is.
        const place = this.view.onBall(pointUnder(this.disc, to));
        this.host.set({ sight: { ...this.#sight, lens: { ...this.#sight.lens, focus: place } } }, "hand");
      },
    };
  }

  #key(event: KeyboardEvent): boolean {
    const view = arrowed(this, event);
    const sight = view === null ? this.#keyed(event.key) : { ...this.#sight, view };
    if (sight === null || event.ctrlKey) return false;
    this.motion.stop();
    this.host.set({ sight }, "hand");
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
      return focused(this.#sight, sourceOf(this.map, [0, 0, 1]), this.isNorthUp);
    }
    return null;
  }
}
