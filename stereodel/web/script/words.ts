/** Numbers as the page writes them: fixed decimals, U+2212 as minus, a narrow space before N, S, E, W. */

const NARROW = "\u202f";

/** A number with fixed decimals. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text.replace("-", "\u2212");
}

/** A size above 0 with so many decimals, or more until there are three digits. */
export function sized(value: number, decimals: number): string {
  return fixed(value, Math.max(decimals, Math.min(20, 2 - Math.floor(Math.log10(value)))));
}

/** A count, in groups of three from five digits on. */
export function counted(value: number): string {
  return value < 10_000 ? String(value) : String(value).replace(/\B(?=(\d{3})+$)/g, NARROW);
}

/** A count with its noun: "1 facet", "4 facets". */
export function several(value: number, one: string, many = `${one}s`): string {
  return `_${counted(value)}_ ${value === 1 ? one : many}`;
}

/** A scale: two decimals, and four digits from ten on. */
export function scale(value: number): string {
  return value < 9.995 ? fixed(value, 2) : fixed(value, Math.max(0, 3 - Math.floor(Math.log10(value))));
}

/** Latitude in degrees: "20.0° N". */
export function latitude(degrees: number, decimals = 1): string {
  return `${fixed(Math.abs(degrees), decimals)}°${NARROW}${degrees < 0 ? "S" : "N"}`;
}

/** Longitude in degrees, in (−180, 180]: "8.0° W". */
export function longitude(degrees: number, decimals = 1): string {
  const wrapped = wrap(degrees);
  return `${fixed(Math.abs(wrapped), decimals)}°${NARROW}${wrapped < 0 ? "W" : "E"}`;
}

/** The same longitude in (−180, 180]. */
export function wrap(degrees: number): number {
  const turned = degrees - 360 * Math.floor((degrees + 180) / 360);
  return turned === -180 ? 180 : turned;
}

/**
 * Facets = triangles + facets that see the pole, as a sum in words.
 * @param where the facets are, and the triangles, and the pole with the space before it.
 */
export function ofFacets(triangles: number, seeing: number, where: readonly [string, string, string]): string {
  const all = `${several(triangles + seeing, "facet")} ${where[0]}`;
  const those = `${several(seeing, "facet")} that ${seeing === 1 ? "sees" : "see"}${where[2]}`;
  return [all, "=", `${several(triangles, "triangle")} ${where[1]}`, "+", those].join("\u2002");
}
