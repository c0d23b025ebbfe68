/** The state of the Globe room, and how links hold it. */

import { direction, fields, number, view, word, type Field, type Fields } from "../fields.ts";
import { directionOf, lonLatOf, type Vector } from "../space.ts";
import { MOST, type Cap, type Lens, type Sight } from "../view/lens.ts";
import { View } from "../view/view.ts";
import { latitude, longitude, scale } from "../words.ts";

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

/** What the room begins with where places are to be in sight. */
export function beginningOf(sight: Sight | null): GlobeState {
  if (sight === null) return BEGINNING;
  const [{ view }, center] = [sight, sight.lens.focus];
  const [from, to] = [BEGINNING.from, BEGINNING.to].map(({ radius }) => ({ center, radius }));
  return { ...BEGINNING, sight, from, to, before: view, after: view };
}

/** Degrees of the smallest bubble and of the largest: the complement of the smallest. */
const LEAST_RADIUS = 0.1;
const MOST_RADIUS = 180 - LEAST_RADIUS;

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

const cap = (name: string): Field<Cap> =>
  fields({ center: direction(name), radius: number(`${name}radius`, LEAST_RADIUS, MOST_RADIUS) });

/** @param least Magnification, and the largest. */
export function sightField(least: number, most: number): Fields<Sight> {
  const lens = fields<Lens>({ magnification: number("s", least, most), focus: direction("focus") });
  return fields<Sight>({ lens, view: view("view") });
}

export const GLOBE = fields<GlobeState>({
  lens: word("lens", ["fisheye", "bubble"]),
  sight: sightField(1, MOST),
  pointer: direction("pointer"),
  from: cap("from"),
  to: cap("to"),
  before: view("before"),
  after: view("after"),
});

export function placeWords(direction: Vector): string {
  const [lon, lat] = lonLatOf(direction);
  return `${latitude(lat)} ${longitude(lon)}`;
}

/** What is seen, for those who do not see it. */
export function sightWords({ lens, view }: Sight): string {
  const seen = placeWords(view.onBall([0, 0, 1]));
  return `${scale(lens.magnification)} times at ${placeWords(lens.focus)}, seen from ${seen}`;
}
