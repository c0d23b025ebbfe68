/** A globe in a place of its own, such as the output of a cell: its drawing, and what hands and keys do to it. */

import type { Rings } from "./contents.ts";
import { make } from "./dom.ts";
import {
  arcLayer,
  dotLayer,
  drawLayers,
  graticuleArcs,
  landLayer,
  placeOf,
  ridgeArcs,
  type Layer,
} from "./drawing/ball.ts";
import { traceDisc, type Disc, type Pen } from "./drawing/pen.ts";
import { Plate } from "./drawing/plate.ts";
import { lonlatToXyz, MoebiusMap, SphericalVoronoi } from "./kernel/api.ts";
import { lonLatOf, row, type Vector } from "./space.ts";
import { arrowStep, grabBall, type Turnable } from "./view/ball_hand.ts";
import { distance, follow, isCommand, type Gestures, type Place } from "./view/hand.ts";
import { seenThrough, sourceOf } from "./view/lens.ts";
import { Motion } from "./view/motion.ts";
import { pointUnder, View } from "./view/view.ts";
import { latitude, longitude } from "./words.ts";

/** What is shown. */
export interface Shown {
  /** Longitude and latitude in turn, degrees: doubles at any place of a buffer. */
  sites: DataView;
  /** A fisheye, by the arguments of `stereodel.fisheye`. */
  lens: { readonly focus: readonly [number, number]; readonly magnification: number };
  /** By the arguments of `stereodel.drawing.View`. */
  view: { readonly lon: number; readonly lat: number; readonly roll: number };
  /** Numbers of sites. */
  selection: readonly number[];
}

/** Hears what a hand has changed. */
type Changed = <K extends keyof Shown>(name: K, value: Shown[K]) => void;

/** By which + and − magnify. */
const STEP = 1.25;

/** The strongest lens by hand. */
const STRONGEST = 1e6;

/** Sites beyond which cells are left out while the globe moves. */
const MANY_SITES = 10_000;

export class NotebookGlobe implements Turnable {
  readonly isNorthUp = false; // but by keys
  readonly #root = make("div", "stereodel-globe");
  readonly #canvas = make("canvas", {
    tabIndex: 0,
    role: "application",
    ariaRoleDescription: "globe to turn",
    ariaDescription:
      "arrows turn, + and − magnify, F sets the focus, comma and full stop walk the sites, Enter selects",
  });
  readonly #status = make("p", { role: "status" });
  readonly #plate: Plate;
  readonly #changed: Changed;
  readonly #ground: readonly (Layer | null)[];
  readonly #themes: MutationObserver; // notebooks change colours by attributes of the body
  readonly #motion = new Motion();
  readonly #release: () => void;
  #cells: Layer | null = null;
  #dots: Layer | null = null;
  #sites: Float64Array = new Float64Array(0);
  #lens = MoebiusMap.identity();
  #focus: readonly [number, number] = [0, 0];
  #view = View.above(0, 0);
  #selection: readonly number[] = [];
  #walked = -1;

  constructor(place: HTMLElement, land: Rings | null, changed: Changed) {
    this.#changed = changed;
    this.#ground = [land && landLayer(land), arcLayer("graticule", graticuleArcs(10))];
    this.#root.append(this.#canvas, this.#status);
    place.append(this.#root);
    this.#plate = new Plate(this.#canvas, (pen, isMoving) => this.#paint(pen, isMoving), undefined, this.#root);
    this.#themes = new MutationObserver(() => this.#plate.redraw("colours"));
    this.#themes.observe(document.body, { attributes: true });
    this.#release = follow(this.#plate, this.#gestures());
    this.#canvas.addEventListener("pointerdown", (event) => {
      event.preventDefault(); // the notebook would take the focus
      this.#canvas.focus({ preventScroll: true });
    });
  }

  /** Shows what Python has set. */
  show({ sites, lens, view, selection }: Partial<Shown>): void {
    if (sites !== undefined) {
      const bytes = sites.buffer.slice(sites.byteOffset, sites.byteOffset + sites.byteLength);
      this.#sites = lonlatToXyz(new Float64Array(bytes));
      this.#cells = arcLayer("cell", ridgeArcs(new SphericalVoronoi(this.#sites)));
      this.#dots = dotLayer("site", this.#sites);
      this.#walked = -1;
    }
    if (lens !== undefined) {
      this.#focus = lens.focus;
      this.#lens = MoebiusMap.fisheye([...lens.focus], lens.magnification);
    }
    if (view !== undefined) this.#view = View.above(view.lon, view.lat, view.roll);
    this.#selection = selection ?? this.#selection;
    this.#update();
  }

  dispose(): void {
    this.#motion.stop();
    this.#release();
    this.#themes.disconnect();
    this.#plate.dispose();
    this.#root.remove();
  }

  get disc(): Disc {
    return this.#plate.disc;
  }

  get view(): View {
    return this.#view;
  }

  /** From the Earth to the axes of the view. */
  get #map(): MoebiusMap {
    return seenThrough(this.#lens, this.#view);
  }

  #update(): void {
    const { magnification } = this.#lens;
    const [lon, lat] = this.#view.middle;
    const lens = `${magnification.toPrecision(3)} times at ${latitude(this.#focus[1])}, ${longitude(this.#focus[0])}`;
    const count = this.#sites.length / 3;
    const text =
      `Seen from ${latitude(lat)}, ${longitude(lon)}` +
      (magnification === 1 ? "" : `; ${lens}`) +
      (count === 0 ? "" : `; ${count} ${count === 1 ? "site" : "sites"}`) +
      (this.#selection.length === 0 ? "" : `, selected: ${this.#selection.slice(0, 5).join(", ")}`);
    this.#canvas.ariaLabel = this.#status.textContent = text;
    this.#plate.redraw("state");
  }

  #paint(pen: Pen, isMoving: boolean): void {
    const { disc } = this;
    const map = this.#map;
    const withCells = !isMoving || this.#sites.length <= 3 * MANY_SITES;
    const chosen = this.#selection.flatMap((number) => row(this.#sites, number));
    const layers = [withCells ? this.#cells : null, this.#dots, dotLayer("held", Float64Array.from(chosen))];
    pen.ball(disc, "ocean");
    drawLayers(pen, disc, map, this.#ground);
    pen.shade(disc);
    drawLayers(pen, disc, map, layers);
    pen.draw("limb", (path) => traceDisc(path, disc));
    this.#root.dataset["frames"] = String(this.#plate.frames + 1);
  }

  // Hands

  #gestures(): Gestures {
    const plate = this.#plate;
    return {
      take: (at) => grabBall(this, this.#motion, at),
      click: (at, reach) => this.#selectNear(at, reach),
      doubleClick: (at, reach) => {
        this.#selectNear(at, reach); // back to what it was before the first of the two
        this.#focusAt(pointUnder(plate.disc, at));
      },
      pinch: (_, spread) => {
        const { magnification } = this.#lens;
        return { move: (_, now) => this.#magnify(((now / spread) * magnification) / this.#lens.magnification) };
      },
      wheel: (_, factor) => this.#magnify(factor),
      key: (event) => this.#key(event),
    };
  }

  #key(event: KeyboardEvent): boolean {
    if (isCommand(event)) return false;
    const step = arrowStep(event);
    const acts: Record<string, () => void> = {
      "+": () => this.#magnify(STEP),
      "-": () => this.#magnify(1 / STEP),
      "0": () => this.#magnify(1 / this.#lens.magnification),
      f: () => this.#focusAt([0, 0, 1]),
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
      Enter: () => this.#toggle(this.#walked),
      Escape: () => this.#set("selection", []),
    };
    const act = step === null ? acts[event.key] : () => this.turn(this.#view.stepped(...step, true));
    if (act === undefined) return false;
    event.stopPropagation(); // the notebook has keys of its own
    this.#motion.stop();
    act();
    return true;
  }

  turn(view: View): void {
    this.#view = view;
    const [lon, lat, roll] = [...view.middle, view.roll].map(rounded);
    this.#update();
    this.#plate.redraw("hand");
    this.#changed("view", { lon, lat, roll });
  }

  #magnify(factor: number): void {
    const magnification = Math.min(STRONGEST, Math.max(1 / STRONGEST, this.#lens.magnification * factor));
    this.#set("lens", { focus: this.#focus, magnification });
    this.#plate.redraw("hand");
  }

  /** Moves the focus to what is seen at a point of the view. */
  #focusAt(point: Vector): void {
    const [lon, lat] = lonLatOf(sourceOf(this.#map, point)).map(rounded);
    this.#set("lens", { focus: [lon, lat], magnification: this.#lens.magnification });
  }

  /** Shows what a hand has changed, and tells it. */
  #set<K extends keyof Shown>(name: K, value: Shown[K]): void {
    this.show({ [name]: value });
    this.#changed(name, value);
  }

  // Sites

  /** Selects the nearest of the sites in sight, or no longer. */
  #selectNear(at: Place, reach: number): void {
    const { disc } = this.#plate;
    const images = this.#map.apply(this.#sites);
    let [nearest, least] = [-1, reach];
    for (let k = 0; 3 * k < images.length; ++k) {
      const image = row(images, k);
      const apart = distance(placeOf(disc, image), at);
      if (image[2] >= 0 && apart < least) [nearest, least] = [k, apart];
    }
    this.#toggle(nearest);
  }

  #toggle(number: number): void {
    if (number < 0) return;
    const others = this.#selection.filter((each) => each !== number);
    this.#set("selection", others.length < this.#selection.length ? others : [...others, number]);
  }

  /** To the next site in either direction, which comes to the middle of the view. */
  #walk(step: number): void {
    const count = this.#sites.length / 3;
    if (count === 0) return;
    this.#walked = (Math.max(this.#walked, step < 0 ? 0 : -1) + step + count) % count;
    const [lon, lat] = lonLatOf(row(this.#lens.apply(row(this.#sites, this.#walked)), 0));
    this.turn(View.above(lon, lat));
  }
}

/** Degrees without the last digits of arithmetic: to 0.1 mm on the Earth. */
function rounded(degrees: number): number {
  return Math.round(degrees * 1e9) / 1e9 + 0;
}
