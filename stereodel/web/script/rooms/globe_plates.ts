/** Drawings of the Globe room: the Earth through a fisheye, two globes with bubbles, and the fisheye from five sides. */

import { arcThrough, circle, pointAt, traceCap, traceCircle, type Circle } from "../drawing/arcs.ts";
import { arcLayer, capLayer, circlePoints, drawLayers, graticuleArcs, placeOf } from "../drawing/ball.ts";
import { widthOf, type Box } from "../drawing/names.ts";
import { drawParts, type IsOn } from "../drawing/parts.ts";
import { drawHandle, traceDisc, type Disc, type Pen } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import { MoebiusMap, Rotation } from "../kernel/api.ts";
import type { RoomHost } from "../room.ts";
import { angle, row, type Vector } from "../space.ts";
import { arrowed, grabBall, keyFactor, lensGestures, type Magnifiable, type Turnable } from "../view/ball_hand.ts";
import { distance, follow, isCommand, type Gestures, type Hold, type Place } from "../view/hand.ts";
import * as lenses from "../view/lens.ts";
import type { Cap, Sight } from "../view/lens.ts";
import { Motion } from "../view/motion.ts";
import { pointUnder, type View } from "../view/view.ts";
import { fixed, scale } from "../words.ts";
import { CIRCLE_RADIUS, STEP, type GlobeScene } from "./globe_scene.ts";
import { BEGINNING, sideView, type GlobeState } from "./globe_state.ts";

/** Pixels beyond a dot within which the pointer is on it. */
const REACHED = 8;

const LABEL: LabelStyle = { ink: "accent-text", halo: "halo", size: 14 };
const LETTER: LabelStyle = { ...LABEL, size: 15, italic: true };

/** Who has globes: the room, or the output of a notebook's cell. */
export interface GlobeHost {
  readonly scene: GlobeScene;
  readonly shown: GlobeState;
  /** What 0 begins anew. */
  readonly beginning: GlobeState;
  readonly isNorthUp: boolean;
  /** Nothing is drawn that only a hand needs. */
  readonly isFramed: boolean;
  readonly hasPointed: boolean;
  readonly isOn: IsOn;
  readonly host: Pick<RoomHost, "guarded">;
  /** The part of the document whose colours hold. */
  readonly place: HTMLElement;
  set(change: Partial<GlobeState>, reason: Reason, isStep?: boolean): void;
  /** The pointer is on a place, or on none. */
  hover(place: number | null): void;
}

/** What the globes have in common: what is drawn of the Earth, the circle at the pointer, the hand. */
abstract class GlobePlate implements Turnable {
  readonly plate: Plate;
  readonly motion = new Motion();
  protected readonly room: GlobeHost;

  constructor(canvas: HTMLCanvasElement, room: GlobeHost) {
    this.room = room;
    const standing = new Map();
    const paint = (pen: Pen, isMoving: boolean): void => {
      const { disc, map, taken } = this;
      drawParts(pen, { disc, map, isMoving, standing, taken }, room.scene.parts, room.isOn);
      pen.draw("limb", (path) => traceDisc(path, this.disc));
    };
    const overlay = (pen: Pen): void => {
      drawLayers(pen, this.disc, this.map, [room.scene.held]);
      if (room.isFramed) return;
      this.#paintPointer(pen);
      this.paintHeld(pen);
    };
    this.plate = new Plate(canvas, paint, room.host.guarded, room.place, overlay);
    follow(this.plate, { hover: (at) => this.point(at), ...this.gestures() });
  }

  abstract get view(): View;
  abstract turn(view: View, reason: Reason): void;

  /** From the Earth to the axes of the view. */
  protected abstract get map(): MoebiusMap;
  /** What there is at the pointer: a circle, with its scale where scales differ from those of a plain globe. */
  protected abstract get pointed(): "scale" | "circle" | null;
  /** What there is to drag. */
  protected abstract paintHeld(pen: Pen): void;
  /** Where that keeps names away. */
  protected get taken(): readonly Box[] {
    return [];
  }
  protected abstract gestures(): Gestures;

  get disc(): Disc {
    return this.plate.disc;
  }

  get isNorthUp(): boolean {
    return this.room.isNorthUp;
  }

  /** Whether there is a circle at the pointer. */
  get isPointed(): boolean {
    return this.pointed !== null && lenses.imageOf(this.map, this.room.shown.pointer)[2] > 0;
  }

  protected change(change: Partial<GlobeState>): void {
    this.motion.stop();
    this.room.set(change, "hand");
  }

  protected under(at: Place): Vector {
    return pointUnder(this.disc, at);
  }

  protected isOnBall(at: Place): boolean {
    return distance(at, [this.disc.x, this.disc.y]) <= this.disc.r;
  }

  /** The circle goes to the pointer. */
  protected point(at: Place | null): void {
    if (at === null || !this.isOnBall(at)) return this.room.hover(null);
    const pointer = lenses.sourceOf(this.map, this.under(at));
    this.room.set({ pointer }, "pointer");
    const near = this.room.scene.nearest(pointer);
    const isOver = near && distance(at, placeOf(this.disc, lenses.imageOf(this.map, near.at))) <= near.radius + REACHED;
    this.room.hover(isOver ? near.place : null);
  }

  /** The circle at the pointer; its scale stands below it, or above it near the lower limb. */
  #paintPointer(pen: Pen): void {
    const { disc, map, pointed } = this;
    if (pointed === null) return;
    const { pointer } = this.room.shown;
    const images = map.apply(Float64Array.from(circlePoints(pointer, CIRCLE_RADIUS).flat()));
    const rim = arcThrough(images, 0, true);
    const at = lenses.imageOf(map, pointer);
    if (rim === null || at[2] <= 0) return;
    pen.draw("seen", (path) => traceCap(path, disc, rim));
    pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
    if (pointed === "circle") return;
    const [x, y] = placeOf(disc, at);
    const away = rim.r * disc.r;
    const isBelow = y + away + 20 < disc.y + disc.r * Math.sqrt(Math.max(0, 1 - at[0] ** 2));
    const words = `${scale(lenses.scaleAt(map, pointer))}×`;
    const half = widthOf(words, LABEL) / 2 + 2;
    const inward = Math.max(half, Math.min(pen.width - half, disc.x + (x - disc.x) * 0.98));
    const style = this.room.scene.lettered(LABEL);
    pen.label(words, inward, isBelow ? y + away + 17 : y - away - 7, { ...style, align: "center" });
  }
}

/** The large globe through the fisheye: turned, magnified and focused by hand. */
export class FisheyeGlobe extends GlobePlate implements Magnifiable {
  get most(): number {
    return lenses.MOST;
  }

  /** Over places of the reader's own, nothing before anybody has pointed. */
  protected get pointed(): "scale" | null {
    return this.room.scene.places === null || this.room.hasPointed ? "scale" : null;
  }

  get view(): View {
    return this.sight.view;
  }

  protected get map(): MoebiusMap {
    return lenses.sightMap(this.sight);
  }

  get sight(): Sight {
    return this.room.shown.sight;
  }

  see(sight: Sight): void {
    this.change({ sight });
  }

  turn(view: View, reason: Reason): void {
    this.room.set({ sight: { ...this.sight, view } }, reason);
  }

  /** Goes to another sight, on the way that a flight takes. */
  fly(to: Sight): void {
    const from = this.sight;
    this.motion.fly((t) => {
      const sight = lenses.betweenSights(from, to, t, this.isNorthUp);
      this.room.set({ sight }, t < 1 ? "flight" : "state", t === 1);
    });
  }

  get #focus() {
    const { focus } = this.sight.lens;
    const seen = this.view.seen(focus);
    const [isFront, isRight, [x, y]] = [seen[2] >= 0, seen[0] <= 0.75, placeOf(this.disc, seen)];
    const style: LabelStyle = { ...this.room.scene.lettered(LETTER), align: isRight ? "left" : "right" };
    return { x, y, isFront, isRight, words: isFront ? "focus" : "focus*, behind*", style };
  }

  protected override get taken(): Box[] {
    const { x, y, isRight, words, style } = this.#focus;
    const width = widthOf(words, style) + 11;
    return [[x - (isRight ? 7 : width), y - 20, x + (isRight ? width : 7), y + 7]];
  }

  protected paintHeld(pen: Pen): void {
    const { x, y, isFront, isRight, words, style } = this.#focus;
    drawHandle(pen, x, y, isFront ? "front" : "behind");
    pen.label(words, x + (isRight ? 9 : -9), y - 7, style);
  }

  protected gestures(): Gestures {
    return {
      take: (at, reach) => this.#take(at, reach),
      click: (at) => {
        this.motion.stop();
        this.point(at);
      },
      doubleClick: (at) => {
        if (this.isOnBall(at)) this.fly(this.#focusedAt(this.under(at)));
      },
      ...lensGestures(this, this.motion),
      key: (event) => {
        const view = arrowed(this, event);
        const sight = view === null ? this.#keyed(event.key) : { ...this.sight, view };
        if (sight === null || isCommand(event)) return false;
        this.change({ sight });
        return true;
      },
    };
  }

  #focusedAt(point: Vector): Sight {
    return lenses.focused(this.sight, lenses.sourceOf(this.map, point), this.isNorthUp);
  }

  #take(at: Place, reach: number): Hold | null {
    const { lens, view } = this.sight;
    const away = distance(at, placeOf(this.disc, view.seen(lens.focus)));
    if (this.room.isFramed || away > reach) return grabBall(this, this.motion, at);
    this.motion.stop();
    // The fisheye leaves its focus where it is: the ring is at the pointer where the view stays as it is.
    return { move: (to) => this.change({ sight: { lens: { ...lens, focus: view.onBall(this.under(to)) }, view } }) };
  }

  #keyed(key: string): Sight | null {
    const { lens, view } = this.sight;
    const factor = keyFactor(key);
    if (factor !== null) return { lens: { ...lens, magnification: lens.magnification * factor }, view };
    if (key === "0") return this.room.beginning.sight;
    return key === "f" || key === "F" ? this.#focusedAt([0, 0, 1]) : null;
  }
}

/** Where a rim has its handle: the point of the rim that lies farthest this way in the drawing. */
const TOWARD = [0.8, -1] as const;

/** Points of a rim, less than a reach apart. */
const POINTS = 180;

/** The bubble that is taken, or the one that it fills; rims and insides are dragged in either. */
export class BubbleGlobe extends GlobePlate {
  readonly #which: "before" | "after";

  constructor(canvas: HTMLCanvasElement, which: "before" | "after", room: GlobeHost) {
    super(canvas, room);
    this.#which = which;
  }

  get view(): View {
    return this.room.shown[this.#which];
  }

  protected get map(): MoebiusMap {
    const { from, to } = this.room.shown;
    return lenses.seenThrough(this.#which === "after" ? lenses.capToCap(from, to) : MoebiusMap.identity(), this.view);
  }

  /** Nothing before anybody has pointed. */
  protected get pointed(): "scale" | "circle" | null {
    if (!this.room.hasPointed) return null;
    return this.#which === "after" ? "scale" : "circle";
  }

  turn(view: View, reason: Reason): void {
    this.room.set({ [this.#which]: view }, reason);
  }

  get #end(): "from" | "to" {
    return this.#which === "before" ? "from" : "to";
  }

  get #cap(): Cap {
    return this.room.shown[this.#end];
  }

  /** The bubble's rim, axes of the view. */
  get #rim(): Circle {
    const { center, radius } = this.#cap;
    return circle(this.view.seen(center), Math.cos((radius * Math.PI) / 180));
  }

  #setCap(cap: Cap): void {
    this.change({ [this.#end]: cap });
  }

  protected paintHeld(pen: Pen): void {
    const { disc } = this;
    const rim = this.#rim;
    if (this.#which === "before") pen.draw("seen", (path) => traceCap(path, disc, rim));
    pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
    const handle = this.#handle();
    if (handle === null) return;
    const [x, y] = placeOf(disc, handle);
    drawHandle(pen, x, y, "rim");
    const isRight = handle[0] < 0.55;
    // Near the lower limb the label stands above its handle: below there is no drawing.
    const isLow = handle[1] < -0.5 && handle[2] < 0.4;
    const style: LabelStyle = { ...this.room.scene.lettered(LABEL), align: isRight ? "left" : "right" };
    pen.label(`${fixed(this.#cap.radius, 1)}°`, x + (isRight ? 9 : -9), y + (isLow ? -6 : 14), style);
  }

  protected override get taken(): Box[] {
    const handle = this.#handle();
    if (handle === null) return [];
    const [x, y] = placeOf(this.disc, handle);
    return [[x - 48, y - 20, x + 48, y + 18]]; // on either side
  }

  /** Points of the rim in front. */
  get #seen(): Vector[] {
    const rim = this.#rim;
    const points = Array.from({ length: POINTS }, (_, k) => pointAt(rim, (2 * Math.PI * k) / POINTS));
    return points.filter((point) => point[2] >= 0);
  }

  /** The handle's point of the view, or null while the rim is behind. */
  #handle(): Vector | null {
    const toward = ([x, y]: Vector): number => TOWARD[0] * x + TOWARD[1] * y;
    return this.#seen.reduce<Vector | null>((a, b) => (a === null || toward(b) > toward(a) ? b : a), null);
  }

  protected gestures(): Gestures {
    return {
      take: (at, reach) => this.#take(at, reach),
      key: (event) => {
        const view = event.key === "0" ? BEGINNING[this.#which] : arrowed(this, event);
        if (view !== null) this.change({ [this.#which]: view });
        return view !== null;
      },
    };
  }

  #take(at: Place, reach: number): Hold | null {
    if (!this.isOnBall(at)) return null;
    const start = this.#cap;
    const point = this.under(at);
    const center = this.view.seen(start.center);
    // In the drawing: one degree of the rim is not so many pixels everywhere.
    const isRim = this.#seen.some((place) => distance(at, placeOf(this.disc, place)) <= reach);
    if (!isRim && angle(center, point) > start.radius) return grabBall(this, this.motion, at);
    this.motion.stop();
    return {
      move: (to) => {
        const now = this.under(to);
        if (isRim) return this.#setCap({ ...start, radius: angle(center, now) });
        const moved = row(Rotation.between(point, now).apply(center), 0);
        this.#setCap({ ...start, center: this.view.onBall(moved) });
      },
    };
  }
}

/** The radius of the tinted surroundings, degrees: 8 up to S = 4, then as large as they are seen. */
const REACH = 8;
const REACH_TIMES_S = 32;

/** Between limb and edge of the small globes, pixels. */
const MARGIN = 1;

/** Five small globes: the lens from five sides, as the panels of Figures 10 to 12, with the surroundings of the focus. */
export class FiveViews {
  readonly #room: GlobeHost;
  readonly #plates: Plate[];
  readonly #graticule = arcLayer("graticule", graticuleArcs(STEP));
  #shown = "";

  constructor(buttons: readonly HTMLButtonElement[], room: GlobeHost) {
    this.#room = room;
    this.#plates = buttons.map((button) => {
      const paint = (pen: Pen): void => this.#paint(pen, Number(button.value));
      return new Plate(button.querySelector("canvas")!, paint, room.host.guarded);
    });
  }

  /** Draws what has changed: while the ball turns under a lens that stays, nothing has. */
  redraw(reason: Reason): void {
    const lens = JSON.stringify(this.#room.shown.sight.lens);
    const isMoving = reason === "hand" || reason === "flight";
    if (isMoving && this.#shown === lens) return;
    this.#shown = lens;
    for (const plate of this.#plates) plate.redraw(isMoving ? "state" : reason);
  }

  #paint(pen: Pen, panel: number): void {
    const { lens } = this.#room.shown.sight;
    const disc = { x: pen.width / 2, y: pen.height / 2, r: Math.max(pen.width / 2 - MARGIN, 1) };
    const map = lenses.seenThrough(lenses.lensMap(lens), sideView(panel, lens.focus));
    pen.ball(disc, "ball");
    const around = circlePoints(lens.focus, Math.min(REACH, REACH_TIMES_S / lens.magnification));
    drawLayers(pen, disc, map, [capLayer("patch", Float64Array.from(around.flat())), this.#graticule]);
    pen.draw("limb-small", (path) => traceDisc(path, disc));
  }
}
