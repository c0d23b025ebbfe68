/**
 * Latitudes of the WGS84 ellipsoid as latitudes of a sphere: forth in double-double, operation by operation as in
 * stereodel/sphere/latitudes.py, which has the formulas, so that points have the same bits; back in doubles, for what is
 * shown and written.
 */

import { DoubleDouble } from "./double_double.ts";
import { kernel } from "./instance.ts";

/** What a latitude may be: of the sphere unchanged, or of WGS84 with the direction from its centre or equal areas. */
export type Latitude = "spherical" | "geodetic" | "authalic";

const exact = (value: number): DoubleDouble => new DoubleDouble(value);

const FLATTER = exact(297257223563).over(exact(298257223563)); // 1 − f
const POLAR = FLATTER.times(FLATTER);
const E2 = exact(1e9)
  .over(exact(298257223563))
  .times(FLATTER.plus(exact(1)));

/** Terms of P, and those of them that need double-double. */
const TERMS = 15;
const PAIRS = 5;

const P: DoubleDouble[] = [];
for (let k = 0, power = exact(1); k < TERMS; ++k, power = power.times(E2)) {
  P.push(power.times(exact(k + 1)).over(exact(2 * k + 1)));
}

/** Those of D: the sums of all later ones of P. */
const D: DoubleDouble[] = [];
for (let k = TERMS - 1, sum = exact(0); k > 0; --k) D.unshift((sum = sum.plus(P[k])));

/** Horner's rule: small terms of high order in doubles. */
function polynomial(terms: readonly DoubleDouble[], t: DoubleDouble): DoubleDouble {
  let tail = 0;
  for (let k = terms.length - 1; k >= PAIRS; --k) tail = (tail + terms[k].hi) * t.hi;
  let total = exact(tail);
  for (let k = PAIRS - 1; k > 0; --k) total = total.plus(terms[k]).times(t);
  return total.plus(terms[0]);
}

const P_AT_POLE = polynomial(P, exact(1));

/** Sine and cosine on the sphere of those of a latitude of the ellipsoid. */
function onSphere(sine: DoubleDouble, cosine: DoubleDouble, kind: Latitude): [DoubleDouble, DoubleDouble] {
  if (kind === "geodetic") {
    const low = POLAR.times(sine);
    const length = low.times(low).plus(cosine.times(cosine)).sqrt();
    return [low.over(length), cosine.over(length)];
  }
  const t = sine.times(sine);
  const p = polynomial(P, t);
  const r = p
    .times(p)
    .plus(P_AT_POLE.plus(p).times(polynomial(D, t)))
    .sqrt();
  return [sine.times(p).over(P_AT_POLE), cosine.times(r).over(P_AT_POLE)];
}

/** Unit vectors of rows (longitude, latitude of the ellipsoid) in degrees, each component rounded once. */
export function ellipsoidToXyz(lonlat: Float64Array, kind: Latitude): Float64Array {
  const parts = kernel().run((session) => {
    const out = session.place(Float64Array, 4 * lonlat.length);
    session.call("sin_cos_degrees", lonlat, lonlat.length, out);
    return out.copy();
  });
  const pair = (k: number): DoubleDouble => new DoubleDouble(parts[k], parts[k + 1]);
  const xyz = new Float64Array((3 * lonlat.length) / 2);
  for (let k = 0; 2 * k < lonlat.length; ++k) {
    const [sine, cosine] = onSphere(pair(8 * k + 4), pair(8 * k + 6), kind);
    xyz[3 * k] = cosine.times(pair(8 * k + 2)).round() + 0;
    xyz[3 * k + 1] = cosine.times(pair(8 * k)).round() + 0;
    xyz[3 * k + 2] = sine.round() + 0;
  }
  return xyz;
}

const DEGREES = 180 / Math.PI;
const plain = (terms: readonly DoubleDouble[], t: number): number =>
  terms.reduceRight((total, term) => total * t + term.hi, 0);

/** The latitude of a table of what has this latitude on the sphere, degrees, to some ulps: Newton's method. */
export function tableLatitude(onTheSphere: number, kind: Latitude): number {
  if (kind === "spherical") return onTheSphere;
  const [z, rho] = [Math.sin(onTheSphere / DEGREES), Math.cos(onTheSphere / DEGREES)];
  if (kind === "geodetic") return Math.atan2(z, POLAR.hi * rho) * DEGREES;
  let latitude = Math.atan2(z, FLATTER.hi ** (4 / 3) * rho);
  for (let step = 0; step < 2; ++step) {
    const [s, c] = [Math.sin(latitude), Math.cos(latitude)];
    const p = plain(P, s * s);
    const r = Math.sqrt(p * p + (P_AT_POLE.hi + p) * plain(D, s * s));
    latitude += ((z * c * r - rho * s * p) / (rho * c * r + z * s * p)) * (1 - E2.hi * s * s) ** 2 * r;
  }
  return latitude * DEGREES;
}
