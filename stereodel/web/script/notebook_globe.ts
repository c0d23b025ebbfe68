/** A globe in a place of its own, such as the output of a cell: its drawing, and what hands and keys do to it. */

import type { Rings } from "./contents.ts";
import { make } from "./dom.ts";
import { arcLayer, dotLayer, drawLayers, graticuleArcs, regionLayer, ridgeArcs } from "./drawing/ball.ts";
import type { Layer } from "./drawing/ball.ts";
import { traceDisc } from "./drawing/pen.ts";
import type { Pen } from "./drawing/pen.ts";
import { Plate } from "./drawing/plate.ts";
import { lonlatToXyz, MoebiusMap, SphericalDelaunay, SphericalVoronoi } from "./kernel/api.ts";
import { directionOf, lonLatOf, row } from "./rooms/space.ts";
import type { Vector } from "./rooms/space.ts";
import { pointUnder, View } from "./view/view.ts";

/** The lens: a fisheye, by the arguments of `stereodel.fisheye`. */
export interface Lens {
  readonly focus: readonly [number, number];
  readonly magnification: number;
}

/** The view, by the arguments of `stereodel.drawing.View`. */
export interface ViewAngles {
  readonly lon: number;
  readonly lat: number;
  readonly roll: number;
}

/** Hears what a hand has changed: the lens, the view or the selection. */
export type Changed = (name: "lens" | "view" | "selection", value: Lens | ViewAngles | number[]) => void;

/** By which + and − magnify. */
const STEP = 1.25;

/** The strongest lens by hand. */
const STRONGEST = 1e6;

/** Degrees by which arrows turn the globe, alone and with Shift. */
const COARSE = 5;
const FINE = 1;

/** How near to a site a click must be, pixels of the screen. */
const NEAR = 12;

/** Pixels by which a pointer may move in a click. */
const STILL = 4;

/** Sites beyond which cells are left out while the globe moves. */
const MANY_SITES = 10_000;

/** A place of which it is known that it is no land: in the South Pacific, farther from any than all others. */
const AT_SEA: Vector = directionOf(-123.4, -48.9);

const KEYS = "arrows turn, + and − magnify, F sets the focus, comma and full stop walk the sites, Enter selects";

export class NotebookGlobe {
  readonly #root = make("div", "stereodel-globe");
  readonly #canvas = make("canvas");
  readonly #status = make("p");
  readonly #plate: Plate;
  readonly #changed: Changed;
  readonly #ground: readonly Layer[];
  readonly #themes: MutationObserver; // notebooks change colours by attributes of the body
  readonly #ends = new AbortController();
  readonly #fingers = new Map<number, [number, number]>();
  #cells: Layer | null = null;
  #dots: Layer | null = null;
  #sites: Float64Array = new Float64Array(0);
  #lens = MoebiusMap.identity();
  #focus: readonly [number, number] = [0, 0];
  #view = View.above(0, 0);
  #selection: readonly number[] = [];
  #walked = -1;
  #held: Vector | null = null;
  #moved = 0;

  constructor(place: HTMLElement, land: Rings | null, changed: Changed) {
    this.#changed = changed;
    this.#ground = [
      ...(land === null ? [] : [regionLayer("land", "coast", lonlatToXyz(land.lonlat), land.offsets, AT_SEA, false)]),
      arcLayer("graticule", graticuleArcs(10)),
    ];
    this.#canvas.tabIndex = 0;
    this.#canvas.setAttribute("role", "application");
    this.#canvas.setAttribute("aria-roledescription", "globe to turn");
    this.#canvas.setAttribute("aria-description", KEYS);
    this.#status.setAttribute("role", "status");
    this.#root.append(this.#canvas, this.#status);
    place.append(this.#root);
    this.#plate = new Plate(this.#canvas, (pen, isMoving) => this.#paint(pen, isMoving), undefined, this.#root);
    this.#themes = new MutationObserver(() => this.#plate.redraw("colours"));
    this.#themes.observe(document.body, { attributes: true });
    this.#listen();
  }

  /** Sites by longitude and latitude in turn, degrees. */
  showSites(lonlat: Float64Array): void {
    this.#sites = lonlatToXyz(lonlat);
    const delaunay = new SphericalDelaunay(this.#sites);
    this.#cells = arcLayer(
      "voronoi",
      lonlat.length > 2 ? ridgeArcs(new SphericalVoronoi(delaunay)) : new Float64Array(0),
    );
    this.#dots = dotLayer("site", this.#sites);
    this.#walked = -1;
    this.#show();
  }

  showLens({ focus, magnification }: Lens): void {
    this.#focus = focus;
    this.#lens = MoebiusMap.fisheye([...focus], magnification);
    this.#show();
  }

  showView({ lon, lat, roll }: ViewAngles): void {
    this.#view = View.above(lon, lat, roll);
    this.#show();
  }

  showSelection(numbers: readonly number[]): void {
    this.#selection = numbers;
    this.#show();
  }

  dispose(): void {
    this.#ends.abort();
    this.#themes.disconnect();
    this.#plate.dispose();
    this.#root.remove();
  }

  /** From the Earth to the axes of the view. */
  get #map(): MoebiusMap {
    const { left, magnification, right } = this.#lens;
    return new MoebiusMap(this.#view.rotation.after(left), magnification, right);
  }

  #show(): void {
    const magnification = this.#lens.magnification;
    const [lon, lat] = this.#view.middle;
    const text =
      `Seen from ${places(lat, "N", "S")}, ${places(lon, "E", "W")}` +
      (magnification === 1 ? "" : `; ${magnification.toPrecision(3)} times at ${places(this.#focus[1], "N", "S")}, `) +
      (magnification === 1 ? "" : places(this.#focus[0], "E", "W")) +
      (this.#sites.length === 0 ? "" : `; ${this.#sites.length / 3} ${this.#sites.length === 3 ? "site" : "sites"}`) +
      (this.#selection.length === 0 ? "" : `, selected: ${this.#selection.slice(0, 5).join(", ")}`);
    this.#canvas.setAttribute("aria-label", text);
    this.#status.textContent = text;
    this.#plate.redraw("state");
  }

  #paint(pen: Pen, isMoving: boolean): void {
    const { disc } = this.#plate;
    const map = this.#map;
    const many = this.#sites.length > 3 * MANY_SITES;
    pen.ball(disc, "ocean");
    drawLayers(pen, disc, map, this.#ground);
    pen.shade(disc);
    drawLayers(
      pen,
      disc,
      map,
      [this.#cells, this.#dots].filter((layer) => layer !== null).slice(many && isMoving ? 1 : 0),
    );
    const chosen = this.#selection.flatMap((number) => [...row(this.#sites, number)]);
    if (chosen.length > 0) drawLayers(pen, disc, map, [dotLayer("held", Float64Array.from(chosen))]);
    pen.draw("limb", (path) => traceDisc(path, disc));
    this.#root.dataset["frames"] = String(this.#plate.frames + 1);
  }

  // Hands

  #listen(): void {
    const canvas = this.#canvas;
    const { signal } = this.#ends;
    canvas.addEventListener("pointerdown", (event) => this.#press(event), { signal });
    canvas.addEventListener("pointermove", (event) => this.#drag(event), { signal });
    canvas.addEventListener("pointerup", (event) => this.#release(event), { signal });
    canvas.addEventListener("pointercancel", (event) => this.#fingers.delete(event.pointerId), { signal });
    canvas.addEventListener("dblclick", (event) => this.#focusAt(this.#under(event)), { signal });
    canvas.addEventListener("keydown", (event) => this.#key(event), { signal });
    canvas.addEventListener(
      "wheel",
      (event) => {
        if (document.activeElement !== canvas) return; // the notebook scrolls
        event.preventDefault();
        this.#magnify(Math.exp(-event.deltaY / 500));
      },
      { passive: false, signal },
    );
  }

  #under(event: MouseEvent): Vector {
    return pointUnder(this.#plate.disc, this.#plate.placeOf(event));
  }

  #press(event: PointerEvent): void {
    this.#canvas.setPointerCapture(event.pointerId);
    this.#canvas.focus({ preventScroll: true });
    this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.#held = this.#under(event);
    this.#moved = 0;
    event.preventDefault();
  }

  #drag(event: PointerEvent): void {
    const before = this.#fingers.get(event.pointerId);
    if (before === undefined || this.#held === null) return;
    const spread = this.#spread;
    this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.#moved += Math.hypot(event.clientX - before[0], event.clientY - before[1]);
    if (this.#fingers.size === 2) {
      if (spread > 0) this.#magnify(this.#spread / spread);
      return;
    }
    if (this.#moved < STILL) return;
    const to = this.#under(event);
    this.#turn(this.#view.dragged(this.#held, to));
    this.#held = to;
  }

  /** The distance of two fingers, pixels; 0 where there are not two. */
  get #spread(): number {
    const [a, b] = [...this.#fingers.values()];
    return this.#fingers.size === 2 ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  }

  #release(event: PointerEvent): void {
    const isClick = this.#fingers.size === 1 && this.#moved < STILL;
    this.#fingers.delete(event.pointerId);
    this.#held = null;
    if (isClick) this.#selectNear(this.#plate.placeOf(event));
  }

  #key(event: KeyboardEvent): void {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const step = event.shiftKey ? FINE : COARSE;
    const acts: Record<string, () => void> = {
      ArrowLeft: () => this.#turn(this.#view.stepped(-step, 0, true)),
      ArrowRight: () => this.#turn(this.#view.stepped(step, 0, true)),
      ArrowUp: () => this.#turn(this.#view.stepped(0, step, true)),
      ArrowDown: () => this.#turn(this.#view.stepped(0, -step, true)),
      "+": () => this.#magnify(STEP),
      "-": () => this.#magnify(1 / STEP),
      "0": () => this.#magnify(1 / this.#lens.magnification),
      f: () => this.#focusAt([0, 0, 1]),
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
      Enter: () => this.#toggle(this.#walked),
      Escape: () => this.#select([]),
    };
    const act = acts[event.key];
    if (act === undefined) return;
    event.preventDefault();
    event.stopPropagation(); // the notebook has keys of its own
    act();
  }

  #turn(view: View): void {
    this.#view = view;
    const [lon, lat, roll] = [...view.middle, view.roll].map(rounded);
    this.#show();
    this.#plate.redraw("hand");
    this.#changed("view", { lon, lat, roll });
  }

  #magnify(factor: number): void {
    const magnification = Math.min(STRONGEST, Math.max(1 / STRONGEST, this.#lens.magnification * factor));
    this.showLens({ focus: this.#focus, magnification });
    this.#plate.redraw("hand");
    this.#changed("lens", { focus: this.#focus, magnification });
  }

  /** Moves the focus to what is seen at a point of the view. */
  #focusAt(point: Vector): void {
    const [lon, lat] = lonLatOf(row(this.#map.inverse().apply(point), 0)).map(rounded);
    const focus = [lon, lat] as const;
    this.showLens({ focus, magnification: this.#lens.magnification });
    this.#changed("lens", { focus, magnification: this.#lens.magnification });
  }

  // Sites

  #selectNear(place: readonly [number, number]): void {
    const { x, y, r } = this.#plate.disc;
    const images = this.#map.apply(this.#sites);
    let [nearest, distance] = [-1, NEAR];
    for (let k = 0; 3 * k < images.length; ++k) {
      if (images[3 * k + 2] < 0) continue;
      const apart = Math.hypot(x + r * images[3 * k] - place[0], y - r * images[3 * k + 1] - place[1]);
      if (apart < distance) [nearest, distance] = [k, apart];
    }
    if (nearest >= 0) this.#toggle(nearest);
  }

  #toggle(number: number): void {
    if (number < 0) return;
    const others = this.#selection.filter((each) => each !== number);
    this.#select(others.length < this.#selection.length ? others : [...others, number]);
  }

  #select(numbers: number[]): void {
    this.showSelection(numbers);
    this.#changed("selection", numbers);
  }

  /** To the next site in either direction, which comes to the middle of the view. */
  #walk(step: number): void {
    const count = this.#sites.length / 3;
    if (count === 0) return;
    this.#walked = (this.#walked + step + count + (this.#walked < 0 && step < 0 ? 1 : 0)) % count;
    const [lon, lat] = lonLatOf(row(this.#lens.apply(row(this.#sites, this.#walked)), 0));
    this.#turn(View.above(lon, lat));
  }
}

/** Degrees without the last digits of arithmetic: to 0.1 mm on the Earth. */
function rounded(degrees: number): number {
  return Math.round(degrees * 1e9) / 1e9 + 0;
}

/** A coordinate in words. */
function places(degrees: number, positive: string, negative: string): string {
  return `${Math.abs(degrees).toFixed(1)}° ${degrees < 0 ? negative : positive}`;
}
