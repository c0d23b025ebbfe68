/** The state of the Sphere room but for its sites, and how a link tells it. */

import { lonlatToXyz } from "../kernel/api.ts";
import { writePlace, type LinkValues } from "../link.ts";
import { lonLatOf, row, type Vector } from "../space.ts";
import { wrap } from "../words.ts";

/** Longitude and latitude, degrees. */
export type Place = readonly [number, number];

export const CLICKS = ["keep", "add", "remove"] as const;

/** What a click does. */
export type Click = (typeof CLICKS)[number];

/** How the room begins: degrees. */
const POLE: Place = [-150, 53.1];
export const VIEW: Place = [0, 0];
const AIM: Place = [-9.94, 3.49];

/** Decimals of a degree to which the view is held: what they leave out is invisible, so a link shows the same pixels. */
const VIEW_DECIMALS = 4;

/** Decimals of a degree to which the hand moves things. */
const HAND_DECIMALS = 3;

export interface SphereState {
  pole: Place;
  view: Place;
  /** Where the pointer was last, and whether the bubble there is kept. */
  aim: Vector;
  isPinned: boolean;
  /** Sites that are inserted; null for all of them, drawn as what they are in the end. */
  step: number | null;
  readonly click: Click;
}

/** The values of a link; what is as in the beginning is left out. */
export function toValues({ pole, view, aim, isPinned, step, click }: SphereState): Record<string, string> {
  const values: Record<string, string> = {};
  const put = (name: string, value: Place, otherwise: Place): void => {
    if (value[0] === otherwise[0] && value[1] === otherwise[1]) return;
    Object.assign(values, writePlace(`${name}-`, value, VIEW_DECIMALS));
  };
  put("pole", pole, POLE);
  put("view", view, VIEW);
  if (isPinned) {
    put("aim", handPlace(lonLatOf(aim)), AIM);
    values["pin"] = "1";
  }
  if (step !== null) values["step"] = String(step);
  if (click !== "keep") values["click"] = click;
  return values;
}

/**
 * The state that a link tells of `count` sites.
 * @throws LinkError where it cannot be read.
 */
export function fromValues(values: LinkValues, count: number): SphereState {
  const step = values.whole("step", 1, count, 0);
  return {
    pole: values.place("pole-", POLE),
    view: values.place("view-", VIEW),
    aim: directionAt(values.place("aim-", AIM)),
    isPinned: values.has("pin"),
    step: step === 0 || step === count ? null : step,
    click: values.word("click", CLICKS, "keep"),
  };
}

/** The direction of a place, as the kernel and Python have it. */
export function directionAt([lon, lat]: Place): Vector {
  return row(lonlatToXyz([lon, lat]), 0);
}

/** A place as the hand sets it. */
export function handPlace(place: Place): Place {
  return rounded(place, HAND_DECIMALS);
}

/** A view as a link holds it. */
export function viewPlace(place: Place): Place {
  return rounded(place, VIEW_DECIMALS);
}

function rounded([lon, lat]: Place, decimals: number): Place {
  return [Number(wrap(lon).toFixed(decimals)), Number(lat.toFixed(decimals))];
}
