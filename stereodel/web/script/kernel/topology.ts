/** Triangulated surfaces as integers alone: nothing here knows a coordinate. Rows are those of Python's arrays. */

/** Edges i < j of triangles, each once, in lexicographic order. */
export function edgesOf(simplices: Int32Array, neighbors: Int32Array): Int32Array {
  // As many as there are half-edges in pairs and alone.
  const alone = neighbors.reduce((count, beyond) => count + (beyond < 0 ? 1 : 0), 0);
  const low = new Int32Array((simplices.length + alone) / 2);
  const high = new Int32Array(low.length);
  let size = 0;
  forEdges(simplices, (u, v, opposite) => {
    // Of the two directions of an edge one goes up; an edge at the border has a single one.
    if (u > v && neighbors[opposite] >= 0) return;
    low[size] = Math.min(u, v);
    high[size++] = Math.max(u, v);
  });
  return sortedPairs(low, high);
}

/**
 * Neighbours of each of `size` points: those of point k are indices[indptr[k]] to indices[indptr[k + 1] - 1].
 *
 * @param edges As `edgesOf` has them: by their order, the neighbours of each point come in theirs.
 */
export function adjacencyOf(edges: Int32Array, size: number): { indptr: Int32Array; indices: Int32Array } {
  const indptr = startsOf(edges, size);
  const indices = new Int32Array(edges.length);
  const next = indptr.slice();
  for (let k = 0; k < edges.length; k += 2) indices[next[edges[k + 1]]++] = edges[k]; // the lower ones first
  for (let k = 0; k < edges.length; k += 2) indices[next[edges[k]]++] = edges[k + 1];
  return { indptr, indices };
}

/** Directed edges of the triangles `inside` that border others or nothing, in lexicographic order. */
export function boundaryOf(
  simplices: Int32Array,
  neighbors: Int32Array,
  inside: (triangle: number) => boolean,
): Int32Array {
  const border: [number, number][] = [];
  forEdges(simplices, (u, v, opposite) => {
    const beyond = neighbors[opposite];
    if (inside(Math.floor(opposite / 3)) && (beyond < 0 || !inside(beyond))) border.push([u, v]);
  });
  return Int32Array.from(border.sort(([a, b], [c, d]) => a - c || b - d).flat());
}

/** The next entry of the same row of three. */
export const following = (entry: number): number => (entry % 3 === 2 ? entry - 2 : entry + 1);

/** Calls visit(u, v, place) for the directed edge opposite each corner, counterclockwise. */
function forEdges(simplices: Int32Array, visit: (u: number, v: number, opposite: number) => void): void {
  for (let row = 0; row < simplices.length; row += 3) {
    const [a, b, c] = [simplices[row], simplices[row + 1], simplices[row + 2]];
    visit(b, c, row);
    visit(c, a, row + 1);
    visit(a, b, row + 2);
  }
}

/** Rows (first, second) in lexicographic order: sorted by the second numbers, then, which keeps their order, by the first. */
function sortedPairs(first: Int32Array, second: Int32Array): Int32Array {
  const size = Math.max(...[first, second].map((numbers) => numbers.reduce((most, k) => Math.max(most, k + 1), 0)));
  const [next, again] = [startsOf(second, size), startsOf(first, size)];
  const order = new Int32Array(first.length);
  for (let k = 0; k < first.length; ++k) order[next[second[k]]++] = k;
  const rows = new Int32Array(2 * first.length);
  for (const k of order) {
    const at = again[first[k]]++;
    rows[2 * at] = first[k];
    rows[2 * at + 1] = second[k];
  }
  return rows;
}

/** Where lists begin that have an entry for each of the numbers below `size` that is in `numbers`; and the last one's end. */
function startsOf(numbers: Int32Array, size: number): Int32Array {
  const starts = new Int32Array(size + 1);
  for (const number of numbers) ++starts[number + 1];
  for (let k = 0; k < size; ++k) starts[k + 1] += starts[k];
  return starts;
}
