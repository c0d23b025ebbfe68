/** The state of the Sphere room but for its sites, and how a link tells it. */

import { direction, fields, flag, place, whole, word, type Fields, type Place } from "../fields.ts";
import { lonlatToXyz } from "../kernel/api.ts";
import { directionOf, row, type Vector } from "../space.ts";
import { wrap } from "../words.ts";

export const CLICKS = ["keep", "add", "remove"] as const;

/** What a click does. */
export type Click = (typeof CLICKS)[number];

/** Decimals of a degree to which the hand moves sites and the pole. */
const HAND_DECIMALS = 3;

export interface SphereState {
  readonly pole: Place;
  readonly view: Place;
  /** Where the pointer was last, and whether the bubble there is kept. */
  readonly aim: Vector;
  readonly isPinned: boolean;
  /** Sites that are inserted; null for all of them, drawn as what they are in the end. */
  readonly step: number | null;
  /** The site that is held. */
  readonly held: number | null;
  readonly click: Click;
}

export const BEGINNING: SphereState = {
  pole: [-150, 53.1],
  view: [0, 0],
  aim: directionOf(-9.94, 3.49),
  isPinned: false,
  step: null,
  held: null,
  click: "keep",
};

/** Of so many sites. */
export function sphereFields(count: number): Fields<SphereState> {
  return fields<SphereState>({
    pole: place("pole-", HAND_DECIMALS),
    view: place("view-"),
    aim: direction("aim-"),
    isPinned: flag("pin"),
    step: whole("step", count),
    held: whole("held", count, 1),
    click: word("click", CLICKS),
  });
}

/** The direction of a place, as the kernel and Python have it. */
export function directionAt([lon, lat]: Place): Vector {
  return row(lonlatToXyz([lon, lat]), 0);
}

/** A place as the hand sets it. */
export function handPlace([lon, lat]: Place): Place {
  return [Number(wrap(lon).toFixed(HAND_DECIMALS)), Number(lat.toFixed(HAND_DECIMALS))];
}
