/** What keys do in the Sphere room, while one of its drawings has the focus. */

import { arrowed } from "../view/ball_hand.ts";
import type { Turnable } from "../view/ball_hand.ts";
import { VIEW } from "./sphere_state.ts";
import type { Place } from "./sphere_state.ts";

/** Degrees that an arrow key moves a site, and with Shift. */
const STEP = { wide: 5, fine: 1 };

/** Degrees east and north, in steps, by key. */
const ARROWS: Readonly<Record<string, Place>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export interface SphereActions {
  turn(place: Place): void;
  /** A site at the middle of the view. */
  add(): void;
  /** What a click at the middle of the view does. */
  click(): void;
  removeHeld(): void;
  /** Moves the site that is held, degrees. */
  nudge(east: number, north: number): void;
  /** To another site, so many numbers on. */
  walk(by: number): void;
  /** Nothing is held, and no bubble is kept. */
  free(): void;
  undo(): void;
}

/** What a key does, or null where it is none of the room's; without sites there is only to add one. */
export function actionOf(
  event: KeyboardEvent,
  ball: Turnable,
  actions: SphereActions,
  hasSites: boolean,
): (() => void) | null {
  const view = arrowed(ball, event);
  if (view !== null) return () => actions.turn(view.middle);
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (event.ctrlKey) {
    const step = event.shiftKey ? STEP.fine : STEP.wide;
    const [east, north] = ARROWS[key] ?? [0, 0];
    if (key === "z") return () => actions.undo();
    return key in ARROWS ? () => actions.nudge(east * step, north * step) : null;
  }
  const always: Record<string, () => void> = { "0": () => actions.turn(VIEW), n: () => actions.add() };
  const withSites: Record<string, () => void> = {
    ",": () => actions.walk(-1),
    ".": () => actions.walk(1),
    Delete: () => actions.removeHeld(),
    Backspace: () => actions.removeHeld(),
    Enter: () => actions.click(),
    Escape: () => actions.free(),
  };
  return always[key] ?? (hasSites ? withSites[key] : undefined) ?? null;
}
