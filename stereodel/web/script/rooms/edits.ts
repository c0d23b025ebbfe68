/** Sites that the reader changes by hand, and the states before to go back to. */

import { ownSites } from "./site_controls.ts";
import type { NamedSites } from "./site_controls.ts";
import type { Place } from "./sphere_state.ts";

/** States that are kept. */
const MOST = 100;

/** The sites with one more at the end. */
export function withSite({ places, names }: NamedSites, place: Place): NamedSites {
  const more = new Float64Array(places.length + 2);
  more.set(places);
  more.set(place, places.length);
  return ownSites(more, names && [...names, ""]);
}

/** The sites with one of them elsewhere. */
export function withMoved({ places, names }: NamedSites, site: number, place: Place): NamedSites {
  const moved = places.slice();
  moved.set(place, 2 * site);
  return ownSites(moved, names);
}

/** The sites without one of them; those behind it take the numbers before theirs. */
export function withoutSite({ places, names }: NamedSites, site: number): NamedSites {
  const left = places.filter((_, k) => k >> 1 !== site);
  return ownSites(left, names && names.filter((_, k) => k !== site));
}

/** Earlier states of the sites. */
export class History {
  readonly #states: NamedSites[] = [];

  get isEmpty(): boolean {
    return this.#states.length === 0;
  }

  /** Keeps a state; nobody writes to it afterwards. */
  push(state: NamedSites): void {
    this.#states.push(state);
    if (this.#states.length > MOST) this.#states.shift();
  }

  /** The state before, or null. */
  pop(): NamedSites | null {
    return this.#states.pop() ?? null;
  }

  clear(): void {
    this.#states.length = 0;
  }
}
