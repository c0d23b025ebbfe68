/** The two pictures of the Sphere room: the ball, and the plane that its sites are projected to. */

import { arcThrough, traceCap, traceCircle, type Circle } from "../drawing/arcs.ts";
import * as balls from "../drawing/ball.ts";
import type { Layer, Surface } from "../drawing/ball.ts";
import { drawNames, Seats, sidesToward, widthOf, type Box, type Named } from "../drawing/names.ts";
import { drawParts, type IsOn, type Part } from "../drawing/parts.ts";
import { cornersOf, drawHandle, traceCorners, traceDisc, traceSegment } from "../drawing/pen.ts";
import type { Disc, Path, Pen, Point } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import type { MoebiusMap } from "../kernel/api.ts";
import { lazy } from "../kernel/lazy.ts";
import { cross, dot, type Vector } from "../space.ts";
import { imageOf, sourceOf } from "../view/lens.ts";
import type { View } from "../view/view.ts";
import type { Bubble, Insertion, SphereSites } from "./sphere_sites.ts";
import type { PlaneFrame, Twin } from "./twin.ts";
import { roundInPlane, roundOnBall, sitesIn, united, windowOf, type RoundFacet, type Window } from "./window.ts";

/** A step of the insertion: what it does, and which facets before it and of its fan see the pole. */
export interface Step {
  readonly site: number;
  readonly insertion: Insertion | null;
  readonly beforeSeeing: Uint8Array;
  readonly fanSeeing: Uint8Array;
}

/** All that both pictures show. */
export interface SphereScene {
  readonly sites: SphereSites;
  readonly layers: BallLayers;
  readonly named: Named | null;
  readonly view: View;
  /** Through the lens, to the axes of the view. */
  readonly map: MoebiusMap;
  readonly twin: Twin;
  /** One byte a facet: 1 where it sees the pole. */
  readonly seeing: Uint8Array;
  readonly isOn: IsOn;
  readonly bubble: Bubble | null;
  /** Where the pointer was last. */
  readonly aim: Vector;
  /** Sites that are held besides those of the bubble. */
  readonly held: readonly number[];
  /** The step of the insertion that is looked at; "done" for the picture of all sites. */
  readonly step: Step | "done";
}

const BALL_LABEL: LabelStyle = { ink: "accent-text", halo: "ball", size: 15 };
const NAME: LabelStyle = { ink: "ink", halo: "ball", size: 13 };

/** Height above the picture, ball radii, below which a site's number would be cut by the limb. */
const LEAST_HEIGHT = 0.2;

/** Radius of a circle of the plane, px, below which the numbers of its sites would lie on each other. */
const LEAST_CIRCLE = 12;

/** What is drawn of sites on the ball, whose directions stay in the kernel while the ball turns. */
export type BallLayers = Readonly<Record<"edges" | "ridges" | "dots", Layer>>;

export function ballLayers(sites: SphereSites): BallLayers {
  return lazy({
    edges: () => balls.arcLayer("delaunay", balls.edgeArcs(sites.delaunay)),
    ridges: () => balls.arcLayer("voronoi", balls.ridgeArcs(sites.voronoi)),
    dots: () => balls.dotLayer("site", sites.xyz),
  });
}

/** The ball or the plane: a surface, and what is drawn on it in its own way. */
interface Picture extends Surface {
  readonly isPlane: boolean;
  readonly label: LabelStyle;
  /** Where numbers and names are set. */
  readonly seats: Seats;
  /** The region of the facets that see the pole, with the outline on whose left they are. */
  hatch(outline: readonly number[]): void;
  closing?(): void;
  triangles(): void;
  cells(): void;
  bubble(bubble: Bubble): void;
  dots(): void;
  names?(named: Named): void;
  /** The side of its dot on which the number of a bubble's site stands, y up; null where it is left out. */
  side(bubble: Bubble, site: number): Point | null;
  /** The facets that see the new site of a step, or those of its fan. */
  opening(path: Path, insertion: Insertion, isThere: (k: number) => boolean): void;
}

/** What both pictures show. GeoJSON has the diagram of all sites, whatever is drawn of it, at any step. */
export function sphereParts({ sites, named, seeing, bubble, held, step }: SphereScene): Part<Picture>[] {
  const isThere = step === "done";
  const outline = sites.outline(seeing);
  const isAimed = isThere && bubble !== null;
  return [
    { layer: "seeing", isThere: isThere && outline.length > 0, draw: (_, on) => on.hatch(outline) },
    { layer: "closing", isThere: isThere && sites.hasClosing, draw: (_, on) => on.closing?.() },
    {
      layer: "triangles",
      isThere,
      always: ["geojson"],
      draw: (_, on) => on.triangles(),
      regions: () => sites.triangles(),
    },
    {
      layer: "cells",
      isThere,
      always: ["geojson"],
      draw: (_, on) => on.cells(),
      regions: () => sites.cells(),
    },
    { layer: "seeing", isThere, draw: (pen, on) => pen.draw("hull", (path) => on.ring(path, outline)) },
    { isThere, draw: (_, on) => on.dots() },
    { isThere: !isThere, draw: (pen, on) => drawStep(pen, on, step as Step) },
    { layer: "bubble", isThere: isAimed, isOver: true, draw: (_, on) => on.bubble(bubble!) },
    { isThere, isOver: true, draw: (pen, on) => balls.drawDots(pen, on, "held", [...(bubble?.sites ?? []), ...held]) },
    // Names first: they stay while the bubble follows the pointer.
    { layer: "names", isThere: isThere && named !== null, isOver: true, draw: (_, on) => on.names?.(named!) },
    { layer: "bubble", isThere: isAimed, isOver: true, draw: (_, on) => drawNumbers(on, bubble!) },
  ];
}

/** What stays where only the pointer moves, and what lies over it. */
export type Stratum = "ground" | "over";

/** The one picture or the other. */
export interface Drawing {
  draw(pen: Pen, scene: SphereScene, stratum: Stratum): void;
  /** Where circles round facets are seen. */
  round(scene: SphereScene): RoundFacet;
}

/** A drawing's ground as it was painted. */
export interface Ground {
  readonly sites: SphereSites;
  readonly round: RoundFacet;
  readonly inks: Pen["inks"];
}

/** Brings a ground up to date where one site has moved since: where it was, and where it is now. */
export function drawMoved(pen: Pen, drawing: Drawing, scene: SphereScene, ground: Ground, site: number): void {
  const { sites, twin } = scene;
  const round = drawing.round(scene);
  pen.known = ground.inks;
  const window = (of: Pick<Ground, "sites" | "round">): Window =>
    windowOf(of.sites, site, of.round, pen.width, pen.height);
  for (const each of united(window(ground), window({ sites, round }))) {
    const seen = sitesIn(sites, each, round);
    const trace = (path: Path): void => traceCorners(path, cornersOf(...each));
    pen.within({ region: trace }, () => {
      pen.draw("paper", trace);
      drawing.draw(pen, { ...scene, sites: seen, layers: ballLayers(seen), seeing: seen.seeing(twin.pole) }, "ground");
    });
  }
  pen.known = null;
}

/** The ball in a disc. */
export function ballDrawing(disc: Disc): Drawing {
  return {
    draw: (pen, scene, stratum) => drawBall(pen, disc, scene, stratum),
    round: ({ sites, layers, map }) => roundOnBall(disc, map.apply(layers.dots.directions), sites),
  };
}

/** The plane in its frame. */
export function planeDrawing(frame: PlaneFrame): Drawing {
  return {
    draw: (pen, scene, stratum) => drawPlane(pen, frame, scene, stratum),
    round({ sites, twin, seeing }) {
      const places = new Float64Array(2 * sites.count);
      for (let k = 0; k < sites.count; ++k)
        [places[2 * k], places[2 * k + 1]] = frame.place(twin.forward(sites.site(k)));
      return roundInPlane(places, seeing, sites);
    },
  };
}

function drawBall(pen: Pen, disc: Disc, scene: SphereScene, stratum: Stratum): void {
  const { sites, layers, view, map, seeing } = scene;
  const isPlain = map.magnification === 1;
  const site = (k: number): Vector => sites.site(k);
  const surface = isPlain ? balls.ballSurface(disc, (k) => view.seen(site(k))) : balls.ballSurface(disc, site, map);
  const hidden = sourceOf(map, [0, 0, -1]);
  // Through its sites: of a small circle a centre and a radius say less.
  const rimOf = (bubble: Bubble): Circle | null =>
    arcThrough(map.apply(bubble.sites.flatMap((k) => [...site(k)])), 0, true);
  const pole = poleLabel(disc, scene);
  const seats = new Seats(pen, disc, pole === null ? [] : [pole.box]);
  const ball: Picture = {
    ...surface,
    isPlane: false,
    label: BALL_LABEL,
    seats,
    hatch(outline) {
      pen.draw("hatch", (path) => surface.region(path, outline, sites.regionHolds(seeing, hidden)));
    },
    closing() {
      const isHeld = sites.facetAt(hidden) === null;
      pen.draw("closing", (path) => surface.region(path, sites.closingOutline, isHeld));
    },
    triangles: () => balls.drawLayers(pen, disc, map, [layers.edges]),
    cells: () => balls.drawLayers(pen, disc, map, [layers.ridges]),
    bubble(bubble) {
      const rim = rimOf(bubble);
      if (rim === null) return;
      pen.draw("seen", (path) => traceCap(path, disc, rim));
      pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
      pen.draw("triangle", (path) => surface.ring(path, bubble.sites));
    },
    dots: () => balls.drawLayers(pen, disc, map, [layers.dots]),
    names: (named) => drawNames(seats, named, map.apply(layers.dots.directions), NAME),
    side(bubble, site) {
      const [point, rim] = [imageOf(map, sites.site(site)), rimOf(bubble)];
      if (rim === null || point[2] < LEAST_HEIGHT) return null;
      return [point[0] - rim.n[0], point[1] - rim.n[1]];
    },
    opening: (path, { before, seeing }) =>
      seeing.forEach((facet) => {
        const three = [...before.subarray(3 * facet, 3 * facet + 3)];
        const [a, b, c] = three.map(site);
        const normals = [cross(a, b), cross(b, c), cross(c, a)];
        // Facets that only close the hull are no triangles of the sphere.
        if (dot(normals[0], c) > 0)
          surface.region(
            path,
            three,
            normals.every((n) => dot(n, hidden) >= 0),
          );
      }),
  };
  if (stratum === "ground") pen.ball(disc, "ball");
  drawStratum(pen, ball, scene, stratum);
  if (stratum === "ground") pen.draw("limb", (path) => traceDisc(path, disc));
  else if (pole !== null) drawPole(pen, pole);
}

function drawStratum(pen: Pen, on: Picture, scene: SphereScene, stratum: Stratum): void {
  const parts = sphereParts(scene).filter(({ isOver = false }) => isOver === (stratum === "over"));
  drawParts(pen, on, parts, scene.isOn);
}

function drawPlane(pen: Pen, frame: PlaneFrame, scene: SphereScene, stratum: Stratum): void {
  const { sites, twin, seeing } = scene;
  const { x, y, size } = frame;
  const flat = (k: number): Point => frame.place(twin.forward(sites.site(k)));
  const whole = (path: Path): void => traceCorners(path, cornersOf(x, y, x + size, y + size));
  const surface = balls.planeSurface(flat, whole);
  const plane: Picture = {
    ...surface,
    isPlane: true,
    label: { ...BALL_LABEL, halo: "halo" },
    seats: new Seats(pen),
    // The outline runs clockwise on the picture, as the frame does: turned round, the path winds once between them.
    hatch: (outline) => pen.draw("hatch", (path) => surface.region(path, [...outline].reverse(), true)),
    triangles: () => surface.lines(pen, "delaunay", edgesOf(sites.delaunay.simplices, seeing)),
    cells: () => balls.drawSegments(pen, "voronoi", planeRidges(frame, scene)),
    bubble(bubble) {
      const image = twin.circle(bubble.center, bubble.cosine);
      if (image.kind === "line") {
        const [a, b] = image.normal;
        const size = a * a + b * b;
        const [u, v] = [(a * image.offset) / size, (b * image.offset) / size];
        const ends = [-1e3, 1e3].map((far) => frame.place([u + far * b, v - far * a]));
        pen.draw("bubble-open", (path) => traceSegment(path, ends[0], ends[1]));
        return;
      }
      const [x, y] = frame.place(image.middle);
      const r = image.radius * frame.scale;
      const ring = (path: Path): void => {
        path.moveTo(x + r, y);
        path.ellipse(x, y, r, r, 0, 2 * Math.PI, 0, true);
        path.closePath();
      };
      pen.draw("seen", (path) => {
        if (image.holdsPole) whole(path);
        ring(path);
      });
      pen.draw("bubble-open", ring);
      if (!image.holdsPole) pen.draw("triangle", (path) => surface.ring(path, bubble.sites));
    },
    dots: () => balls.drawDots(pen, surface, "site", Array(sites.count).keys()),
    side(bubble, site) {
      const image = twin.circle(bubble.center, bubble.cosine);
      if (image.kind === "line" || image.radius * frame.scale < LEAST_CIRCLE) return null;
      const [u, v] = twin.forward(sites.site(site));
      const sign = image.holdsPole ? -1 : 1;
      return [sign * (u - image.middle[0]), sign * (v - image.middle[1])];
    },
    opening(path, { outline, site }, isThere) {
      outline.forEach((a, k) => {
        if (isThere(k)) surface.ring(path, [a, outline[(k + 1) % outline.length], site]);
      });
    },
  };
  pen.within({ region: whole }, () => drawStratum(pen, plane, scene, stratum));
  if (stratum === "ground") pen.draw("frame", whole);
}

/** The numbers of a bubble's sites. */
function drawNumbers(on: Picture, bubble: Bubble): void {
  for (const site of bubble.sites) on.seats.takeDot(on.place(site), 3);
  for (const site of bubble.sites) {
    const out = on.side(bubble, site);
    if (out === null) continue;
    on.seats.set(String(site + 1), on.place(site), on.label, sidesToward(out[0], -out[1]));
  }
}

/** A step of the insertion. */
function drawStep(pen: Pen, on: Picture, { site, insertion, beforeSeeing, fanSeeing }: Step): void {
  if (insertion !== null) {
    const { outline, before } = insertion;
    // Facets of the fan that see the pole are no triangles of the plane, nor are sides between two of them its sides.
    const isThere = (k: number): boolean => !on.isPlane || !fanSeeing[(k + outline.length) % outline.length];
    if (outline.length > 0) pen.draw("seen", (path) => on.opening(path, insertion, isThere));
    on.lines(pen, "delaunay", edgesOf(before, on.isPlane ? beforeSeeing : null));
    pen.draw("fan", (path) => {
      outline.forEach((a, k) => (isThere(k) || isThere(k - 1)) && on.line(path, site, a));
    });
    pen.draw("horizon", (path) => {
      outline.forEach((a, k) => isThere(k) && on.line(path, a, outline[(k + 1) % outline.length]));
    });
  }
  balls.drawDots(pen, on, "site", Array(site + 1).keys());
  balls.drawDots(pen, on, "held", [site]);
}

/** Magnification up to which the pole is shown behind: above it all that is behind is one point. */
const BEHIND_UP_TO = 10;

/** The pole, axes of the view; null where it is not shown. */
export function poleSeen(map: MoebiusMap, twin: Twin): Vector | null {
  const pole = imageOf(map, twin.pole);
  return pole[2] < 0 && map.magnification > BEHIND_UP_TO ? null : pole;
}

/** The handle of the pole of projection, and its name. */
function drawPole(pen: Pen, { x, y, isFront, text, isLeft }: NonNullable<ReturnType<typeof poleLabel>>): void {
  drawHandle(pen, x, y, isFront ? "front" : "behind");
  pen.label(text, x + (isLeft ? -11 : 11), y + 5, { ...BALL_LABEL, align: isLeft ? "right" : "left" });
}

/** What stands beside the pole, towards the middle, where there is room; and the box of both. */
function poleLabel(disc: Disc, { map, twin }: SphereScene) {
  const pole = poleSeen(map, twin);
  if (pole === null) return null;
  const [isFront, [x, y]] = [pole[2] >= 0, balls.placeOf(disc, pole)];
  const [text, isLeft] = [isFront ? "*P*" : "*P*, behind", x > disc.x];
  const width = 11 + widthOf(text, BALL_LABEL);
  const box: Box = [x - (isLeft ? width : 7), y - 7, x + (isLeft ? 7 : width), y + 9];
  return { x, y, isFront, text, isLeft, box };
}

/** Ridges between the triangles of the plane, and rays where one has no neighbour: the centres are those of its circles. */
function planeRidges(frame: PlaneFrame, { sites, twin, seeing }: SphereScene): number[] {
  const { simplices, neighbors } = sites.delaunay;
  const middleOf = ({ center, cosine }: Bubble): Point => {
    const image = twin.circle(center, cosine);
    return image.kind === "circle" ? image.middle : [0, 0];
  };
  const middles: Point[] = [];
  const middle = (facet: number): Point => (middles[facet] ??= middleOf(sites.bubble(facet)));
  const ends: number[] = [];
  for (let at = 0; at < neighbors.length; ++at) {
    const facet = Math.floor(at / 3);
    const beyond = neighbors[at];
    if (seeing[facet] || (!seeing[beyond] && beyond < facet)) continue;
    if (!seeing[beyond]) {
      ends.push(...frame.place(middle(facet)), ...frame.place(middle(beyond)));
      continue;
    }
    // The side opposite the corner runs counterclockwise: outward is to its right.
    const [a, b] = [1, 2].map((k) => twin.forward(sites.site(simplices[3 * facet + ((at + k) % 3)])));
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const [u, v] = middle(facet);
    const far = (4 * frame.reach + Math.hypot(u - frame.middle[0], v - frame.middle[1])) / length;
    ends.push(...frame.place([u, v]), ...frame.place([u + far * (b[1] - a[1]), v - far * (b[0] - a[0])]));
  }
  return ends;
}

/** Every edge of facets once; with `seeing` those of the plane, of whose facets one at least does not see the pole. */
function edgesOf(facets: Int32Array, seeing: Uint8Array | null): number[] {
  const [drawn, edges] = [new Set<number>(), [] as number[]];
  for (let k = 0; k < facets.length; ++k) {
    const [a, b] = [facets[k], facets[k % 3 === 2 ? k - 2 : k + 1]];
    const name = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    if (seeing === null ? a > b : seeing[Math.floor(k / 3)] || drawn.has(name)) continue;
    drawn.add(name);
    edges.push(a, b);
  }
  return edges;
}
