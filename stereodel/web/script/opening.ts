/** Opening a file of the reader's: what is wrong is told in a line, and nothing changes. */

import { make } from "./dom.ts";
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
      askColumns(file.name, error.names, kinds, messages, (names) => {
        void openPoints(file, kind, messages, opened, names);
      });
    } else {
      messages.show(...complaint(file.name, error));
    }
    return;
  }
  messages.close();
  opened(points);
}

/** Asks which columns of a file are meant; `chosen` gets two names. */
function askColumns(
  file: string,
  names: readonly string[],
  kinds: readonly [string, string],
  messages: Messages,
  chosen: (names: [string, string]) => void,
): void {
  const selects = kinds.map((_, k) => {
    const select = make("select", "", ...names.map((name) => make("option", "", name)));
    select.selectedIndex = Math.min(k, names.length - 1);
    return select;
  });
  const open = { words: "Open", act: () => chosen([selects[0].value, selects[1].value]) };
  const inputs = kinds.map((kind, k) => make("label", "field column", `${kind} `, selects[k]));
  messages.show(`Which columns of ${file}?`, "", open, inputs);
}

/** A message's beginning and its words: the file, the row where there is one, then what is wrong. */
export function complaint(file: string, error: unknown): [string, string] {
  if (error instanceof NoTableError) return ["", `${error.message} ${UNCHANGED}`];
  if (error instanceof TooManyError) return [file, `${error.message} ${UNCHANGED}`];
  if (!(error instanceof TableError)) return [`${file}:`, `the file cannot be read. ${UNCHANGED}`];
  const [, place, rest] = /^((?:row|line) \d+): (.*)$/s.exec(error.message) ?? [];
  const words = rest ?? error.message;
  const stop = /[.?!]$/.test(words) ? "" : ".";
  return [place === undefined ? `${file}:` : `${file}, ${place}:`, `${words}${stop} ${UNCHANGED}`];
}
