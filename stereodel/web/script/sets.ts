/** Sets of sites to begin with. Those of the Earth and the sky come with the page, the others are made here. */

/** A set: its name in links, its words in the list, its places (n, 2). */
export interface SiteSet {
  readonly name: string;
  readonly words: string;
  readonly make: () => Float64Array;
}

/** Decimals of a degree, or of a sheet's unit, to which places that are made here are rounded: links stay short. */
const DECIMALS = 3;

/** Longitude and latitude of 54 sites, each the farthest of 14 drawn, none within 68° of the first pole of projection. */
const GAP = [
  1.599, 47.98, 121.053, -45.044, -19.214, -45.919, -147.077, -19.93, 106.94, 28.52, 54.768, -16.885, -2.383, -3.019,
  -94.282, -25.083, -57.062, 13.38, 56.807, 35.13, 27.597, -71.86, 141.887, 6.391, 177.055, -65.651, 157.893, -33.468,
  -130.978, -44.025, 82.302, 1.539, 22.617, 11.4, -75.048, -52.007, -37.443, -19.753, 171.039, -7.226, 22.927, -35.664,
  -33.214, 22.331, 95.46, -27.172, 125.81, -14.276, -121.999, -13.47, 16.421, 27.697, 52.929, 10.485, -66.38, -13.219,
  -38.177, -64.532, 63.382, -47.227, -129.232, -70.749, 94.261, -55.49, -88.655, 2.811, 7.741, -13.358, 91.269, -76.549,
  83.171, 37.039, 91.49, 15.324, 32.763, -18.209, -52.625, -38.116, -8.851, 26.661, -37.535, -2.819, 145.496, -49.309,
  -170.16, -47.522, -17.333, -18.886, 29.832, -2.51, 21.862, -53.857, -107.377, -42.814, -75.539, -33.681, 28.269,
  49.221, 96.643, -7.359, 48.512, -58.954, 115.27, 13.545, -127.853, -27.32, -167.346, -17.822,
];

/** 48 places of a sheet of 3 by 2 about its middle, each the farthest of 12 drawn. */
const SHEET = [
  -0.495, 0.906, 1.176, -0.651, -1.047, -0.318, -0.032, -0.8, 1.282, 0.241, 0.315, 0.368, 0.428, -0.236, -0.48, 0.026,
  -1.209, 0.508, -1.266, -0.898, 0.676, 0.748, -0.181, -0.356, 1.423, -0.289, -0.906, 0.189, -0.216, 0.577, -0.695,
  -0.453, -1.299, 0.031, 1.403, 0.717, -0.506, -0.821, 0.877, -0.132, 0.806, -0.414, -0.019, 0.367, 0.493, 0.108,
  -0.612, 0.538, -0.77, -0.186, 0.395, -0.679, 0.135, 0.693, 0.885, -0.691, -0.891, -0.793, -1.407, 0.884, -1.402,
  -0.514, -1.012, 0.902, 0.883, 0.435, -1.408, 0.274, -0.265, 0.89, 0.715, 0.213, 0.646, -0.92, 0.668, 0.521, 1.236,
  0.482, -1.107, 0.318, 0.415, 0.687, 0.212, 0.094, -0.079, -0.032, -0.399, -0.36, -0.285, 0.345, 1.055, 0.752, 0.118,
  -0.33, -0.258, -0.878,
];

/** Longitudes and latitudes in turn by the names of sets; "given" are those that the page was made for. */
export type Stored = Readonly<Record<string, Float64Array>>;

/** The sets of the sphere: those that the page was made for and carries, and those that are made here. */
export function sphereSets(stored: Stored, givenName = "Given sites"): SiteSet[] {
  const kept = (name: string, words: string): SiteSet[] => {
    const places = stored[name];
    return places === undefined || places.length === 0 ? [] : [{ name, words, make: () => places }];
  };
  return [
    ...kept("given", givenName),
    { name: "gap", words: "Scattered, with a gap round P", make: () => Float64Array.from(GAP) },
    { name: "everywhere", words: "Scattered everywhere", make: () => scatteredOnSphere(72, 90) },
    { name: "hemisphere", words: "In one hemisphere", make: () => scatteredOnSphere(40, 75) },
    ...kept("cities", "Cities"),
    ...kept("airports", "Airports"),
    ...kept("stars", "Stars"),
    { name: "dodecahedron", words: "Corners of a dodecahedron", make: dodecahedron },
  ];
}

/** The sets of the sheet. */
export function sheetSets(): SiteSet[] {
  return [
    { name: "sheet", words: "Scattered over a sheet of 3 by 2", make: () => Float64Array.from(SHEET) },
    { name: "grid", words: "A square grid", make: grid },
    { name: "flat", words: "Nearly flat, where the plain test fails", make: nearlyFlat },
  ];
}

/** Corners of the rectangle that a set of the sheet stands on, where it is not the smallest one: width and height. */
export const SHEET_SIDES: Readonly<Record<string, readonly [number, number]>> = { sheet: [3, 2] };

/** Sites over the cap about (0° E, 0° N) that reaches so many degrees, or everywhere from 90 on. */
function scatteredOnSphere(count: number, reach: number): Float64Array {
  const random = randomNumbers(count + reach);
  const low = reach < 90 ? Math.cos((reach * Math.PI) / 180) : -1;
  const draw = (): number[] => {
    const x = low + (1 - low) * random();
    const turn = 2 * Math.PI * random();
    const h = Math.sqrt(1 - x * x);
    return [x, h * Math.cos(turn), h * Math.sin(turn)];
  };
  const degrees = 180 / Math.PI;
  return rounded(spread(count, draw).flatMap(([x, y, z]) => [Math.atan2(y!, x!) * degrees, Math.asin(z!) * degrees]));
}

/** A site after the other, each the farthest from those before of so many drawn. */
function spread(count: number, draw: () => number[], drawn = 14): number[][] {
  const sites = [draw()];
  const apart = (a: number[], b: number[]): number => Math.hypot(...a.map((x, k) => x - b[k]));
  const alone = (site: number[]): number => Math.min(...sites.map((other) => apart(site, other)));
  while (sites.length < count) {
    const candidates = Array.from({ length: drawn }, draw);
    sites.push(candidates.reduce((best, site) => (alone(site) > alone(best) ? site : best)));
  }
  return sites;
}

/** The same numbers in [0, 1) on every machine: the generator mulberry32. */
function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

function rounded(values: number[]): Float64Array {
  return Float64Array.from(values, (value) => Number(value.toFixed(DECIMALS)));
}

/** Longitude and latitude of the twenty corners, as near as doubles come. */
function dodecahedron(): Float64Array {
  const golden = (1 + Math.sqrt(5)) / 2;
  const corners: number[][] = [];
  for (const s of [-1, 1]) {
    for (const t of [-1, 1]) {
      for (const u of [-1, 1]) corners.push([s, t, u]);
      corners.push([0, s / golden, t * golden], [s / golden, t * golden, 0], [t * golden, 0, s / golden]);
    }
  }
  const degrees = 180 / Math.PI;
  return Float64Array.from(
    corners.flatMap(([x, y, z]) => [Math.atan2(y!, x!) * degrees, Math.atan2(z!, Math.hypot(x!, y!)) * degrees]),
  );
}

/** Nine by six sites at whole coordinates. */
function grid(): Float64Array {
  return Float64Array.from({ length: 108 }, (_, k) => (k % 2 === 0 ? (k >> 1) % 9 : Math.floor(k / 18)));
}

/** A sheet of 30 by 20 centimetres in metres of a country's grid: squares of its coordinates leave no digits for it. */
function nearlyFlat(): Float64Array {
  const origin = [4_500_000, 5_300_000];
  return Float64Array.from(SHEET, (value, k) => Number((origin[k % 2] + value / 10).toFixed(DECIMALS + 1)));
}
