/** The hand that turns a ball and magnifies it: what is grabbed stays under the pointer, a fast drag runs out. */

import type { Disc } from "../drawing/pen.ts";
import { Rotation } from "../kernel/api.ts";
import { DEGREE } from "../space.ts";
import { distance, isCommand, type Gestures, type Hold, type Place } from "./hand.ts";
import { magnified, type Sight } from "./lens.ts";
import { Motion } from "./motion.ts";
import { pointUnder, View } from "./view.ts";

/** Speed below which a drag has no run, pixels a millisecond. */
const SLOW = 0.3;

const KEY_FACTOR = 1.25;

/** Degrees that an arrow key turns, and with Shift. */
const STEP = { wide: 5, fine: 1 };

export interface Turnable {
  readonly disc: Disc;
  readonly view: View;
  readonly isNorthUp: boolean;
  /** Shows another view. */
  turn(view: View, reason: "hand" | "flight" | "state"): void;
}

/** A ball under a lens. */
export interface Magnifiable extends Turnable {
  readonly sight: Sight;
  /** The largest magnification. */
  readonly most: number;
  /** Shows another sight, as the hand has it. */
  see(sight: Sight): void;
}

/** The wheel and two fingers, which magnify about the place where they are. */
export function lensGestures(ball: Magnifiable, motion: Motion): Required<Pick<Gestures, "pinch" | "wheel">> {
  return {
    wheel: (at, factor) => {
      const { disc, isNorthUp } = ball;
      const point = distance(at, [disc.x, disc.y]) <= disc.r ? pointUnder(disc, at) : ([0, 0, 1] as const);
      motion.stop();
      ball.see(magnified(ball.sight, point, factor, isNorthUp, ball.most));
    },
    pinch: (middle, spread, turn) => {
      motion.stop();
      const { disc, sight: start, isNorthUp, most } = ball;
      const from = pointUnder(disc, middle);
      return (now, nowSpread, nowTurn) => {
        const sight = magnified(start, from, nowSpread / spread, isNorthUp, most);
        const to = pointUnder(disc, now);
        const view = sight.view.holding(sight.view.onBall(from), to, isNorthUp);
        const by = (turn - nowTurn) / DEGREE;
        ball.see({ ...sight, view: isNorthUp ? view : view.turned(Rotation.about(to, by)) });
      };
    },
  };
}

/** By how much a key magnifies, or null for other keys. */
export function keyFactor(key: string): number | null {
  return key === "+" || key === "=" ? KEY_FACTOR : key === "-" ? 1 / KEY_FACTOR : null;
}

/** Takes hold of a ball; null beside it. */
export function grabBall(ball: Turnable, motion: Motion, at: Place): Hold | null {
  const { disc } = ball;
  if (Math.hypot(at[0] - disc.x, at[1] - disc.y) > disc.r) return null;
  motion.stop();
  const start = ball.view;
  const direction = start.onBall(pointUnder(disc, at));
  let last = at;
  const turnTo = (to: Place, reason: "hand" | "flight"): void => {
    // Step by step, so that north up follows through the poles as it is the nearest view.
    const { view, isNorthUp } = ball;
    ball.turn((isNorthUp ? view : start).holding(direction, pointUnder(disc, to), isNorthUp), reason);
    last = to;
  };
  return {
    move: (to) => turnTo(to, "hand"),
    end(speed) {
      if (Math.hypot(...speed) < SLOW) return;
      motion.coast((time) => turnTo([last[0] + speed[0] * time, last[1] + speed[1] * time], "flight"));
    },
  };
}

/** What an arrow key makes of a view, or null for other keys. */
export function arrowed(ball: Turnable, event: KeyboardEvent): View | null {
  const step = isCommand(event) ? null : arrowStep(event);
  return step === null ? null : ball.view.stepped(...step, ball.isNorthUp);
}

/** Degrees east and north of an arrow key, or null for other keys. */
export function arrowStep({ key, shiftKey }: KeyboardEvent): Place | null {
  const at = ["ArrowLeft", "ArrowDown", "ArrowRight", "ArrowUp"].indexOf(key);
  if (at < 0) return null;
  const step = (at < 2 ? -1 : 1) * (shiftKey ? STEP.fine : STEP.wide);
  return at % 2 === 0 ? [step, 0] : [0, step];
}
