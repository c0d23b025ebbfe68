/** The page: head and foot, rooms by the fragment of the address, files that are dropped, exports, states. */

import { Contents } from "./contents.ts";
import type { Places } from "./rooms/globe_scene.ts";
import { field, find } from "./dom.ts";
import type { Exchange } from "./exchange.ts";
import { word } from "./fields.ts";
import type { Latitude } from "./kernel/api.ts";
import { load } from "./kernel/instance.ts";
import { laterScript } from "./later_script.ts";
import type { LiftRoomMaker } from "./lift.ts";
import { LinkError, readLink, ROOMS, writeLink, type Link, type LinkValues, type RoomName } from "./link.ts";
import { announcerIn, messagesIn } from "./messages.ts";
import type { Room, RoomHost } from "./room.ts";
import { Choice, NAMED, NumberField } from "./rooms/controls.ts";
import { GlobeRoom } from "./rooms/globe.ts";
import { sphereRoom } from "./rooms/sphere.ts";

/** Milliseconds of rest after which the address tells the state. */
const REST = 300;

/** Without a word the colours are those of the system. */
type Colours = "" | "light" | "dark";
const COLOURS = word<Colours>("colours", ["", "light", "dark"]);

/** What a link says of a table. */
const TABLE = ["sites", "names", "name", "values"];

type Makers = Record<RoomName, (host: RoomHost) => Room | Promise<Room>>;

class Page implements RoomHost {
  readonly contents: Contents;
  readonly #makers: Makers;
  readonly exchange: () => Promise<Exchange>;
  readonly messages = messagesIn(find(document, "#messages"));
  readonly announcer = announcerIn(find(document, "#status"));
  readonly #rooms = new Map<RoomName, Room>();
  readonly #colours = new Choice<Colours>(document, "colours", () => {
    this.#paint(this.#colours.value);
    this.guarded(() => this.#room?.redraw());
    this.changed();
  });
  /** The document as it came. */
  readonly #source: Node;
  /** What a page that was saved shows before anything else; its table is there for links that name it. */
  readonly #saved: Link | null;
  readonly #given: Places | null;
  #name: RoomName = "sphere";
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isStep = false;

  constructor(contents: Contents, makers: Makers, source: Node, saved: string, given: Places | null) {
    this.contents = contents;
    this.#makers = makers;
    [this.#source, this.#given] = [source, given];
    this.#saved = saved === "" ? null : readLink(saved, Infinity);
    this.exchange = laterScript(contents, "exchange");
  }

  /** Shows what the address says, and follows it from now on. */
  async start(): Promise<void> {
    addEventListener("hashchange", () => void this.#follow());
    await this.#follow();
    this.#takeFiles();
    this.#foot();
    find(document, ".skip").addEventListener("click", (event) => {
      event.preventDefault(); // the address is the state's
      find(this.#section, ".plate").focus();
    });
  }

  get #section(): HTMLElement {
    return find(document, `#room-${this.#name}`);
  }

  /** The room that is open, as soon as it is there. */
  get #room(): Room | undefined {
    return this.#rooms.get(this.#name);
  }

  /** A room, which is made when it is first entered. */
  async #made(name: RoomName): Promise<Room> {
    const made = await this.#makers[name](this);
    const room = this.#rooms.get(name) ?? made; // it may have been entered twice meanwhile
    if (!this.#rooms.has(name)) room.attach(find(document, `#room-${name}`));
    this.#rooms.set(name, room);
    return room;
  }

  /** Enters the room of the address in its state; what cannot be read is said, and the room begins anew. */
  async #follow(): Promise<void> {
    clearTimeout(this.#timer);
    const begin = this.#given === null ? "sphere" : "globe";
    const first = location.hash === "" && this.#rooms.size === 0 ? this.#saved : null;
    const link = this.#read(
      () => first ?? readLink(location.hash || begin),
      () => ({ room: this.#name, values: new Map() }),
    );
    const saved = this.#saved?.values;
    if (saved?.has("name") && saved.get("name") === link.values.get("file"))
      for (const name of TABLE) if (saved.has(name)) link.values.set(name, saved.get(name)!);
    this.#enter(link.room);
    const isNew = link.values.size > 0 || !this.#rooms.has(link.room);
    try {
      const room = this.#room ?? (await this.#made(link.room));
      if (this.#name !== link.room) return; // the reader is in another room by now
      const restore = (values: LinkValues): void => {
        if (values.size > 0) this.#paint(COLOURS.read(values, ""));
        room.restore(values);
      };
      const anew = (): void => restore(new Map());
      this.guarded(() => isNew && this.#read(() => restore(link.values), anew));
      this.#python();
    } catch (error) {
      this.#failed(error);
    }
  }

  /** What `body` reads of a link, or `otherwise` where it cannot be read. */
  #read<T>(body: () => T, otherwise: () => T): T {
    try {
      return body();
    } catch (error) {
      if (!(error instanceof LinkError)) throw error;
      this.messages.show("", "This link cannot be read, so here is the room as it begins.");
      return otherwise();
    }
  }

  /** Shows a room's section and hides the others. */
  #enter(name: RoomName): void {
    this.#name = name;
    for (const room of ROOMS) find(document, `#room-${room}`).hidden = room !== name;
    for (const link of document.querySelectorAll<HTMLAnchorElement>(".rooms a")) {
      link.ariaCurrent = link.hash === `#${name}` ? "page" : null;
    }
    const title = name === "globe" && this.#given?.owner?.title;
    document.title = title || `${name[0].toUpperCase()}${name.slice(1)} · stereodel`;
  }

  /** The address and the Python lines follow the state once the hand rests. */
  changed(isStep = false): void {
    this.#isStep ||= isStep;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      if (this.#room === undefined) return;
      const hash = `#${this.#link(this.#room.state(false))}`;
      if (hash !== location.hash) history[this.#isStep ? "pushState" : "replaceState"](null, "", hash);
      this.#isStep = false;
      this.#python();
    }, REST);
  }

  /** The fragment of a state of the room, with the colours where they are not those of the system. */
  #link(state: Record<string, string>): string {
    const colours = this.#colours.value;
    return writeLink(this.#name, colours === "" ? state : { ...state, colours });
  }

  #paint(colours: Colours): void {
    document.documentElement.dataset["colours"] = this.#colours.value = colours;
  }

  readonly guarded = (body: () => void): void => {
    try {
      body();
      this.#section.classList.remove("failed");
    } catch (error) {
      this.#failed(error);
    }
  };

  #failed(error: unknown): void {
    console.error(error);
    this.#section.classList.add("failed");
    const again = { words: "Draw again", act: () => this.guarded(() => this.#room?.redraw()) };
    this.messages.show("", "The computation failed and was stopped. Your sites are still here.", again);
  }

  /** Files may be dropped anywhere. */
  #takeFiles(): void {
    for (const type of ["dragover", "drop"] as const) {
      addEventListener(type, (event) => {
        if (!event.dataTransfer?.types.includes("Files")) return;
        event.preventDefault();
        if (type === "drop") this.#open(event.dataTransfer.files[0]);
      });
    }
    for (const input of document.querySelectorAll<HTMLInputElement>("input[type=file]")) {
      input.addEventListener("change", () => {
        this.#open(input.files?.[0]);
        input.value = ""; // the same file may be picked again
      });
    }
  }

  #foot(): void {
    const foot = find(document, ".foot");
    for (const button of foot.querySelectorAll<HTMLButtonElement>("button[data-export]")) {
      button.addEventListener("click", () =>
        this.#exchanging((...both) => this.#export(button.dataset["export"] ?? "", ...both)),
      );
    }
    new NumberField(foot, "png-scale", 0, () => {});
    find(foot, "details").addEventListener("toggle", () => this.#python());
  }

  /** Does what takes the second script; what fails is told as a failure of the kernel is. */
  #exchanging(body: (room: Room, exchange: Exchange) => void | Promise<void>): void {
    const room = this.#room;
    if (room === undefined) return;
    const done = this.exchange().then((exchange) => body(room, exchange));
    done.catch((error: unknown) => this.#failed(error));
  }

  #open(file: File | undefined, columns?: [string, string]): void {
    if (file !== undefined) this.#exchanging((room, exchange) => room.open(file, exchange, columns));
  }

  async pass(name: RoomName, file: File, columns?: [string, string]): Promise<void> {
    history.pushState(null, "", `#${name}`);
    await this.#follow();
    this.#open(file, columns);
  }

  async #export(kind: string, room: Room, exchange: Exchange): Promise<void> {
    const name = `stereodel-${this.#name}`;
    if (kind === "svg") exchange.download(`${name}.svg`, await exchange.sheetSvg(room.sheet()));
    else if (kind === "png") {
      const scale = field(document, "png-scale").valueAsNumber;
      exchange.download(`${name}.png`, await exchange.sheetPng(room.sheet(), scale));
    } else if (kind === "geojson" || kind === "csv") {
      const text = room[kind](exchange);
      const file = kind === "csv" ? "sites.csv" : `${name}.geojson`; // as the lines of Python call it
      if (text !== null) exchange.download(file, text);
    } else if (kind === "page") {
      exchange.download(`${name}.html`, await exchange.savedPage(this.#source, this.#link(room.state(true))));
    } else {
      const state = room.state(false);
      const link = `${location.href.split("#")[0]}#${this.#link(state)}`;
      const what = "file" in state ? "file" : "picture";
      const otherwise = what === "file" ? "save the page" : "send the file along";
      const left = `The link names the ${what} but does not hold its ${NAMED[what]}; ${otherwise}.`;
      const copied = navigator.clipboard?.writeText(link).then(() => (what in state ? left : "Link copied."));
      const cannot = "Nothing can be copied here; the link is the page's address.";
      this.messages.show("", (await copied?.catch(() => cannot)) ?? cannot);
    }
  }

  /** The lines of Python, where they are looked at. */
  #python(): void {
    const details = find<HTMLDetailsElement>(document, ".foot details");
    if (!details.open) return;
    this.#exchanging((room, exchange) => {
      find(details, "code").textContent = room.python(exchange);
    });
  }
}

async function main(): Promise<void> {
  const source = document.documentElement.cloneNode(true);
  // Marks of rulers in their places: the policy of the page allows no styles in its HTML.
  for (const mark of document.querySelectorAll<HTMLElement>("[data-at]"))
    mark.style.setProperty("--at", mark.dataset["at"]!);
  // The drawing alone, in a frame of another page.
  if (new URLSearchParams(location.search).has("frame")) document.documentElement.classList.add("framed");
  const contents = new Contents((name) => document.getElementById(`block-${name}`)?.textContent ?? null);
  const loaded = contents.kernel().then(load);
  const stored: Record<string, Float64Array> = {}; // before the rooms are made, so that links can name them
  for (const name of ["gap", "everywhere", "hemisphere", "cities", "airports", "stars", "sheet"])
    stored[name] = (await contents.rings(name))?.lonlat ?? new Float64Array(0);
  const [given, saved] = [await contents.given(), (await contents.text("state")) ?? ""];
  // Those of the ellipsoid with equal areas, if the page does not say.
  const latitude = ((await contents.text("latitude")) ?? "authalic") as Latitude;
  const lift = laterScript<LiftRoomMaker>(contents, "lift");
  await loaded;
  document.body.classList.remove("loading");
  const makers: Makers = {
    sphere: (host) => sphereRoom(host, stored, given),
    lift: async (host) => (await lift())(host, stored["sheet"]),
    globe: (host) => new GlobeRoom(host, given, latitude),
  };
  const page = new Page(contents, makers, source, saved, given);
  await page.start();
  document.documentElement.dataset["ready"] = "true";
}

void main();
