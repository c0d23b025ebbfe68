/** What the package offers, but for the way its module is got. */

export { KernelError } from "./instance.ts";
export type { Numbers } from "./checks.ts";
export { lonlatToXyz, xyzToLonlat, type Latitude } from "./coordinates.ts";
export { PlanarDelaunay, SphericalDelaunay, type Inconclusive } from "./delaunay.ts";
export { PlanarVoronoi, SphericalVoronoi } from "./voronoi.ts";
export { inBubble, incircle, orient2d, orient3d, turn } from "./predicates.ts";
export { Directions, MoebiusMap } from "./moebius.ts";
export { Rotation } from "./rotation.ts";
export { Raster, type PixelPlace } from "./raster.ts";
