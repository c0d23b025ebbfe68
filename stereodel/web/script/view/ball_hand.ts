/** The hand that turns a ball: the grabbed point stays under the pointer. */

import type { Disc } from "../drawing/pen.ts";
import type { Hold, Place } from "./hand.ts";
import { Motion } from "./motion.ts";
import { pointUnder, View } from "./view.ts";

/** Degrees that an arrow key turns, and with Shift. */
const STEP = { wide: 5, fine: 1 };

export interface Turnable {
  readonly disc: Disc;
  readonly view: View;
  readonly isNorthUp: boolean;
  /** Shows another view. */
  turn(view: View, reason: "hand" | "state"): void;
}

/** Takes hold of a ball; null beside it. */
export function grabBall(ball: Turnable, motion: Motion, at: Place): Hold | null {
  const { disc } = ball;
  if (Math.hypot(at[0] - disc.x, at[1] - disc.y) > disc.r) return null;
  motion.stop();
  const start = ball.view;
  const grabbed = pointUnder(disc, at);
  const direction = start.onBall(grabbed);
  return {
    move(to) {
      const point = pointUnder(disc, to);
      // Step by step, so that north up follows through the poles as it is the nearest view.
      ball.turn(ball.isNorthUp ? ball.view.holding(direction, point) : start.dragged(grabbed, point), "hand");
    },
  };
}

/** What an arrow key makes of a view, or null for other keys. */
export function arrowed(ball: Turnable, event: KeyboardEvent): View | null {
  const step = event.ctrlKey ? null : arrowStep(event);
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
