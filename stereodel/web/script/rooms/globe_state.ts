/** The state of the Globe room, and how links hold it. */

import { writeNumber, writePlace, type LinkValues } from "../link.ts";
import { directionOf, lonLatOf, type Vector } from "../space.ts";
import { MOST, type Cap, type Sight } from "../view/lens.ts";
import { View } from "../view/view.ts";

export interface GlobeState {
  readonly lens: "fisheye" | "bubble";
  /** Of the fisheye. */
  readonly sight: Sight;
  /** The direction of the Earth that the pointer was on last. */
  readonly pointer: Vector;
  /** The bubble that is taken and the one that it fills. */
  readonly from: Cap;
  readonly to: Cap;
  /** Where the globes of both bubbles are seen from. */
  readonly before: View;
  readonly after: View;
}

const CENTRAL_EUROPE = directionOf(10, 48);

export const BEGINNING: GlobeState = {
  lens: "fisheye",
  sight: { lens: { focus: CENTRAL_EUROPE, magnification: 3 }, view: View.above(-8, 20) },
  pointer: directionOf(0, 20),
  from: { center: CENTRAL_EUROPE, radius: 14 },
  to: { center: CENTRAL_EUROPE, radius: 72 },
  before: View.above(10, 42),
  after: View.above(10, 42),
};

/** Degrees of the smallest bubble and of the largest: the complement of the smallest. */
export const LEAST_RADIUS = 0.1;
export const MOST_RADIUS = 180 - LEAST_RADIUS;

const NEW_YORK = directionOf(-73.98, 40.75);
const ABOVE_NEW_YORK = View.above(-73.98, 40.75);

/** What the buttons under "Begin with" begin with. */
export const PRESETS: Readonly<Record<string, Partial<GlobeState>>> = {
  "figure-10": { lens: "fisheye", sight: figure(1) },
  "figure-11": { lens: "fisheye", sight: figure(4) },
  "figure-12": { lens: "fisheye", sight: figure(20) },
  // 100 kilometres become a hemisphere.
  "new-york": {
    lens: "bubble",
    from: { center: NEW_YORK, radius: 0.9 },
    to: { center: NEW_YORK, radius: 90 },
    before: ABOVE_NEW_YORK,
    after: ABOVE_NEW_YORK,
    pointer: BEGINNING.pointer,
  },
};

/** The fourth panel of Figures 10 to 12: above the focus. */
function figure(magnification: number): Sight {
  return { lens: { focus: directionOf(0, 40), magnification }, view: View.above(0, 40) };
}

/** The five sides from which a fisheye is shown, by the numbers of the figures' panels. */
export function sideView(panel: number, focus: Vector): View {
  const [lon, lat] = lonLatOf(focus);
  const across = View.above(lon + 180, -lat);
  return [View.above(lon, 0), View.above(lon, 90), View.above(lon, -90), View.above(lon, lat), across][panel - 1];
}

/** Digits behind the point of degrees and scales in links: finer than any pixel. */
const DIGITS = 7;

export function toValues({ lens, sight, pointer, from, to, before, after }: GlobeState): Record<string, string> {
  const number = (value: number): string => writeNumber(value, DIGITS);
  const place = (name: string, at: Vector) => writePlace(name, lonLatOf(at), DIGITS);
  const cap = (name: string, { center, radius }: Cap) => ({
    ...place(name, center),
    [`${name}radius`]: number(radius),
  });
  const view = (name: string, seen: View) => {
    const roll = number(seen.roll);
    return { ...writePlace(name, seen.middle, DIGITS), ...(roll === "0" ? {} : { [`${name}roll`]: roll }) };
  };
  const shown = { lens, s: number(sight.lens.magnification), ...place("focus", sight.lens.focus) };
  const values = { ...shown, ...view("view", sight.view), ...place("pointer", pointer) };
  if (lens === "fisheye") return values;
  return { ...values, ...cap("from", from), ...cap("to", to), ...view("before", before), ...view("after", after) };
}

/** @throws LinkError where a value cannot be read. */
export function fromValues(values: LinkValues, begin = BEGINNING): GlobeState {
  const place = (name: string, otherwise: Vector): Vector =>
    values.has(`${name}lon`) || values.has(`${name}lat`)
      ? directionOf(...values.place(name, lonLatOf(otherwise)))
      : otherwise;
  const view = (name: string, otherwise: View): View =>
    View.above(...values.place(name, otherwise.middle), values.number(`${name}roll`, -360, 360, 0));
  const cap = (name: string, otherwise: Cap): Cap => ({
    center: place(name, otherwise.center),
    radius: values.number(`${name}radius`, LEAST_RADIUS, MOST_RADIUS, otherwise.radius),
  });
  const focus = place("focus", begin.sight.lens.focus);
  const magnification = values.number("s", 1, MOST, begin.sight.lens.magnification);
  return {
    lens: values.word("lens", ["fisheye", "bubble"], begin.lens),
    sight: { lens: { focus, magnification }, view: view("view", begin.sight.view) },
    pointer: place("pointer", begin.pointer),
    from: cap("from", begin.from),
    to: cap("to", begin.to),
    before: view("before", begin.before),
    after: view("after", begin.after),
  };
}
