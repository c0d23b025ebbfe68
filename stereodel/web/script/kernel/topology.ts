/** Triangulated surfaces as integers alone: nothing here knows a coordinate. Rows are those of Python's arrays. */

/** Edges i < j of triangles, each once, in lexicographic order. */
export function edgesOf(simplices: Int32Array, neighbors: Int32Array): Int32Array {
  const low: number[] = [];
  const high: number[] = [];
  forEdges(simplices, (u, v, opposite) => {
    // Of the two directions of an edge one goes up; an edge at the border has a single one.
    if (u < v || neighbors[opposite] < 0) {
      low.push(Math.min(u, v));
      high.push(Math.max(u, v));
    }
  });
  return sortedPairs(Int32Array.from(low), Int32Array.from(high));
}

/** Neighbours of each of `size` points: those of point k are indices[indptr[k]] to indices[indptr[k + 1] - 1]. */
export function adjacencyOf(edges: Int32Array, size: number): { indptr: Int32Array; indices: Int32Array } {
  const count = edges.length / 2;
  const from = new Int32Array(2 * count);
  const to = new Int32Array(2 * count);
  for (let k = 0; k < count; ++k) {
    from[2 * k] = to[2 * k + 1] = edges[2 * k];
    to[2 * k] = from[2 * k + 1] = edges[2 * k + 1];
  }
  const pairs = sortedPairs(from, to);
  const indptr = new Int32Array(size + 1);
  for (let k = 0; k < from.length; ++k) ++indptr[from[k] + 1];
  for (let k = 0; k < size; ++k) indptr[k + 1] += indptr[k];
  return { indptr, indices: pairs.filter((_, k) => k % 2 === 1) };
}

/** Directed edges of the triangles `inside` that border others or nothing, in lexicographic order. */
export function boundaryOf(
  simplices: Int32Array,
  neighbors: Int32Array,
  inside: (triangle: number) => boolean,
): Int32Array {
  const from: number[] = [];
  const to: number[] = [];
  forEdges(simplices, (u, v, opposite) => {
    const beyond = neighbors[opposite];
    if (inside(Math.floor(opposite / 3)) && (beyond < 0 || !inside(beyond))) {
      from.push(u);
      to.push(v);
    }
  });
  return sortedPairs(Int32Array.from(from), Int32Array.from(to));
}

/** Calls visit(u, v, place) for the directed edge opposite each corner, counterclockwise. */
function forEdges(simplices: Int32Array, visit: (u: number, v: number, opposite: number) => void): void {
  for (let row = 0; row < simplices.length; row += 3) {
    const [a, b, c] = [simplices[row], simplices[row + 1], simplices[row + 2]];
    visit(b, c, row);
    visit(c, a, row + 1);
    visit(a, b, row + 2);
  }
}

/** Rows (first, second) in lexicographic order: by counting, the second numbers first. */
function sortedPairs(first: Int32Array, second: Int32Array): Int32Array {
  const order = countingSort(first, countingSort(second, Int32Array.from(second.keys())));
  const rows = new Int32Array(2 * order.length);
  for (let k = 0; k < order.length; ++k) {
    rows[2 * k] = first[order[k]];
    rows[2 * k + 1] = second[order[k]];
  }
  return rows;
}

/** The places in `order` by their numbers, equal ones as they stand. */
function countingSort(numbers: Int32Array, order: Int32Array): Int32Array {
  const size = numbers.reduce((most, number) => Math.max(most, number + 1), 0);
  const next = new Int32Array(size + 1);
  for (const number of numbers) ++next[number + 1];
  for (let k = 0; k < size; ++k) next[k + 1] += next[k];
  const sorted = new Int32Array(order.length);
  for (const place of order) sorted[next[numbers[place]]++] = place;
  return sorted;
}
