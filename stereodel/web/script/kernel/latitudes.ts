/**
 * Latitudes of the WGS84 ellipsoid of those on a sphere, in doubles, for what is shown and written; the way there is the
 * kernel's. stereodel/sphere/latitudes.py has the formulas.
 */

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
