/**
 * `Delaunay` and `Voronoi` with the properties and methods of d3-delaunay, on the exact kernel. Call `load` of the
 * package before.
 *
 * Differences, besides those of `delaunator.ts`: sites on one line, but for the rounding of their coordinates, have
 * neighbours and cells, but no triangles; the peer moves them a little. Duplicates are nobody's neighbours. A place on a
 * border is in the cell of the lower site. `render` of a diagram draws the borders in the order of the sites.
 */

import Delaunator from "./delaunator.ts";
import { following } from "./topology.ts";

/** What draws: a context of a canvas, a path, or whatever has these methods. */
export interface PathContext {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
  closePath(): void;
  arc?(x: number, y: number, radius: number, start: number, end: number): void;
  rect?(x: number, y: number, width: number, height: number): void;
}

type Place = [x: number, y: number];
/** A closed ring: the last place is the first. */
export type Polygon = Place[];
/** [xmin, ymin, xmax, ymax]. */
export type Bounds = readonly [xmin: number, ymin: number, xmax: number, ymax: number];
/** Nothing if a context was given; else the path as SVG writes it, null if it is empty. */
export type Drawing = string | null | undefined;

function drawn(context: PathContext | null | undefined, draw: (to: PathContext) => void): Drawing {
  let path = "";
  const writer: PathContext = {
    moveTo: (x, y) => (path += `M${x},${y}`),
    lineTo: (x, y) => (path += `L${x},${y}`),
    closePath: () => (path += "Z"),
    arc: (x, y, r) => (path += `A${r},${r},0,1,1,${x - r},${y}A${r},${r},0,1,1,${x + r},${y}`),
    rect: (x, y, width, height) => (path += `M${x},${y}h${width}v${height}h${-width}Z`),
  };
  draw(context ?? writer);
  return context ? undefined : path || null;
}

function trace(to: PathContext, places: Place[], closed = true): void {
  places.forEach(([x, y], k) => (k === 0 ? to.moveTo(x, y) : to.lineTo(x, y)));
  if (closed && places.length > 0) to.closePath();
}

const closed = (ring: Place[]): Polygon => [...ring, ...ring.slice(0, 1)];

/** The triangulation of sites of the plane. */
export class Delaunay extends Delaunator {
  /** Of each site a half-edge that ends there, on the hull for those on it; -1 without triangles and for duplicates. */
  declare inedges: Int32Array;
  /** The different sites in order, if there are more than two and all on one line. */
  declare collinear: Int32Array | undefined;
  /** @internal Without triangles, where in the hull each site is. */
  declare line: Map<number, number>;

  /** The sites x0, y0, x1, y1, … as given; `update` reads them again. */
  get points(): ArrayLike<number> {
    return this.coords;
  }

  /** Triangulates anew, after changes of `points` in place. */
  override update(): this {
    super.update();
    const { points, size, dimension } = this.exact;
    if (dimension === 2 && isLine(points, this.triangles)) {
      const before = (i: number, j: number): number => points[i] - points[j] || points[i + 1] - points[j + 1];
      this.hull = Uint32Array.from(new Set(this.triangles)).sort((i, j) => before(2 * i, 2 * j));
      [this.triangles, this.halfedges] = [new Uint32Array(0), new Int32Array(0)];
    }
    this.inedges = new Int32Array(size).fill(-1);
    for (let edge = 0; edge < this.halfedges.length; ++edge) {
      const to = this.triangles[following(edge)];
      if (this.halfedges[edge] < 0 || this.inedges[to] < 0) this.inedges[to] = edge;
    }
    const isFlat = this.triangles.length === 0;
    this.line = new Map(isFlat ? Array.from(this.hull, (site, at) => [site, at]) : []);
    this.collinear = isFlat && this.hull.length > 2 ? Int32Array.from(this.hull) : undefined;
    return this;
  }

  /** The Voronoi diagram, cut by bounds. */
  voronoi(bounds?: Bounds): Voronoi {
    return new Voronoi(this, bounds);
  }

  /** The sites around one, counterclockwise where y points up; of one on the hull from the hull on. */
  *neighbors(i: number): Generator<number> {
    const at = this.line.get(i) ?? NaN;
    for (const near of [at - 1, at + 1]) if (near in this.hull) yield this.hull[near];
    const edges = this.around(i);
    for (const edge of edges) yield this.triangles[edge];
    const last = following(edges.at(-1) ?? 0);
    if (edges.length > 0 && this.halfedges[last] < 0) yield this.triangles[following(last)];
  }

  /** The site nearest to a place, exactly, without a start; the lowest of equally near ones, -1 if there is none. */
  find(x: number, y: number, _start?: number): number {
    const place = [+x, +y];
    return this.exact.size > 0 && place.every(Number.isFinite) ? this.exact.nearest(place)[0] : -1;
  }

  /** Draws the edges. */
  render(context?: PathContext | null): Drawing {
    const { triangles, halfedges } = this;
    return drawn(context, (to) => {
      halfedges.forEach((other, edge) => {
        if (other > edge) trace(to, this.places([triangles[edge], triangles[other]]), false);
      });
      this.renderHull(to);
    });
  }

  /** Draws circles around the sites. */
  renderPoints(context?: PathContext | number | string | null, radius?: number | string | null): Drawing {
    const isContext = typeof context === "object" && context !== null;
    const r = +((isContext ? radius : (radius ?? context)) ?? 2);
    return drawn(isContext ? context : null, (to) => {
      for (const [x, y] of this.places(Array(this.exact.size).keys())) {
        to.moveTo(x + r, y);
        to.arc?.(x, y, r, 0, 2 * Math.PI);
      }
    });
  }

  /** Draws the hull. */
  renderHull(context?: PathContext | null): Drawing {
    return drawn(context, (to) => trace(to, this.places(this.hull)));
  }

  /** Draws a triangle. */
  renderTriangle(i: number, context?: PathContext | null): Drawing {
    return drawn(context, (to) => trace(to, this.trianglePolygon(i).slice(0, 3)));
  }

  /** The hull as a closed ring. */
  hullPolygon(): Polygon {
    return closed(this.places(this.hull));
  }

  /** A triangle as a closed ring. */
  trianglePolygon(i: number): Polygon {
    return closed(this.places(this.triangles.subarray(3 * i, 3 * i + 3)));
  }

  /** The triangles as closed rings. */
  *trianglePolygons(): Generator<Polygon> {
    for (let k = 0; k < this.triangles.length / 3; ++k) yield this.trianglePolygon(k);
  }

  /** @internal Half-edges that end at a site, counterclockwise; that on the hull begins. */
  around(i: number): number[] {
    const edges: number[] = [];
    for (let edge = this.inedges[i] ?? -1; edge >= 0 && edge !== edges[0]; edge = this.halfedges[following(edge)]) {
      edges.push(edge);
    }
    return edges;
  }

  /** @internal */
  places(sites: Iterable<number>): Place[] {
    return Array.from(sites, (site) => [this.points[2 * site], this.points[2 * site + 1]]);
  }
}

/** Whether triangles are flat but for the rounding of their corners. */
function isLine(points: Float64Array, triangles: Uint32Array): boolean {
  const size = points.reduce((most, value, k) => Math.max(most, Math.abs(value - points[k % 2])), 0);
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [2 * triangles[k], 2 * triangles[k + 1], 2 * triangles[k + 2]];
    const [x, y] = [points[b] - points[a], points[b + 1] - points[a + 1]];
    const area = x * (points[c + 1] - points[a + 1]) - y * (points[c] - points[a]);
    if (Math.abs(area) > 2 ** -50 * size * size) return false;
  }
  return true;
}

/** A corner of a cell: a place, or with w = 0 instead of 1 a direction; and the site beyond the side that leaves it. */
type Corner = [x: number, y: number, w: number, beyond: number];

/** The cells of sites, cut by bounds. */
export class Voronoi {
  readonly delaunay: Delaunay;
  readonly xmin: number;
  readonly ymin: number;
  readonly xmax: number;
  readonly ymax: number;
  /** The centre of each triangle's circle: x, y. */
  circumcenters!: Float64Array;
  /** Of each site on the hull the directions of the two rays of its cell: x, y, x, y; of others zeros. */
  vectors!: Float64Array;

  constructor(delaunay: Delaunay, bounds: Bounds = [0, 0, 960, 500]) {
    this.delaunay = delaunay;
    [this.xmin, this.ymin, this.xmax, this.ymax] = Array.from(bounds, Number);
    if (!(this.xmax >= this.xmin && this.ymax >= this.ymin)) throw new Error("invalid bounds: xmin, ymin, xmax, ymax");
    this.prepare();
  }

  /** Triangulates anew, after changes of the points in place. */
  update(): this {
    this.delaunay.update();
    this.prepare();
    return this;
  }

  /** Draws the borders between the cells. */
  render(context?: PathContext | null): Drawing {
    return drawn(context, (to) => {
      for (const i of this.delaunay.inedges.keys()) {
        this.cell(i).forEach(([x, y, , beyond], k, ring) => {
          const next = ring[(k + 1) % ring.length];
          if (beyond > i) trace(to, [[x, y], next.slice(0, 2) as Place], false); // prettier-ignore
        });
      }
    });
  }

  /** Draws the bounds. */
  renderBounds(context?: PathContext | null): Drawing {
    return drawn(context, (to) => to.rect?.(this.xmin, this.ymin, this.xmax - this.xmin, this.ymax - this.ymin));
  }

  /** Draws a cell. */
  renderCell(i: number, context?: PathContext | null): Drawing {
    return drawn(context, (to) => trace(to, outline(this.cell(i))));
  }

  /** A cell as a closed ring, null if nothing of it is within the bounds. */
  cellPolygon(i: number): Polygon | null {
    const ring = outline(this.cell(i));
    return ring.length > 0 ? closed(ring) : null;
  }

  /** The cells of which something is within the bounds as closed rings, each with the number of its site. */
  *cellPolygons(): Generator<Polygon & { index: number }> {
    for (const index of this.delaunay.inedges.keys()) {
      const polygon = this.cellPolygon(index);
      if (polygon !== null) yield Object.assign(polygon, { index });
    }
  }

  /** Whether a site is the nearest one of a place. */
  contains(i: number, x: number, y: number): boolean {
    return i >= 0 && this.delaunay.find(x, y) === i;
  }

  /** The sites whose cells share a side with that of one within the bounds. */
  *neighbors(i: number): Generator<number> {
    const beyond = new Set(this.cell(i).map((corner) => corner[3]));
    for (const j of this.delaunay.neighbors(i)) if (beyond.has(j)) yield j;
  }

  private prepare(): void {
    const { points, triangles, halfedges, exact, inedges } = this.delaunay;
    this.circumcenters = triangles.length > 0 ? exact.circumcenters : new Float64Array(0);
    this.vectors = new Float64Array(4 * inedges.length);
    halfedges.forEach((other, edge) => {
      if (other >= 0) return;
      const [from, to] = [triangles[edge], triangles[following(edge)]];
      const ray = [points[2 * from + 1] - points[2 * to + 1], points[2 * to] - points[2 * from]];
      this.vectors.set(ray, 4 * to);
      this.vectors.set(ray, 4 * from + 2);
    });
  }

  /** The cell of a site within the bounds, counterclockwise where y points up; nothing for duplicates. */
  private cell(i: number): Corner[] {
    const { delaunay, circumcenters, vectors, xmin, ymin, xmax, ymax } = this;
    const { triangles, halfedges, inedges } = delaunay;
    if (triangles.length === 0) return this.strip(delaunay.line.get(i) ?? -1);
    let ring: Corner[] = [];
    const isOpen = halfedges[inedges[i]] < 0;
    if (isOpen) ring.push([vectors[4 * i], vectors[4 * i + 1], 0, triangles[inedges[i]]]);
    let isWithin = !isOpen;
    for (const edge of delaunay.around(i)) {
      const k = 2 * Math.floor(edge / 3);
      const [x, y] = [circumcenters[k], circumcenters[k + 1]];
      ring.push([x, y, 1, triangles[following(following(edge))]]);
      isWithin &&= x >= xmin && x <= xmax && y >= ymin && y <= ymax;
    }
    if (isWithin) return different(ring);
    if (isOpen) {
      const [a, b, c, d] = vectors.subarray(4 * i, 4 * i + 4);
      ring.push([c, d, 0, -1], [a + c, b + d, 0, -1]);
    }
    [xmin, ymin, xmax, ymax].forEach((bound, side) => {
      const [axis, sign] = [side % 2, side < 2 ? 1 : -1];
      ring = cut(ring, [sign * (1 - axis), sign * axis, sign * bound], -1, (site) => {
        // A border meets a bound where its sites say, not its ends, which may be far away.
        const [p, q] = delaunay.places([i, site]);
        const slope = (p[axis] - q[axis]) / (p[1 - axis] - q[1 - axis]);
        return (p[1 - axis] + q[1 - axis]) / 2 + ((p[axis] + q[axis]) / 2 - bound) * slope;
      });
    });
    ring = different(ring);
    // Corners of the bounds stand before the side that comes in.
    const last = ring.map(([, , , beyond]) => beyond >= 0).lastIndexOf(true);
    return isOpen && ring[0]?.[3] >= 0 ? begun(ring, last + 2) : ring;
  }

  /** The cell of the site at a place of a line: the bounds, cut by the borders towards those beside it. */
  private strip(at: number): Corner[] {
    const { xmin, ymin, xmax, ymax, delaunay } = this;
    const { hull } = delaunay;
    if (at < 0) return [];
    let ring: Corner[] = [[xmin, ymax, 1, -1], [xmin, ymin, 1, -1], [xmax, ymin, 1, -1], [xmax, ymax, 1, -1]]; // prettier-ignore
    for (const other of [at - 1, at + 1]) {
      if (!(other in hull)) continue;
      const [[x, y], [u, v]] = delaunay.places([hull[at], hull[other]]);
      const [a, b] = [x - u, y - v];
      ring = cut(ring, [a, b, a * (x - a / 2) + b * (y - b / 2)], hull[other]);
    }
    ring = different(ring);
    // The border towards the middle of the line begins; at the ends what is behind it.
    const inner = hull[2 * at < hull.length ? at + 1 : at - 1];
    const border = ring.map(([, , , beyond]) => beyond).indexOf(inner);
    return begun(ring, Math.max(0, border) + (at === 0 || at === hull.length - 1 ? 2 : 0));
  }
}

const begun = (ring: Corner[], k: number): Corner[] => ring.map((_, at) => ring[(at + k) % ring.length]);

/** A ring without repetitions; nothing of what is no more than a side. */
function different(ring: Corner[]): Corner[] {
  const left = ring.filter((corner, k) => {
    const next = k + 1 < ring.length ? ring[k + 1] : ring[0];
    return corner[0] !== next[0] || corner[1] !== next[1];
  });
  return left.length > 2 ? left : [];
}

/** The corners of a ring, but for those on straight sides along an axis. */
function outline(ring: Corner[]): Place[] {
  const places: Place[] = [];
  for (let k = 0; k < ring.length; ++k) {
    const [[x, y], p, q] = [ring[k], ring[(k || ring.length) - 1], ring[k + 1 < ring.length ? k + 1 : 0]];
    if ((x !== p[0] || x !== q[0]) && (y !== p[1] || y !== q[1])) places.push([x, y]);
  }
  return places;
}

/** The part of a convex ring where ax + by is at least c, with the site beyond that border; `meet` as it says above. */
function cut(ring: Corner[], [a, b, c]: number[], beyond: number, meet?: (site: number) => number): Corner[] {
  const depths = ring.map(([x, y, w]) => a * x + b * y - c * w);
  if (depths.every((depth) => depth >= 0)) return ring;
  const left: Corner[] = [];
  ring.forEach((corner, k) => {
    const next = (k + 1) % ring.length;
    const isInside = depths[k] >= 0;
    if (isInside) left.push(corner);
    if (isInside === depths[next] >= 0) return;
    const [p, q] = [corner, ring[next]];
    const [near, far] = [Math.abs(depths[next]), Math.abs(depths[k])];
    const w = p[2] * near + q[2] * far;
    const between = (axis: 0 | 1): number => {
      if (w === 0) return p[axis] * near + q[axis] * far;
      const met = corner[3] < 0 ? NaN : (meet?.(corner[3]) ?? NaN);
      const value = Number.isFinite(met) ? met : (p[axis] * near + q[axis] * far) / w;
      const isPart = p[2] > 0 && q[2] > 0;
      return isPart ? Math.max(Math.min(p[axis], q[axis]), Math.min(Math.max(p[axis], q[axis]), value)) : value;
    };
    const [x, y] = [w > 0 && b === 0 ? c / a : between(0), w > 0 && a === 0 ? c / b : between(1)];
    left.push([x, y, Math.sign(w), isInside ? beyond : corner[3]]);
  });
  return left;
}
