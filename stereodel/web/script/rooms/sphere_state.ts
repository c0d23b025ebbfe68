/** The state of the Sphere room but for its sites, and how a link tells it. */

import { direction, fields, flag, number, place, view, whole, word, type Fields, type Place } from "../fields.ts";
import { lonlatToXyz } from "../kernel/api.ts";
import { directionOf, row, type Vector } from "../space.ts";
import { fitted } from "../view/fit.ts";
import type { Lens, Sight } from "../view/lens.ts";
import { View } from "../view/view.ts";
import { wrap } from "../words.ts";

/** Decimals of a degree to which the hand moves sites and the pole: those of sites where nothing is magnified. */
const HAND_DECIMALS = 3;

/** Sites some metres apart fill the ball at the largest magnification; its focus has digits for that. */
export const MOST = 1e6;
const FOCUS_DECIMALS = 12;

export interface SphereState extends Sight {
  readonly pole: Place;
  /** Where the pointer was last, and whether the bubble there is kept. */
  readonly aim: Vector;
  readonly isPinned: boolean;
  /** Sites that are inserted; null for all of them, drawn as what they are in the end. */
  readonly step: number | null;
  /** The site that is held. */
  readonly held: number | null;
  /** What a click does. */
  readonly click: "keep" | "add" | "remove";
}

export const BEGINNING: SphereState = {
  pole: [-150, 53.1],
  view: View.above(0, 0),
  lens: { focus: [1, 0, 0], magnification: 1 },
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
    view: view("view-"),
    lens: fields<Lens>({ magnification: number("s", 1, MOST), focus: direction("focus-", FOCUS_DECIMALS) }),
    aim: direction("aim-"),
    isPinned: flag("pin"),
    step: whole("step", count),
    held: whole("held", count, 1),
    click: word("click", ["keep", "add", "remove"]),
  });
}

/** The magnification from which on sites are so close together that the room begins with the lens on them. */
const CLOSE = 6;

/** How sites are seen that lie close together; nothing for others. */
export function sightOf(lonlat: Float64Array): Sight | null {
  const sight = lonlat.length > 2 ? fitted(lonlat, MOST, FOCUS_DECIMALS) : null;
  return sight !== null && sight.lens.magnification > CLOSE ? sight : null;
}

/** The direction of a place, as the kernel and Python have it. */
export function directionAt([lon, lat]: Place): Vector {
  return row(lonlatToXyz([lon, lat]), 0);
}

/** A place as the hand sets it, where the ball is magnified so many times. */
export function handPlace([lon, lat]: Place, magnification = 1): Place {
  const decimals = HAND_DECIMALS + Math.max(0, Math.ceil(Math.log10(magnification)));
  return [Number(wrap(lon).toFixed(decimals)), Number(lat.toFixed(decimals))];
}
