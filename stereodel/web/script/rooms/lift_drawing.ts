/** The picture of the Lift room: a sheet that bends onto a ball, under the plane that it was. */

import { holdsHidden, traceOutlines, traceRegions, type Rings, type Side } from "../drawing/arcs.ts";
import { arcsBetween, ballSurface, drawArcs, drawDots, planeSurface, sidesOf } from "../drawing/ball.ts";
import type { Surface } from "../drawing/ball.ts";
import { drawParts, type IsOn, type Part } from "../drawing/parts.ts";
import { cornersOf, traceCorners, traceDisc, traceSegment } from "../drawing/pen.ts";
import type { Disc, Path, Pen, Point } from "../drawing/pen.ts";
import { FAINT, type LabelStyle } from "../drawing/styles.ts";
import { SphericalVoronoi } from "../kernel/api.ts";
import { following } from "../kernel/topology.ts";
import { DEGREE, type Vector } from "../space.ts";
import type { View } from "../view/view.ts";
import type { LiftSites, Sheet } from "./lift_sites.ts";

/** What the picture shows. */
export interface LiftScene {
  readonly sites: LiftSites;
  readonly sheet: Sheet;
  readonly view: View;
  readonly isOn: IsOn;
  readonly isMoving: boolean;
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

const LETTER: LabelStyle = { ink: "accent-text", halo: "halo", size: 17, italic: true, align: "center" };
const WORD: LabelStyle = { ink: "ink-2", halo: "ball", size: 14 };

/** A scene in a drawing of some pixels; what has its place there does not move while the ball is turned sideways. */
export class LiftPicture {
  readonly #scene: LiftScene;
  readonly width: number;
  readonly height: number;
  /** Pixels of a diagonal, and the point of contact. */
  readonly scale: number;
  readonly contact: Point;
  /** The ball; of no use where the sheet is flat. */
  readonly #disc: Disc;
  /** Corners of the sheet, counterclockwise. */
  readonly #corners: readonly Point[];
  /** Where the sites are, and where they were in the plane. */
  readonly surface: Surface;
  readonly #before: Surface;

  constructor(scene: LiftScene, width: number, height: number) {
    const { sheet, sites, view } = scene;
    [this.#scene, this.width, this.height] = [scene, width, height];
    const unit = Math.min(width / BOX.width, height / BOX.height);
    const steep = Math.sin(Math.max(HIGH, view.middle[1]) * DEGREE) / Math.sin(HIGH * DEGREE);
    this.scale = (DIAGONAL * unit) / steep;
    this.contact = [width / 2, (height - BOX.height * unit) / 2 + BOX.contact * unit];
    const [x, y] = this.place([0, 0, -sheet.radius]);
    this.#disc = { x, y, r: this.scale * sheet.radius };
    const { middle, width: w, height: h } = sites.rectangle;
    this.#corners = cornersOf(middle[0] - w / 2, middle[1] - h / 2, middle[0] + w / 2, middle[1] + h / 2);
    const looks: Vector[] = [];
    this.#before = planeSurface((site) => this.above(site), this.#plane);
    this.surface = sheet.isFlat
      ? this.#before
      : ballSurface(this.#disc, (k) => (looks[k] ??= view.seen(sheet.direction(...sites.place(k)))));
  }

  /** Where a point of space, in diagonals, is on the drawing. */
  place(point: Vector): Point {
    const seen = this.#scene.view.seen(point);
    return [this.contact[0] + this.scale * seen[0], this.contact[1] - this.scale * seen[1]];
  }

  /** Where a site is in the plane. */
  above(site: number): Point {
    return this.#flat(this.#scene.sites.place(site));
  }

  readonly #flat = (at: Point): Point => this.place(this.#scene.sheet.flat(...at));

  /** The plane's rectangle. */
  readonly #plane = (path: Path): void => traceCorners(path, this.#corners.map(this.#flat));

  draw(pen: Pen): void {
    drawParts(pen, this, LiftPicture.parts(this.#scene), this.#scene.isOn);
  }

  /** What there is behind the sheet, by the names in the library's pictures. */
  get grounds(): string[] {
    const { corner } = this.#scene.sheet;
    return ["hull", ...(corner >= BALL_FROM ? ["ball"] : []), ...(corner >= OUTLINE_FROM ? ["limb"] : [])];
  }

  static parts({ sites, sheet, isOn, isMoving, p, q, lit }: LiftScene): Part<LiftPicture>[] {
    const { isFlat, corner } = sheet;
    const isBent = !isFlat;
    const sides: Side[] = isFlat ? ["front"] : ["front", "back"];
    const letters = [p, q].map((site, k): Part<LiftPicture>[] => [
      { layer: "rays", isThere: isBent && site !== null, draw: (pen, on) => on.#drawRay(pen, site!) },
      { isThere: site !== null, draw: (pen, on) => on.#drawLetter(pen, site!, "PQ"[k]) },
    ]);
    return [
      { isThere: isBent && corner >= BALL_FROM, draw: (pen, on) => pen.ball(on.#disc, "ball") },
      {
        isThere: isBent && corner >= OUTLINE_FROM,
        draw: (pen, on) => pen.draw("limb-soft", (path) => traceDisc(path, on.#disc)),
      },
      { isThere: isFlat, draw: (pen, on) => pen.draw("sheet", on.#region) },
      { layer: "seeing", draw: (pen, on) => on.#drawSeeing(pen) },
      { isThere: isBent, draw: (pen, on) => on.#drawBehind(pen, isOn("triangles") && !isMoving) },
      { layer: "triangles", draw: (pen, on) => on.surface.lines(pen, "delaunay", sites.delaunay.edges) },
      {
        layer: "cells",
        isThere: sites.delaunay.dimension === 2,
        draw: (pen, on) => pen.within({ region: on.#region }, () => on.#drawRidges(pen)),
      },
      {
        draw: (pen, on) =>
          pen.draw("side", isFlat ? on.#region : (path) => traceOutlines(path, on.#disc, on.#border("front"))),
      },
      { draw: (pen, on) => drawDots(pen, on.surface, "site", Array(sites.count).keys()) },
      { isThere: isBent, draw: (pen, on) => on.#drawPlane(pen) },
      {
        isThere: p !== null && q !== null && p !== q,
        draw: (pen, on) => sides.forEach((side) => on.surface.lines(pen, "span", [p!, q!], side)),
      },
      ...letters.flat(),
      { isThere: isBent, draw: (pen, on) => on.#drawPole(pen) },
      { isThere: lit !== null && lit < sites.count, draw: (pen, on) => pen.dots("held", on.surface.place(lit!)) },
    ];
  }

  /** The sheet on the ball, or the plane's rectangle. */
  readonly #region = (path: Path): void => {
    if (this.#scene.sheet.isFlat) this.#plane(path);
    else this.#traceSheet(path, "front");
  };

  /** The bent sheet, which does not hold the pole. */
  #traceSheet(path: Path, side: Side): void {
    const [rings, [x, y, z]] = [this.#border(side), this.#away];
    traceRegions(path, this.#disc, rings, holdsHidden(rings, [x, y, side === "front" ? z : -z], false));
  }

  /** The bent sheet and what is faint of it, with the far side of its triangles. */
  #drawBehind(pen: Pen, hasTriangles: boolean): void {
    pen.within(FAINT, () => pen.draw("sheet", (path) => this.#traceSheet(path, "back")));
    pen.draw("sheet", this.#region);
    pen.within(FAINT, () => {
      pen.draw("side", (path) => traceOutlines(path, this.#disc, this.#border("back")));
      if (hasTriangles) this.surface.lines(pen, "delaunay", this.#scene.sites.delaunay.edges, "back");
    });
  }

  /** The facets that see the pole: hatched, with their edges. */
  #drawSeeing(pen: Pen): void {
    const { sites, sheet } = this.#scene;
    const { hull, closing } = sites;
    if (!sheet.isFlat && hull.length < 3) return;
    const ring = (): Rings => ringOf(hull.map((site) => this.#look(...sites.place(site))));
    const holds = sheet.isFlat || !holdsHidden(ring(), this.#away, false);
    pen.draw("hatch", (path) => this.surface.region(path, [...hull].reverse(), holds));
    const edge = (a: number, k: number): number[] => {
      const b = closing[following(k)];
      return a < b || hull.includes(a) ? [a, b] : [];
    };
    this.surface.lines(pen, "hull", sheet.isFlat ? sidesOf(hull) : [...closing].flatMap(edge));
  }

  /** The plane over the bent sheet, and the point of contact. */
  #drawPlane(pen: Pen): void {
    const [x, y] = this.contact;
    pen.draw("sheet-plane", this.#plane);
    // The triangles as they were: "behind" is as weak as what lies beyond the ball.
    const { sites, isOn, isMoving } = this.#scene;
    const edges = isOn("triangles") && !isMoving ? sites.delaunay.edges : [];
    pen.within(FAINT, () => this.#before.lines(pen, "delaunay", edges));
    pen.draw("touch", (path) => {
      traceSegment(path, [x - 4.5, y], [x + 4.5, y]);
      traceSegment(path, [x, y - 3.5], [x, y + 3.5]);
    });
  }

  /** From the pole, or where that is out of sight from a site's image, to its place in the plane. */
  #drawRay(pen: Pen, site: number): void {
    const from = this.seenPole ?? this.surface.place(site);
    pen.draw("ray", (path) => traceSegment(path, from, this.above(site)));
  }

  /** P or Q, and its place in the plane. */
  #drawLetter(pen: Pen, site: number, letter: string): void {
    const above = this.above(site);
    if (!this.#scene.sheet.isFlat) pen.dots("shadow", above);
    pen.dots("held", this.surface.place(site));
    pen.label(letter, above[0], above[1] - 9, LETTER);
  }

  #drawPole(pen: Pen): void {
    const pole = this.seenPole;
    if (pole === null) return;
    pen.dots("pole", pole);
    pen.label("pole", pole[0] + 7, pole[1] + 6, WORD);
  }

  get seenPole(): Point | null {
    const pole = this.place(this.#scene.sheet.pole);
    return pole[1] < this.height - 20 ? pole : null;
  }

  /** A place of the bent sheet, axes of the view. */
  #look(x: number, y: number): Vector {
    return this.#scene.view.seen(this.#scene.sheet.direction(x, y));
  }

  /** The sides of the bent sheet; from the back those of the mirror image that is seen there, which run the other way. */
  #border(side: Side): Rings {
    const parts = Array.from({ length: PER_SIDE }, (_, j) => j / PER_SIDE);
    const points = this.#corners.flatMap(([ax, ay], k) => {
      const [bx, by] = this.#corners[(k + 1) % 4];
      return parts.map((t) => this.#look(ax + t * (bx - ax), ay + t * (by - ay)));
    });
    return ringOf(side === "front" ? points : points.reverse().map(([x, y, z]) => [x, y, -z]));
  }

  /** The direction of the pole, axes of the view. */
  get #away(): Vector {
    return this.#scene.view.seen([0, 0, -1]);
  }

  /** Sides of the cells, which on the ball are not the images of those in the plane. */
  #drawRidges(pen: Pen): void {
    const { sites, sheet } = this.#scene;
    if (sheet.isFlat) {
      const places = sites.ridges().flatMap((y, k, ends) => (k % 2 === 0 ? [] : this.#flat([ends[k - 1], y])));
      return pen.lines("voronoi", places);
    }
    const looks = Array.from({ length: sites.count }, (_, site) => this.#look(...sites.place(site)));
    const { vertices, ridgeVertices } = new SphericalVoronoi(looks.flat());
    drawArcs(pen, this.#disc, "voronoi", arcsBetween(vertices, ridgeVertices));
  }
}

function ringOf(points: readonly Vector[]): Rings {
  return { points: Float64Array.from(points.flat()), offsets: [0, points.length] };
}
