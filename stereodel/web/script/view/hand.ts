/** The hand on a drawing: drags, pinches, clicks, the wheel and keys, in pixels of the drawing. */

import type { Plate } from "../drawing/plate.ts";

export type Place = readonly [number, number];

/** What a press has taken hold of. */
export interface Hold {
  move(to: Place): void;
  /** The speed, pixels a millisecond. */
  end?(speed: Place): void;
}

/** Two fingers: their middle, their distance and the angle from the first to the second. */
type Two = [middle: Place, spread: number, turn: number];

/** What a drawing does about the hand. Whatever is left out is left to the page. */
export interface Gestures {
  /** A press; null leaves it to the page. It becomes a click where the pointer does not move. */
  take(at: Place, reach: number): Hold | null;
  /** The pointer without a press, or that it is gone. */
  hover?(at: Place | null): void;
  click?(at: Place, reach: number): void;
  /** Instead of the second click. */
  doubleClick?(at: Place, reach: number): void;
  /** Two fingers are there, and what is done as they move; the first one's hold is let go. */
  pinch?(...two: Two): (...now: Two) => void;
  /** The wheel, while the drawing has the focus: factors above 1 magnify. */
  wheel?(at: Place, factor: number): void;
  /** A key; whether it was one of the drawing's. */
  key?(event: KeyboardEvent): boolean;
}

/** How far a pointer may be from what it takes, and how far it moves before a click has become a drag, pixels. */
const POINTERS = { touch: { reach: 22, steady: 8 }, mouse: { reach: 12, steady: 3 } };

/** Milliseconds between the clicks of a double one, and their distance in pixels. */
const DOUBLE = { time: 350, distance: 24 };

/** Milliseconds after which a finger that has not moved has come to rest. */
const RESTS = 80;

/** Wheel steps, pixels, that magnify by e. */
const WHEEL = 500;

interface Finger {
  at: Place;
  time: number;
  /** Pixels a millisecond. */
  speed: Place;
  readonly start: Place;
  readonly reach: number;
  readonly steady: number;
  hold: Hold | null;
  isDrag: boolean;
}

/** Follows the hand on a drawing. */
export function follow(plate: Plate, gestures: Gestures): void {
  const { canvas } = plate;
  const fingers = new Map<number, Finger>();
  let pinch: ((...now: Two) => void) | null = null;
  let lastClick: { readonly at: Place; readonly time: number } | null = null;

  const on = <K extends keyof HTMLElementEventMap>(name: K, act: (event: HTMLElementEventMap[K]) => void): void =>
    canvas.addEventListener(name, act);

  const two = (): Two => {
    const [a, b] = [...fingers.values()].map(({ at }) => at);
    const middle: Place = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    return [middle, Math.max(1, distance(a, b)), Math.atan2(b[1] - a[1], b[0] - a[0])];
  };

  on("pointerdown", (event) => {
    if (event.button !== 0) return;
    const at = plate.placeOf(event);
    const pointer = POINTERS[event.pointerType === "touch" ? "touch" : "mouse"];
    const hold = fingers.size === 0 ? gestures.take(at, pointer.reach) : null;
    if (hold === null && fingers.size === 0) return;
    canvas.setPointerCapture(event.pointerId);
    const time = event.timeStamp;
    fingers.set(event.pointerId, { at, time, speed: [0, 0], start: at, ...pointer, hold, isDrag: false });
    if (fingers.size !== 2 || gestures.pinch === undefined) return;
    for (const finger of fingers.values()) {
      if (finger.isDrag) finger.hold?.end?.([0, 0]);
      finger.hold = null;
      finger.isDrag = true;
    }
    pinch = gestures.pinch(...two());
  });

  on("pointermove", (event) => {
    const [at, finger] = [plate.placeOf(event), fingers.get(event.pointerId)];
    if (finger === undefined) {
      if (event.pointerType !== "touch") gestures.hover?.(at);
      return;
    }
    const time = Math.max(1, event.timeStamp - finger.time);
    finger.speed = [(at[0] - finger.at[0]) / time, (at[1] - finger.at[1]) / time];
    [finger.at, finger.time] = [at, event.timeStamp];
    if (pinch !== null) return pinch(...two());
    finger.isDrag ||= distance(at, finger.start) > finger.steady;
    if (finger.isDrag) finger.hold?.move(at);
  });

  const up = (event: PointerEvent): void => {
    const finger = fingers.get(event.pointerId);
    if (finger === undefined) return;
    fingers.delete(event.pointerId);
    const [isCancelled, isResting] = [event.type === "pointercancel", event.timeStamp - finger.time > RESTS];
    if (pinch !== null) {
      pinch = null;
      // The finger that is left holds the drawing where it is.
      for (const left of fingers.values()) left.hold = gestures.take(left.at, 0);
    } else if (finger.isDrag) finger.hold?.end?.(isCancelled || isResting ? [0, 0] : finger.speed);
    else if (!isCancelled) click(finger, event.timeStamp);
  };
  on("pointerup", up);
  on("pointercancel", up);
  on("pointerleave", () => {
    if (fingers.size === 0) gestures.hover?.(null);
  });

  const click = ({ at, reach }: Finger, time: number): void => {
    const last = lastClick;
    const isSecond = last !== null && time - last.time < DOUBLE.time && distance(last.at, at) < DOUBLE.distance;
    const isDouble = isSecond && gestures.doubleClick !== undefined;
    lastClick = isDouble ? null : { at, time };
    gestures[isDouble ? "doubleClick" : "click"]?.(at, reach);
  };

  on("wheel", (event) => {
    if (gestures.wheel === undefined || document.activeElement !== canvas) return;
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 33;
    gestures.wheel(plate.placeOf(event), Math.exp((-event.deltaY * unit) / WHEEL));
  });

  on("keydown", (event) => {
    if (!event.altKey && gestures.key?.(event)) event.preventDefault();
  });
}

/** Whether the key of commands is held: Ctrl, or ⌘ on a Mac. */
export function isCommand(event: KeyboardEvent): boolean {
  return event.ctrlKey || event.metaKey;
}

/** Of two places of a drawing, pixels. */
export function distance(a: Place, b: Place): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
