/** The two pictures of the Sphere room: the ball, and the plane that its sites are projected to. */

import { arcThrough, traceCap, traceCircle } from "../drawing/arcs.ts";
import * as balls from "../drawing/ball.ts";
import type { Layer, Surface } from "../drawing/ball.ts";
import { drawNames, Seats, sidesToward, type Named } from "../drawing/names.ts";
import { drawParts, type IsOn, type Part } from "../drawing/parts.ts";
import { cornersOf, drawHandle, traceCorners, traceDisc, traceSegment } from "../drawing/pen.ts";
import type { Disc, Path, Pen, Point } from "../drawing/pen.ts";
import type { LabelStyle, StyleName } from "../drawing/styles.ts";
import type { MoebiusMap, SphericalDelaunay } from "../kernel/api.ts";
import { lazy } from "../kernel/lazy.ts";
import { following } from "../kernel/topology.ts";
import { cross, dot, row, type Vector } from "../space.ts";
import { imageOf, sourceOf } from "../view/lens.ts";
import type { View } from "../view/view.ts";
import type { Bubble, Insertion, SphereSites } from "./sphere_sites.ts";
import type { PlaneFrame, Twin } from "./twin.ts";
import { roundFacets, sitesIn, squareAbout, united, windowOf, type RoundFacet, type Window } from "./window.ts";

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
  /** The step of the insertion that is looked at; null for the picture of all sites. */
  readonly step: Insertion | null;
}

const BALL_LABEL: LabelStyle = { ink: "accent-text", halo: "ball", size: 15 };
const NAME: LabelStyle = { ink: "ink", halo: "ball", size: 13 };

/** What is drawn of sites on the ball, whose directions stay in the kernel while the ball turns. */
export type BallLayers = Readonly<Record<"edges" | "ridges" | "dots", Layer>>;

export function ballLayers(sites: SphereSites): BallLayers {
  return lazy({
    edges: () => balls.arcLayer("delaunay", balls.arcsBetween(sites.delaunay.points, sites.delaunay.edges)),
    ridges: () => balls.arcLayer("voronoi", balls.ridgeArcs(sites.voronoi())),
    dots: () => balls.dotLayer("site", sites.xyz),
  });
}

/** The ball or the plane: a surface, and what is drawn on it in its own way. */
interface Picture extends Surface {
  readonly isPlane: boolean;
  /** Where numbers and names are set. */
  readonly seats: Seats;
  /** The region of the facets that are marked. */
  hatch(style: StyleName, marked: Uint8Array): void;
  triangles(): void;
  cells(): void;
  bubble(bubble: Bubble): void;
  dots(): void;
  /** A facet, unless it is none of the triangles there. */
  facet(path: Path, sites: Vector): void;
}

/** What both pictures show. */
export function sphereParts(scene: SphereScene): Part<Picture>[] {
  const { sites, layers, map, named, seeing, bubble, held, step } = scene;
  const isThere = step === null;
  const isAimed = isThere && bubble !== null;
  return [
    { layer: "seeing", isThere: isThere && seeing.includes(1), draw: (_, on) => on.hatch("hatch", seeing) },
    {
      layer: "closing",
      isThere: isThere && sites.hasClosing,
      draw: (_, on) => on.isPlane || on.hatch("closing", sites.delaunay.closing),
    },
    { layer: "triangles", isThere, draw: (_, on) => on.triangles(), regions: () => sites.triangles() },
    { layer: "cells", isThere, draw: (_, on) => on.cells(), regions: () => sites.cells() },
    { layer: "seeing", isThere, draw: (pen, on) => on.lines(pen, "hull", balls.sidesOf(sites.rings(seeing)[0])) },
    { isThere, draw: (_, on) => on.dots() },
    { isThere: !isThere, draw: (pen, on) => drawStep(pen, on, scene, step!) },
    { layer: "bubble", isThere: isAimed, isOver: true, draw: (_, on) => on.bubble(bubble!) },
    { isThere, isOver: true, draw: (pen, on) => balls.drawDots(pen, on, "held", [...(bubble?.sites ?? []), ...held]) },
    // The pole and names before numbers: they stay while the bubble follows the pointer.
    { isOver: true, draw: (pen, on) => on.isPlane || drawPole(pen, on, scene) },
    {
      layer: "names",
      isThere: isThere && named !== null,
      isOver: true,
      draw: (_, on) => on.isPlane || drawNames(on.seats, named!, map.apply(layers.dots.directions), NAME),
    },
    { layer: "bubble", isThere: isAimed, isOver: true, draw: (_, on) => drawNumbers(on, bubble!.sites) },
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
  readonly scene: SphereScene;
  readonly inks: Pen["inks"];
  round?: RoundFacet;
}

/** Brings a ground up to date where one site has moved since: where it was, and where it is now. */
export function drawMoved(pen: Pen, drawing: Drawing, scene: SphereScene, ground: Ground, site: number): void {
  const [before, round] = [(ground.round ??= drawing.round(ground.scene)), drawing.round(scene)];
  pen.known = ground.inks;
  const window = ({ sites }: SphereScene, round: RoundFacet): Window =>
    windowOf(sites, site, round, [pen.width, pen.height]);
  for (const each of united(window(ground.scene, before), window(scene, round))) {
    const seen = sitesIn(scene.sites, each, round);
    const trace = (path: Path): void => traceCorners(path, cornersOf(...each));
    pen.within({ region: trace }, () => {
      pen.draw("paper", trace);
      drawing.draw(
        pen,
        { ...scene, sites: seen, layers: ballLayers(seen), seeing: seen.seeing(scene.twin.pole) },
        "ground",
      );
    });
  }
  pen.known = null;
}

/** The ball in a disc. */
export function ballDrawing(disc: Disc): Drawing {
  return {
    draw(pen, scene, stratum) {
      const { sites, layers, view, map } = scene;
      const isPlain = map.magnification === 1;
      const site = (k: number): Vector => sites.site(k);
      const surface = isPlain ? balls.ballSurface(disc, (k) => view.seen(site(k))) : balls.ballSurface(disc, site, map);
      const hidden = sourceOf(map, [0, 0, -1]);
      const seats = new Seats(pen, disc);
      const ball: Picture = {
        ...surface,
        isPlane: false,
        seats,
        hatch(style, facets) {
          // What lies beyond all triangles is one region: that of all facets that close the hull, if one is marked.
          const { closing } = sites.delaunay;
          const beyond = facets.find((mark, k) => mark === 1 && closing[k] === 1) ?? 0;
          const marked = facets.map((mark, k) => (closing[k] ? beyond : mark));
          const holds = marked[sites.facetAt(hidden) ?? closing.indexOf(1)] === 1;
          const rings = sites.rings(marked);
          pen.draw(style, (path) => rings.forEach((ring, k) => surface.region(path, ring, holds && k === 0)));
        },
        triangles: () => balls.drawLayers(pen, disc, map, [layers.edges]),
        cells: () => balls.drawLayers(pen, disc, map, [layers.ridges]),
        bubble(bubble) {
          // Through its sites: of a small circle a centre and a radius say less.
          const rim = arcThrough(map.apply(bubble.sites.flatMap((k) => [...site(k)])), 0, true);
          if (rim === null) return;
          pen.draw("seen", (path) => traceCap(path, disc, rim));
          pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
          surface.lines(pen, "triangle", balls.sidesOf(bubble.sites));
        },
        dots: () => balls.drawLayers(pen, disc, map, [layers.dots]),
        facet(path, sites) {
          const [a, b, c] = sites.map(site);
          const normals = [cross(a, b), cross(b, c), cross(c, a)];
          const holds = normals.every((n) => dot(n, hidden) >= 0);
          if (dot(normals[0], c) > 0) surface.region(path, sites, holds); // others only close the hull
        },
      };
      if (stratum === "ground") pen.ball(disc, "ball");
      drawStratum(pen, ball, scene, stratum);
      if (stratum === "ground") pen.draw("limb", (path) => traceDisc(path, disc));
    },
    round: ({ sites, layers, map }) =>
      roundFacets(map.apply(layers.dots.directions), sites, (center, cosine) => {
        const reach = Math.sqrt(2 - 2 * Math.min(1, cosine)); // from the middle of the cap to its rim
        const radius = cosine > 0 ? disc.r * reach : Infinity;
        return squareAbout(balls.placeOf(disc, center), center[2] < -reach ? 0 : radius);
      }),
  };
}

/** The plane in its frame. */
export function planeDrawing(frame: PlaneFrame): Drawing {
  return {
    draw(pen, scene, stratum) {
      const { sites, twin, seeing } = scene;
      const { x, y, size } = frame;
      const flat = (k: number): Point => frame.place(twin.forward(sites.site(k)));
      const whole = (path: Path): void => traceCorners(path, cornersOf(x, y, x + size, y + size));
      const places = (): number[] => Array.from({ length: sites.count }, (_, site) => flat(site)).flat();
      const surface = balls.planeSurface(flat, whole);
      const plane: Picture = {
        ...surface,
        isPlane: true,
        seats: new Seats(pen),
        // The outline runs clockwise on the picture, as the frame does: turned round, the path winds once between them.
        hatch: (style, marked) =>
          pen.draw(style, (path) => surface.region(path, sites.rings(marked)[0].reverse(), true)),
        triangles: () => surface.lines(pen, "delaunay", edgesOf(sites.delaunay, seeing)),
        cells: () => pen.lines("voronoi", balls.ridgeSegments(places(), 2 * size)),
        bubble(bubble) {
          const image = twin.circle(bubble.center, bubble.cosine);
          if (image.isLine) {
            const [a, b] = image.normal;
            const size = a * a + b * b;
            const [u, v] = [(a * image.offset) / size, (b * image.offset) / size];
            const ends = [-1e3, 1e3].map((far) => frame.place([u + far * b, v - far * a]));
            pen.draw("bubble-open", (path) => traceSegment(path, ends[0], ends[1]));
            return;
          }
          const [x, y] = frame.place(image.middle);
          const r = image.radius * frame.scale;
          const ring = (path: Path): void => traceDisc(path, { x, y, r }, true);
          pen.draw("seen", (path) => {
            if (image.holdsPole) whole(path);
            ring(path);
          });
          pen.draw("bubble-open", ring);
          if (!image.holdsPole) surface.lines(pen, "triangle", balls.sidesOf(bubble.sites));
        },
        dots: () => balls.drawDots(pen, surface, "site", Array(sites.count).keys()),
        facet: (path, sites) => surface.region(path, sites, false),
      };
      pen.within({ region: whole }, () => drawStratum(pen, plane, scene, stratum));
      if (stratum === "ground") pen.draw("frame", whole);
    },
    round: ({ sites, twin }) =>
      roundFacets(sites.xyz, sites, (center, cosine) => {
        const { middle, radius, holdsPole } = twin.circle(center, cosine);
        return squareAbout(frame.place(middle), holdsPole ? Infinity : radius * frame.scale);
      }),
  };
}

function drawStratum(pen: Pen, on: Picture, scene: SphereScene, stratum: Stratum): void {
  const parts = sphereParts(scene).filter(({ isOver = false }) => isOver === (stratum === "over"));
  drawParts(pen, on, parts, scene.isOn);
}

/** The numbers of sites, on the sides that point away from their middle. */
function drawNumbers({ seats, place, isSeen, isPlane }: Picture, sites: Vector): void {
  const label: LabelStyle = { ...BALL_LABEL, halo: isPlane ? "halo" : "ball" };
  const places = sites.map(place);
  const [x, y] = [0, 1].map((k) => places.reduce((sum, at) => sum + at[k], 0) / places.length);
  for (const at of places) seats.takeDot(at, 3);
  places.forEach((at, k) => {
    if (isSeen(sites[k])) seats.set(String(sites[k] + 1), at, label, sidesToward(at[0] - x, at[1] - y));
  });
}

const NONE = new Int32Array(0);

/** A step of the insertion. */
function drawStep(pen: Pen, on: Picture, { sites, twin }: SphereScene, step: Insertion): void {
  const { site, before, outline, fan } = step;
  const [beforeSeeing, fanSeeing] = [before.simplices, fan].map((facets) =>
    sites.seeing(twin.pole, on.isPlane ? facets : NONE),
  );
  // Facets of the fan that see the pole are no triangles of the plane, nor are sides between two of them its sides.
  const isThere = (k: number): boolean => !fanSeeing[(k + outline.length) % outline.length];
  pen.draw("seen", (path) => outline.forEach((_, k) => isThere(k) && on.facet(path, row(fan, k))));
  on.lines(pen, "delaunay", edgesOf(before, beforeSeeing));
  const spokes = outline.flatMap((a, k) => (isThere(k) || isThere(k - 1) ? [site, a] : []));
  const rim = balls.sidesOf(outline).filter((_, k) => isThere(k >> 1));
  on.lines(pen, "fan", spokes);
  on.lines(pen, "horizon", rim);
  balls.drawDots(pen, on, "site", Array(site + 1).keys());
  balls.drawDots(pen, on, "held", [site]);
}

/** Radius of the pole's handle, px. */
const HANDLE = 7;

/** Magnification up to which the pole is shown behind: above it all that is behind is one point. */
const BEHIND_UP_TO = 10;

/** The pole, axes of the view; null where it is not shown. */
export function poleSeen(map: MoebiusMap, twin: Twin): Vector | null {
  const pole = imageOf(map, twin.pole);
  return pole[2] < 0 && map.magnification > BEHIND_UP_TO ? null : pole;
}

/** The pole's handle and its name, beside it towards the middle. */
function drawPole(pen: Pen, { seats }: Picture, { map, twin }: SphereScene): void {
  const pole = poleSeen(map, twin);
  if (pole === null) return;
  const [isFront, at] = [pole[2] >= 0, balls.placeOf(seats.disc, pole)];
  drawHandle(pen, ...at, isFront ? "front" : "behind");
  seats.takeDot(at, HANDLE);
  seats.set(isFront ? "*P*" : "*P*, behind", at, BALL_LABEL, sidesToward(-pole[0], 0), HANDLE);
}

/** Every edge once of facets of which one at least does not see the pole. */
function edgesOf({ simplices, neighbors }: SphericalDelaunay, seeing: Uint8Array): number[] {
  const edges: number[] = [];
  neighbors.forEach((beyond, at) => {
    const [a, b] = [following(at), following(following(at))].map((k) => simplices[k]);
    if (!seeing[Math.floor(at / 3)] && (a < b || seeing[beyond])) edges.push(a, b);
  });
  return edges;
}
