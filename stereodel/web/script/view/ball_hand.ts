/** The hand that turns a ball: the grabbed point stays under the pointer, a fast drag runs out. */

import type { Disc } from "../drawing/pen.ts";
import { isCommand, type Hold, type Place } from "./hand.ts";
import { Motion } from "./motion.ts";
import { pointUnder, View } from "./view.ts";

/** Speed below which a drag has no run, pixels a millisecond. */
const SLOW = 0.3;

/** Degrees that an arrow key turns, and with Shift. */
const STEP = { wide: 5, fine: 1 };

export interface Turnable {
  readonly disc: Disc;
  readonly view: View;
  readonly isNorthUp: boolean;
  /** Shows another view. */
  turn(view: View, reason: "hand" | "flight" | "state"): void;
}

/** Takes hold of a ball; null beside it. */
export function grabBall(ball: Turnable, motion: Motion, at: Place): Hold | null {
  const { disc } = ball;
  if (Math.hypot(at[0] - disc.x, at[1] - disc.y) > disc.r) return null;
  motion.stop();
  const start = ball.view;
  const grabbed = pointUnder(disc, at);
  const direction = start.onBall(grabbed);
  let last = at;
  const turnTo = (to: Place, reason: "hand" | "flight"): void => {
    const point = pointUnder(disc, to);
    // Step by step, so that north up follows through the poles as it is the nearest view.
    ball.turn(ball.isNorthUp ? ball.view.holding(direction, point) : start.dragged(grabbed, point), reason);
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
  const step = shiftKey ? STEP.fine : STEP.wide;
  return key in ARROWS ? [ARROWS[key][0] * step, ARROWS[key][1] * step] : null;
}

const ARROWS: Readonly<Record<string, Place>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
