/** Sites of the sphere with all that the kernel and the Sphere room say of them. Nothing here is drawn. */

import { cellOf, type Region } from "../drawing/parts.ts";
import { inBubble, lonlatToXyz, SphericalDelaunay, SphericalVoronoi } from "../kernel/api.ts";
import { following } from "../kernel/topology.ts";
import { angle, dot, lonLatOf, row, type Vector } from "../space.ts";
import { counted, latitude, longitude, scale, several, sized } from "../words.ts";
import type { Lens } from "../view/lens.ts";
import type { Twin } from "./twin.ts";

/** The circle round a facet: its centre on the outer side, the cosine of its angular radius, its three sites. */
export interface Bubble {
  readonly facet: number;
  readonly sites: readonly [number, number, number];
  readonly center: Vector;
  readonly cosine: number;
}

export class SphereSites {
  /** Longitude and latitude in turn, degrees. */
  readonly lonlat: Float64Array;
  /** Directions. */
  readonly xyz: Float64Array;
  readonly delaunay: SphericalDelaunay;
  #voronoi: SphericalVoronoi | null = null;
  #neighborCounts: Int32Array | null = null;

  constructor(lonlat: Float64Array) {
    this.lonlat = lonlat;
    this.xyz = lonlatToXyz(lonlat);
    this.delaunay = new SphericalDelaunay(this.xyz);
  }

  get count(): number {
    return this.lonlat.length / 2;
  }

  get facetCount(): number {
    return this.delaunay.simplices.length / 3;
  }

  get voronoi(): SphericalVoronoi {
    return (this.#voronoi ??= new SphericalVoronoi(this.delaunay));
  }

  /** A site's direction. */
  site(k: number): Vector {
    return row(this.xyz, k);
  }

  /** Latitude and longitude of a site in words. */
  words(site: number): [string, string] {
    return [latitude(this.lonlat[2 * site + 1]), longitude(this.lonlat[2 * site])];
  }

  /** How many cells lie beside that of each site: across edges, or across the ridges of sites on one great circle. */
  get neighborCounts(): Int32Array {
    if (this.#neighborCounts !== null) return this.#neighborCounts;
    const { simplices, dimension } = this.delaunay;
    this.#neighborCounts = new Int32Array(this.count);
    // As many facets meet at a site as edges do, where there are any; on one circle it has the two next to it.
    for (const k of dimension === 1 ? this.voronoi.ridgePoints : simplices) ++this.#neighborCounts[k];
    return this.#neighborCounts;
  }

  /** The site that a duplicate repeats, or null. */
  sameAs(site: number): number | null {
    const { duplicates } = this.delaunay;
    for (let k = 0; k < duplicates.length; k += 2) if (duplicates[k] === site) return duplicates[k + 1];
    return null;
  }

  /** The facet that holds a direction, or null. */
  facetAt(direction: Vector): number | null {
    if (this.delaunay.dimension < 2) return null;
    const found = this.delaunay.findSimplex(direction)[0];
    return found < 0 ? null : found;
  }

  /** The circle round a facet. */
  bubble(facet: number): Bubble {
    const [a, b, c] = this.delaunay.simplices.subarray(3 * facet, 3 * facet + 3);
    const center = row(this.delaunay.circumcenters, facet);
    return { facet, sites: [a, b, c], center, cosine: dot(center, this.site(a)) };
  }

  /** One byte a facet: 1 where its closed bubble holds the pole, so that the plane does not have it. */
  seeing(pole: Vector, facets: Int32Array = this.delaunay.simplices): Uint8Array {
    return Uint8Array.from(bubbleSigns(this.xyz, facets, pole), (sign) => (sign >= 0 ? 1 : 0));
  }

  /** The sites around the facets that are marked, such as those that see the pole, which are on the left. */
  rings(marked: Uint8Array): number[][] {
    return ringsOf(this.delaunay.simplices, (facet) => marked[facet] === 1);
  }

  /** Whether all sites lie in a hemisphere, so that some facets are no spherical triangles. */
  get hasClosing(): boolean {
    return this.delaunay.closing.includes(1);
  }

  /** The sites' cells; that of a site alone is all of the sphere. */
  cells(): Region[] {
    const areas = this.count > 0 ? this.voronoi.areas() : [];
    return Array.from(areas, (area, site) => {
      if (this.sameAs(site) !== null) return [];
      const properties = { kind: "cell", point: site, area };
      return this.delaunay.dimension === 0 ? [{ properties, corners: [] }] : cellOf(this.voronoi, site, properties);
    }).flat();
  }

  /** The facets that are triangles of the sphere. */
  triangles(): Region[] {
    const { simplices, closing } = this.delaunay;
    const facets = Array.from(closing.keys()).filter((facet) => !closing[facet]);
    return facets.map((triangle) => {
      const [a, b, c] = simplices.subarray(3 * triangle, 3 * triangle + 3);
      const corners = [a, b, c].map((site) => this.site(site));
      return { properties: { kind: "triangle", triangle, a, b, c }, corners };
    });
  }

  /** What it does to insert a site into those before it. One that lies on the bubble of a facet displaces nothing there. */
  insertion(site: number): Insertion {
    const before = new SphericalDelaunay(this.xyz.subarray(0, 3 * site)).simplices;
    const signs = bubbleSigns(this.xyz, before, this.site(site));
    const [outline] = ringsOf(before, (facet) => signs[facet] > 0);
    const fan = Int32Array.from(outline.flatMap((corner, k) => [corner, outline[(k + 1) % outline.length], site]));
    return { site, before, seeing: [...signs.keys()].filter((facet) => signs[facet] > 0), outline, fan };
  }
}

/**
 * `in_bubble(a, b, c, point)` of each facet: above 0 where its bubble holds the point, 0 on the circle.
 * @param xyz directions (n, 3).
 * @param simplices facets (m, 3), counterclockwise seen from outside.
 */
export function bubbleSigns(xyz: Float64Array, simplices: Int32Array, point: Vector): Int8Array {
  if (simplices.length === 0) return new Int8Array(0);
  const corner = (k: number): Float64Array => {
    const rows = new Float64Array(simplices.length);
    for (let at = 0; at < rows.length; ++at) rows[at] = xyz[3 * simplices[at - (at % 3) + k] + (at % 3)];
    return rows;
  };
  return inBubble(corner(0), corner(1), corner(2), point);
}

/** What inserting a site does to the facets before. */
export interface Insertion {
  /** Index of the new site. */
  readonly site: number;
  /** Facets of the sites before, (m, 3) flat; none where these lie on one great circle. */
  readonly before: Int32Array;
  /** Indices of those that see the site. */
  readonly seeing: readonly number[];
  /** Sites of their outline, counterclockwise seen from outside; empty where nothing sees the site. */
  readonly outline: readonly number[];
  /** The facets that close the hole, (k, 3) flat. */
  readonly fan: Int32Array;
}

/** The closed lines around some facets, on their left: their sides without a facet of theirs across. */
function ringsOf(facets: Int32Array, isChosen: (facet: number) => boolean): number[][] {
  const sides = new Map<string, [number, number]>();
  facets.forEach((a, at) => {
    if (!isChosen(Math.floor(at / 3))) return;
    const b = facets[following(at)];
    if (!sides.delete(`${b} ${a}`)) sides.set(`${a} ${b}`, [a, b]);
  });
  return chained(sides.values());
}

/** The closed lines that sides make, each from one number to another; without any an empty one. */
export function chained(sides: Iterable<readonly [number, number]>): number[][] {
  const next = new Map<number, number[]>();
  for (const [a, b] of sides) next.set(a, [...(next.get(a) ?? []), b]);
  const lines = [...next.keys()].map((begin) => {
    const line: number[] = [];
    for (let at = begin, to; (to = next.get(at)!.pop()) !== undefined; at = to) line.push(at);
    return line;
  });
  return lines.length === 0 ? [[]] : lines.filter((line) => line.length > 0);
}

/** What there is to say of sites without triangles; null where there are triangles. */
export function withoutTriangles(sites: SphereSites): string | null {
  const { dimension } = sites.delaunay;
  if (dimension === 2) return null;
  if (sites.count === 0) return "No sites yet. Click the ball, or open a file.";
  if (dimension === 0) return "All sites lie at one place: its cell is the whole sphere, and there are no triangles.";
  return sites.count === 2
    ? "Two sites: each has half of the sphere, and there are no triangles."
    : "All sites lie on one great circle: there are no triangles.";
}

/** What the pictures show, below each: of the ball, and of the plane. */
export function ofPictures(
  has: Readonly<Record<"triangles" | "cells" | "seeing" | "steps", boolean>>,
): [string, string] {
  const strong = "Delaunay triangles in strong lines, Voronoi cells in thin ones.";
  const lines = ["", "Voronoi cells.", "Delaunay triangles.", strong][2 * Number(has.triangles) + Number(has.cells)];
  const ball = has.steps ? "Delaunay triangles, new ones dashed." : lines;
  const plane = [
    has.triangles && "The same triangles.",
    has.seeing && "Hatched is where the facets go that see *P*.",
    has.cells && "Cells differ: centres are not sent to centres.",
  ];
  return [ball, plane.filter(Boolean).join(" ")];
}

/** What the circle round a triangle is on the sphere and in the plane. */
export function ofBubble(bubble: Bubble, sites: SphereSites, twin: Twin): string {
  const names = bubble.sites.map((site) => site + 1).join("\u2009·\u2009");
  const radius = `The circle round _${names}_ has the radius _${sized(angle(bubble.center, sites.site(bubble.sites[0])), 2)}°_ on the sphere`;
  const image = twin.circle(bubble.center, bubble.cosine);
  if (image.isLine || image.holdsPole) {
    return `${radius}. This bubble holds *P*: in the plane it is the outside of the circle, and its facet is left out.`;
  }
  // The kernel's signs, without rounding; the plane's circle holds the images of what the bubble holds.
  const [a, b, c] = bubble.sites.map((site) => sites.site(site));
  const inside = counted(inBubble(a, b, c, sites.xyz).filter((sign) => sign > 0).length);
  return (
    `${radius}, _${sized(image.radius, 3)}_ ball radii in the plane. ` +
    `Other sites inside, counted exactly: _${inside}_\u00a0and\u00a0_${inside}_.`
  );
}

/** What a lens does; nothing where it does nothing. */
export function ofLens({ focus, magnification }: Lens): string {
  if (magnification === 1) return "";
  const [lon, lat] = lonLatOf(focus);
  const times = magnification < 1000 ? scale(magnification) : counted(Math.round(magnification));
  return `Magnified _${times}_ times at _${latitude(lat)}_ _${longitude(lon)}_.`;
}

/** What inserting a site does. */
export function ofStep({ site, before, seeing, outline }: Insertion): string {
  const name = `Site _${site + 1}_`;
  if (before.length === 0)
    return `${name} is one of the first: all before it lie on one great circle and have no facets.`;
  if (seeing.length === 0) return `${name} sees no facet: it lies exactly on one before it, or on their bubbles.`;
  const words = `They make room: their outline has _${outline.length}_ sides, and as many new facets meet at the site.`;
  return `${name} sees ${several(seeing.length, "facet")}. ${words}`;
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
