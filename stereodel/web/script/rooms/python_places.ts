/** Places in lines of Python. */

/** Sites beyond which the lines name a file in place of the places. */
export const MOST_WRITTEN = 200;

/** Pairs of coordinates as an array (n, 2) of Python, in lines of at most 88 letters. */
export function placesPython(values: Float64Array): string {
  const rows = Array.from({ length: values.length / 2 }, (_, k) => `[${values[2 * k]}, ${values[2 * k + 1]}]`);
  const lines: string[] = [];
  for (const row of rows) {
    const last = lines[lines.length - 1];
    if (last !== undefined && last.length + row.length < 84) lines[lines.length - 1] = `${last} ${row},`;
    else lines.push(`    ${row},`);
  }
  return lines.length === 0 ? "np.zeros((0, 2))" : `np.array([\n${lines.join("\n")}\n])`;
}
