/** Sites that the reader changes by hand. */

import { ownSites } from "./site_controls.ts";
import type { NamedSites } from "./site_controls.ts";
import type { Place } from "./sphere_state.ts";

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
