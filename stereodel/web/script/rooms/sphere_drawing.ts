/** The two pictures of the Sphere room: the ball, and the plane that its sites are projected to. */

import { circle, traceCircle } from "../drawing/arcs.ts";
import {
  arcLayer,
  dotLayer,
  drawLayers,
  edgeArcs,
  placeOf,
  ridgeArcs,
  traceGreat,
  tracePolygon,
  traceSides,
  type Layer,
} from "../drawing/ball.ts";
import { traceCap } from "../drawing/fill.ts";
import {
  cornersOf,
  drawHandle,
  traceCorners,
  traceDisc,
  traceSegment,
  type Disc,
  type Path,
  type Pen,
} from "../drawing/pen.ts";
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
  /** Of what is drawn. */
  readonly shown: {
    readonly triangles: boolean;
    readonly cells: boolean;
    readonly seeing: boolean;
    readonly closing: boolean;
  };
  readonly bubble: Bubble | null;
  /** Sites that are held besides those of the bubble. */
  readonly held: readonly number[];
  /** The step of the insertion that is looked at; "done" for the picture of all sites. */
  readonly step: Step | "done";
}

const BALL_LABEL: LabelStyle = { ink: "accent-text", halo: "ball", size: 15 };
const PLANE_LABEL: LabelStyle = { ink: "accent-text", halo: "halo", size: 15 };

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

/** Where sites are drawn, those that are seen, and how a line runs from one to another. */
interface Surface {
  place(site: number): [number, number];
  isSeen(site: number): boolean;
  line(path: Path, a: number, b: number): void;
}

/** Draws the ball into a disc. */
export function drawBall(pen: Pen, disc: Disc, scene: SphereScene): void {
  const { sites, view, step } = scene;
  const look = (k: number): Vector => view.seen(sites.site(k));
  pen.ball(disc, "ball");
  if (step === "done") drawWholeBall(pen, disc, scene, look);
  else {
    const surface = {
      place: (k: number) => placeOf(disc, look(k)),
      isSeen: (k: number) => look(k)[2] >= 0,
      line: (path: Path, a: number, b: number) => traceGreat(path, disc, look(a), look(b)),
    };
    drawStep(pen, surface, step, false, (path, { outline, ...facets }) => {
      tracePolygon(path, disc, outline.map(look), holdsDirection(facets, sites, view.onBall([0, 0, -1])));
    });
  }
  pen.draw("limb", (path) => traceDisc(path, disc));
  drawPole(pen, disc, scene);
}

function drawWholeBall(pen: Pen, disc: Disc, scene: SphereScene, look: (k: number) => Vector): void {
  const { sites, layers, view, seeing, shown, bubble } = scene;
  const map = MoebiusMap.rotation(view.rotation);
  const hidden = view.onBall([0, 0, -1]);
  const outline = sites.outline(seeing).map(look);
  if (shown.seeing && outline.length > 0) {
    pen.draw("hatch", (path) => tracePolygon(path, disc, outline, sites.regionHolds(seeing, hidden)));
  }
  if (shown.closing && sites.hasClosing) {
    const rim = sites.closingOutline.map(look);
    pen.draw("closing", (path) => tracePolygon(path, disc, rim, sites.facetAt(hidden) === null));
  }
  if (shown.triangles) drawLayers(pen, disc, map, [layers.edges]);
  if (shown.cells) drawLayers(pen, disc, map, [layers.ridges]);
  if (shown.seeing) pen.draw("hull", (path) => traceSides(path, disc, outline));
  if (bubble !== null) drawBallBubble(pen, disc, bubble, view, look);
  drawLayers(pen, disc, map, [layers.dots]);
  const held = [...(bubble?.sites ?? []), ...scene.held].map(look).filter((point) => point[2] >= 0);
  const places = held.flatMap((point) => placeOf(disc, point));
  pen.dots("held", places);
  if (bubble === null) return;
  const middle = view.seen(bubble.center);
  for (const site of bubble.sites) {
    const point = look(site);
    const out = [point[0] - middle[0], point[1] - middle[1]] as const;
    if (point[2] >= LEAST_HEIGHT) numberAt(pen, placeOf(disc, point), out, site, BALL_LABEL);
  }
}

function drawBallBubble(pen: Pen, disc: Disc, bubble: Bubble, view: View, look: (site: number) => Vector): void {
  const rim = circle(view.seen(bubble.center), bubble.cosine);
  pen.draw("seen", (path) => traceCap(path, disc, rim));
  pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
  pen.draw("triangle", (path) => traceSides(path, disc, bubble.sites.map(look)));
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
  const sites = Array.from({ length: site + 1 }, (_, k) => k).filter((k) => surface.isSeen(k));
  pen.dots("site", sites.flatMap(surface.place));
  if (surface.isSeen(site)) pen.dots("held", surface.place(site));
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

/** Draws the plane into its frame. */
export function drawPlane(pen: Pen, frame: PlaneFrame, scene: SphereScene): void {
  const { sites, twin } = scene;
  const flat = (k: number): [number, number] => frame.place(twin.forward(sites.site(k)));
  pen.clipped(
    (path) => traceFrame(path, frame),
    () => {
      if (scene.step === "done") drawWholePlane(pen, frame, scene, flat);
      else {
        const surface = {
          place: flat,
          isSeen: () => true,
          line: (path: Path, a: number, b: number) => traceSegment(path, flat(a), flat(b)),
        };
        const { site } = scene.step;
        drawStep(pen, surface, scene.step, true, (path, { outline }, isThere) => {
          outline.forEach((a, k) => {
            if (isThere(k)) traceCorners(path, [a, outline[(k + 1) % outline.length], site].map(flat));
          });
        });
      }
    },
  );
  pen.draw("frame", (path) => traceFrame(path, frame));
}

function traceFrame(path: Path, { x, y, size }: PlaneFrame): void {
  traceCorners(path, cornersOf(x, y, x + size, y + size));
}

function drawWholePlane(pen: Pen, frame: PlaneFrame, scene: SphereScene, flat: (k: number) => [number, number]): void {
  const { sites, twin, seeing, shown, bubble, held } = scene;
  const outline = sites.outline(seeing).map(flat);
  if (shown.seeing && outline.length > 0) {
    // The outline runs clockwise on the picture, the frame the same way turned round: between them the path winds once.
    pen.draw("hatch", (path) => {
      traceFrame(path, frame);
      traceCorners(path, counterclockwise(outline));
    });
  }
  if (shown.triangles) {
    pen.draw("delaunay", (path) => {
      eachEdge(sites.delaunay.simplices, seeing, (a, b) => traceSegment(path, flat(a), flat(b)));
    });
  }
  if (shown.cells) pen.draw("voronoi", (path) => planeRidges(path, frame, scene));
  if (shown.seeing) pen.draw("hull", (path) => traceCorners(path, outline));
  if (bubble !== null) drawPlaneBubble(pen, frame, bubble, twin, flat);
  const places = Array.from({ length: sites.count }, (_, k) => flat(k)).flat();
  pen.dots("site", places);
  pen.dots("held", [...(bubble?.sites ?? []), ...held].flatMap(flat));
  if (bubble === null) return;
  const image = twin.circle(bubble.center, bubble.cosine);
  if (image.kind === "line" || image.radius * frame.scale < LEAST_CIRCLE) return;
  for (const site of bubble.sites) {
    const [u, v] = twin.forward(sites.site(site));
    const out: [number, number] = [u - image.middle[0], v - image.middle[1]];
    numberAt(pen, flat(site), image.holdsPole ? [-out[0], -out[1]] : out, site, PLANE_LABEL);
  }
}

/** A ring so that it runs against a clock on a picture whose y points down. */
function counterclockwise(ring: readonly (readonly [number, number])[]): (readonly [number, number])[] {
  let area = 0;
  ring.forEach(([x, y], k) => {
    const [u, v] = ring[(k + 1) % ring.length];
    area += x * v - u * y;
  });
  return area > 0 ? [...ring].reverse() : [...ring];
}

function drawPlaneBubble(
  pen: Pen,
  frame: PlaneFrame,
  bubble: Bubble,
  twin: Twin,
  flat: (k: number) => [number, number],
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
    if (image.holdsPole) traceFrame(path, frame);
    ring(path);
  });
  pen.draw("bubble-open", ring);
  if (!image.holdsPole) pen.draw("triangle", (path) => traceCorners(path, bubble.sites.map(flat)));
}

/** Ridges between the triangles of the plane, and rays where one has no neighbour: the centres are those of its circles. */
function planeRidges(path: Path, frame: PlaneFrame, { sites, twin, seeing }: SphereScene): void {
  const { simplices, neighbors } = sites.delaunay;
  const middles = new Map<number, readonly [number, number]>();
  const middle = (facet: number): readonly [number, number] => {
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

/** A site's number beside its dot, on the side `out`, whose y points up. */
function numberAt(
  pen: Pen,
  [x, y]: [number, number],
  out: readonly [number, number],
  site: number,
  style: LabelStyle,
): void {
  const size = Math.hypot(...out) || 1;
  const [u, v] = [out[0] / size, out[1] / size];
  const align = u > 0.35 ? "left" : u < -0.35 ? "right" : "center";
  pen.label(String(site + 1), x + 0.6 * AWAY * u, y - AWAY * v + 5, { ...style, align });
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
