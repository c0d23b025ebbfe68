/** The hand on a drawing: drags, pinches, clicks, the wheel and keys, in pixels of the drawing. */

import type { Plate } from "../drawing/plate.ts";

export type Place = readonly [number, number];

/** What a press has taken hold of. */
export interface Hold {
  move(to: Place): void;
  /** The speed, pixels a millisecond. */
  end?(speed: Place): void;
}

/** Two fingers, in what has become of them: their middle, their distance and the angle from the first to the second. */
export interface Pinch {
  move(middle: Place, spread: number, turn: number): void;
}

/** What a drawing does about the hand. Whatever is left out is left to the page. */
export interface Gestures {
  /** A press; null leaves it to the page. It becomes a click where the pointer does not move. */
  take(at: Place, reach: number): Hold | null;
  /** The pointer without a press, or that it is gone. */
  hover?(at: Place | null): void;
  click?(at: Place, reach: number): void;
  /** Instead of the second click. */
  doubleClick?(at: Place, reach: number): void;
  /** The first finger's hold is let go. */
  pinch?(middle: Place, spread: number): Pinch;
  /** The wheel, while the drawing has the focus: factors above 1 magnify. */
  wheel?(at: Place, factor: number): void;
  /** A key; whether it was one of the drawing's. */
  key?(event: KeyboardEvent): boolean;
}

/** How far a pointer may be from what it takes, pixels: a finger and a mouse. */
const REACH = { touch: 22, mouse: 12 };

/** Pixels that a pointer moves before a click has become a drag: a finger and a mouse. */
const STEADY = { touch: 8, mouse: 3 };

/** Milliseconds between the clicks of a double one, and their distance in pixels. */
const DOUBLE = { time: 350, distance: 24 };

/** Milliseconds of a drag's end that tell its speed. */
const RECENT = 80;

/** Wheel steps, pixels, that magnify by e. */
const WHEEL = 500;

interface Finger {
  at: Place;
  readonly start: Place;
  readonly by: "touch" | "mouse";
  hold: Hold | null;
  isDrag: boolean;
  readonly track: { at: Place; time: number }[];
}

/** Follows the hand on a drawing. */
export function follow(plate: Plate, gestures: Gestures): void {
  new Hand(plate, gestures).start();
}

class Hand {
  readonly #plate: Plate;
  readonly #gestures: Gestures;
  readonly #fingers = new Map<number, Finger>();
  #pinch: Pinch | null = null;
  #lastClick: { at: Place; time: number } | null = null;

  constructor(plate: Plate, gestures: Gestures) {
    this.#plate = plate;
    this.#gestures = gestures;
  }

  start(): void {
    const { canvas } = this.#plate;
    const on = <K extends keyof HTMLElementEventMap>(name: K, act: (event: HTMLElementEventMap[K]) => void): void =>
      canvas.addEventListener(name, act);
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event, false));
    on("pointercancel", (event) => this.#up(event, true));
    on("pointerleave", () => {
      if (this.#fingers.size === 0) this.#gestures.hover?.(null);
    });
    on("wheel", (event) => this.#wheel(event));
    on("keydown", (event) => {
      if (!event.altKey && this.#gestures.key?.(event)) event.preventDefault();
    });
  }

  #down(event: PointerEvent): void {
    if (event.button !== 0) return;
    const at = this.#plate.placeOf(event);
    const by = event.pointerType === "touch" ? "touch" : "mouse";
    const hold = this.#fingers.size === 0 ? this.#gestures.take(at, REACH[by]) : null;
    if (hold === null && this.#fingers.size === 0) return;
    this.#plate.canvas.setPointerCapture(event.pointerId);
    const track = [{ at, time: event.timeStamp }];
    this.#fingers.set(event.pointerId, { at, start: at, by, hold, isDrag: false, track });
    if (this.#fingers.size === 2 && this.#gestures.pinch !== undefined) {
      for (const finger of this.#fingers.values()) {
        if (finger.isDrag) finger.hold?.end?.([0, 0]);
        finger.hold = null;
        finger.isDrag = true;
      }
      const { middle, spread } = this.#two();
      this.#pinch = this.#gestures.pinch(middle, spread);
    }
  }

  #move(event: PointerEvent): void {
    const at = this.#plate.placeOf(event);
    const finger = this.#fingers.get(event.pointerId);
    if (finger === undefined) {
      if (event.pointerType !== "touch") this.#gestures.hover?.(at);
      return;
    }
    finger.at = at;
    if (this.#pinch !== null) {
      const { middle, spread, turn } = this.#two();
      this.#pinch.move(middle, spread, turn);
      return;
    }
    finger.track.push({ at, time: event.timeStamp });
    finger.isDrag ||= distance(at, finger.start) > STEADY[finger.by];
    if (finger.isDrag) finger.hold?.move(at);
  }

  #up(event: PointerEvent, isCancelled: boolean): void {
    const finger = this.#fingers.get(event.pointerId);
    if (finger === undefined) return;
    this.#fingers.delete(event.pointerId);
    if (this.#pinch !== null) {
      this.#pinch = null;
      // The finger that is left holds the drawing where it is.
      for (const left of this.#fingers.values()) left.hold = this.#gestures.take(left.at, 0);
      return;
    }
    if (finger.isDrag) finger.hold?.end?.(isCancelled ? [0, 0] : speedOf(finger, event.timeStamp));
    else if (!isCancelled) this.#click(finger, event.timeStamp);
  }

  #click(finger: Finger, time: number): void {
    const [last, { at, by }] = [this.#lastClick, finger];
    const { doubleClick, click } = this.#gestures;
    const isDouble = doubleClick && last && time - last.time < DOUBLE.time && distance(last.at, at) < DOUBLE.distance;
    this.#lastClick = isDouble ? null : { at, time };
    (isDouble ? doubleClick : click)?.(at, REACH[by]);
  }

  #wheel(event: WheelEvent): void {
    const { wheel } = this.#gestures;
    if (wheel === undefined || document.activeElement !== this.#plate.canvas) return;
    event.preventDefault();
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 33;
    wheel(this.#plate.placeOf(event), Math.exp((-event.deltaY * unit) / WHEEL));
  }

  #two(): { middle: Place; spread: number; turn: number } {
    const [a, b] = [...this.#fingers.values()].map((finger) => finger.at);
    const middle: Place = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    return { middle, spread: Math.max(1, distance(a, b)), turn: Math.atan2(b[1] - a[1], b[0] - a[0]) };
  }
}

/** Whether the key of commands is held: Ctrl, or ⌘ on a Mac. */
export function isCommand(event: KeyboardEvent): boolean {
  return event.ctrlKey || event.metaKey;
}

/** Of two places of a drawing, pixels. */
export function distance(a: Place, b: Place): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** How fast a finger was at its end, pixels a millisecond; 0 if it had come to rest. */
function speedOf({ track }: Finger, now: number): Place {
  const recent = track.filter((point) => now - point.time < RECENT);
  if (recent.length < 2) return [0, 0];
  const [first, last] = [recent[0], recent[recent.length - 1]];
  const time = Math.max(last.time - first.time, 1);
  return [(last.at[0] - first.at[0]) / time, (last.at[1] - first.at[1]) / time];
}
