/** The two pictures of the Sphere room: the ball, and the plane that its sites are projected to. */

import { circle, traceCap, traceCircle } from "../drawing/arcs.ts";
import {
  arcLayer,
  ballSurface,
  dotLayer,
  drawDots,
  drawLayers,
  edgeArcs,
  placeOf,
  planeSurface,
  ridgeArcs,
  type Layer,
  type Surface,
} from "../drawing/ball.ts";
import { cornersOf, drawHandle, traceCorners, traceDisc, traceSegment } from "../drawing/pen.ts";
import type { Disc, Path, Pen, Point } from "../drawing/pen.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { MoebiusMap } from "../kernel/api.ts";
import { lazy } from "../kernel/lazy.ts";
import { cross, dot, type Vector } from "../space.ts";
import type { View } from "../view/view.ts";
import type { Bubble, Insertion, SphereSites } from "./sphere_sites.ts";
import type { PlaneFrame, Twin } from "./twin.ts";

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
  readonly view: View;
  readonly twin: Twin;
  /** One byte a facet: 1 where it sees the pole. */
  readonly seeing: Uint8Array;
  readonly isOn: (name: string) => boolean;
  readonly bubble: Bubble | null;
  /** Sites that are held besides those of the bubble. */
  readonly held: readonly number[];
  /** The step of the insertion that is looked at; "done" for the picture of all sites. */
  readonly step: Step | "done";
}

const BALL_LABEL: LabelStyle = { ink: "accent-text", halo: "ball", size: 15 };

/** Height above the picture, ball radii, below which a site's number would be cut by the limb. */
const LEAST_HEIGHT = 0.2;

/** Radius of a circle of the plane, px, below which the numbers of its sites would lie on each other. */
const LEAST_CIRCLE = 12;

/** Distance of a site's number from its dot, px. */
const AWAY = 12;

/** What is drawn of sites on the ball, whose directions stay in the kernel while the ball turns. */
export type BallLayers = Readonly<Record<"edges" | "ridges" | "dots", Layer>>;

export function ballLayers(sites: SphereSites): BallLayers {
  return lazy({
    edges: () => arcLayer("delaunay", edgeArcs(sites.delaunay)),
    ridges: () => arcLayer("voronoi", ridgeArcs(sites.voronoi)),
    dots: () => dotLayer("site", sites.xyz),
  });
}

/** What the pictures of all sites draw each in its own way. */
interface Own {
  /** The region of the facets that see the pole, with the outline on whose left they are. */
  hatch(path: Path, outline: number[]): void;
  closing?(): void;
  triangles(): void;
  cells(): void;
  bubble(bubble: Bubble): void;
  dots(): void;
  /** The side of its dot on which the number of a bubble's site stands, y up; null where it is left out. */
  side(bubble: Bubble, site: number): Point | null;
}

/** Draws the ball into a disc. */
export function drawBall(pen: Pen, disc: Disc, scene: SphereScene): void {
  const { sites, layers, view, seeing, step } = scene;
  const look = (k: number): Vector => view.seen(sites.site(k));
  const surface = ballSurface(disc, look);
  const map = MoebiusMap.rotation(view.rotation);
  const hidden = view.onBall([0, 0, -1]);
  pen.ball(disc, "ball");
  if (step === "done") {
    drawWhole(pen, surface, scene, BALL_LABEL, {
      hatch: (path, outline) => surface.region(path, outline, sites.regionHolds(seeing, hidden)),
      closing() {
        const isHeld = sites.facetAt(hidden) === null;
        pen.draw("closing", (path) => surface.region(path, sites.closingOutline, isHeld));
      },
      triangles: () => drawLayers(pen, disc, map, [layers.edges]),
      cells: () => drawLayers(pen, disc, map, [layers.ridges]),
      bubble(bubble) {
        const rim = circle(view.seen(bubble.center), bubble.cosine);
        pen.draw("seen", (path) => traceCap(path, disc, rim));
        pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
        pen.draw("triangle", (path) => surface.ring(path, bubble.sites));
      },
      dots: () => drawLayers(pen, disc, map, [layers.dots]),
      side(bubble, site) {
        const [point, middle] = [look(site), view.seen(bubble.center)];
        return point[2] >= LEAST_HEIGHT ? [point[0] - middle[0], point[1] - middle[1]] : null;
      },
    });
  } else {
    drawStep(pen, surface, step, false, (path, { outline, ...facets }) => {
      surface.region(path, outline, holdsDirection(facets, sites, hidden));
    });
  }
  pen.draw("limb", (path) => traceDisc(path, disc));
  drawPole(pen, disc, scene);
}

/** Draws the plane into its frame. */
export function drawPlane(pen: Pen, frame: PlaneFrame, scene: SphereScene): void {
  const { sites, twin, seeing, step } = scene;
  const { x, y, size } = frame;
  const flat = (k: number): Point => frame.place(twin.forward(sites.site(k)));
  const whole = (path: Path): void => traceCorners(path, cornersOf(x, y, x + size, y + size));
  const surface = planeSurface(flat, whole);
  pen.clipped(whole, () => {
    if (step === "done") {
      drawWhole(
        pen,
        surface,
        scene,
        { ...BALL_LABEL, halo: "halo" },
        {
          // The outline runs clockwise on the picture, as the frame does: turned round, the path winds once between them.
          hatch: (path, outline) => surface.region(path, outline.reverse(), true),
          triangles: () =>
            pen.draw("delaunay", (path) => {
              eachEdge(sites.delaunay.simplices, seeing, (a, b) => surface.line(path, a, b));
            }),
          cells: () => pen.draw("voronoi", (path) => planeRidges(path, frame, scene)),
          bubble: (bubble) => drawPlaneBubble(pen, frame, bubble, twin, surface, whole),
          dots: () =>
            drawDots(
              pen,
              surface,
              "site",
              Array.from({ length: sites.count }, (_, k) => k),
            ),
          side(bubble, site) {
            const image = twin.circle(bubble.center, bubble.cosine);
            if (image.kind === "line" || image.radius * frame.scale < LEAST_CIRCLE) return null;
            const [u, v] = twin.forward(sites.site(site));
            const sign = image.holdsPole ? -1 : 1;
            return [sign * (u - image.middle[0]), sign * (v - image.middle[1])];
          },
        },
      );
    } else {
      drawStep(pen, surface, step, true, (path, { outline }, isThere) => {
        outline.forEach((a, k) => {
          if (isThere(k)) surface.ring(path, [a, outline[(k + 1) % outline.length], step.site]);
        });
      });
    }
  });
  pen.draw("frame", whole);
}

/** The picture of all sites. */
function drawWhole(pen: Pen, surface: Surface, scene: SphereScene, label: LabelStyle, own: Own): void {
  const { sites, seeing, isOn, bubble } = scene;
  const outline = sites.outline(seeing);
  if (isOn("seeing") && outline.length > 0) pen.draw("hatch", (path) => own.hatch(path, [...outline]));
  if (isOn("closing") && sites.hasClosing) own.closing?.();
  if (isOn("triangles")) own.triangles();
  if (isOn("cells")) own.cells();
  if (isOn("seeing")) pen.draw("hull", (path) => surface.ring(path, outline));
  if (bubble !== null) own.bubble(bubble);
  own.dots();
  drawDots(pen, surface, "held", [...(bubble?.sites ?? []), ...scene.held]);
  for (const site of bubble?.sites ?? []) {
    const out = own.side(bubble!, site);
    if (out === null) continue;
    const [x, y] = surface.place(site);
    const [u, v] = out.map((part) => part / (Math.hypot(...out) || 1));
    const align = u > 0.35 ? "left" : u < -0.35 ? "right" : "center";
    pen.label(String(site + 1), x + 0.6 * AWAY * u, y - AWAY * v + 5, { ...label, align });
  }
}

/** A step of the insertion. @param region Traces the facets that see the new site, or those of its fan. */
function drawStep(
  pen: Pen,
  surface: Surface,
  { site, insertion, beforeSeeing, fanSeeing }: Step,
  isPlane: boolean,
  region: (path: Path, insertion: Insertion, isThere: (k: number) => boolean) => void,
): void {
  if (insertion !== null) {
    const { outline, before } = insertion;
    // Facets of the fan that see the pole are no triangles of the plane, nor are sides between two of them its sides.
    const isThere = (k: number): boolean => !isPlane || !fanSeeing[(k + outline.length) % outline.length];
    if (outline.length > 0) pen.draw("seen", (path) => region(path, insertion, isThere));
    pen.draw("delaunay", (path) => {
      eachEdge(before, isPlane ? beforeSeeing : null, (a, b) => surface.line(path, a, b));
    });
    pen.draw("fan", (path) => {
      outline.forEach((a, k) => (isThere(k) || isThere(k - 1)) && surface.line(path, site, a));
    });
    pen.draw("horizon", (path) => {
      outline.forEach((a, k) => isThere(k) && surface.line(path, a, outline[(k + 1) % outline.length]));
    });
  }
  drawDots(
    pen,
    surface,
    "site",
    Array.from({ length: site + 1 }, (_, k) => k),
  );
  drawDots(pen, surface, "held", [site]);
}

/** Whether the region of the facets that see a new site holds a direction. */
function holdsDirection(
  { before, seeing }: Pick<Insertion, "before" | "seeing">,
  sites: SphereSites,
  direction: Vector,
): boolean {
  return seeing.some((facet) => {
    const [a, b, c] = [0, 1, 2].map((k) => sites.site(before[3 * facet + k]));
    return [cross(a, b), cross(b, c), cross(c, a)].every((normal) => dot(direction, normal) >= 0);
  });
}

/** The handle of the pole of projection, and its name. */
function drawPole(pen: Pen, disc: Disc, { view, twin }: SphereScene): void {
  const pole = view.seen(twin.pole);
  const [x, y] = placeOf(disc, pole);
  drawHandle(pen, x, y, pole[2] >= 0 ? "front" : "behind");
  const text = pole[2] >= 0 ? "*P*" : "*P*, behind";
  const left = x > disc.x; // towards the middle, where there is room
  pen.label(text, x + (left ? -11 : 11), y + 5, { ...BALL_LABEL, align: left ? "right" : "left" });
}

function drawPlaneBubble(
  pen: Pen,
  frame: PlaneFrame,
  bubble: Bubble,
  twin: Twin,
  surface: Surface,
  whole: (path: Path) => void,
): void {
  const image = twin.circle(bubble.center, bubble.cosine);
  if (image.kind === "line") {
    const [a, b] = image.normal;
    const size = a * a + b * b;
    const [u, v] = [(a * image.offset) / size, (b * image.offset) / size];
    pen.draw("bubble-open", (path) =>
      traceSegment(path, frame.place([u - 1e3 * b, v + 1e3 * a]), frame.place([u + 1e3 * b, v - 1e3 * a])),
    );
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
}

/** Ridges between the triangles of the plane, and rays where one has no neighbour: the centres are those of its circles. */
function planeRidges(path: Path, frame: PlaneFrame, { sites, twin, seeing }: SphereScene): void {
  const { simplices, neighbors } = sites.delaunay;
  const middles = new Map<number, Point>();
  const middle = (facet: number): Point => {
    let found = middles.get(facet);
    if (found === undefined) {
      const { center, cosine } = sites.bubble(facet);
      const image = twin.circle(center, cosine);
      found = image.kind === "circle" ? image.middle : [0, 0];
      middles.set(facet, found);
    }
    return found;
  };
  for (let at = 0; at < neighbors.length; ++at) {
    const facet = Math.floor(at / 3);
    const beyond = neighbors[at];
    if (seeing[facet] || (!seeing[beyond] && beyond < facet)) continue;
    if (!seeing[beyond]) {
      traceSegment(path, frame.place(middle(facet)), frame.place(middle(beyond)));
      continue;
    }
    // The side opposite the corner runs counterclockwise: outward is to its right.
    const [a, b] = [1, 2].map((k) => twin.forward(sites.site(simplices[3 * facet + ((at + k) % 3)])));
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const [u, v] = middle(facet);
    const far = (4 * frame.reach + Math.hypot(u, v)) / length;
    traceSegment(path, frame.place([u, v]), frame.place([u + far * (b[1] - a[1]), v - far * (b[0] - a[0])]));
  }
}

/** Every edge of facets once; with `seeing` those of the plane, of whose facets one at least does not see the pole. */
function eachEdge(facets: Int32Array, seeing: Uint8Array | null, visit: (a: number, b: number) => void): void {
  const drawn = new Set<number>();
  for (let k = 0; k < facets.length; ++k) {
    const [a, b] = [facets[k], facets[k % 3 === 2 ? k - 2 : k + 1]];
    const name = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    if (seeing === null ? a > b : seeing[Math.floor(k / 3)] || drawn.has(name)) continue;
    drawn.add(name);
    visit(a, b);
  }
}
