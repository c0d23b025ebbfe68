/** A drawing of the page: a canvas that is as large as its place and drawn anew when something asks for it. */

import { CanvasPen } from "./canvas_pen.ts";
import type { Disc, Pen, Sheet } from "./pen.ts";
import { colours, onColours } from "./styles.ts";

/** Why a drawing is made: its kind decides how much of it may be left out. */
export type Reason = "size" | "colours" | "state" | "hand" | "flight" | "rest" | "pointer";

/** Milliseconds after the last frame of a movement until the drawing is made in full. */
const REST = 120;

/** Between a ball's limb and the edge of its canvas, pixels: handles on the limb are whole. The style sheet has it, too. */
const BALL_MARGIN = 7;

/** Draws everything. While it moves, `isMoving`, what takes long may be left out. */
type Painter = (pen: Pen, isMoving: boolean) => void;

export class Plate {
  readonly canvas: HTMLCanvasElement;
  /** Pixels of the screen; 0 while the room is not shown. */
  width = 0;
  height = 0;
  /** Frames that were drawn. */
  frames = 0;
  #reason: Reason | null = null;
  readonly #paint: Painter;
  readonly #overlay: Painter | null;
  readonly #ground = document.createElement("canvas"); // what lies below the overlay; a movement's whole frame
  #isKept = false; // whether it is what is to be seen
  readonly #run: (body: () => void) => void;
  readonly #place: HTMLElement;
  readonly #observer: ResizeObserver;
  readonly #forget: () => void;
  #asked = 0;
  #resting: ReturnType<typeof setTimeout> | undefined;

  /**
   * @param run Runs a painter, which may fail.
   * @param place The part of the document whose colours hold.
   * @param overlay What is drawn over it, and alone anew where only the pointer has moved.
   */
  constructor(
    canvas: HTMLCanvasElement,
    paint: Painter,
    run: (body: () => void) => void = (body) => body(),
    place: HTMLElement = document.documentElement,
    overlay: Painter | null = null,
  ) {
    this.canvas = canvas;
    this.#place = place;
    this.#paint = paint;
    this.#overlay = overlay;
    this.#run = run;
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(canvas);
    this.#forget = onColours(() => this.#draw("colours"));
  }

  /** The disc of a ball that fills the drawing. */
  get disc(): Disc {
    const [x, y] = [this.width / 2, this.height / 2];
    return { x, y, r: Math.max(Math.min(x, y) - BALL_MARGIN, 1) };
  }

  /** Asks for a drawing with the next frame; moves are followed by one in full. */
  redraw(reason: Reason): void {
    if (reason !== "pointer" || this.#asked === 0) this.#reason = reason;
    if (this.#asked === 0) this.#asked = requestAnimationFrame(() => this.#draw(this.#reason ?? reason));
  }

  /** The place of a pointer in the drawing. */
  placeOf(event: { clientX: number; clientY: number }): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** The whole drawing, as a picture to take along. @param isBare Without what only the hand needs. */
  sheet(title: string, isBare = false): Sheet {
    const paint = (pen: Pen): void => {
      this.#paint(pen, false);
      if (!isBare) this.#overlay?.(pen, false);
    };
    return { title, width: this.width, height: this.height, paint };
  }

  dispose(): void {
    cancelAnimationFrame(this.#asked);
    clearTimeout(this.#resting);
    this.#observer.disconnect();
    this.#forget();
  }

  #resize(): void {
    const [scale, wasHidden] = [devicePixelRatio, this.width === 0];
    // Asked for here alone: in the midst of a movement the question would have the whole page laid out.
    [this.width, this.height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const [width, height] = [Math.round(this.width * scale), Math.round(this.height * scale)];
    if (width === 0 || height === 0) return;
    if (!wasHidden && this.canvas.width === width && this.canvas.height === height) return;
    [this.canvas.width, this.canvas.height] = [width, height];
    this.#draw("size");
  }

  #draw(reason: Reason): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
    this.#reason = reason;
    if (this.width === 0 || this.height === 0) return;
    const isMoving = reason === "hand" || reason === "flight";
    if (reason !== "pointer") clearTimeout(this.#resting);
    if (isMoving) this.#resting = setTimeout(() => this.redraw("rest"), REST);
    this.#run(() => this.#layers(reason, isMoving));
    ++this.frames;
  }

  /**
   * Frames are drawn beside the canvas and shown when they are whole, so that a painter that fails leaves the last one.
   * What lies below the overlay is kept, so that the overlay alone is drawn where only the pointer moves.
   */
  #layers(reason: Reason, isMoving: boolean): void {
    const [canvas, ground, overlay] = [this.canvas, this.#ground, this.#overlay];
    const scale = canvas.width / this.width;
    if (ground.width !== canvas.width || ground.height !== canvas.height) {
      [ground.width, ground.height] = [canvas.width, canvas.height];
      this.#isKept = false;
    }
    if (!this.#isKept || reason !== "pointer") {
      this.#isKept = false; // should the painter fail
      cleared(ground);
      const pen = this.#pen(ground, scale);
      this.#paint(pen, isMoving);
      if (isMoving) overlay?.(pen, isMoving);
      else this.#isKept = overlay !== null;
    }
    cleared(canvas).drawImage(ground, 0, 0);
    if (!isMoving) overlay?.(this.#pen(canvas, scale), false);
  }

  #pen(canvas: HTMLCanvasElement, scale: number): CanvasPen {
    return new CanvasPen(canvas.getContext("2d")!, this.width, this.height, scale, colours(this.#place));
  }
}

function cleared(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const context = canvas.getContext("2d")!;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  return context;
}
