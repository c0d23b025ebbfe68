/** What rooms have in common: switches and a table; those of sites a list of sets, and what a link calls the sites. */

import { find } from "../dom.ts";
import type { IsOn, Switch } from "../drawing/parts.ts";
import type { Reason } from "../drawing/plate.ts";
import type { Exchange } from "../exchange.ts";
import type { Points } from "../files.ts";
import { word, type Fields, type Place } from "../fields.ts";
import { LETTERS, LinkError, MOST_SITES, numbersOf, type LinkValues } from "../link.ts";
import type { RoomHost } from "../room.ts";
import type { SiteSet } from "../sets.ts";
import { SiteTable, type Rows } from "../table.ts";
import { counted } from "../words.ts";
import { Switches, tellNamed } from "./controls.ts";
import type { Column } from "./owner.ts";
import type { Origin } from "./python.ts";

/** The name of sites that are no set of the list: opened, or changed by hand. */
const OWN = "own";

/** A table of the reader's own. */
export interface Table {
  /** Pairs of coordinates, (n, 2) flat. */
  readonly places: Float64Array;
  /** Of the places, where their file has such a column. */
  readonly names: readonly string[] | null;
  /** Of the table: that of its file, whatever a hand has done to it since. */
  readonly name: string | null;
  /** Its columns of numbers, NaN where one is missing. */
  readonly values?: ReadonlyMap<string, Column>;
}

/** Sites, the set that they are, and the file that has them as they are. */
export interface NamedSites extends Table {
  readonly set: string;
  readonly file: string | null;
}

/** Sites of no file, of a link or changed by hand. */
function ownSites(table: Table): NamedSites {
  return { ...table, set: OWN, file: null };
}

function ofSet(set: SiteSet): NamedSites {
  return { places: set.make(), names: set.names ?? null, name: null, set: set.name, file: null };
}

/** What a link says of a table: all of it, or where it is too long for one and need not be whole the name of its file. */
export function tableValues({ places, names, name, values }: Table, isWhole: boolean): Record<string, string> {
  const named = { file: name ?? "sites" };
  if (!isWhole && places.length > 2 * MOST_SITES) return named;
  const lines = (texts: readonly string[]): string => texts.map((text) => text.replaceAll("\n", " ")).join("\n");
  const columns = [...(values ?? [])].flatMap(([title, column]) => [
    title,
    Array.from(column).join().replaceAll("NaN", ""),
  ]);
  const table = {
    sites: places.join(),
    ...(names && { names: lines(names) }),
    ...(name && { name }),
    ...(columns.length * places.length > 0 && { values: lines(columns) }),
  };
  const isShort = encodeURIComponent(Object.values(table).join()).length <= LETTERS;
  return isWhole || isShort ? table : named;
}

/** The table of a link, or null. @throws LinkError where it cannot be read. */
export function tableOf(values: LinkValues, kind: "lonlat" | "plane"): Table | null {
  const sites = values.get("sites");
  if (sites === undefined) return null;
  const places = sites === "" ? new Float64Array(0) : numbersOf(sites);
  const isPlace = (value: number, k: number): boolean =>
    Number.isFinite(value) && (kind === "plane" || k % 2 === 0 || Math.abs(value) <= 90);
  if (places.length % 2 !== 0 || !places.every(isPlace)) throw new LinkError("half a site, or one that is nowhere");
  const lines = values.get("values")?.split("\n") ?? [];
  const columns = lines.flatMap((title, k) => (k % 2 === 0 ? [[title, numbersOf(lines[k + 1] ?? "")] as const] : []));
  if (columns.some(([, column]) => column.length !== places.length / 2)) throw new LinkError("a column is too short");
  const names = values.get("names")?.split("\n") ?? null;
  return { places, names, name: values.get("name") ?? null, values: new Map(columns) };
}

/** Sites from which on nothing but dots and the bubble is drawn while something moves. */
const VERY_MANY = 100_000;

export abstract class TableRoom {
  readonly host: RoomHost;
  protected section!: HTMLElement;
  protected table!: SiteTable;
  switches!: Switches;
  readonly isOn: IsOn = (name) => this.switches.isOn(name);

  constructor(host: RoomHost) {
    this.host = host;
  }

  /** The number of a site was pressed. */
  protected abstract chosen(site: number): void;
  /** The pointer or the focus is on the row of a site, or on none. */
  protected abstract pointed(site: number | null): void;
  /** Something is drawn, or no longer. */
  protected abstract switched(name: string): void;

  attach(section: HTMLElement): void {
    this.section = section;
    this.table = new SiteTable(
      find(section, ".sites"),
      (site) => this.host.guarded(() => this.chosen(site)),
      (site) => this.pointed(site),
    );
    this.switches = new Switches(section, (name) => {
      this.host.guarded(() => this.switched(name));
      this.host.changed();
    });
  }

  /** Where the room says something. */
  protected out(name: string): HTMLElement {
    return find(this.section, `[data-out=${name}]`);
  }

  /** The state has changed; a screen reader hears what. */
  protected changed(words: string): void {
    this.host.changed();
    this.host.announcer.say(words);
  }
}

/** A room of sites, which come with the page, from a file or by hand, in a state of a kind. */
export abstract class SiteRoom<S> extends TableRoom {
  /** The state, as its link tells it. */
  protected abstract now: S;
  protected readonly sets: readonly SiteSet[];
  /** What the sites are called. */
  protected named = ownSites({ places: new Float64Array(0), names: null, name: null });
  /** The site whose row the pointer or the focus is on. */
  protected lit: number | null = null;
  readonly #kind: "lonlat" | "plane";
  #select!: HTMLSelectElement;

  /** @param kind What the coordinates of the sites are. */
  constructor(host: RoomHost, sets: readonly SiteSet[], kind: "lonlat" | "plane") {
    super(host);
    [this.sets, this.#kind] = [sets, kind];
  }

  /** The state of so many sites. */
  protected abstract fields(count: number): Fields<S>;
  /** The state in which sites are shown first, after that of others. */
  protected abstract beginning(named: NamedSites, before?: S): S;
  /** Other sites are there: a set of the list, a file, or those of a link. */
  protected abstract begin(named: NamedSites): void;
  abstract redraw(reason?: Reason): void;

  protected override pointed(site: number | null): void {
    this.lit = site;
    this.redraw("pointer");
  }

  override attach(section: HTMLElement): void {
    super.attach(section);
    this.#select = find(section, "select[name=set]");
    this.#select.append(...this.sets.map(({ name, words }) => new Option(words, name)));
    this.#select.addEventListener("change", () => {
      const set = this.sets.find(({ name }) => name === this.#select.value);
      if (set !== undefined) this.#begin(ofSet(set));
    });
  }

  protected get count(): number {
    return this.named.places.length / 2;
  }

  protected put(change: Partial<S>): void {
    this.now = this.fields(this.count).settle({ ...this.now, ...change });
  }

  state(isWhole: boolean): Record<string, string> {
    const sites = this.named.set === OWN ? tableValues(this.named, isWhole) : { set: this.named.set };
    return { ...sites, ...this.switches.values, ...this.fields(this.count).write(this.now) };
  }

  /** The sites of a link; nothing is shown yet. @throws LinkError where they cannot be read. */
  #sitesOf(values: LinkValues): NamedSites {
    const name = word("set", [...this.sets.map((set) => set.name), OWN]).read(values, this.sets[0].name);
    const table = tableOf(values, this.#kind);
    if (table !== null) return ownSites(table);
    return ofSet(this.sets.find((set) => set.name === name) ?? this.sets[0]);
  }

  restore(values: LinkValues): void {
    const named = this.#sitesOf(values);
    this.now = this.fields(named.places.length / 2).read(values, this.beginning(named));
    this.switches.restore(values);
    tellNamed(this.host.messages, values, "file");
    this.begin(named);
  }

  /** Whether something is drawn. @param cells Sites beyond which cells are left out while the picture moves. */
  protected shown(isMoving: boolean, cells: number): IsOn {
    const most: Partial<Record<Switch, number>> = { cells, bubble: Infinity };
    return (name) => this.isOn(name) && !(isMoving && this.count > (most[name] ?? VERY_MANY));
  }

  /** Shows what the sites are called, how many there are, and the table. */
  protected show(named: NamedSites, rows: Omit<Rows, "names">): void {
    this.named = named;
    if (this.#kind === "lonlat") this.switches.offer("names", named.names !== null);
    // Sites of the reader's own have an entry while they are there.
    this.#select.querySelector(`option[value=${OWN}]`)?.remove();
    if (named.set === OWN) this.#select.prepend(new Option(named.name ?? "Your own sites", OWN));
    this.#select.value = named.set;
    const { count } = rows;
    this.out("count").textContent = count === 0 ? "No sites" : count === 1 ? "The site" : `The ${counted(count)} sites`;
    this.table.show({ ...rows, names: named.names });
  }

  open(file: File, exchange: Exchange, columns?: [string, string]): Promise<void> {
    const opened = ({ places, names, values, file }: Points): void =>
      this.#begin({ ...ownSites({ places, names, name: file, values }), file });
    return exchange.openPoints(file, this.#kind, this.host, opened, columns);
  }

  csv(exchange: Exchange): string {
    const { places, names, values } = this.named;
    return exchange.csv(this.#kind === "plane" ? ["x", "y"] : ["lon", "lat"], places, names, values);
  }

  /** Where the lines of Python have the sites from. */
  protected get origin(): Origin {
    const { set, file } = this.named;
    const given = this.sets.find(({ name }) => name === set && name === "given");
    return { set, file: file ?? given?.words ?? "sites.csv" };
  }

  protected get title(): string {
    return find(this.section, "h1").textContent ?? "";
  }

  #begin(named: NamedSites): void {
    this.host.guarded(() => {
      this.now = this.fields(named.places.length / 2).settle(this.beginning(named, this.now));
      this.begin(named);
      this.host.changed(true);
    });
  }
}

/** The sites with one of them elsewhere, one more at the end, or, without a place, one less: its number is the next one's. */
export function edited(table: NamedSites, site: number, place: Place | null): NamedSites {
  if (place !== null && 2 * site < table.places.length) {
    const places = table.places.slice();
    places.set(place, 2 * site);
    return ownSites({ ...table, places });
  }
  const edit = <T>(all: ArrayLike<T>, added: T): T[] =>
    place ? [...Array.from(all), added] : Array.from(all).filter((_, k) => k !== site);
  const places = place ? [...table.places, ...place] : table.places.filter((_, k) => k >> 1 !== site);
  const values = [...(table.values ?? [])].map(([title, all]) => [title, edit(all, NaN)] as const);
  const names = table.names && edit(table.names, "");
  return ownSites({ places: Float64Array.from(places), names, name: table.name, values: new Map(values) });
}
