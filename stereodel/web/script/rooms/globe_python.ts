/** The Python lines that make the same globe. */

import { fixed } from "../words.ts";
import type { View } from "../view/view.ts";
import { CIRCLE_RADIUS, STEP } from "./globe_scene.ts";
import type { GlobeScene } from "./globe_scene.ts";
import type { GlobeState } from "./globe_state.ts";
import { lonLatOf } from "./space.ts";
import type { Vector } from "./space.ts";

export function globePython(state: GlobeState, { places, picture, latitude }: GlobeScene): string {
  const { drawn, lens } = state;
  const file = places?.name ?? null;
  const hasLand = drawn.land && picture === null;
  const isBubble = lens === "bubble";
  const names = isBubble ? "SphereCircle, bubble_to_bubble" : "fisheye";
  const withCells = file !== null;
  const kind = latitude === "spherical" ? "" : `latitude="${latitude}"`;
  return [
    `from stereodel import ${withCells ? `SphericalVoronoi, ${names}`.split(", ").sort(byPython).join(", ") : names}`,
    "from stereodel.drawing import View",
    "from stereodel.globe import Globe",
    ...(withCells ? ["from stereodel.io import read_points"] : []),
    "",
    ...(isBubble ? bubbleLines(state) : fisheyeLines(state)),
    `globe = Globe(${withCells ? kind : ""})`,
    ...(picture === null ? [] : [`globe.add_raster(${JSON.stringify(picture.name)})`]),
    ...(hasLand ? ['globe.add_land(resolution="50m")'] : []),
    ...(drawn.graticule ? [`globe.add_graticule(${number(STEP)})`] : []),
    ...(hasLand ? ['globe.add_coastlines(resolution="50m")'] : []),
    ...(drawn.tissot ? [`globe.add_tissot(${number(STEP)}, ${CIRCLE_RADIUS.toFixed(4)})`] : []),
    ...(withCells ? placeLines(file, drawn.cells, kind) : []),
    `globe.save("globe.svg", lens, ${viewText(isBubble ? state.after : state.sight.view)})`,
    "",
  ].join("\n");
}

function byPython(a: string, b: string): number {
  return a < b ? -1 : 1;
}

function fisheyeLines({ sight }: GlobeState): string[] {
  const { focus, magnification } = sight.lens;
  return [`lens = fisheye(${place(focus)}, magnification=${number(magnification)})`];
}

function bubbleLines({ from, to }: GlobeState): string[] {
  const circle = (center: Vector, radius: number): string => `SphereCircle.around(${place(center)}, ${number(radius)})`;
  return [
    `taken = ${circle(from.center, from.radius)}`,
    `filled = ${circle(to.center, to.radius)}`,
    "lens = bubble_to_bubble(taken, filled)",
  ];
}

function placeLines(file: string, withCells: boolean, kind: string): string[] {
  return [
    `places = read_points(${JSON.stringify(file)}).lonlat`,
    ...(withCells
      ? [`globe.add_cells(SphericalVoronoi.from_lonlat(${["places", kind].filter(Boolean).join(", ")}))`]
      : []),
    "globe.add_points(places)",
  ];
}

function place(direction: Vector): string {
  const [lon, lat] = lonLatOf(direction);
  return `(${number(lon)}, ${number(lat)})`;
}

function viewText(view: View): string {
  const roll = number(view.roll);
  const [lon, lat] = view.middle.map(number);
  return roll === "0.0" ? `View(${lon}, ${lat})` : `View(${lon}, ${lat}, ${roll})`;
}

/** A float of Python, with four digits behind the point at the most. */
function number(value: number): string {
  const text = fixed(value, 4).replace("\u2212", "-").replace(/0+$/, "");
  return text.endsWith(".") ? `${text}0` : text;
}
