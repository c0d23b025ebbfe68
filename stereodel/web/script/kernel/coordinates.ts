/** Longitude and latitude to unit vectors and back. */

import { asDirections, asLonlat, type Numbers } from "./checks.ts";
import { computed } from "./instance.ts";

/**
 * Unit vectors of rows (longitude, latitude) in degrees: (cos lat cos lon, cos lat sin lon, sin lat), each component
 * rounded once.
 *
 * @param latitude "spherical" takes latitudes unchanged; the others take them as geodetic ones on WGS84, with the
 * direction from the Earth's centre ("geodetic") or the point on the sphere of equal area ("authalic").
 */
export function lonlatToXyz(lonlat: Numbers, latitude: Latitude = "spherical"): Float64Array {
  const rows = asLonlat(lonlat);
  const count = rows.length / 2;
  if (latitude === "spherical") return computed(3 * count, "lonlat_to_xyz", rows, count);
  return computed(3 * count, "ellipsoid_to_xyz", rows, count, latitude === "authalic" ? 1 : 0);
}

/**
 * Rows (longitude, latitude) in degrees of directions of any length: longitude in [-180, 180), each within an ulp.
 */
export function xyzToLonlat(xyz: Numbers): Float64Array {
  const rows = asDirections(xyz, "xyz");
  return computed((rows.length / 3) * 2, "xyz_to_lonlat", rows, rows.length / 3);
}

/** What a latitude may be: of the sphere unchanged, or of WGS84 with the direction from its centre or equal areas. */
export type Latitude = "spherical" | "geodetic" | "authalic";

/** Rows (longitude, latitude) as a table has them of what has these on the sphere: each step leaves 1/150 of the error. */
export function tableLonlat(onTheSphere: Float64Array, kind: Latitude): Float64Array {
  const rows = onTheSphere.slice();
  for (let step = 0; step < (kind === "spherical" ? 0 : 6); ++step) {
    const images = xyzToLonlat(lonlatToXyz(rows, kind));
    for (let k = 1; k < rows.length; k += 2) {
      rows[k] = Math.max(-90, Math.min(90, rows[k] + onTheSphere[k] - images[k]));
    }
  }
  return rows;
}
