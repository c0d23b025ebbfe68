/** The Python lines that make the picture of a room. */

import { linesOf, type IsOn, type Part } from "../drawing/parts.ts";
import { writeNumber } from "../link.ts";
import { lonLatOf, type Vector } from "../space.ts";
import type { GlobeScene } from "./globe_scene.ts";
import type { GlobeState } from "./globe_state.ts";
import type { LiftScene } from "./lift_drawing.ts";
import type { SphereScene } from "./sphere_drawing.ts";
import type { SphereState } from "./sphere_state.ts";

/** Sites beyond which the lines name a file in place of the places. */
const MOST_WRITTEN = 200;

/** Lines that draw the ball and the plane into two files. @param file Of the sites, if they are of one. */
export function spherePython(
  { sites, isOn }: SphereScene,
  parts: readonly Part<never>[],
  { pole, view }: SphereState,
  file: string | null,
): string {
  const tangent = [pole[0] > 0 ? pole[0] - 180 : pole[0] + 180, -pole[1]] as const;
  const isRead = file !== null || sites.count > MOST_WRITTEN;
  return text(
    "import numpy as np",
    "from stereodel import SphericalDelaunay, SphericalVoronoi, Stereographic, lonlat_to_xyz",
    "from stereodel.drawing import Scene, Sketch, View",
    isRead && "from stereodel.io import read_points",
    "from stereodel.sphere import SphereCircle",
    "from stereodel.triangulation import planar_part",
    "",
    `lonlat = ${isRead ? `read_points(${quoted(file)}).lonlat` : written(sites.lonlat)}`,
    "delaunay = SphericalDelaunay.from_lonlat(lonlat)",
    "voronoi = SphericalVoronoi(delaunay)",
    "",
    "ball = Scene()",
    ...linesOf(parts, isOn, "ball"),
    `ball.page(View(${numbers(view)}), width=340).save("ball.svg")`,
    "",
    `pole = lonlat_to_xyz((${numbers(pole)}))`,
    `flat = Stereographic((${numbers(tangent)})).forward(delaunay.points)`,
    "triangles = planar_part(delaunay, pole)",
    "edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)",
    "plane = Sketch()",
    ...linesOf(parts, isOn, "plane"),
    "size = 1.07 * np.abs(flat).max()",
    'plane.page((-size, size, -size, size)).save("plane.svg")',
  );
}

/** Lines that draw the sheet or the ball. @param sides Of the rectangle, where it is not the smallest one. */
export function liftPython(
  { sites, sheet, height, isOn }: LiftScene,
  parts: readonly Part<never>[],
  side: number,
  file: string | null,
  sides?: readonly [number, number],
): string {
  const isRead = file !== null || sites.count > MOST_WRITTEN;
  const ball = [
    `sphere = Stereographic((0, -90), radius=lift.diagonal / 4 / np.tan(np.radians(${sheet.corner / 2})))`,
    "xyz = sphere.inverse(points - lift.center)[:, [1, 0, 2]] * [1, 1, -1]  # the point of contact on top",
    "",
    "ball = Scene()",
    ...linesOf(parts, isOn, "ball"),
    `ball.page(View(${side - 90}, ${height}), width=340).save("lift.svg")`,
    ...linesOf(parts, isOn, "pair"),
  ];
  return text(
    "import numpy as np",
    "from stereodel import PlanarDelaunay, RectangleLift, Stereographic, angular_distance",
    "from stereodel.drawing import Scene, View, diagram_page",
    "",
    isRead
      ? `points = np.loadtxt(${quoted(file)}, delimiter=",", skiprows=1)  # the columns x and y`
      : `points = ${written(sites.places)}`,
    `lift = ${sides === undefined ? "RectangleLift.fit(points)" : `RectangleLift(${sides.join(", ")})`}`,
    "sheet = PlanarDelaunay(points)",
    ...linesOf(parts, isOn, "sheet"),
    ...(sheet.isFlat ? [] : ball),
  );
}

/** Lines that draw the globe. */
export function globePython(state: GlobeState, { places, latitude, parts }: GlobeScene, isOn: IsOn): string {
  const { from, to } = state;
  const { focus, magnification } = state.sight.lens;
  const isBubble = state.lens === "bubble";
  const names = [isBubble && "SphereCircle", places !== null && "SphericalVoronoi"].filter(Boolean);
  const at = (direction: Vector): string => `(${lonLatOf(direction).map(float).join(", ")})`;
  const view = isBubble ? state.after : state.sight.view;
  const [roll, ...middle] = [view.roll, ...view.middle].map(float);
  return text(
    `from stereodel import ${[...names, isBubble ? "bubble_to_bubble" : "fisheye"].join(", ")}`,
    "from stereodel.drawing import View",
    "from stereodel.globe import Globe",
    places !== null && "from stereodel.io import read_points",
    "",
    isBubble && `taken = SphereCircle.around(${at(from.center)}, ${float(from.radius)})`,
    isBubble && `filled = SphereCircle.around(${at(to.center)}, ${float(to.radius)})`,
    isBubble
      ? "lens = bubble_to_bubble(taken, filled)"
      : `lens = fisheye(${at(focus)}, magnification=${float(magnification)})`,
    `globe = Globe(${places === null || latitude === "spherical" ? "" : `latitude="${latitude}"`})`,
    ...linesOf(parts, isOn, "globe"),
    `globe.save("globe.svg", lens, View(${[...middle, ...(roll === "0.0" ? [] : [roll])].join(", ")}))`,
  );
}

/** Lines, without those that are left out. */
function text(...lines: readonly (string | false)[]): string {
  return `${lines.filter((line) => line !== false).join("\n")}\n`;
}

/** The name of a file; sites that have none are to be saved as sites.csv. */
function quoted(file: string | null): string {
  return JSON.stringify(file ?? "sites.csv");
}

/** Pairs of coordinates as an array (n, 2) of Python, in lines of at most 88 letters. */
function written(values: Float64Array): string {
  const rows = Array.from({ length: values.length / 2 }, (_, k) => `[${values[2 * k]}, ${values[2 * k + 1]}]`);
  const lines: string[] = [];
  for (const row of rows) {
    const last = lines[lines.length - 1];
    if (last !== undefined && last.length + row.length < 84) lines[lines.length - 1] = `${last} ${row},`;
    else lines.push(`    ${row},`);
  }
  return lines.length === 0 ? "np.zeros((0, 2))" : `np.array([\n${lines.join("\n")}\n])`;
}

function numbers(pair: readonly [number, number]): string {
  return pair.map((value) => writeNumber(value, 4)).join(", ");
}

/** A number that is a float of Python, with at most four digits behind the point. */
function float(value: number): string {
  const short = writeNumber(value, 4);
  return short.includes(".") ? short : `${short}.0`;
}
