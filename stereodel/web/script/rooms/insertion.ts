/**
 * One step of the paper's algorithm: the facets that see the new site, their outline, and the fan that closes the hole.
 *
 * A facet sees the site when the site lies inside its bubble, which the kernel's exact sign says.
 */

/** What inserting a site does to the facets before. */
export interface Insertion {
  /** Index of the new site. */
  readonly site: number;
  /** Facets of the sites before, (m, 3) flat. */
  readonly before: Int32Array;
  /** Indices of those that see the site. */
  readonly seeing: readonly number[];
  /** Sites of their outline, counterclockwise seen from outside; empty where nothing sees the site. */
  readonly outline: readonly number[];
  /** The facets that close the hole, (k, 3) flat. */
  readonly fan: Int32Array;
}

/**
 * The step that inserts `site` into the facets `before`.
 *
 * @param signs of `in_bubble(a, b, c, site)`, one a facet: above 0 inside. A site on the bubble displaces nothing.
 */
export function insertion(site: number, before: Int32Array, signs: ArrayLike<number>): Insertion {
  const seeing = Array.from({ length: before.length / 3 }, (_, k) => k).filter((k) => signs[k] > 0);
  const outline = outlineOf(before, seeing);
  const fan = Int32Array.from(outline.flatMap((corner, k) => [corner, outline[(k + 1) % outline.length], site]));
  return { site, before, seeing, outline, fan };
}

/** The facets after a step: those that do not see the site, and the fan. */
export function facetsAfter({ before, seeing, fan }: Insertion): Int32Array {
  const gone = new Set(seeing);
  const kept = before.filter((_, k) => !gone.has(Math.floor(k / 3)));
  return Int32Array.from([...kept, ...fan]);
}

/** The one closed line around some facets, on their left: their sides without a facet of theirs across. */
export function outlineOf(facets: Int32Array, chosen: readonly number[]): number[] {
  const sides = new Map<string, [number, number]>();
  for (const k of chosen) {
    for (let corner = 0; corner < 3; ++corner) {
      const a = facets[3 * k + corner];
      const b = facets[3 * k + ((corner + 1) % 3)];
      if (!sides.delete(`${b} ${a}`)) sides.set(`${a} ${b}`, [a, b]);
    }
  }
  return chained(new Map(sides.values()));
}

/** The closed line that begins with the first key: from each number to its value. */
export function chained(next: Map<number, number>): number[] {
  const outline: number[] = [];
  for (let at = next.keys().next().value; at !== undefined && next.has(at);) {
    outline.push(at);
    const to: number = next.get(at)!;
    next.delete(at);
    at = to;
  }
  return outline;
}
