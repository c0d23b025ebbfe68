/** What the web makes of a set of points, array by array, as hashes: compared with Python's by test_exact.py. */

import {
  inBubble,
  incircle,
  lonlatToXyz,
  MoebiusMap,
  orient2d,
  orient3d,
  PlanarDelaunay,
  PlanarVoronoi,
  Rotation,
  SphericalDelaunay,
  SphericalVoronoi,
  turn,
  xyzToLonlat,
} from "../../stereodel/web/script/kernel/api.ts";

type Values = Float64Array | Int32Array | Int8Array | Uint8Array;

/** SHA-256 of an array's bytes; every NaN is the same one. */
async function hash(values: Values): Promise<string> {
  const same = values instanceof Float64Array ? values.map((value) => (Number.isNaN(value) ? NaN : value)) : values;
  const bytes = new Uint8Array(same.buffer as ArrayBuffer, same.byteOffset, same.byteLength);
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

async function hashed(arrays: Record<string, Values>): Promise<Record<string, string>> {
  const names = Object.keys(arrays);
  const all = await Promise.all(names.map((name) => hash(arrays[name])));
  return Object.fromEntries(names.map((name, k) => [name, all[k]]));
}

/** Everything about a set, of the plane or of the sphere by the numbers in a row. */
export async function describe(points: Float64Array, width: number, queries: Float64Array): Promise<object> {
  const onSphere = width === 3;
  const triangulation = onSphere ? new SphericalDelaunay(points) : new PlanarDelaunay(points);
  const diagram =
    triangulation instanceof SphericalDelaunay
      ? new SphericalVoronoi(triangulation)
      : new PlanarVoronoi(triangulation as PlanarDelaunay);
  const { indptr, indices } = triangulation.vertexNeighborVertices;
  const { filter, curvature, doubleDouble, exact } = triangulation.inconclusive;
  const arrays: Record<string, Values> = {
    simplices: triangulation.simplices,
    neighbors: triangulation.neighbors,
    duplicates: triangulation.duplicates,
    counts: Float64Array.of(triangulation.dimension, filter, curvature, doubleDouble, exact),
    edges: triangulation.edges,
    indptr,
    indices,
    convex_hull: triangulation.convexHull,
    circumcenters: triangulation.circumcenters,
    vertices: diagram.vertices,
    region_offsets: diagram.regionOffsets,
    region_indices: diagram.regionIndices,
    region_neighbors: diagram.regionNeighbors,
    point_region: diagram.pointRegion,
    simplex_vertex: diagram.simplexVertex,
    ridge_points: diagram.ridgePoints,
    ridge_vertices: diagram.ridgeVertices,
    areas: diagram.areas(),
    centroids: diagram.centroids(),
    find_simplex: triangulation.findSimplex(queries),
  };
  if (triangulation instanceof SphericalDelaunay) {
    arrays["closing"] = triangulation.closing;
    arrays["lonlat"] = xyzToLonlat(points);
    arrays["ridge_normals"] = (diagram as SphericalVoronoi).ridgeNormals();
  }
  if (triangulation.size > 0) {
    arrays["nearest"] = triangulation.nearest(queries);
    arrays["nearest_few"] = triangulation.nearest(queries, Math.min(5, triangulation.size));
    triangulation.insert(queries.subarray(0, width));
    arrays["inserted"] = triangulation.simplices;
    arrays["number"] = triangulation.remove([0]);
    arrays["removed"] = triangulation.simplices;
    arrays["left"] = triangulation.duplicates;
  }
  return hashed(arrays);
}

/** Signs of rows of points; the predicate by its name in Python. */
export function signs(name: string, rows: Float64Array[]): Promise<string> {
  const predicates = {
    orient2d,
    incircle,
    orient3d,
    in_bubble: inBubble,
    turn,
  } as Record<string, (...points: Float64Array[]) => Int8Array>;
  return hash(predicates[name](...rows));
}

/** Unit vectors of longitude and latitude of the ellipsoid. */
export function ellipsoid(lonlat: Float64Array): Promise<object> {
  return hashed({
    geodetic: lonlatToXyz(lonlat, "geodetic"),
    authalic: lonlatToXyz(lonlat, "authalic"),
  });
}

/** Maps made in the same ways, and what they make of directions. */
export async function maps(lonlat: Float64Array, magnifications: number[]): Promise<object[]> {
  const xyz = lonlatToXyz(lonlat);
  const found = [];
  for (const [k, magnification] of magnifications.entries()) {
    const lens = MoebiusMap.fisheye(lonlat.subarray(2 * k, 2 * k + 2), magnification);
    const turned = MoebiusMap.rotation(Rotation.about(lonlat.subarray(2 * k + 2, 2 * k + 4), 10 * k + 0.1));
    const both = lens.after(turned).after(MoebiusMap.fisheye(xyz.subarray(3 * k + 9, 3 * k + 12), 2.5));
    for (const map of [lens, both, both.inverse(), lens.after(lens.inverse())]) {
      found.push(
        await hashed({
          parameters: Float64Array.of(...map.left.quaternion, map.magnification, ...map.right.quaternion),
          focus: map.focus,
          images: map.apply(xyz),
          scales: map.scaleFactor(xyz),
          lonlat: map.lonlat(lonlat),
        }),
      );
    }
  }
  return found;
}
