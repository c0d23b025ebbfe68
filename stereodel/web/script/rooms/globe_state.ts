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
/** 100 kilometres, degrees. */
const NEW_YORK_RADIUS = 0.9;

/** What the buttons under "Begin with" begin with. */
export const PRESETS: Readonly<Record<string, Partial<GlobeState>>> = {
  "figure-10": { lens: "fisheye", sight: figure(1) },
  "figure-11": { lens: "fisheye", sight: figure(4) },
  "figure-12": { lens: "fisheye", sight: figure(20) },
  "new-york": {
    lens: "bubble",
    from: { center: NEW_YORK, radius: NEW_YORK_RADIUS },
    to: { center: NEW_YORK, radius: 90 },
    before: View.above(-73.98, 40.75),
    after: View.above(-73.98, 40.75),
  },
};

/** The fourth panel of Figures 10 to 12: above the focus. */
function figure(magnification: number): Sight {
  return { lens: { focus: directionOf(0, 40), magnification }, view: View.above(0, 40) };
}

/** The five sides from which a fisheye is shown, by the numbers of the figures' panels. */
export function sideView(panel: number, focus: Vector): View {
  const [lon, lat] = lonLatOf(focus);
  return [
    View.above(lon, 0),
    View.above(lon, 90),
    View.above(lon, -90),
    View.above(lon, lat),
    View.above(lon + 180, -lat),
  ][panel - 1];
}

/** Digits behind the point of degrees and scales in links: finer than any pixel. */
const DIGITS = 7;

type Values = Record<string, string>;

export function toValues(state: GlobeState): Values {
  const { sight, from, to } = state;
  return {
    lens: state.lens,
    s: writeNumber(sight.lens.magnification, DIGITS),
    ...placeValues("focus", sight.lens.focus),
    ...viewValues("view", sight.view),
    ...placeValues("pointer", state.pointer),
    ...(state.lens === "bubble"
      ? {
          ...placeValues("from", from.center),
          fromradius: writeNumber(from.radius, DIGITS),
          ...placeValues("to", to.center),
          toradius: writeNumber(to.radius, DIGITS),
          ...viewValues("before", state.before),
          ...viewValues("after", state.after),
        }
      : {}),
  };
}

/** @throws LinkError where a value cannot be read. */
export function fromValues(values: LinkValues): GlobeState {
  const begin = BEGINNING;
  const cap = (name: string, otherwise: Cap): Cap => ({
    center: readPlace(values, name, otherwise.center),
    radius: values.number(`${name}radius`, LEAST_RADIUS, MOST_RADIUS, otherwise.radius),
  });
  const { lens, view } = begin.sight;
  return {
    lens: values.word("lens", ["fisheye", "bubble"], begin.lens),
    sight: {
      lens: {
        focus: readPlace(values, "focus", lens.focus),
        magnification: values.number("s", 1, MOST, lens.magnification),
      },
      view: readView(values, "view", view),
    },
    pointer: readPlace(values, "pointer", begin.pointer),
    from: cap("from", begin.from),
    to: cap("to", begin.to),
    before: readView(values, "before", begin.before),
    after: readView(values, "after", begin.after),
  };
}

function placeValues(name: string, direction: Vector): Values {
  return writePlace(name, lonLatOf(direction), DIGITS);
}

function viewValues(name: string, view: View): Values {
  const roll = writeNumber(view.roll, DIGITS);
  return { ...writePlace(name, view.middle, DIGITS), ...(roll === "0" ? {} : { [`${name}roll`]: roll }) };
}

function readPlace(values: LinkValues, name: string, otherwise: Vector): Vector {
  if (!values.has(`${name}lon`) && !values.has(`${name}lat`)) return otherwise;
  return directionOf(...values.place(name, lonLatOf(otherwise)));
}

function readView(values: LinkValues, name: string, otherwise: View): View {
  return View.above(...values.place(name, otherwise.middle), values.number(`${name}roll`, -360, 360, 0));
}
