/** Longitude and latitude to unit vectors and back. */

import { asDirections, asLonlat, type Numbers } from "./checks.ts";
import { computed } from "./instance.ts";
import type { Latitude } from "./latitudes.ts";

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
