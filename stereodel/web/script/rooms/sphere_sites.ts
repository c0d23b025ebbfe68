/** Sites of the sphere with all that the kernel and the Sphere room say of them. Nothing here is drawn. */

import { cellOf, type Region } from "../drawing/parts.ts";
import { inBubble, lonlatToXyz, SphericalDelaunay, SphericalVoronoi } from "../kernel/api.ts";
import { once } from "../kernel/lazy.ts";
import { boundaryOf } from "../kernel/topology.ts";
import { angle, dot, lonLatOf, row, type Vector } from "../space.ts";
import { counted, latitude, longitude, scale, several, sized } from "../words.ts";
import type { Lens } from "../view/lens.ts";
import type { Twin } from "./twin.ts";

export type Bubble = ReturnType<SphereSites["bubble"]>;
export type Insertion = ReturnType<SphereSites["insertion"]>;

export class SphereSites {
  /** Longitude and latitude in turn, degrees. */
  readonly lonlat: Float64Array;
  /** Directions. */
  readonly xyz: Float64Array;
  readonly delaunay: SphericalDelaunay;
  readonly voronoi = once(() => new SphericalVoronoi(this.delaunay));

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

  /** A site's direction. */
  site(k: number): Vector {
    return row(this.xyz, k);
  }

  /** Latitude and longitude of a site in words. */
  words(site: number): [string, string] {
    return [latitude(this.lonlat[2 * site + 1]), longitude(this.lonlat[2 * site])];
  }

  /** How many cells lie beside that of each site: across edges, or across the ridges of sites on one great circle. */
  readonly neighborCounts = once(() => {
    const { simplices, dimension } = this.delaunay;
    const counts = new Int32Array(this.count);
    // As many facets meet at a site as edges do, where there are any; on one circle it has the two next to it.
    for (const k of dimension === 1 ? this.voronoi().ridgePoints : simplices) ++counts[k];
    return counts;
  });

  /** The facet that holds a direction, or null. */
  facetAt(direction: Vector): number | null {
    if (this.delaunay.dimension < 2) return null;
    const found = this.delaunay.findSimplex(direction)[0];
    return found < 0 ? null : found;
  }

  /** The circle round a facet: its three sites, its centre on the outer side, the cosine of its angular radius. */
  bubble(facet: number) {
    const sites = row(this.delaunay.simplices, facet);
    const center = row(this.delaunay.circumcenters, facet);
    return { facet, sites, center, cosine: dot(center, this.site(sites[0])) };
  }

  /** One byte a facet: 1 where its closed bubble holds the pole, so that the plane does not have it. */
  seeing(pole: Vector, facets: Int32Array = this.delaunay.simplices): Uint8Array {
    return Uint8Array.from(bubbleSigns(this.xyz, facets, pole), (sign) => (sign >= 0 ? 1 : 0));
  }

  /** The closed lines of sites around the facets that are marked, such as those that see the pole: on their left. */
  rings(marked: Uint8Array): number[][] {
    const { simplices, neighbors } = this.delaunay;
    return chained(boundaryOf(simplices, neighbors, (facet) => marked[facet] === 1));
  }

  /** Whether all sites lie in a hemisphere, so that some facets are no spherical triangles. */
  get hasClosing(): boolean {
    return this.delaunay.closing.includes(1);
  }

  /** The sites' cells; that of a site alone is all of the sphere. */
  cells(): Region[] {
    const areas = this.count > 0 ? this.voronoi().areas() : [];
    return Array.from(areas, (area, site) => {
      const properties = { kind: "cell", point: site, area };
      const isAlone = this.delaunay.dimension === 0 && area > 0;
      return isAlone ? [{ properties, corners: [] }] : cellOf(this.voronoi(), site, properties);
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

  /**
   * What it does to insert a site into those before it, which have no facets where they lie on one great circle: which of
   * their facets see the site, the outline of these, empty where none does, and the facets that close the hole. One that
   * lies on the bubble of a facet displaces nothing there.
   */
  insertion(site: number) {
    const before = new SphericalDelaunay(this.xyz.subarray(0, 3 * site));
    const signs = bubbleSigns(this.xyz, before.simplices, this.site(site));
    const [outline] = chained(boundaryOf(before.simplices, before.neighbors, (facet) => signs[facet] > 0));
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

/** The closed lines of directed edges, two points each; without any an empty one. */
export function chained(edges: Int32Array): number[][] {
  const next = new Map<number, number[]>();
  for (let k = 0; k < edges.length; k += 2) next.set(edges[k], [...(next.get(edges[k]) ?? []), edges[k + 1]]);
  const lines = [...next.keys()].map((begin) => {
    const line: number[] = [];
    for (let at = begin, to; (to = next.get(at)!.pop()) !== undefined; at = to) line.push(at);
    return line;
  });
  return lines.length === 0 ? [[]] : lines.filter((line) => line.length > 0);
}

/** What there is to say of sites without triangles, by their dimension. */
export const WITHOUT_TRIANGLES: Readonly<Record<number, string>> = {
  [-1]: "No sites yet. Click the ball, or open a file.",
  0: "All sites lie at one place: its cell is the whole sphere, and there are no triangles.",
  1: "All sites lie on one great circle: there are no triangles.",
};

/** What the pictures show, below each: of the ball, and of the plane. */
const PICTURES = {
  triangles: ["Delaunay triangles.", "The same triangles."],
  steps: ["New ones are dashed.", ""],
  cells: ["Voronoi cells in thin lines.", "Cells differ: centres are not sent to centres."],
  seeing: ["", "Hatched is where the facets go that see *P*."],
} as const;

export function ofPictures(has: Readonly<Record<keyof typeof PICTURES, boolean>>): string[] {
  const shown = Object.entries(PICTURES).filter(([name]) => has[name as keyof typeof PICTURES]);
  return [0, 1].map((k) => shown.flatMap(([, words]) => words[k] || []).join(" "));
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
  if (before.dimension < 2)
    return `${name} is one of the first: all before it lie on one great circle and have no facets.`;
  if (seeing.length === 0) return `${name} sees no facet: it lies exactly on one before it, or on their bubbles.`;
  const words = `They make room: their outline has _${outline.length}_ sides, and as many new facets meet at the site.`;
  return `${name} sees ${several(seeing.length, "facet")}. ${words}`;
}

/** Nothing where there are no duplicates. */
export function ofDuplicates({ delaunay }: SphereSites): string {
  const same = delaunay.duplicates.length / 2;
  const words = [
    "site lies exactly on another and counts once.",
    "sites lie exactly on others and count once.",
  ] as const;
  return same === 0 ? "" : several(same, ...words);
}

/** A site for those who do not see it: its number, its name, its place, how many neighbours it has. */
export function ofSite(sites: SphereSites, site: number, name?: string): string {
  const words = [`Site ${site + 1}`, ...(name ? [name] : []), ...sites.words(site)];
  return `${words.join(", ")}, ${sites.neighborCounts()[site]} neighbours`;
}
