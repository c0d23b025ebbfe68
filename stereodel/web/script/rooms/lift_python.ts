/** The Python lines that make the picture of the Lift room. */

import type { Sheet } from "./lift_sheet.ts";
import type { LiftSites } from "./lift_sites.ts";
import { MOST_WRITTEN, placesPython } from "./python_places.ts";

/** What the picture shows beside the sites; degrees. */
export interface Shown {
  /** Of the rectangle, where it is not the smallest one. */
  readonly sides: readonly [number, number] | undefined;
  readonly file: string | null;
  readonly height: number;
  readonly side: number;
  readonly p: number | null;
  readonly q: number | null;
}

export function liftPython(sites: LiftSites, sheet: Sheet, shown: Shown): string {
  const { sides } = shown;
  const read = shown.file !== null || sites.count > MOST_WRITTEN;
  const file = JSON.stringify(shown.file ?? "sites.csv");
  const ball = [
    `sphere = Stereographic((0, -90), radius=lift.diagonal / 4 / np.tan(np.radians(${sheet.corner / 2})))`,
    "xyz = sphere.inverse(points - lift.center)[:, [1, 0, 2]] * [1, 1, -1]  # the point of contact on top",
    "",
    "ball = Scene()",
    'ball.add_edges(xyz, sheet.edges, name="delaunay")',
    'ball.add_points(xyz, name="sites")',
    `ball.page(View(${shown.side - 90}, ${shown.height}), width=340).save("lift.svg")`,
    ...(shown.p === null || shown.q === null ? [] : [`print(angular_distance(xyz[${shown.p}], xyz[${shown.q}]))`]),
  ];
  const flat = ['diagram_page(sheet).save("sheet.svg")'];
  return [
    "import numpy as np",
    "from stereodel import PlanarDelaunay, RectangleLift, Stereographic, angular_distance",
    "from stereodel.drawing import Scene, View, diagram_page",
    "",
    read
      ? `points = np.loadtxt(${file}, delimiter=",", skiprows=1)  # the columns x and y`
      : `points = ${placesPython(sites.places)}`,
    sides === undefined ? "lift = RectangleLift.fit(points)" : `lift = RectangleLift(${sides.join(", ")})`,
    "sheet = PlanarDelaunay(points)",
    ...(sheet.isFlat ? flat : ball),
    "",
  ].join("\n");
}
