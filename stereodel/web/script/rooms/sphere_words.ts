/** What the Sphere room says: sentences whose numbers change. */

import { DEGREES } from "../space.ts";
import { fixed, several } from "../words.ts";
import type { Bubble, Insertion, SphereSites } from "./sphere_sites.ts";
import type { Twin } from "./twin.ts";

/** Distances below a radius by less than this part of it are those of sites on the circle, which are rounded. */
const ON_CIRCLE = 1e-9;

/** Sites as "7 · 22 · 41". */
export function numbers(sites: readonly number[]): string {
  return sites.map((site) => String(site + 1)).join("\u2009·\u2009");
}

/** What there is to say of sites without triangles; null where there are triangles. */
export function withoutTriangles(sites: SphereSites): string | null {
  const { dimension } = sites.delaunay;
  if (dimension === 2) return null;
  if (sites.count === 0) return "No sites yet. Click the ball, or open a file.";
  if (dimension === 0) return "All sites lie at one place: its cell is the whole sphere, and there are no triangles.";
  return sites.count === 2
    ? "Two sites: each has half of the sphere, and there are no triangles."
    : "All sites lie on one circle: there are no triangles.";
}

/** What the circle round a triangle is on the sphere and in the plane. */
export function ofBubble(bubble: Bubble, sites: SphereSites, twin: Twin): string {
  const radius = `The circle round _${numbers(bubble.sites)}_ has the radius _${fixed(Math.acos(bubble.cosine) * DEGREES, 2)}°_ on the sphere`;
  const image = twin.circle(bubble.center, bubble.cosine);
  if (image.kind === "line" || image.holdsPole) {
    return `${radius}. This bubble holds *P*: in the plane it is the outside of the circle, and its facet is left out.`;
  }
  const [u, v] = image.middle;
  let [onSphere, inPlane] = [0, 0];
  for (let k = 0; k < sites.count; ++k) {
    if (bubble.sites.includes(k)) continue;
    const site = sites.site(k);
    const height = site[0] * bubble.center[0] + site[1] * bubble.center[1] + site[2] * bubble.center[2];
    const [x, y] = twin.forward(site);
    if (height > bubble.cosine + ON_CIRCLE) ++onSphere;
    if (Math.hypot(x - u, y - v) < image.radius * (1 - ON_CIRCLE)) ++inPlane;
  }
  return `${radius}, _${fixed(image.radius, 3)}_ ball radii in the plane. Other sites inside: _${onSphere}_\u00a0and\u00a0_${inPlane}_.`;
}

/** What inserting a site does. */
export function ofStep(step: Insertion | null, site: number): string {
  if (step === null)
    return `Site _${site + 1}_ is one of the first: all before it lie on one circle and have no facets.`;
  if (step.seeing.length === 0)
    return `Site _${site + 1}_ sees no facet: it lies exactly on one before it, or on their bubbles.`;
  return (
    `Site _${site + 1}_ sees ${several(step.seeing.length, "facet")}. They make room: their outline has ` +
    `_${step.outline.length}_ sides, and as many new facets meet at the site.`
  );
}

/** The first duplicate, if there is one. */
export function ofDuplicates(sites: SphereSites): string {
  const { duplicates } = sites.delaunay;
  if (duplicates.length === 0) return "";
  const first = `Site _${duplicates[0] + 1}_ lies exactly on site _${duplicates[1] + 1}_ and counts once.`;
  const others = duplicates.length / 2 - 1;
  return others > 0 ? `${first} There ${others === 1 ? "is" : "are"} ${several(others, "more such site")}.` : first;
}

/** A site for those who do not see it: its number, its name, its place, how many neighbours it has. */
export function ofSite(sites: SphereSites, site: number, name?: string): string {
  const words = [`Site ${site + 1}`, ...(name ? [name] : []), ...sites.words(site)];
  return `${words.join(", ")}, ${sites.neighborCounts[site]} neighbours`;
}
