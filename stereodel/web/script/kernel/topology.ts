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

/** Entries that are sorted by moving each to its place. */
const FEW = 16;

/** Rows (first, second) in lexicographic order: the second numbers in a list for each first one, each list sorted. */
function sortedPairs(first: Int32Array, second: Int32Array): Int32Array {
  const size = first.reduce((most, number) => Math.max(most, number + 1), 0);
  const starts = startsOf(first, size);
  const lists = new Int32Array(second.length);
  const next = starts.slice();
  for (let k = 0; k < first.length; ++k) lists[next[first[k]]++] = second[k];
  const rows = new Int32Array(2 * lists.length);
  for (let number = 0; number < size; ++number) {
    const [begin, end] = [starts[number], starts[number + 1]];
    if (end - begin > FEW) lists.subarray(begin, end).sort();
    else sortFew(lists, begin, end);
    for (let k = begin; k < end; ++k) {
      rows[2 * k] = number;
      rows[2 * k + 1] = lists[k];
    }
  }
  return rows;
}

function sortFew(numbers: Int32Array, begin: number, end: number): void {
  for (let k = begin + 1; k < end; ++k) {
    const number = numbers[k];
    let place = k;
    for (; place > begin && numbers[place - 1] > number; --place) numbers[place] = numbers[place - 1];
    numbers[place] = number;
  }
}

/** Where lists begin that have an entry for each of the numbers below `size` that is in `numbers`; and the last one's end. */
function startsOf(numbers: Int32Array, size: number): Int32Array {
  const starts = new Int32Array(size + 1);
  for (const number of numbers) ++starts[number + 1];
  for (let k = 0; k < size; ++k) starts[k + 1] += starts[k];
  return starts;
}
