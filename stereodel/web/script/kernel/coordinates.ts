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

const FLATTER = 297257223563 / 298257223563; // 1 − f
const POLAR = FLATTER ** 2;
const E2 = 1 - POLAR;

/** Terms of P. */
const P = Array.from({ length: 15 }, (_, k) => (E2 ** k * (k + 1)) / (2 * k + 1));
/** Those of D: the sums of all later ones of P. */
const D = P.slice(1).map((_, k) => P.slice(k + 1).reduceRight((sum, term) => sum + term));

const polynomial = (terms: readonly number[], t: number): number =>
  terms.reduceRight((total, term) => total * t + term);
const P_AT_POLE = polynomial(P, 1);

const DEGREES = 180 / Math.PI;

/** The latitude of a table of what has this latitude on the sphere, degrees, to some ulps: Newton's method. */
export function tableLatitude(onTheSphere: number, kind: Latitude): number {
  if (kind === "spherical") return onTheSphere;
  const [z, rho] = [Math.sin(onTheSphere / DEGREES), Math.cos(onTheSphere / DEGREES)];
  if (kind === "geodetic") return Math.atan2(z, POLAR * rho) * DEGREES;
  let latitude = Math.atan2(z, FLATTER ** (4 / 3) * rho);
  for (let step = 0; step < 2; ++step) {
    const [s, c] = [Math.sin(latitude), Math.cos(latitude)];
    const p = polynomial(P, s * s);
    const r = Math.sqrt(p * p + (P_AT_POLE + p) * polynomial(D, s * s));
    latitude += ((z * c * r - rho * s * p) / (rho * c * r + z * s * p)) * (1 - E2 * s * s) ** 2 * r;
  }
  return latitude * DEGREES;
}
