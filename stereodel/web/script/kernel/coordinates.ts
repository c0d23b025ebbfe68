/** Longitude and latitude to unit vectors and back. */

import { asDirections, asLonlat, type Numbers } from "./checks.ts";
import { computed } from "./instance.ts";
import { ellipsoidToXyz, type Latitude } from "./latitudes.ts";

/**
 * Unit vectors of rows (longitude, latitude) in degrees: (cos lat cos lon, cos lat sin lon, sin lat), each component
 * rounded once.
 *
 * @param latitude "spherical" takes latitudes unchanged; the others take them as geodetic ones on WGS84, with the
 * direction from the Earth's centre ("geodetic") or the point on the sphere of equal area ("authalic").
 */
export function lonlatToXyz(lonlat: Numbers, latitude: Latitude = "spherical"): Float64Array {
  if (latitude !== "spherical") return ellipsoidToXyz(asLonlat(lonlat), latitude);
  const rows = asLonlat(lonlat);
  return computed((rows.length / 2) * 3, "lonlat_to_xyz", rows, rows.length / 2);
}

/**
 * Rows (longitude, latitude) in degrees of directions of any length: longitude in [-180, 180), each within an ulp.
 */
export function xyzToLonlat(xyz: Numbers): Float64Array {
  const rows = asDirections(xyz, "xyz");
  return computed((rows.length / 3) * 2, "xyz_to_lonlat", rows, rows.length / 3);
}
