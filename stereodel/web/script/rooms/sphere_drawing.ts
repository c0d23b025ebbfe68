/** The two pictures of the Sphere room: the ball, and the plane that its sites are projected to. */

import { arcThrough, traceCap, traceCircle, type Circle } from "../drawing/arcs.ts";
import * as balls from "../drawing/ball.ts";
import type { Layer, Surface } from "../drawing/ball.ts";
import { drawNames, Seats, sidesToward, widthOf, type Box, type Named } from "../drawing/names.ts";
import { drawParts, type IsOn, type Part } from "../drawing/parts.ts";
import { cornersOf, drawHandle, traceCorners, traceDisc, traceSegment } from "../drawing/pen.ts";
import type { Disc, Path, Pen, Point } from "../drawing/pen.ts";
import type { LabelStyle, StyleName } from "../drawing/styles.ts";
import type { MoebiusMap } from "../kernel/api.ts";
import { lazy } from "../kernel/lazy.ts";
import { following } from "../kernel/topology.ts";
import { cross, dot, type Vector } from "../space.ts";
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
  /** The region of the facets that are marked. */
  hatch(style: StyleName, marked: Uint8Array): void;
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

/** What both pictures show. */
export function sphereParts(scene: SphereScene): Part<Picture>[] {
  const { sites, named, seeing, bubble, held, step } = scene;
  const isThere = step === null;
  const whole = { isThere, always: ["geojson"] as const }; // all sites, whatever is drawn of them, at any step
  const isAimed = isThere && bubble !== null;
  return [
    { layer: "seeing", isThere: isThere && seeing.includes(1), draw: (_, on) => on.hatch("hatch", seeing) },
    {
      layer: "closing",
      isThere: isThere && sites.hasClosing,
      draw: (_, on) => on.isPlane || on.hatch("closing", sites.delaunay.closing),
    },
    { layer: "triangles", ...whole, draw: (_, on) => on.triangles(), regions: () => sites.triangles() },
    { layer: "cells", ...whole, draw: (_, on) => on.cells(), regions: () => sites.cells() },
    { layer: "seeing", isThere, draw: (pen, on) => pen.draw("hull", (path) => on.ring(path, sites.rings(seeing)[0])) },
    { isThere, draw: (_, on) => on.dots() },
    { isThere: !isThere, draw: (pen, on) => drawStep(pen, on, scene, step!) },
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
            const holds = normals.every((n) => dot(n, hidden) >= 0);
            if (dot(normals[0], c) > 0) surface.region(path, three, holds); // others only close the hull
          }),
      };
      if (stratum === "ground") pen.ball(disc, "ball");
      drawStratum(pen, ball, scene, stratum);
      if (stratum === "ground") pen.draw("limb", (path) => traceDisc(path, disc));
      else pole?.draw(pen);
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
      const surface = balls.planeSurface(flat, whole);
      const plane: Picture = {
        ...surface,
        isPlane: true,
        label: { ...BALL_LABEL, halo: "halo" },
        seats: new Seats(pen),
        // The outline runs clockwise on the picture, as the frame does: turned round, the path winds once between them.
        hatch: (style, marked) =>
          pen.draw(style, (path) => surface.region(path, sites.rings(marked)[0].reverse(), true)),
        triangles: () => surface.lines(pen, "delaunay", edgesOf(sites.delaunay.simplices, seeing)),
        cells: () => balls.drawSegments(pen, "voronoi", planeRidges(frame, scene)),
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
          if (image.isLine || image.radius * frame.scale < LEAST_CIRCLE) return null;
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

/** The numbers of a bubble's sites. */
function drawNumbers(on: Picture, bubble: Bubble): void {
  for (const site of bubble.sites) on.seats.takeDot(on.place(site), 3);
  for (const site of bubble.sites) {
    const out = on.side(bubble, site);
    if (out === null) continue;
    on.seats.set(String(site + 1), on.place(site), on.label, sidesToward(out[0], -out[1]));
  }
}

const NONE = new Int32Array(0);

/** A step of the insertion. */
function drawStep(pen: Pen, on: Picture, { sites, twin }: SphereScene, step: Insertion): void {
  const { site, before, outline, fan } = step;
  const [beforeSeeing, fanSeeing] = [before, fan].map((facets) => sites.seeing(twin.pole, on.isPlane ? facets : NONE));
  // Facets of the fan that see the pole are no triangles of the plane, nor are sides between two of them its sides.
  const isThere = (k: number): boolean => !fanSeeing[(k + outline.length) % outline.length];
  if (outline.length > 0) pen.draw("seen", (path) => on.opening(path, step, isThere));
  on.lines(pen, "delaunay", edgesOf(before, beforeSeeing));
  pen.draw("fan", (path) => outline.forEach((a, k) => (isThere(k) || isThere(k - 1)) && on.line(path, site, a)));
  pen.draw("horizon", (path) =>
    outline.forEach((a, k) => isThere(k) && on.line(path, a, outline[(k + 1) % outline.length])),
  );
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

/** The pole's handle and its name, beside it towards the middle, where there is room; the box of both, and what draws them. */
function poleLabel(disc: Disc, { map, twin }: SphereScene) {
  const pole = poleSeen(map, twin);
  if (pole === null) return null;
  const [isFront, [x, y]] = [pole[2] >= 0, balls.placeOf(disc, pole)];
  const [text, isLeft] = [isFront ? "*P*" : "*P*, behind", x > disc.x];
  const width = 11 + widthOf(text, BALL_LABEL);
  const box: Box = [x - (isLeft ? width : 7), y - 7, x + (isLeft ? 7 : width), y + 9];
  const draw = (pen: Pen): void => {
    drawHandle(pen, x, y, isFront ? "front" : "behind");
    pen.label(text, x + (isLeft ? -11 : 11), y + 5, { ...BALL_LABEL, align: isLeft ? "right" : "left" });
  };
  return { box, draw };
}

/** Ridges between the triangles of the plane, and rays where one has no neighbour: the centres are those of its circles. */
function planeRidges(frame: PlaneFrame, { sites, twin, seeing }: SphereScene): number[] {
  const { simplices, neighbors } = sites.delaunay;
  const middles = Array.from(seeing, (_, facet): Point => {
    const { center, cosine } = sites.bubble(facet);
    return twin.circle(center, cosine).middle;
  });
  const ends: number[] = [];
  for (let at = 0; at < neighbors.length; ++at) {
    const facet = Math.floor(at / 3);
    const beyond = neighbors[at];
    if (seeing[facet] || (!seeing[beyond] && beyond < facet)) continue;
    if (!seeing[beyond]) {
      ends.push(...frame.place(middles[facet]), ...frame.place(middles[beyond]));
      continue;
    }
    // The side opposite the corner runs counterclockwise: outward is to its right.
    const [a, b] = [1, 2].map((k) => twin.forward(sites.site(simplices[3 * facet + ((at + k) % 3)])));
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const [u, v] = middles[facet];
    const far = (4 * frame.reach + Math.hypot(u - frame.middle[0], v - frame.middle[1])) / length;
    ends.push(...frame.place([u, v]), ...frame.place([u + far * (b[1] - a[1]), v - far * (b[0] - a[0])]));
  }
  return ends;
}

/** Every edge once of facets of which one at least does not see the pole. */
function edgesOf(facets: Int32Array, seeing: Uint8Array): number[] {
  const [drawn, edges] = [new Set<number>(), [] as number[]];
  for (let k = 0; k < facets.length; ++k) {
    const [a, b] = [facets[k], facets[following(k)]];
    const name = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    if (seeing[Math.floor(k / 3)] || drawn.has(name)) continue;
    drawn.add(name);
    edges.push(a, b);
  }
  return edges;
}
