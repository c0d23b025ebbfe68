/** Movements that follow the hand: flights to another state. */

/** Milliseconds of a flight. */
const FLIGHT = 400;

/** One movement at a time, stopped by any input. */
export class Motion {
  #asked = 0;

  /** Calls `step` with t from 0 to 1; only with 1 where there is to be no motion. */
  fly(step: (t: number) => void): void {
    this.stop();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      step(1);
      return;
    }
    let start: number | null = null;
    const frame = (now: number): void => {
      start ??= now;
      const t = Math.min(1, (now - start) / FLIGHT);
      this.#asked = t < 1 ? requestAnimationFrame(frame) : 0;
      step(t * t * (3 - 2 * t)); // gently off, gently to rest
    };
    this.#asked = requestAnimationFrame(frame);
  }

  stop(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
  }
}
