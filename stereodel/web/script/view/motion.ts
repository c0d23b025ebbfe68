/** Movements that follow the hand: a flight to another state, a ball that comes to rest. */

/** Milliseconds of a flight. */
const FLIGHT = 400;

/** Milliseconds in which a turning ball stops. */
const REST = 300;

/** One movement at a time, stopped by any input. Where the reader has asked for no motion, movements are cuts. */
export class Motion {
  #asked = 0;

  /** Calls `step` with t from 0 to 1; only with 1 where there is to be no motion. */
  fly(step: (t: number) => void): void {
    if (!this.#run(FLIGHT, (t) => step(t * t * (3 - 2 * t)))) step(1); // gently off, gently to rest
  }

  /** Goes on with a speed that decays: `step` gets how much of what is left to go, per unit of speed, in milliseconds. */
  coast(step: (milliseconds: number) => void): void {
    let done = 0;
    this.#run(REST, (t) => {
      const way = (REST / 3) * (1 - (1 - t) ** 3); // the integral of (1 − t)²
      step(way - done);
      done = way;
    });
  }

  stop(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
  }

  /** Calls `step` with t from 0 to 1; false where there is to be no motion. */
  #run(duration: number, step: (t: number) => void): boolean {
    this.stop();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return false;
    let start: number | null = null;
    const frame = (now: number): void => {
      start ??= now;
      const t = Math.min(1, (now - start) / duration);
      this.#asked = t < 1 ? requestAnimationFrame(frame) : 0;
      step(t);
    };
    this.#asked = requestAnimationFrame(frame);
    return true;
  }
}
