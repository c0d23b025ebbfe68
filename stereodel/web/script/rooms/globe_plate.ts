/** What the globes of the room have in common: what is drawn of the Earth, the circle at the pointer, the hand. */

import { arcThrough } from "../drawing/arcs.ts";
import { circlePoints, placeOf } from "../drawing/ball.ts";
import { traceCap } from "../drawing/arcs.ts";
import { traceDisc, type Disc, type Pen } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import type { LabelStyle } from "../drawing/styles.ts";
import type { MoebiusMap } from "../kernel/api.ts";
import type { Vector } from "../space.ts";
import type { Turnable } from "../view/ball_hand.ts";
import { distance, follow, type Gestures, type Place } from "../view/hand.ts";
import { imageOf, scaleAt, sourceOf } from "../view/lens.ts";
import { Motion } from "../view/motion.ts";
import { pointUnder, type View } from "../view/view.ts";
import { scale } from "../words.ts";
import type { GlobeRoom } from "./globe.ts";
import { CIRCLE_RADIUS } from "./globe_scene.ts";

export const LABEL: LabelStyle = { ink: "accent-text", halo: "halo", size: 14 };

/** What the room does for its globes. */
export type GlobeHost = Pick<GlobeRoom, "scene" | "shown" | "isOn" | "set" | "run">;

export abstract class GlobePlate implements Turnable {
  readonly plate: Plate;
  protected readonly host: GlobeHost;
  protected readonly motion = new Motion();

  constructor(canvas: HTMLCanvasElement, host: GlobeHost) {
    this.host = host;
    this.plate = new Plate(
      canvas,
      (pen, isMoving) => this.#paint(pen, isMoving),
      (body) => host.run(body),
      document.documentElement,
      (pen) => {
        this.#paintPointer(pen);
        this.paintHeld(pen);
      },
    );
    follow(this.plate, { hover: (at) => this.point(at), ...this.gestures() });
  }

  abstract get view(): View;
  abstract turn(view: View, reason: Reason): void;

  /** From the Earth to the axes of the view. */
  protected abstract get map(): MoebiusMap;
  /** What there is to drag. */
  protected abstract paintHeld(pen: Pen): void;
  protected abstract gestures(): Gestures;

  get disc(): Disc {
    return this.plate.disc;
  }

  /** Whether the circle at the pointer is drawn, as the globe has it before anybody has pointed. */
  protected get isPointed(): boolean {
    return true;
  }

  /** Whether scales differ from those of a plain globe. */
  protected get isMagnified(): boolean {
    return true;
  }

  get isNorthUp(): boolean {
    return this.host.isOn("north");
  }

  stop(): void {
    this.motion.stop();
  }

  protected isOnBall(at: Place): boolean {
    return distance(at, [this.disc.x, this.disc.y]) <= this.disc.r;
  }

  /** The circle goes to the pointer. */
  protected point(at: Place | null): void {
    if (at === null || !this.isOnBall(at)) return;
    this.host.set({ pointer: sourceOf(this.map, pointUnder(this.disc, at)) }, "pointer");
  }

  #paint(pen: Pen, isMoving: boolean): void {
    this.host.scene.draw(pen, this.disc, this.map, (name) => this.host.isOn(name), isMoving);
    pen.draw("limb", (path) => traceDisc(path, this.disc));
  }

  /** The circle at the pointer, with its scale. */
  #paintPointer(pen: Pen): void {
    if (!this.isPointed) return;
    const { disc, map } = this;
    const { pointer } = this.host.shown;
    const images = map.apply(Float64Array.from(circlePoints(pointer, CIRCLE_RADIUS).flat()));
    const circle = arcThrough(images, 0, 1, 2, true);
    const at = imageOf(map, pointer);
    if (circle === null || at[2] <= 0) return;
    pen.draw("bubble", (path) => traceCap(path, disc, circle));
    if (this.isMagnified) this.#label(pen, `${scale(scaleAt(map, pointer))}×`, at, circle.r);
  }

  /** Below the circle at the pointer, or above it near the lower limb. */
  #label(pen: Pen, words: string, at: Vector, radius: number): void {
    const [x, y] = placeOf(this.disc, at);
    const away = radius * this.disc.r;
    const isBelow = y + away + 20 < this.disc.y + this.disc.r * Math.sqrt(Math.max(0, 1 - at[0] ** 2));
    const inward = this.disc.x + (x - this.disc.x) * 0.98;
    pen.label(words, inward, isBelow ? y + away + 17 : y - away - 7, { ...LABEL, align: "center" });
  }
}
