/** Sites of the sphere with all that the kernel says of them. Nothing here is drawn. */

import { lonlatToXyz, SphericalDelaunay, SphericalVoronoi } from "../kernel/api.ts";
import { bubbleSigns } from "./bubble_signs.ts";
import { insertion, outlineOf } from "./insertion.ts";
import type { Insertion } from "./insertion.ts";
import { dot, row } from "./space.ts";
import type { Vector } from "./space.ts";

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

  /** How many edges each site has. */
  get neighborCounts(): Int32Array {
    if (this.#neighborCounts === null) {
      this.#neighborCounts = new Int32Array(this.count);
      for (const k of this.delaunay.edges) ++this.#neighborCounts[k];
    }
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

  /** The sites around the facets that see the pole, which are on the left; as a line of the plane, its convex hull. */
  outline(seeing: Uint8Array): number[] {
    const chosen = Array.from(seeing.keys()).filter((facet) => seeing[facet] === 1);
    return outlineOf(this.delaunay.simplices, chosen);
  }

  /** Whether all sites lie in a hemisphere, so that some facets are no spherical triangles. */
  get hasClosing(): boolean {
    return this.delaunay.closing.includes(1);
  }

  /** The sites around the facets that are spherical triangles, where there are others: these are on the left. */
  get closingOutline(): number[] {
    return this.outline(this.delaunay.closing);
  }

  /** Whether the region of the facets that see the pole holds a direction. */
  regionHolds(seeing: Uint8Array, direction: Vector): boolean {
    const facet = this.facetAt(direction);
    if (facet !== null) return seeing[facet] === 1;
    const { closing } = this.delaunay;
    return seeing.some((sees, k) => sees === 1 && closing[k] === 1);
  }

  /** What it does to insert a site into those before it; null while these have no facets. */
  insertion(site: number): Insertion | null {
    const before = new SphericalDelaunay(this.xyz.subarray(0, 3 * site));
    if (before.dimension < 2) return null;
    return insertion(site, before.simplices, bubbleSigns(this.xyz, before.simplices, this.site(site)));
  }
}
