/** The picture of the Lift room: a sheet that bends onto a ball, under the plane that it was. */

import { traceArc } from "../drawing/arcs.ts";
import { traceGreat, tracePolygon } from "../drawing/ball.ts";
import { traceRegions } from "../drawing/fill.ts";
import { cornersOf, traceCorners, traceDisc, traceSegment, type Disc, type Path, type Pen } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { cross, unit, type Vector } from "../space.ts";
import type { View } from "../view/view.ts";
import type { LiftSites, Sheet } from "./lift_sites.ts";
import { chained } from "./sphere_sites.ts";

/** What the picture shows. */
export interface LiftScene {
  readonly sites: LiftSites;
  readonly sheet: Sheet;
  readonly view: View;
  /** Height of the view above the sheet, degrees: it says how large the picture can be. */
  readonly height: number;
  readonly shown: {
    readonly triangles: boolean;
    readonly cells: boolean;
    readonly rays: boolean;
    readonly seeing: boolean;
  };
  readonly p: number | null;
  readonly q: number | null;
  /** A site that the table points at. */
  readonly lit: number | null;
}

/** The picture's box in units of which the sheet's diagonal has so many, and where the point of contact is in it. */
const BOX = { width: 1200, height: 960, contact: 345 };
const DIAGONAL = 1190;

/** Height of the view, degrees, from which on the sheet would be too high for the box. */
const HIGH = 35;

/** Angles of the corners from which on the ball's outline and the ball itself are drawn: before they are larger than the picture. */
const OUTLINE_FROM = 40;
const BALL_FROM = 75;

/** Points along each side of the sheet. */
const PER_SIDE = 48;

const LETTER: LabelStyle = { ink: "accent-text", halo: "ball", size: 17, italic: true, align: "center" };
const WORD: LabelStyle = { ink: "ink-2", halo: "ball", size: 14 };

/** Where the picture is in a drawing: the point of contact, and pixels of a diagonal. */
interface Stand {
  readonly x: number;
  readonly y: number;
  readonly scale: number;
}

/** The stand of a picture in a drawing of some pixels; it does not change while the ball is turned sideways. */
export function standOf(width: number, height: number, elevation: number): Stand {
  const unit = Math.min(width / BOX.width, height / BOX.height);
  const steep = Math.sin((Math.max(HIGH, elevation) * Math.PI) / 180) / Math.sin((HIGH * Math.PI) / 180);
  return { x: width / 2, y: (height - BOX.height * unit) / 2 + BOX.contact * unit, scale: (DIAGONAL * unit) / steep };
}

/** Where a point of space, in diagonals, is on the drawing. */
export function onPicture({ x, y, scale }: Stand, view: View, point: Vector): [number, number] {
  const seen = view.seen(point);
  return [x + scale * seen[0], y - scale * seen[1]];
}

/** Where the image of a site is on the drawing, and whether it is in front. */
export function sitePlace(
  stand: Stand,
  { sites, sheet, view }: LiftScene,
  k: number,
): { at: [number, number]; front: boolean } {
  const [x, y] = [sites.places[2 * k], sites.places[2 * k + 1]];
  const front = sheet.isFlat || view.seen(sheet.direction(x, y))[2] >= 0;
  return { at: onPicture(stand, view, sheet.image(x, y)), front };
}

/** Draws the picture. */
export function drawLift(pen: Pen, scene: LiftScene, isMoving: boolean): void {
  const stand = standOf(pen.width, pen.height, scene.height);
  if (scene.sheet.isFlat) drawFlat(pen, stand, scene);
  else drawBent(pen, stand, scene, isMoving);
  drawPair(pen, stand, scene);
}

function drawBent(pen: Pen, stand: Stand, scene: LiftScene, isMoving: boolean): void {
  const { sheet, sites, shown } = scene;
  const disc = discOf(stand, scene);
  if (sheet.corner >= BALL_FROM) pen.ball(disc, "ball");
  if (sheet.corner >= OUTLINE_FROM) pen.draw("limb-soft", (path) => traceDisc(path, disc));
  const look = lookAt(scene);
  const border = borderOf(scene);
  const hull = hullOf(sites);
  if (shown.seeing && hull.length > 2) drawSeeing(pen, disc, scene, hull, look);
  const region = (path: Path): void => traceRegions(path, disc, ringOf(border), holds(scene, [0, 0, -1]));
  // Seen from behind the ball is its mirror image: rings run the other way.
  const mirrored = border.map(([x, y, z]): Vector => [x, y, -z]).reverse();
  pen.behind(() => pen.draw("sheet", (path) => traceRegions(path, disc, ringOf(mirrored), holds(scene, [0, 0, 1]))));
  pen.draw("sheet", region);
  const { edges } = sites.delaunay;
  const drawEdges = (side: "front" | "back"): void => {
    pen.draw("delaunay", (path) => {
      for (let k = 0; k < edges.length; k += 2) traceGreat(path, disc, look(edges[k]), look(edges[k + 1]), side);
    });
  };
  pen.behind(() => {
    pen.draw("side", (path) => traceBorder(path, disc, scene, "back"));
    if (shown.triangles && !isMoving) drawEdges("back");
  });
  if (shown.triangles) drawEdges("front");
  if (shown.cells) {
    pen.clipped(region, () => {
      pen.draw("voronoi", (path) => {
        for (const [a, b] of ridgesOf(scene, look)) traceGreat(path, disc, a, b);
      });
    });
  }
  pen.draw("side", (path) => traceBorder(path, disc, scene, "front"));
  drawSites(pen, stand, scene);
  pen.draw("sheet-plane", (path) => tracePlane(path, stand, scene));
}

function drawFlat(pen: Pen, stand: Stand, scene: LiftScene): void {
  const { sites, sheet, view, shown } = scene;
  const place = (x: number, y: number): [number, number] => onPicture(stand, view, sheet.flat(x, y));
  const site = (k: number): [number, number] => place(sites.places[2 * k], sites.places[2 * k + 1]);
  const outline = (path: Path): void => tracePlane(path, stand, scene);
  pen.draw("sheet", outline);
  if (shown.seeing) {
    const hull = hullOf(sites);
    pen.draw("hatch", (path) => {
      outline(path);
      traceCorners(path, hull.map(site).reverse());
    });
    pen.draw("hull", (path) => traceCorners(path, hull.map(site)));
  }
  if (shown.triangles) {
    const { edges } = sites.delaunay;
    pen.draw("delaunay", (path) => {
      for (let k = 0; k < edges.length; k += 2) traceSegment(path, site(edges[k]), site(edges[k + 1]));
    });
  }
  if (shown.cells) {
    pen.clipped(outline, () => {
      pen.draw("voronoi", (path) => {
        for (const [a, b] of sites.ridges) traceSegment(path, place(...a), place(...b));
      });
    });
  }
  pen.draw("side", outline);
  drawSites(pen, stand, scene);
}

/** The facets that see the pole: hatched, with their edges. */
function drawSeeing(pen: Pen, disc: Disc, scene: LiftScene, hull: number[], look: (k: number) => Vector): void {
  const { sites } = scene;
  const outside = !insideHull(sites, hull, flatOf(scene, [0, 0, -1]));
  pen.draw("hatch", (path) => tracePolygon(path, disc, hull.map(look).reverse(), outside));
  pen.draw("hull", (path) => {
    const { closing } = sites;
    for (let k = 0; k < closing.length; ++k) {
      const [a, b] = [closing[k], closing[k % 3 === 2 ? k - 2 : k + 1]];
      if (a < b || hull.includes(a)) traceGreat(path, disc, look(a), look(b));
    }
  });
}

/** P and Q: their rays, the arc between them, their places in the plane, and the pole. */
function drawPair(pen: Pen, stand: Stand, scene: LiftScene): void {
  const { sites, sheet, view, shown, p, q, lit } = scene;
  const at = (k: number): [number, number] => [sites.places[2 * k], sites.places[2 * k + 1]];
  if (!sheet.isFlat) {
    const touch = onPicture(stand, view, [0, 0, 0]);
    pen.draw("touch", (path) => {
      traceSegment(path, [touch[0] - 4.5, touch[1]], [touch[0] + 4.5, touch[1]]);
      traceSegment(path, [touch[0], touch[1] - 3.5], [touch[0], touch[1] + 3.5]);
    });
  }
  if (p !== null && q !== null && p !== q) {
    const [a, b] = [p, q].map(at).map(([x, y]) => (sheet.isFlat ? sheet.flat(x, y) : view.seen(sheet.direction(x, y))));
    pen.draw("span", (path) => {
      if (sheet.isFlat) traceSegment(path, onPicture(stand, view, a), onPicture(stand, view, b));
      else for (const side of ["front", "back"] as const) traceGreat(path, discOf(stand, scene), a, b, side);
    });
  }
  const pole = sheet.isFlat ? null : onPicture(stand, view, sheet.pole);
  const poleIsSeen = pole !== null && pole[1] < pen.height - 20;
  for (const [site, name] of [
    [p, "P"],
    [q, "Q"],
  ] as const) {
    if (site === null) continue;
    const above = onPicture(stand, view, sheet.flat(...at(site)));
    const image = onPicture(stand, view, sheet.image(...at(site)));
    if (!sheet.isFlat) {
      if (shown.rays) pen.draw("ray", (path) => traceSegment(path, poleIsSeen ? pole : image, above));
      pen.dots("shadow", above);
    }
    pen.dots("held", image);
    pen.label(name, above[0], above[1] - 9, { ...LETTER, halo: "halo" });
  }
  if (poleIsSeen) {
    pen.dots("pole", pole);
    pen.label("pole", pole[0] + 7, pole[1] + 6, WORD);
  }
  if (lit !== null && lit < sites.count) pen.dots("held", sitePlace(stand, scene, lit).at);
}

function drawSites(pen: Pen, stand: Stand, scene: LiftScene): void {
  const places: number[] = [];
  for (let k = 0; k < scene.sites.count; ++k) {
    const { at, front } = sitePlace(stand, scene, k);
    if (front) places.push(...at);
  }
  pen.dots("site", places);
}

/** The ball on the drawing. */
function discOf(stand: Stand, { sheet, view }: LiftScene): Disc {
  const [x, y] = onPicture(stand, view, [0, 0, -sheet.radius]);
  return { x, y, r: stand.scale * sheet.radius };
}

/** The directions of sites' images in the axes of the view, each made once. */
function lookAt({ sites, sheet, view }: LiftScene): (k: number) => Vector {
  const known: Vector[] = [];
  return (k) => (known[k] ??= view.seen(sheet.direction(sites.places[2 * k], sites.places[2 * k + 1])));
}

/** Corners of the sheet, counterclockwise. */
function sheetCorners({ sites }: LiftScene): [number, number][] {
  const { middle, width, height } = sites.rectangle;
  const [w, h] = [width / 2, height / 2];
  return cornersOf(middle[0] - w, middle[1] - h, middle[0] + w, middle[1] + h);
}

/** Directions along the sheet's sides, axes of the view. */
function borderOf(scene: LiftScene): Vector[] {
  const corners = sheetCorners(scene);
  return corners.flatMap(([ax, ay], k) => {
    const [bx, by] = corners[(k + 1) % 4];
    return Array.from({ length: PER_SIDE }, (_, j) => {
      const t = j / PER_SIDE;
      return scene.view.seen(scene.sheet.direction(ax + t * (bx - ax), ay + t * (by - ay)));
    });
  });
}

function ringOf(points: readonly Vector[]): { points: Float64Array; offsets: number[] } {
  return { points: Float64Array.from(points.flat()), offsets: [0, points.length] };
}

/** The sheet's sides: arcs of circles through the pole. */
function traceBorder(path: Path, disc: Disc, scene: LiftScene, side: "front" | "back"): void {
  const corners = sheetCorners(scene);
  const look = (x: number, y: number): Vector => scene.view.seen(scene.sheet.direction(x, y));
  corners.forEach(([ax, ay], k) => {
    const [bx, by] = corners[(k + 1) % 4];
    const rows = [...look(ax, ay), ...look((ax + bx) / 2, (ay + by) / 2), ...look(bx, by)];
    traceArc(path, disc, rows, 0, 1, 2, side);
  });
}

/** The plane's rectangle. */
function tracePlane(path: Path, stand: Stand, scene: LiftScene): void {
  traceCorners(
    path,
    sheetCorners(scene).map(([x, y]) => onPicture(stand, scene.view, scene.sheet.flat(x, y))),
  );
}

/** The place of the plane, in its units, whose image is a direction in the axes of the view. */
function flatOf({ sheet, view }: LiftScene, seen: Vector): [number, number] {
  const [x, y, z] = view.onBall(seen);
  const stretch = (2 * sheet.radius * sheet.diagonal) / (1 + z);
  return [sheet.rectangle.middle[0] + stretch * x, sheet.rectangle.middle[1] + stretch * y];
}

/** Whether the bent sheet holds a direction in the axes of the view. */
function holds(scene: LiftScene, seen: Vector): boolean {
  const { middle, width, height } = scene.sites.rectangle;
  const [x, y] = flatOf(scene, seen);
  return Math.abs(x - middle[0]) <= width / 2 && Math.abs(y - middle[1]) <= height / 2;
}

/** Sites of the convex hull, counterclockwise. */
function hullOf(sites: LiftSites): number[] {
  const { convexHull } = sites.delaunay;
  const starts = convexHull.filter((_, k) => k % 2 === 0);
  return chained(new Map(Array.from(starts, (a, k) => [a, convexHull[2 * k + 1]])));
}

/** Whether a place lies in a convex polygon of sites. */
function insideHull({ places }: LiftSites, hull: readonly number[], [x, y]: readonly [number, number]): boolean {
  return hull.every((a, k) => {
    const b = hull[(k + 1) % hull.length];
    const [ax, ay, bx, by] = [places[2 * a], places[2 * a + 1], places[2 * b], places[2 * b + 1]];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
  });
}

/** Sides of the cells on the ball: from the centre of a facet's circle to that of the facet across each of its edges. */
function ridgesOf({ sites }: LiftScene, look: (k: number) => Vector): [Vector, Vector][] {
  const centers = new Map<string, Vector>();
  const ridges: [Vector, Vector][] = [];
  for (const facets of [sites.delaunay.simplices, sites.closing]) {
    for (let at = 0; at < facets.length; at += 3) {
      const [a, b, c] = facets.subarray(at, at + 3);
      const center = facetCenter(look(a), look(b), look(c));
      for (const [from, to] of [
        [a, b],
        [b, c],
        [c, a],
      ]) {
        const beyond = centers.get(`${to} ${from}`);
        if (beyond === undefined) centers.set(`${from} ${to}`, center);
        else ridges.push([center, beyond]);
      }
    }
  }
  return ridges;
}

/** The middle of a facet's circle on the ball, on the outer side of its plane. */
function facetCenter(a: Vector, b: Vector, c: Vector): Vector {
  return unit(cross([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]));
}
