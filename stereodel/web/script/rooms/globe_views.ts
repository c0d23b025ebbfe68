/** Five small globes: the lens from five sides, as the panels of Figures 10 to 12, with the surroundings of the focus. */

import { arcLayer, drawLayers, graticuleArcs, regionLayer, type Layer } from "../drawing/ball.ts";
import { cornersOf, traceDisc, type Disc, type Pen } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import { directionOf, lonLatOf, type Vector } from "../space.ts";
import { lensMap, seenThrough, type Lens } from "../view/lens.ts";
import type { GlobeHost } from "./globe_plate.ts";
import { STEP } from "./globe_scene.ts";
import { sideView } from "./globe_state.ts";

/** Half the side of the tinted surroundings as in the figures, degrees: 8 up to S = 4, then as large as they are seen. */
const REACH = 8;
const REACH_TIMES_S = 32;

/** Points of each of their sides. */
const POINTS = 16;

/** Between limb and edge of the small globes, pixels. */
const MARGIN = 1;

export class FiveViews {
  readonly #host: GlobeHost;
  readonly #plates: Plate[];
  readonly #graticule = arcLayer("graticule", graticuleArcs(STEP));
  #patch: { lens: Lens; layer: Layer } | null = null;
  #shown: Lens | null = null;

  constructor(buttons: readonly HTMLButtonElement[], host: GlobeHost) {
    this.#host = host;
    this.#plates = buttons.map((button) => {
      const panel = Number(button.value);
      const plate: Plate = new Plate(
        button.querySelector("canvas")!,
        (pen) => this.#paint(pen, panel, discOf(plate)),
        (body) => host.run(body),
      );
      return plate;
    });
  }

  /** Draws what has changed: while the ball turns under a lens that stays, nothing has. */
  redraw(reason: Reason): void {
    const { lens } = this.#host.shown.sight;
    const isMoving = reason === "hand" || reason === "flight";
    if (isMoving && this.#shown !== null && isSame(this.#shown, lens)) return;
    this.#shown = lens;
    for (const plate of this.#plates) plate.redraw(isMoving ? "state" : reason);
  }

  #paint(pen: Pen, panel: number, disc: Disc): void {
    const { lens } = this.#host.shown.sight;
    const map = seenThrough(lensMap(lens), sideView(panel, lens.focus));
    pen.ball(disc, "ball");
    drawLayers(pen, disc, map, [this.#surroundings(lens), this.#graticule]);
    pen.draw("limb-small", (path) => traceDisc(path, disc));
  }

  #surroundings(lens: Lens): Layer {
    if (this.#patch?.lens !== lens) this.#patch = { lens, layer: patchLayer(lens) };
    return this.#patch.layer;
  }
}

function isSame(a: Lens, b: Lens): boolean {
  return a.magnification === b.magnification && a.focus.every((value, k) => value === b.focus[k]);
}

function discOf(plate: Plate): Disc {
  const [x, y] = [plate.width / 2, plate.height / 2];
  return { x, y, r: Math.max(x - MARGIN, 1) };
}

/** A box of longitudes and latitudes round the focus; near a pole it ends there. */
function patchLayer({ focus, magnification }: Lens): Layer {
  const [lon, lat] = lonLatOf(focus);
  const reach = Math.min(REACH, REACH_TIMES_S / magnification);
  const [south, north] = [Math.max(lat - reach, -89), Math.min(lat + reach, 89)];
  const corners = cornersOf(lon - reach, south, lon + reach, north);
  const ring = corners.flatMap(([x, y], k) => {
    const [toX, toY] = corners[(k + 1) % 4];
    return Array.from({ length: POINTS }, (_, n) => {
      const t = n / POINTS;
      return [...directionOf(x + t * (toX - x), y + t * (toY - y))];
    });
  });
  const opposite: Vector = [-focus[0], -focus[1], -focus[2]];
  return regionLayer("seen", "patch-line", Float64Array.from(ring.flat()), [0, ring.length], opposite, false);
}
