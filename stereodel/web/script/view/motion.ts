/** Movements that follow the hand: a flight to another state, a ball that comes to rest. */

/** Milliseconds of a flight, and its pace: cubic-bezier(.3, 0, .2, 1). */
const FLIGHT = 400;
const PACE = [0.3, 0, 0.2, 1] as const;

/** Milliseconds in which a turning ball stops. */
const REST = 300;

/** Whether the reader has asked for no motion: movements are cuts then. */
export function isStill(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** One movement at a time, stopped by any input. */
export class Motion {
  #asked = 0;

  /** Calls `step` with t from 0 to 1; only with 1 where there is to be no motion. */
  fly(step: (t: number) => void, duration = FLIGHT): void {
    this.stop();
    if (isStill()) {
      step(1);
      return;
    }
    let start: number | null = null;
    const frame = (now: number): void => {
      start ??= now;
      const t = Math.min(1, (now - start) / duration);
      this.#asked = t < 1 ? requestAnimationFrame(frame) : 0;
      step(paced(t));
    };
    this.#asked = requestAnimationFrame(frame);
  }

  /** Goes on with a speed that decays: `step` gets how much of what is left to go, per unit of speed, in milliseconds. */
  coast(step: (milliseconds: number) => void): void {
    this.stop();
    if (isStill()) return;
    let start: number | null = null;
    let done = 0;
    const frame = (now: number): void => {
      start ??= now;
      const t = Math.min(1, (now - start) / REST);
      this.#asked = t < 1 ? requestAnimationFrame(frame) : 0;
      const way = (REST / 3) * (1 - (1 - t) ** 3); // the integral of (1 − t)²
      step(way - done);
      done = way;
    };
    this.#asked = requestAnimationFrame(frame);
  }

  stop(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
  }
}

/** The share of the way at a share of the time. */
export function paced(t: number): number {
  if (t <= 0 || t >= 1) return t <= 0 ? 0 : 1;
  const [x1, y1, x2, y2] = PACE;
  const bezier = (a: number, b: number, s: number): number =>
    3 * a * s * (1 - s) ** 2 + 3 * b * s * s * (1 - s) + s ** 3;
  let [low, high] = [0, 1];
  for (let step = 0; step < 30; ++step) {
    const middle = (low + high) / 2;
    if (bezier(x1, x2, middle) < t) low = middle;
    else high = middle;
  }
  return bezier(y1, y2, (low + high) / 2);
}
