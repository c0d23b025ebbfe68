/** The state of the Globe room, and how links hold it. */

import { writeNumber } from "../link.ts";
import type { LinkValues } from "../link.ts";
import { MOST } from "../view/lens.ts";
import type { Cap, Sight } from "../view/lens.ts";
import { View } from "../view/view.ts";
import type { Drawn } from "./globe_scene.ts";
import { directionOf, lonLatOf } from "./space.ts";
import type { Vector } from "./space.ts";

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
  readonly drawn: Drawn;
  readonly isNorthUp: boolean;
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
  drawn: { land: true, graticule: true, tissot: true, cells: false },
  isNorthUp: true,
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
  const { sight, from, to, drawn } = state;
  const off = (["land", "graticule", "tissot"] as const).filter((name) => !drawn[name]);
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
    ...(off.length > 0 ? { off: off.join(",") } : {}),
    ...(drawn.cells ? { cells: "1" } : {}),
    ...(state.isNorthUp ? {} : { north: "0" }),
  };
}

/** @throws LinkError where a value cannot be read. */
export function fromValues(values: LinkValues): GlobeState {
  const begin = BEGINNING;
  const off = values.text("off", "").split(",");
  const isOn = (name: string): boolean => !off.includes(name);
  const isNorthUp = values.word("north", ["0", "1"], "1") === "1";
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
    drawn: {
      land: isOn("land"),
      graticule: isOn("graticule"),
      tissot: isOn("tissot"),
      cells: values.word("cells", ["0", "1"], "0") === "1",
    },
    isNorthUp,
  };
}

function placeValues(name: string, direction: Vector): Values {
  const [lon, lat] = lonLatOf(direction);
  return { [`${name}lon`]: writeNumber(lon, DIGITS), [`${name}lat`]: writeNumber(lat, DIGITS) };
}

function viewValues(name: string, view: View): Values {
  const [lon, lat] = view.middle;
  const roll = writeNumber(view.roll, DIGITS);
  return {
    [`${name}lon`]: writeNumber(lon, DIGITS),
    [`${name}lat`]: writeNumber(lat, DIGITS),
    ...(roll === "0" ? {} : { [`${name}roll`]: roll }),
  };
}

function readLonLat(values: LinkValues, name: string, [lon, lat]: [number, number]): [number, number] {
  return [values.number(`${name}lon`, -360, 360, lon), values.number(`${name}lat`, -90, 90, lat)];
}

function readPlace(values: LinkValues, name: string, otherwise: Vector): Vector {
  if (!values.has(`${name}lon`) && !values.has(`${name}lat`)) return otherwise;
  return directionOf(...readLonLat(values, name, lonLatOf(otherwise)));
}

function readView(values: LinkValues, name: string, otherwise: View): View {
  const roll = values.number(`${name}roll`, -360, 360, 0);
  return View.above(...readLonLat(values, name, otherwise.middle), roll);
}
