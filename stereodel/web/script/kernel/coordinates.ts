/** Longitude and latitude to unit vectors and back. */

import { asDirections, asLonlat, type Numbers } from "./checks.ts";
import { kernel } from "./instance.ts";

/**
 * Unit vectors of rows (longitude, latitude) in degrees: (cos lat cos lon, cos lat sin lon, sin lat), each component
 * rounded once.
 */
export function lonlatToXyz(lonlat: Numbers): Float64Array {
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
