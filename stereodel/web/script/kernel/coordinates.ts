/** Longitude and latitude to unit vectors and back. */

import { asDirections, asLonlat, type Numbers } from "./checks.ts";
import { kernel } from "./instance.ts";
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
  return converted("lonlat_to_xyz", asLonlat(lonlat), 2, 3);
}

/**
 * Rows (longitude, latitude) in degrees of directions of any length: longitude in [-180, 180), each within an ulp.
 */
export function xyzToLonlat(xyz: Numbers): Float64Array {
  return converted("xyz_to_lonlat", asDirections(xyz, "xyz"), 3, 2);
}

function converted(name: string, rows: Float64Array, from: number, to: number): Float64Array {
  return kernel().run((session) => {
    const count = rows.length / from;
    const out = session.place(Float64Array, to * count);
    session.call(name, rows, count, out);
    return out.copy();
  });
}
