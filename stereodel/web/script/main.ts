/** The page: head and foot, rooms by the fragment of the address, files that are dropped, exports, states. */

import { Announcer } from "./announce.ts";
import { Contents } from "./contents.ts";
import { field, find } from "./dom.ts";
import { copy, download } from "./export.ts";
import { load } from "./kernel/instance.ts";
import { LinkError, LinkValues, readLink, ROOMS, writeLink } from "./link.ts";
import type { Link, RoomName } from "./link.ts";
import { Messages } from "./messages.ts";
import type { Room, RoomHost } from "./room.ts";
import { globeRoom } from "./rooms/globe.ts";
import { liftRoom } from "./rooms/lift.ts";
import { sphereRoom } from "./rooms/sphere.ts";

/** Milliseconds of rest after which the address tells the state. */
const REST = 300;

type Makers = Record<RoomName, (host: RoomHost) => Room>;

class Page {
  readonly #contents: Contents;
  readonly #makers: Makers;
  readonly #messages = new Messages(find(document, "#messages"));
  readonly #announcer = new Announcer(find(document, "#status"));
  readonly #rooms = new Map<RoomName, Room>();
  #name: RoomName = "sphere";
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isStep = false;

  constructor(contents: Contents, makers: Makers) {
    this.#contents = contents;
    this.#makers = makers;
  }

  /** Shows what the address says, and follows it from now on. */
  start(): void {
    addEventListener("hashchange", () => this.#follow());
    this.#follow();
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

  /** The room that is open; it is made when it is first entered. */
  get #room(): Room {
    let room = this.#rooms.get(this.#name);
    if (room === undefined) {
      room = this.#makers[this.#name](this.#host());
      this.#rooms.set(this.#name, room);
      room.attach(this.#section);
    }
    return room;
  }

  #host(): RoomHost {
    return {
      contents: this.#contents,
      announcer: this.#announcer,
      messages: this.#messages,
      changed: (isStep = false) => this.#changed(isStep),
      guarded: (body) => this.#guarded(body),
    };
  }

  /** Enters the room of the address in its state; what cannot be read is said, and the room begins anew. */
  #follow(): void {
    clearTimeout(this.#timer);
    let link: Link;
    try {
      link = readLink(location.hash);
    } catch (error) {
      this.#refuse(error);
      link = { room: this.#name, values: new LinkValues() };
    }
    this.#enter(link.room);
    const isNew = link.values.entries().length > 0 || !this.#rooms.has(link.room);
    this.#guarded(() => {
      const room = this.#room;
      if (!isNew) return;
      try {
        room.restore(link.values);
      } catch (error) {
        this.#refuse(error);
        room.restore(new LinkValues());
      }
    });
    this.#python();
  }

  #refuse(error: unknown): void {
    if (!(error instanceof LinkError)) throw error;
    this.#messages.show("", "This link cannot be read, so here is the room as it begins.");
  }

  /** Shows a room's section and hides the others. */
  #enter(name: RoomName): void {
    this.#name = name;
    for (const room of ROOMS) find(document, `#room-${room}`).hidden = room !== name;
    for (const link of document.querySelectorAll<HTMLAnchorElement>(".rooms a")) {
      if (link.hash === `#${name}`) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    }
    document.title = `${name[0].toUpperCase()}${name.slice(1)} · stereodel`;
  }

  /** The address and the Python lines follow the state once the hand rests. */
  #changed(isStep: boolean): void {
    this.#isStep ||= isStep;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const hash = `#${writeLink(this.#name, this.#room.state())}`;
      if (hash !== location.hash) history[this.#isStep ? "pushState" : "replaceState"](null, "", hash);
      this.#isStep = false;
      this.#python();
    }, REST);
  }

  #guarded(body: () => void): void {
    try {
      body();
      this.#section.classList.remove("failed");
    } catch (error) {
      console.error(error);
      this.#section.classList.add("failed");
      const again = { words: "Draw again", act: () => this.#guarded(() => this.#room.redraw()) };
      this.#messages.show("", "The computation failed and was stopped. Your sites are still here.", again);
    }
  }

  /** Files may be dropped anywhere. */
  #takeFiles(): void {
    const body = document.body;
    const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    addEventListener("dragover", (event) => {
      if (!holdsFiles(event)) return;
      event.preventDefault();
      body.classList.add("dropping");
    });
    addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) body.classList.remove("dropping");
    });
    addEventListener("drop", (event) => {
      if (!holdsFiles(event)) return;
      event.preventDefault();
      body.classList.remove("dropping");
      const file = event.dataTransfer?.files[0];
      if (file !== undefined) void this.#room.open(file);
    });
    for (const input of document.querySelectorAll<HTMLInputElement>("input[type=file]")) {
      input.addEventListener("change", () => {
        const file = input.files?.[0];
        if (file !== undefined) void this.#room.open(file);
        input.value = ""; // the same file may be picked again
      });
    }
  }

  #foot(): void {
    const foot = find(document, ".foot");
    for (const button of foot.querySelectorAll<HTMLButtonElement>("button[data-export]")) {
      button.addEventListener("click", () => this.#guarded(() => void this.#export(button.dataset["export"] ?? "")));
    }
    for (const choice of foot.querySelectorAll<HTMLInputElement>("input[name=colours]")) {
      choice.addEventListener("change", () => {
        document.documentElement.dataset["colours"] = choice.value;
        this.#guarded(() => this.#room.redraw());
      });
    }
    find(foot, "details").addEventListener("toggle", () => this.#python());
  }

  async #export(kind: string): Promise<void> {
    const name = `stereodel-${this.#name}`;
    const room = this.#room;
    if (kind === "svg") download(`${name}.svg`, room.svg(), "image/svg+xml");
    else if (kind === "png") {
      const scale = field(document, "png-scale").valueAsNumber;
      download(`${name}.png`, await room.png(scale >= 1 && scale <= 8 ? scale : 2));
    } else if (kind === "geojson") {
      const text = room.geojson();
      if (text !== null) download(`${name}.geojson`, text, "application/geo+json");
    } else {
      const state = room.state();
      await copy(`${location.href.split("#")[0]}#${writeLink(this.#name, state)}`);
      const named = "file" in state;
      this.#messages.show(
        "",
        named ? "The link names the file but does not hold its sites; send the file along." : "Link copied.",
      );
    }
  }

  /** The lines of Python, where they are looked at. */
  #python(): void {
    const details = find<HTMLDetailsElement>(document, ".foot details");
    if (details.open) find(details, "code").textContent = this.#room.python();
  }
}

/** Puts marks of rulers in their places: the policy of the page allows no styles in its HTML. */
function placeMarks(): void {
  for (const mark of document.querySelectorAll<HTMLElement>("[data-at]")) {
    mark.style.setProperty("--at", mark.dataset["at"] ?? "0%");
  }
}

/** The sets of the Sphere room are unpacked before it is made, so that links can name them. */
async function makersOf(contents: Contents): Promise<Makers> {
  const names = ["cities", "airports", "stars"] as const;
  const stored: Record<string, Float64Array> = {};
  for (const name of names) stored[name] = await contents.set(name);
  const given = await contents.given();
  if (given !== null) stored["given"] = given.lonlat;
  return { sphere: (host) => sphereRoom(host, stored, given?.name), lift: liftRoom, globe: globeRoom };
}

async function main(): Promise<void> {
  placeMarks();
  const contents = Contents.ofDocument();
  const [makers] = await Promise.all([makersOf(contents), contents.kernel().then(load)]);
  document.body.classList.remove("loading");
  new Page(contents, makers).start();
  document.documentElement.dataset["ready"] = "true";
}

void main();
