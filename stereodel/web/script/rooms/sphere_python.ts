/** The Python lines that make the picture of the Sphere room. */

import { writeNumber } from "../link.ts";
import { MOST_WRITTEN, placesPython } from "./python_places.ts";
import type { SphereSites } from "./sphere_sites.ts";

/** What the picture shows beside the sites; degrees. */
export interface Shown {
  readonly file: string | null;
  readonly pole: readonly [number, number];
  readonly view: readonly [number, number];
  readonly aim: readonly [number, number] | null;
}

/** Lines that draw the ball and the plane into two files. */
export function spherePython(sites: SphereSites, { file, pole, view, aim }: Shown): string {
  const tangent = [pole[0] > 0 ? pole[0] - 180 : pole[0] + 180, -pole[1]] as const;
  const bubble = aim === null || sites.delaunay.dimension < 2 ? null : `lonlat_to_xyz(${pair(aim)})`;
  const read = file !== null || sites.count > MOST_WRITTEN;
  return [
    "import numpy as np",
    `from stereodel import SphericalDelaunay, SphericalVoronoi, Stereographic, lonlat_to_xyz`,
    "from stereodel.drawing import Scene, Sketch, View",
    ...(read ? ["from stereodel.io import read_points"] : []),
    "from stereodel.sphere import SphereCircle",
    "from stereodel.triangulation.theorem import planar_part",
    "",
    read
      ? `lonlat = read_points(${JSON.stringify(file ?? "sites.csv")}).lonlat`
      : `lonlat = ${placesPython(sites.lonlat)}`,
    "delaunay = SphericalDelaunay.from_lonlat(lonlat)",
    "voronoi = SphericalVoronoi(delaunay)",
    "",
    "ball = Scene()",
    'ball.add_edges(delaunay.points, delaunay.edges, name="delaunay")',
    'ball.add_arcs(voronoi.ridge_arcs(), name="voronoi")',
    ...(bubble === null
      ? []
      : [
          `triangle = delaunay.simplices[delaunay.find_simplex(${bubble})]`,
          "bubble = SphereCircle.through(*delaunay.points[triangle])",
          'ball.add_circles([bubble], name="accent2")',
        ]),
    'ball.add_points(delaunay.points, name="sites")',
    `ball.page(View(${pair(view).slice(1, -1)}), width=340).save("ball.svg")`,
    "",
    `pole = lonlat_to_xyz(${pair(pole)})`,
    `flat = Stereographic(${pair(tangent)}).forward(delaunay.points)`,
    "triangles = planar_part(delaunay, pole)",
    "edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)",
    "plane = Sketch()",
    'plane.add_edges(flat, edges, name="delaunay")',
    'plane.add_points(flat, name="sites")',
    "size = 1.07 * np.abs(flat).max()",
    'plane.page((-size, size, -size, size)).save("plane.svg")',
    "",
  ].join("\n");
}

function pair([lon, lat]: readonly [number, number]): string {
  return `(${writeNumber(lon, 4)}, ${writeNumber(lat, 4)})`;
}
