/** What a room of the page is, and what the page does for it. */

import type { Contents } from "./contents.ts";
import type { Sheet } from "./drawing/pen.ts";
import type { Exchange } from "./exchange.ts";
import type { LinkValues, RoomName } from "./link.ts";
import type { Announcer, Messages } from "./messages.ts";

/** The page, as its rooms see it. */
export interface RoomHost {
  readonly contents: Contents;
  readonly announcer: Announcer;
  readonly messages: Messages;
  /** What the second script offers, which is compiled at first need. */
  readonly exchange: () => Promise<Exchange>;
  /** The state has changed: the address follows at rest. A step is one that the back button takes back. */
  changed(isStep?: boolean): void;
  /** Enters the room that can show a file, which opens it there. @param columns Names of both, where they are known. */
  pass(room: RoomName, file: File, columns?: [string, string]): Promise<void>;
  /** Runs what calls the kernel; a failure is told, and the last drawing stays. */
  guarded(body: () => void): void;
}

/** A room: its drawings, its controls and its state. */
export interface Room {
  /** Takes the room's section of the page, once. */
  attach(section: HTMLElement): void;
  /**
   * The state by name, as the link has it.
   * @param isWhole With a table of any length; otherwise one that is too long for a link is only named.
   */
  state(isWhole: boolean): Record<string, string>;
  /**
   * Shows a state; what it leaves out is as in the beginning.
   * @throws LinkError where a value cannot be read; the state before stays.
   */
  restore(values: LinkValues): void;
  /** Draws everything again, after a failure or with other colours. */
  redraw(): void;
  /** Opens a file of the reader's, or passes it on, or says why it cannot. @param columns As of `pass`. */
  open(file: File, exchange: Exchange, columns?: [string, string]): Promise<void>;
  /** The drawing, as a picture to take along. */
  sheet(): Sheet;
  /** The sites as a table, with all their digits, or null as for GeoJSON. */
  csv(exchange: Exchange): string | null;
  /** What GeoJSON can hold of the room, or null where there is none: then the room has said so. */
  geojson(exchange: Exchange): string | null;
  /** The Python lines that make the same picture. */
  python(exchange: Exchange): string;
}
