/** Opening a file of the reader's: what is wrong is told in a line, and nothing changes. */

import { readPoints, NoTableError, TooManyError } from "./files.ts";
import type { Kind, Points } from "./files.ts";
import type { Messages } from "./messages.ts";
import { ColumnsError, TableError } from "./tables/error.ts";

const UNCHANGED = "Nothing has changed.";

/** Calls `opened` with the points of a file, or says why there are none; the reader may be asked for the columns. */
export async function openPoints(
  file: File,
  kind: Kind,
  messages: Messages,
  opened: (points: Points) => void,
  chosen?: [string, string],
): Promise<void> {
  let points: Points;
  try {
    points = await readPoints(file.name, new Uint8Array(await file.arrayBuffer()), kind, chosen);
  } catch (error) {
    if (error instanceof ColumnsError && error.names.length > 1) {
      const kinds: [string, string] = kind === "lonlat" ? ["Longitude", "Latitude"] : ["x", "y"];
      messages.askColumns(
        file.name,
        error.names,
        kinds,
        (names) => void openPoints(file, kind, messages, opened, names),
      );
    } else {
      messages.show(...complaint(file.name, error));
    }
    return;
  }
  messages.close();
  opened(points);
}

/** A message's beginning and its words: the file, the row where there is one, then the words of `read_points`. */
export function complaint(file: string, error: unknown): [string, string] {
  if (error instanceof NoTableError) return ["", `${error.message} ${UNCHANGED}`];
  if (error instanceof TooManyError) return [file, `${error.message} ${UNCHANGED}`];
  if (!(error instanceof TableError)) return [`${file}:`, `the file cannot be read. ${UNCHANGED}`];
  const [, place, rest] = /^((?:row|line) \d+): (.*)$/s.exec(error.message) ?? [];
  const words = rest ?? error.message;
  const stop = /[.?!]$/.test(words) ? "" : ".";
  return [place === undefined ? `${file}:` : `${file}, ${place}:`, `${words}${stop} ${UNCHANGED}`];
}
