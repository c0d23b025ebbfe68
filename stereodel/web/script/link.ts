/**
 * The state of the page as the fragment of its address: `#v=1&room=sphere&lat=20&…`, or the name of a room alone.
 * What a link says is checked here and by the rooms before anything is drawn: whatever cannot be read is a `LinkError`,
 * and the page shows the room as it begins.
 */

export const ROOMS = ["sphere", "lift", "globe"] as const;
export type RoomName = (typeof ROOMS)[number];

/** Sites that a link holds; more are named but not held. */
export const MOST_SITES = 2000;

/** Letters of a table that a link holds: 2 000 places with all digits and a name of thirty letters each. */
export const LETTERS = 120_000;

/** Letters of the longest link that is read. */
const LONGEST = 131_072;

/** A link that says nothing that can be shown. */
export class LinkError extends Error {}

/** What a link says: a room and its values by name. */
export interface Link {
  readonly room: RoomName;
  readonly values: LinkValues;
}

/** Values of a room by name, as text. */
export type LinkValues = Map<string, string>;

/**
 * Reads the fragment of an address, with or without its `#`.
 * @param longest Letters that it may have.
 * @throws LinkError where it is neither empty, nor the name of a room, nor a state of this version.
 */
export function readLink(hash: string, longest = LONGEST): Link {
  const text = hash.replace(/^#/, "");
  if (text.length > longest) throw new LinkError("the link is too long");
  const alone = ROOMS.find((room) => room === (text || "sphere"));
  if (alone !== undefined) return { room: alone, values: new Map() };
  const values = valuesOf(text.split("&"));
  if (values.get("v") !== "1") throw new LinkError("the link is of no known version");
  const room = ROOMS.find((room) => room === values.get("room"));
  if (room === undefined) throw new LinkError("the link names no room");
  values.delete("v");
  values.delete("room");
  return { room, values };
}

function valuesOf(parts: readonly string[]): LinkValues {
  try {
    const pairs = parts.map((part) => /^([^=]+)=(.*)$/s.exec(part)!.slice(1).map(decodeURIComponent));
    const values: LinkValues = new Map(pairs as [string, string][]);
    if (values.size === parts.length) return values;
  } catch {
    // a part of another form, or a percent sign without its digits: told below
  }
  throw new LinkError("the link has a part that is not name=value, or a name twice");
}

/** The fragment of a state, without its `#`. */
export function writeLink(room: RoomName, values: Record<string, string>): string {
  const parts = Object.entries(values).map(([name, value]) => `${encode(name)}=${encode(value)}`);
  return ["v=1", `room=${room}`, ...parts].join("&");
}

/** Percent signs only where they are needed, so that a link can be read by people, too. */
function encode(text: string): string {
  return encodeURIComponent(text).replace(/%(2C|2F|3A)/g, decodeURIComponent);
}

/** A number with at most so many decimals and no more zeros than it takes. */
export function writeNumber(value: number, decimals: number): string {
  return String(Number(value.toFixed(decimals)));
}

/** Numbers between commas. */
export function numbersOf(text: string): Float64Array {
  return Float64Array.from(text.split(","), numberOf);
}

/** NaN for what is no plain number. */
export function numberOf(text: string): number {
  return /^-?\d{1,40}(\.\d{1,40})?(e[-+]?\d{1,3})?$/.test(text) ? Number(text) : NaN;
}
