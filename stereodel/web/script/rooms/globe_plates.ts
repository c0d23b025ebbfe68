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

const LABEL: LabelStyle = { ink: "accent-text", halo: "halo", size: 15 };

/** Who has globes: the room, or the output of a notebook's cell. */
export interface GlobeHost {
  readonly scene: GlobeScene;
  readonly shown: GlobeState;
  /** What 0 begins anew. */
  readonly beginning: GlobeState;
  readonly isNorthUp: boolean;
  /** Nothing is drawn that only a hand needs. */
  readonly isFramed: boolean;
  /** There is a circle at the pointer. */
  readonly hasPointed: boolean;
  readonly isOn: IsOn;
  readonly host: Pick<RoomHost, "guarded">;
  /** The part of the document whose colours hold. */
  readonly place: HTMLElement;
  set(change: Partial<GlobeState>, reason: Reason, isStep?: boolean): void;
  /** The pointer is on a place, or on none. */
  hover(place: number | null): void;
  /** A click, and a key that is one of the host's own. */
  press?(): void;
  key?(event: KeyboardEvent): boolean;
}

/** What there is to drag: a handle where it is seen, axes of the view, and the words beside it. */
interface Handle {
  readonly at: Vector;
  readonly kind: "front" | "behind" | "rim";
  readonly words: string;
}

/** What the globes have in common: what is drawn of the Earth, the circle at the pointer, a handle, the hand. */
abstract class GlobePlate implements Turnable {
  readonly plate: Plate;
  readonly motion = new Motion();
  protected readonly room: GlobeHost;

  constructor(canvas: HTMLCanvasElement, room: GlobeHost) {
    this.room = room;
    const standing = new Map();
    const paint = (pen: Pen, isMoving: boolean): void => {
      const [{ disc, map }, held] = [this, this.#held];
      const taken = held === null ? [] : [held.box];
      drawParts(pen, { disc, map, isMoving, standing, taken }, room.scene.parts, room.isOn);
      pen.draw("limb", (path) => traceDisc(path, disc));
    };
    const overlay = (pen: Pen): void => {
      drawLayers(pen, this.disc, this.map, [room.scene.held]);
      if (room.isFramed) return;
      this.#paintPointer(pen);
      this.paintRim(pen);
      const held = this.#held;
      if (held === null) return;
      drawHandle(pen, held.x, held.y, held.kind);
      pen.label(held.words, held.x + (held.isRight ? 9 : -9), held.y - 7, held.style);
    };
    this.plate = new Plate(canvas, paint, room.host.guarded, room.place, overlay);
    follow(this.plate, this.gestures());
  }

  abstract get view(): View;

  /** From the Earth to the axes of the view. */
  protected abstract get map(): MoebiusMap;
  protected abstract get handle(): Handle | null;
  /** What is another from another view. */
  protected abstract seenFrom(view: View): Partial<GlobeState>;
  /** What a press drags that is not the globe itself. */
  protected abstract dragged(at: Place, reach: number): Hold["move"] | null;
  /** What a key changes, but for the arrows. */
  protected abstract keyed(key: string): Partial<GlobeState> | null;

  get disc(): Disc {
    return this.plate.disc;
  }

  get isNorthUp(): boolean {
    return this.room.isNorthUp;
  }

  turn(view: View, reason: Reason): void {
    this.room.set(this.seenFrom(view), reason);
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

  protected paintRim(_pen: Pen): void {}

  protected gestures(): Gestures {
    return {
      hover: (at) => this.point(at),
      take: (at, reach) => {
        const move = this.dragged(at, reach);
        if (move === null) return grabBall(this, this.motion, at);
        this.motion.stop();
        return { move };
      },
      key: (event) => {
        if (this.room.key?.(event)) return true;
        const view = arrowed(this, event);
        const change = view === null ? this.keyed(event.key.toLowerCase()) : this.seenFrom(view);
        if (change === null || isCommand(event)) return false;
        this.change(change);
        return true;
      },
    };
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

  /** The handle in the drawing, with its words, where they keep names away. */
  get #held() {
    const { handle } = this;
    if (handle === null) return null;
    const [x, y] = placeOf(this.disc, handle.at);
    const isRight = handle.kind !== "rim" && handle.at[0] <= 0.75; // those of a rim are inside it
    const style: LabelStyle = { ...this.room.scene.lettered(LABEL), align: isRight ? "left" : "right" };
    const width = widthOf(handle.words, style) + 11;
    const box: Box = [x - (isRight ? 7 : width), y - 20, x + (isRight ? width : 7), y + 7];
    return { ...handle, x, y, isRight, style, box };
  }

  /** The circle at the pointer; its scale stands below it, or above it near the lower limb. */
  #paintPointer(pen: Pen): void {
    const { disc, map } = this;
    const { pointer } = this.room.shown;
    const images = map.apply(Float64Array.from(circlePoints(pointer, CIRCLE_RADIUS).flat()));
    const rim = arcThrough(images, 0, true);
    const at = lenses.imageOf(map, pointer);
    if (!this.room.hasPointed || rim === null || at[2] <= 0) return;
    pen.draw("seen", (path) => traceCap(path, disc, rim));
    pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
    if (map.magnification === 1) return; // all sizes are those of a plain globe
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
  /** That of the page, or what a model asks for beyond it. */
  get most(): number {
    return Math.max(lenses.MOST, this.sight.lens.magnification);
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

  protected seenFrom(view: View): Partial<GlobeState> {
    return { sight: { ...this.sight, view } };
  }

  /** Goes to another sight, on the way that a flight takes. */
  fly(to: Sight): void {
    const from = this.sight;
    this.motion.fly((t) => {
      const sight = lenses.betweenSights(from, to, t, this.isNorthUp);
      this.room.set({ sight }, t < 1 ? "flight" : "state", t === 1);
    });
  }

  protected get handle(): Handle {
    const at = this.view.seen(this.sight.lens.focus);
    return at[2] >= 0 ? { at, kind: "front", words: "*focus*" } : { at, kind: "behind", words: "*focus*, behind" };
  }

  protected override gestures(): Gestures {
    return {
      ...super.gestures(),
      ...lensGestures(this, this.motion),
      click: (at) => {
        this.motion.stop();
        this.point(at);
        this.room.press?.();
      },
      doubleClick: (at) => {
        this.room.press?.(); // back to what it was before the first of the two
        if (this.isOnBall(at)) this.fly(this.#focusedAt(this.under(at)));
      },
    };
  }

  #focusedAt(point: Vector): Sight {
    return lenses.focused(this.sight, lenses.sourceOf(this.map, point), this.isNorthUp);
  }

  protected dragged(at: Place, reach: number): Hold["move"] | null {
    const { lens, view } = this.sight;
    if (this.room.isFramed || distance(at, placeOf(this.disc, this.handle.at)) > reach) return null;
    // The fisheye leaves its focus where it is: the ring is at the pointer where the view stays as it is.
    return (to) => this.change({ sight: { lens: { ...lens, focus: view.onBall(this.under(to)) }, view } });
  }

  protected keyed(key: string): Partial<GlobeState> | null {
    const { lens, view } = this.sight;
    const factor = keyFactor(key);
    if (factor !== null) return { sight: { lens: { ...lens, magnification: lens.magnification * factor }, view } };
    if (key === "0") return { sight: this.room.beginning.sight };
    return key === "f" ? { sight: this.#focusedAt([0, 0, 1]) } : null;
  }
}

/** Where a rim has its handle: the point of the rim that lies farthest this way in the drawing. */
const TOWARD = [0.8, -1] as const;

/** Points of a rim, less than a reach apart. */
const POINTS = 180;

/** The bubble that is taken, or the one that it fills; rims and insides are dragged in either. */
export class BubbleGlobe extends GlobePlate {
  readonly #which: "before" | "after";
  readonly #end: "from" | "to";

  constructor(canvas: HTMLCanvasElement, which: "before" | "after", room: GlobeHost) {
    super(canvas, room);
    [this.#which, this.#end] = [which, which === "before" ? "from" : "to"];
  }

  get view(): View {
    return this.room.shown[this.#which];
  }

  protected get map(): MoebiusMap {
    const { from, to } = this.room.shown;
    return lenses.seenThrough(this.#which === "after" ? lenses.capToCap(from, to) : MoebiusMap.identity(), this.view);
  }

  protected seenFrom(view: View): Partial<GlobeState> {
    return { [this.#which]: view };
  }

  get #cap(): Cap {
    return this.room.shown[this.#end];
  }

  /** The bubble's rim, axes of the view. */
  get #rim(): Circle {
    const { center, radius } = this.#cap;
    return circle(this.view.seen(center), Math.cos((radius * Math.PI) / 180));
  }

  protected override paintRim(pen: Pen): void {
    const [{ disc }, rim] = [this, this.#rim];
    if (this.#which === "before") pen.draw("seen", (path) => traceCap(path, disc, rim));
    pen.draw("bubble-open", (path) => traceCircle(path, disc, rim));
  }

  /** Points of the rim in front. */
  get #seen(): Vector[] {
    const rim = this.#rim;
    const points = Array.from({ length: POINTS }, (_, k) => pointAt(rim, (2 * Math.PI * k) / POINTS));
    return points.filter((point) => point[2] >= 0);
  }

  /** None while the rim is behind. */
  protected get handle(): Handle | null {
    const toward = ([x, y]: Vector): number => TOWARD[0] * x + TOWARD[1] * y;
    const [at] = this.#seen.sort((a, b) => toward(b) - toward(a));
    return at === undefined ? null : { at, kind: "rim", words: `${fixed(this.#cap.radius, 1)}°` };
  }

  protected keyed(key: string): Partial<GlobeState> | null {
    return key === "0" ? this.seenFrom(BEGINNING[this.#which]) : null;
  }

  protected dragged(at: Place, reach: number): Hold["move"] | null {
    const [start, point] = [this.#cap, this.under(at)];
    const center = this.view.seen(start.center);
    // In the drawing: one degree of the rim is not so many pixels everywhere.
    const isRim = this.#seen.some((place) => distance(at, placeOf(this.disc, place)) <= reach);
    if (!this.isOnBall(at) || (!isRim && angle(center, point) > start.radius)) return null;
    return (to) => {
      const now = this.under(to);
      const moved = (): Vector => this.view.onBall(row(Rotation.between(point, now).apply(center), 0));
      this.change({ [this.#end]: isRim ? { ...start, radius: angle(center, now) } : { ...start, center: moved() } });
    };
  }
}

/** The radius of the tinted surroundings, degrees: 8 up to S = 4, then as large as they are seen. */
const REACH = 8;
const REACH_TIMES_S = 32;

/** Between limb and edge of the small globes, pixels. */
const MARGIN = 1;

/** Five small globes: the lens from five sides, as the panels of Figures 10 to 12, with the surroundings of the focus. */
export function fiveViews(buttons: readonly HTMLButtonElement[], room: GlobeHost): (reason: Reason) => void {
  const graticule = arcLayer("graticule", graticuleArcs(STEP));
  const plates = buttons.map((button) => {
    const paint = (pen: Pen): void => {
      const { lens } = room.shown.sight;
      const disc = { x: pen.width / 2, y: pen.height / 2, r: Math.max(pen.width / 2 - MARGIN, 1) };
      const map = lenses.seenThrough(lenses.lensMap(lens), sideView(Number(button.value), lens.focus));
      pen.ball(disc, "ball");
      const around = circlePoints(lens.focus, Math.min(REACH, REACH_TIMES_S / lens.magnification));
      drawLayers(pen, disc, map, [capLayer("patch", Float64Array.from(around.flat())), graticule]);
      pen.draw("limb-small", (path) => traceDisc(path, disc));
    };
    return new Plate(button.querySelector("canvas")!, paint, room.host.guarded);
  });
  let shown = "";
  // While the ball turns under a lens that stays, nothing changes.
  return (reason) => {
    const lens = JSON.stringify(room.shown.sight.lens);
    const isMoving = reason === "hand" || reason === "flight";
    if (isMoving && shown === lens) return;
    shown = lens;
    for (const plate of plates) plate.redraw(isMoving ? "state" : reason);
  };
}
