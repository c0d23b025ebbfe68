/** Measurements of the drawing core in Node: what is laid into paths against what the kernel says of the same points. */

import { Contents, type Rings } from "../../stereodel/web/script/contents.ts";
import { arcThrough, traceArc, traceCap } from "../../stereodel/web/script/drawing/arcs.ts";
import { circlePoints, perpendicular, regionLayer } from "../../stereodel/web/script/drawing/ball.ts";
import type { Disc, Path, Pen } from "../../stereodel/web/script/drawing/pen.ts";
import { lonlatToXyz, MoebiusMap, Rotation } from "../../stereodel/web/script/kernel/api.ts";
import { load } from "../../stereodel/web/script/kernel/instance.ts";
import { cross, dot, row, type Vector } from "../../stereodel/web/script/space.ts";
import * as lenses from "../../stereodel/web/script/view/lens.ts";
import { pointUnder, View } from "../../stereodel/web/script/view/view.ts";
import { readFileSync } from "node:fs";

await load(readFileSync(new URL("../../stereodel/web/built/stereodel.wasm", import.meta.url)));

const DISC: Disc = { x: 310, y: 290, r: 280 };

let state = 16;
/** The same numbers in [0, 1) on every machine: mulberry32. */
function random(): number {
  state = (state + 0x6d2b79f5) >>> 0;
  let mixed = Math.imul(state ^ (state >>> 15), state | 1);
  mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
  return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
}

function direction(): Vector {
  const z = 2 * random() - 1;
  const turn = 2 * Math.PI * random();
  return [Math.sqrt(1 - z * z) * Math.cos(turn), Math.sqrt(1 - z * z) * Math.sin(turn), z];
}

function view(): View {
  return new View(new Rotation([0, 0, 0, 0].map(() => 2 * random() - 1)));
}

type Piece = { at: (t: number) => [number, number]; from: number; to: number; isLine: boolean };

/** The angle that a canvas goes along an ellipse: the way that the flag says, all round where that is a turn or more. */
function sweep(from: number, to: number, counterclockwise: boolean): number {
  const turn = 2 * Math.PI;
  const sign = counterclockwise ? -1 : 1;
  const ahead = sign * (to - from);
  return sign * (ahead >= 0 ? Math.min(ahead, turn) : turn - (-ahead % turn));
}

/** What is laid into it, as pieces with a parameter. */
class Recorder implements Path {
  readonly pieces: Piece[] = [];
  #start: [number, number] = [0, 0];
  #last: [number, number] = [0, 0];
  #isEmpty = true;

  moveTo(x: number, y: number): void {
    this.#start = this.#last = [x, y];
    this.#isEmpty = false;
  }

  lineTo(x: number, y: number): void {
    const [[a, b], to] = [this.#last, [x, y]];
    if (!this.#isEmpty) {
      this.pieces.push({ at: (t) => [a + t * (to[0] - a), b + t * (to[1] - b)], from: 0, to: 1, isLine: true });
    }
    this.#last = [x, y];
    this.#isEmpty = false;
  }

  ellipse(
    x: number,
    y: number,
    rx: number,
    ry: number,
    turn: number,
    from: number,
    to: number,
    counterclockwise = false,
  ): void {
    const at = (t: number): [number, number] => {
      const [u, v] = [rx * Math.cos(t), ry * Math.sin(t)];
      return [x + u * Math.cos(turn) - v * Math.sin(turn), y + u * Math.sin(turn) + v * Math.cos(turn)];
    };
    if (this.#isEmpty) this.moveTo(...at(from));
    else if (Math.hypot(at(from)[0] - this.#last[0], at(from)[1] - this.#last[1]) > 0) this.lineTo(...at(from));
    const end = from + sweep(from, to, counterclockwise);
    this.pieces.push({ at, from, to: end, isLine: false });
    this.#last = at(end);
  }

  closePath(): void {
    this.lineTo(...this.#start);
  }

  /** How far a place is from what was drawn. */
  distanceTo([px, py]: [number, number]): number {
    let least = Infinity;
    for (const { at, from, to } of this.pieces) {
      const away = (t: number): number => {
        const [x, y] = at(t);
        return Math.hypot(x - px, y - py);
      };
      const steps = Math.max(24, Math.ceil(Math.abs(to - from) * 60));
      let best = 0;
      for (let k = 0; k <= steps; ++k) {
        if (away(from + ((to - from) * k) / steps) < away(from + ((to - from) * best) / steps)) best = k;
      }
      let [low, high] = [Math.max(0, best - 1) / steps, Math.min(steps, best + 1) / steps];
      for (let step = 0; step < 60; ++step) {
        const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
        if (away(from + (to - from) * a) < away(from + (to - from) * b)) high = b;
        else low = a;
      }
      least = Math.min(least, away(from + (to - from) * low));
    }
    return least;
  }

  /** Twice the area with the sign of its sense is the sum of x dy − y dx; y points down, so the sense is turned. */
  area(): number {
    let sum = 0;
    for (const { at, from, to, isLine } of this.pieces) {
      const steps = isLine ? 1 : Math.max(1, Math.ceil(Math.abs(to - from) * 200));
      for (let k = 0; k < steps; ++k) {
        const [x, y] = at(from + ((to - from) * k) / steps);
        const [u, v] = at(from + ((to - from) * (k + 1)) / steps);
        sum += x * v - u * y;
      }
    }
    return -sum / 2;
  }
}

/** The largest distance, pixels, of images of points of arcs from what is drawn of them, and how many there were. */
export function arcs(count: number): { worst: number; seen: number; missing: number } {
  let [worst, seen, missing] = [0, 0, 0];
  for (let k = 0; k < count; ++k) {
    // Circles of all sizes, and arcs from very short ones to nearly all of a circle.
    const n = direction();
    const d = random() < 0.5 ? 0 : 1 - 2 * random();
    const r = Math.sqrt(1 - d * d);
    const e = perpendicular(n);
    const f = cross(n, e);
    const length = 10 ** (-3 * random()) * 2 * Math.PI * 0.97;
    const at = (t: number): number[] =>
      [0, 1, 2].map((i) => d * n[i] + r * (Math.cos(t * length) * e[i] + Math.sin(t * length) * f[i]));
    const map = lenses.seenThrough(MoebiusMap.fisheye(direction(), 10 ** (6 * random())), view());
    const steps = [0, 0.5, 1, 0.1, 0.25, 0.4, 0.6, 0.75, 0.9];
    const images = map.apply(Float64Array.from(steps.flatMap(at)));
    const path = new Recorder();
    traceArc(path, DISC, images);
    for (let step = 0; step < steps.length; ++step) {
      const [x, y, z] = row(images, step);
      const away = path.distanceTo([DISC.x + DISC.r * x, DISC.y - DISC.r * y]);
      if (z > 1e-4) {
        seen += 1;
        if (away === Infinity) missing += 1;
        else worst = Math.max(worst, away);
      }
    }
  }
  return { worst, seen, missing };
}

/** Which side of an outline a place is on, by the sides that its meridian crosses on the way to the North Pole, at sea. */
class Inside {
  readonly #bins: number[][] = Array.from({ length: 1440 }, () => []);
  readonly #xyz: Float64Array;
  readonly #next: Int32Array;

  constructor(rings: Rings) {
    this.#xyz = lonlatToXyz(rings.lonlat);
    this.#next = new Int32Array(this.#xyz.length / 3);
    for (let ring = 0; ring + 1 < rings.offsets.length; ++ring) {
      for (let k = rings.offsets[ring]; k < rings.offsets[ring + 1]; ++k) {
        const next = k + 1 < rings.offsets[ring + 1] ? k + 1 : rings.offsets[ring];
        this.#next[k] = next;
        const [a, b] = [rings.lonlat[2 * k], rings.lonlat[2 * next]];
        const east = a + ((((b - a + 180) % 360) + 360) % 360) - 180;
        const [low, high] = [Math.min(a, east), Math.max(a, east)].map((lon) => Math.floor((lon + 180) * 4));
        for (let bin = low - 1; bin <= high + 1; ++bin) this.#bins[((bin % 1440) + 1440) % 1440].push(k);
      }
    }
  }

  holds(v: Vector): boolean {
    const lon = (Math.atan2(v[1], v[0]) * 180) / Math.PI;
    let inside = false;
    for (const k of this.#bins[((Math.floor((lon + 180) * 4) % 1440) + 1440) % 1440]) {
      const [a, b] = [row(this.#xyz, k), row(this.#xyz, this.#next[k])];
      const [s, t] = [v[0] * a[1] - v[1] * a[0], v[0] * b[1] - v[1] * b[0]];
      if (s >= 0 === t >= 0) continue;
      const p = [0, 1, 2].map((i) => a[i] + (s / (s - t)) * (b[i] - a[i]));
      const along = p[0] * v[0] + p[1] * v[1];
      if (along > 0 && p[2] * (v[0] ** 2 + v[1] ** 2) > v[2] * along) inside = !inside;
    }
    return inside;
  }
}

const AT_SEA = lonlatToXyz([-123.4, -48.9]);

async function land(block: string): Promise<Rings> {
  const rings = await new Contents((name) => (name === "land-110m" ? block : null)).rings("land-110m");
  return rings!;
}

/** The share of the disc that a layer fills. */
function share(layer: ReturnType<typeof regionLayer>, map: MoebiusMap): number {
  const path = new Recorder();
  const pen = { draw: (_: string, trace: (path: Path) => void) => trace(path) } as unknown as Pen;
  layer.draw(pen, DISC, map.apply(layer.directions), map);
  return path.area() / (Math.PI * DISC.r ** 2);
}

/** Of each map: the share of the disc that is filled, and the share of places of the disc that are on land. */
export async function fills(block: string, count: number, grid: number): Promise<[number, number][]> {
  const rings = await land(block);
  const layer = regionLayer("land", null, lonlatToXyz(rings.lonlat), rings.offsets, row(AT_SEA, 0), false);
  const inside = new Inside(rings);
  const points: number[] = [];
  for (let i = 0; i < grid; ++i) {
    for (let j = 0; j < grid; ++j) {
      const [x, y] = [(2 * i + 1) / grid - 1, (2 * j + 1) / grid - 1];
      if (x * x + y * y < 1) points.push(x, y, Math.sqrt(1 - x * x - y * y));
    }
  }
  const places = Float64Array.from(points);
  return Array.from({ length: count }, (_, k) => {
    const map = lenses.seenThrough(MoebiusMap.fisheye(direction(), 10 ** (1.5 * random())), turnedAway(k, rings));
    const back = map.inverse().apply(places);
    let held = 0;
    for (let i = 0; i < back.length; i += 3) held += Number(inside.holds([back[i], back[i + 1], back[i + 2]]));
    return [share(layer, map), held / (places.length / 3)];
  });
}

/** Views of all kinds; some have behind them, without the lens, a coast, a lake or a pole to the last bit. */
function turnedAway(k: number, rings: Rings): View {
  const behind: [number, number][] = [
    [51, 42], // the Caspian Sea
    [0, -90],
    [0, 90],
    [180, -90],
  ];
  if (k % 5 === 0) return View.above(behind[(k / 5) % 4][0] + 180, -behind[(k / 5) % 4][1]);
  if (k % 5 === 1) {
    const point = Math.floor((random() * rings.lonlat.length) / 2);
    return View.above(rings.lonlat[2 * point] + 180, -rings.lonlat[2 * point + 1]);
  }
  return view();
}

/** Shares of the disc in a slow turn whose far side goes over Antarctica, its pole and its coasts. */
export async function slowTurn(block: string, frames: number): Promise<number[]> {
  const rings = await land(block);
  const layer = regionLayer("land", null, lonlatToXyz(rings.lonlat), rings.offsets, row(AT_SEA, 0), false);
  const lens = MoebiusMap.fisheye([10, 48], 3);
  return Array.from({ length: frames }, (_, k) =>
    share(layer, lenses.seenThrough(lens, View.above(20, 120 - (90 * k) / frames))),
  );
}

/** Areas of caps as they are filled, and by the ellipse's own geometry: the image of points of the ball. */
export function caps(count: number, grid: number): [number, number][] {
  return Array.from({ length: count }, () => {
    const center = direction();
    const radius = 179 * random() + 0.5;
    const circle = arcThrough(circlePoints(center, radius).flat(), 0, true)!;
    const path = new Recorder();
    traceCap(path, DISC, circle);
    let held = 0;
    let all = 0;
    for (let i = 0; i < grid; ++i) {
      for (let j = 0; j < grid; ++j) {
        const [x, y] = [(2 * i + 1) / grid - 1, (2 * j + 1) / grid - 1];
        if (x * x + y * y >= 1) continue;
        all += 1;
        held += Number(dot([x, y, Math.sqrt(1 - x * x - y * y)], center) > Math.cos((radius * Math.PI) / 180));
      }
    }
    return [Math.abs(path.area()) / (Math.PI * DISC.r ** 2), held / all];
  });
}

function disc(reach: number): Vector {
  const [size, turn] = [reach * Math.sqrt(random()), 2 * Math.PI * random()];
  return pointUnder(DISC, [DISC.x + DISC.r * size * Math.cos(turn), DISC.y + DISC.r * size * Math.sin(turn)]);
}

/** The largest distance, pixels, of what was grabbed from where the hand has it: free, north up, wheel and pinch. */
export function grabbed(count: number): Record<string, number> {
  const worst: Record<string, number> = { free: 0, north: 0, wheel: 0, out: 0 };
  const note = (name: string, a: Vector, b: Vector): void => {
    worst[name] = Math.max(worst[name], DISC.r * Math.hypot(a[0] - b[0], a[1] - b[1]));
  };
  for (let k = 0; k < count; ++k) {
    const [from, to] = [disc(0.98), disc(0.98)];
    note("free", pointUnder(DISC, [DISC.x + DISC.r * from[0], DISC.y - DISC.r * from[1]]), from);
    const start = view();
    note("free", start.dragged(from, to).seen(start.onBall(from)), to);
    // With north up: a hand that goes there in small steps, where the place can go.
    const level = View.above(360 * random(), 160 * random() - 80);
    const place = level.onBall(from);
    let now = level;
    for (let step = 1; step <= 40; ++step) {
      const t = step / 40;
      const [x, y] = [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
      const point: Vector = [x, y, Math.sqrt(1 - x * x - y * y)];
      now = now.holding(place, point);
      const isFree = Math.abs(x) < Math.hypot(place[0], place[1]) && Math.abs(now.middle[1]) < 89.999;
      if (isFree) note("north", now.seen(place), point);
      else break;
    }
    const sight = { lens: { focus: direction(), magnification: 10 ** random() }, view: level };
    const source = lenses.sourceOf(lenses.sightMap(sight), from);
    for (const [name, factor] of [
      ["wheel", 1.2],
      ["out", 0.8],
    ] as const) {
      for (const isNorthUp of [false, true]) {
        const next = lenses.magnified(sight, from, factor, isNorthUp);
        const image = lenses.imageOf(lenses.sightMap(next), source);
        if (!isNorthUp) note(name, image, from);
        else if (
          Math.abs(next.view.middle[1]) < 89.999 &&
          Math.abs(from[0]) < Math.hypot(...next.view.onBall(from).slice(0, 2)) - 1e-9
        )
          note(name, image, from);
      }
    }
  }
  return worst;
}
