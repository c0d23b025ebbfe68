/** Exact signs for rows of points; one row alone stands for as many as the others have. */

import { asDirections, asRows, type Numbers } from "./checks.ts";
import { filled } from "./instance.ts";

/** Orientation of triangles of the plane: 1 counterclockwise, -1 clockwise, 0 on one line. */
export function orient2d(a: Numbers, b: Numbers, c: Numbers): Int8Array {
  return signs("plane_turn", 2, { a, b, c });
}

/** Side of d on the circle through a, b, c: 1 inside, -1 outside, 0 on it, for abc counterclockwise. */
export function incircle(a: Numbers, b: Numbers, c: Numbers, d: Numbers): Int8Array {
  return signs("plane_in_circle", 2, { a, b, c, d });
}

/** Side of d on the plane through a, b, c of space: the sign of det(b-a, c-a, d-a). */
export function orient3d(a: Numbers, b: Numbers, c: Numbers, d: Numbers): Int8Array {
  return signs("orient3d", 3, { a, b, c, d });
}

/**
 * Side of p on the circle of the sphere through the directions a, b, c: 1 if p lies in the open bubble that their plane
 * cuts off on the side from which they appear counterclockwise, -1 beyond it, 0 on the circle.
 */
export function inBubble(a: Numbers, b: Numbers, c: Numbers, p: Numbers): Int8Array {
  return signs("sphere_in_circle", 3, { a, b, c, p });
}

/** Side of c on the great circle from a to b, directions: 1 left, -1 right, 0 on it. */
export function turn(a: Numbers, b: Numbers, c: Numbers): Int8Array {
  return signs("sphere_turn", 3, { a, b, c });
}

function signs(name: string, width: number, given: Record<string, Numbers>): Int8Array {
  const rows = Object.entries(given).map(([argument, values]) =>
    name.startsWith("sphere") ? asDirections(values, argument) : asRows(values, width, argument),
  );
  const counts = rows.map((array) => array.length / width);
  const count = counts.includes(0) ? 0 : Math.max(...counts);
  const wrong = counts.findIndex((each) => each !== 1 && each !== count);
  if (wrong >= 0) {
    const argument = Object.keys(given)[wrong];
    throw new RangeError(
      `${argument} has ${counts[wrong]} rows, but others have ${count}; give as many, or one for all`,
    );
  }
  return filled(Int8Array, count, name, ...rows.flatMap((array, k) => [array, counts[k]]));
}
