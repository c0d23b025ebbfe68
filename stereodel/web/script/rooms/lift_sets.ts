/** Sets of sites of the Lift room. */

import type { SiteSet } from "../sets.ts";

/** Decimals of metres to which places are rounded. */
const DECIMALS = 4;

/** The sets of the sheet. @param sheet The places of the first one. */
export function sheetSets(sheet: Float64Array): SiteSet[] {
  return [
    { name: "sheet", words: "Scattered over a sheet of 3 by 2", make: () => sheet },
    { name: "grid", words: "A square grid", make: grid },
    { name: "flat", words: "Nearly flat, where the plain test fails", make: () => nearlyFlat(sheet) },
  ];
}

/** Corners of the rectangle that a set of the sheet stands on, where it is not the smallest one: width and height. */
export const SHEET_SIDES: Readonly<Record<string, readonly [number, number]>> = { sheet: [3, 2] };

/** Nine by six sites at whole coordinates. */
function grid(): Float64Array {
  return Float64Array.from({ length: 108 }, (_, k) => (k % 2 === 0 ? (k >> 1) % 9 : Math.floor(k / 18)));
}

/** A sheet of 30 by 20 centimetres in metres of a country's grid: squares of its coordinates leave no digits for it. */
function nearlyFlat(sheet: Float64Array): Float64Array {
  const origin = [4_500_000, 5_300_000];
  return sheet.map((value, k) => Number((origin[k % 2] + value / 10).toFixed(DECIMALS)));
}
