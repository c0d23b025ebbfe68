/** The Lift room: a sheet that bends onto a hemisphere, and how far apart two of its points are there (P10, P13, P7). */

import { field, find, plain, say } from "../dom.ts";
import type { Pen, Point, Sheet } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import type { Exchange } from "../exchange.ts";
import { fields, number, whole, type Fields } from "../fields.ts";
import type { LinkValues } from "../link.ts";
import type { Room, RoomHost } from "../room.ts";
import { arrowStep } from "../view/ball_hand.ts";
import { distance, follow, isCommand, type Hold } from "../view/hand.ts";
import { View } from "../view/view.ts";
import { counted, fixed, ofFacets, wrap } from "../words.ts";
import { mark, NumberField } from "./controls.ts";
import { LiftPicture, type LiftScene } from "./lift_drawing.ts";
import { LiftSites, SHEET_SIDES, sheetSets, type Sheet as BentSheet } from "./lift_sites.ts";
import { measured, ofBend, ofBounds, ofPair, separation, WITHOUT_TRIANGLES } from "./lift_sites.ts";
import { SiteRoom, type NamedSites } from "./site_room.ts";

/** How the room begins: corners of the sheet, height and side of the view, degrees; P and Q by their indices. */
const HEMISPHERE = 90;
const PAIR = { p: 43, q: 1 };
type Letter = keyof typeof PAIR;
type LiftState = Readonly<Record<"bend" | "height" | "side", number> & Record<Letter, number | null>>;
const BEGINNING: LiftState = { bend: HEMISPHERE, height: 35, side: 17, p: null, q: null };

/** Of so many sites; hundredths of a degree are invisible. */
const liftFields = (count: number): Fields<LiftState> =>
  fields<LiftState>({
    bend: number("bend", 0, HEMISPHERE, 2),
    height: number("height", 0, 90, 2),
    side: number("side", -360, 360, 2),
    p: whole("p", count, 1),
    q: whole("q", count, 1),
  });

/** What the sum of facets is made of. */
const SUM = ["on the ball", "of the sheet", " the pole"] as const;

/** Degrees that a drag of a pixel turns. */
const DEGREES_PER_PIXEL = 0.35;

/** Sites from which on cells are left out while something moves. */
const MANY = 10_000;

/** @param sheet The places of the first set. */
export function liftRoom(host: RoomHost, sheet: Float64Array): Room {
  return new LiftRoom(host, sheetSets(sheet), "plane");
}

class LiftRoom extends SiteRoom implements Room {
  #plate!: Plate;
  #fields!: Record<"height" | "side" | Letter, NumberField>;

  #sites = new LiftSites(new Float64Array(0));
  #state = BEGINNING;
  #next: Letter = "p";

  override attach(section: HTMLElement): void {
    super.attach(section);
    const paint = (pen: Pen, moving: boolean): void => this.#picture(moving, pen).draw(pen);
    this.#plate = new Plate(find(section, "#lift-plate"), paint, this.host.guarded);
    const number = (name: string, typed: (value: number) => void) => new NumberField(section, name, 0, typed);
    this.#fields = {
      height: number("view-height", (height) => this.#turn(this.#state.side, height)),
      side: number("view-side", (side) => this.#turn(side, this.#state.height)),
      p: number("p", (site) => this.#setPair("p", site - 1)),
      q: number("q", (site) => this.#setPair("q", site - 1)),
    };
    const slider = field(section, "bend");
    slider.addEventListener("input", () => this.host.guarded(() => this.#bend(slider.valueAsNumber)));
    follow(this.#plate, {
      take: (at, reach) => this.#grab(at, reach),
      click: (at, reach) => {
        const site = this.#siteAt(at, reach);
        if (site !== null) this.chosen(site);
      },
      key: (event) => this.#key(event),
    });
  }

  // State

  state(isWhole: boolean): Record<string, string> {
    return { ...this.siteValues(isWhole), ...liftFields(this.#sites.count).write(this.#state) };
  }

  override restore(values: LinkValues): void {
    const named = this.sitesOf(values);
    const state = liftFields(named.places.length / 2).read(values, BEGINNING);
    super.restore(values);
    this.begin(named);
    const { p, q } = this.#state;
    this.#state = { ...state, p: state.p ?? p, q: state.q ?? q };
    this.#update();
  }

  /** P and Q are those of the first picture, or the first and the last site. */
  protected override begin(named: NamedSites): void {
    const isFirst = named.set === this.sets[0].name;
    this.#sites = new LiftSites(named.places, SHEET_SIDES[named.set]);
    const { count } = this.#sites;
    const ends = count < 2 ? { p: null, q: null } : { p: 0, q: count - 1 };
    this.#state = { ...this.#state, ...(isFirst ? PAIR : ends) };
    const label = `Sheet with ${counted(count)} ${count === 1 ? "site" : "sites"}, and ball`;
    this.#plate.canvas.setAttribute("aria-label", label);
    for (const letter of ["p", "q"] as const) {
      Object.assign(field(this.section, letter), { max: String(Math.max(1, count)), disabled: count < 2 });
    }
    this.#update("state", named);
  }

  // Drawing and words

  redraw(reason: Reason = "state"): void {
    this.#plate.redraw(reason);
  }

  get #bent(): BentSheet {
    return this.#sites.sheet(this.#state.bend);
  }

  #scene(isMoving: boolean): LiftScene {
    const { height, side, p, q } = this.#state;
    const isOn = this.shown(isMoving, MANY);
    const view = View.above(side - 90, height);
    return { sites: this.#sites, sheet: this.#bent, view, isOn, isMoving, p, q, lit: this.lit };
  }

  #picture(isMoving = false, { width, height }: Pick<Pen, "width" | "height"> = this.#plate): LiftPicture {
    return new LiftPicture(this.#scene(isMoving), width, height);
  }

  /** Everything that is said and drawn, after the state has changed. */
  #update(reason: Reason = "state", named = this.named): void {
    this.#showBend();
    this.#showPair();
    this.#showSites(named);
    const { simplices, dimension } = this.#sites.delaunay;
    const sum = (): string => ofFacets(simplices.length / 3, this.#sites.closing.length / 3, SUM);
    say(this.out("sum"), WITHOUT_TRIANGLES[dimension] ?? sum());
    this.#showView();
    this.redraw(reason);
  }

  #showView(): void {
    [this.#fields.height.value, this.#fields.side.value] = [this.#state.height, this.#state.side];
  }

  #showBend(): void {
    const slider = field(this.section, "bend");
    const words = ofBend(this.#bent);
    slider.value = String(this.#state.bend);
    slider.setAttribute("aria-valuetext", `corners at ${fixed(this.#state.bend, 0)}°: ${words}`);
    this.out("bend").textContent = words;
  }

  /** The sentence, and the ruler with the bounds and the angle of the moment. */
  #showPair(): void {
    const bounds = find(this.section, ".bounds");
    const { p, q } = this.#state;
    const isEnd = this.#state.bend === HEMISPHERE;
    bounds.classList.toggle("flat", !isEnd);
    bounds.classList.toggle("plane", this.#state.bend === 0);
    const ruler = this.out("scale");
    ruler.hidden = p === null || q === null;
    [this.#fields.p.value, this.#fields.q.value] = [p, q].map((site) => (p === null || q === null ? null : site! + 1));
    if (p === null || q === null) {
      say(this.out("separation"), "Two sites are needed.");
      say(this.out("promise"), "");
      return;
    }
    const now = separation(this.#sites, this.#bent, p, q);
    say(this.out("separation"), ofPair(now, this.#state.bend));
    say(this.out("promise"), ofBounds(now));
    const [low, high] = [`${fixed(now.low, 1)}°`, `${fixed(now.high, 1)}°`];
    const angle = now.angle === null ? "" : `${fixed(now.angle, 1)}°`;
    mark(bounds, ".needle", angle, (now.angle ?? 0) / 1.8).hidden = now.angle === null;
    const span = find(bounds, ".span");
    for (const [name, degrees] of Object.entries({ "--from": now.low, "--to": now.high })) {
      span.style.setProperty(name, `${fixed(degrees / 1.8, 2)}%`);
    }
    // Bounds whose marks would stand in each other's way share one.
    const isNarrow = now.high - now.low < CLOSE;
    mark(bounds, ".low", isNarrow ? `${low} to ${high}` : low, (isNarrow ? (now.low + now.high) / 2 : now.low) / 1.8);
    mark(bounds, ".high", isNarrow ? "" : high, now.high / 1.8);
    // The bounds come before the ends of the ruler.
    const room = isNarrow ? 2 * CLOSE : CLOSE;
    find(bounds, ".first").classList.toggle("bare", isEnd && now.low < room);
    find(bounds, ".last").classList.toggle("bare", isEnd && now.high > 180 - room);
    bounds.classList.toggle("narrow", isNarrow);
    const label = angle === "" ? "No separation in the plane" : `Separation ${angle}`;
    ruler.setAttribute("aria-label", isEnd ? `${label}; it must lie between ${low} and ${high}` : label);
  }

  /** What the sites are called, and the table, whose scales change with the sheet. */
  #showSites(named: NamedSites): void {
    const { count } = this.#sites;
    const sheet = this.#bent;
    this.show(named, {
      count,
      heads: ["*x*", "*y*", "Scale"],
      cells: (site) => {
        const [x, y] = this.#sites.place(site);
        return [measured(x, sheet.diagonal), measured(y, sheet.diagonal), fixed(sheet.scale(x, y), 3)];
      },
      mark: (site) => (site === this.#state.p ? "P" : site === this.#state.q ? "Q" : ""),
    });
    this.table.hold([this.#state.p, this.#state.q].filter((site) => site !== null));
  }

  // What can be done

  #bend(bend: number): void {
    this.#state = liftFields(this.#sites.count).settle({ ...this.#state, bend });
    this.#update("hand");
    this.changed(ofBend(this.#bent));
  }

  #turn(side: number, height: number, reason: Reason = "state"): void {
    this.#state = liftFields(this.#sites.count).settle({ ...this.#state, side: wrap(side), height });
    this.#showView();
    this.redraw(reason);
    this.changed(
      `Seen from ${fixed(this.#state.height, 0)}° above the sheet, turned by ${fixed(this.#state.side, 0)}°`,
    );
  }

  protected override switched(): void {
    this.redraw();
  }

  /** A site becomes P, the next one Q, and so on. */
  protected override chosen(site: number): void {
    const letter = this.#next;
    this.#next = letter === "p" ? "q" : "p";
    this.#setPair(letter, site);
  }

  #setPair(letter: Letter, site: number): void {
    if (!Number.isInteger(site) || site < 0 || site >= this.#sites.count) return;
    this.#state = { ...this.#state, [letter]: site };
    this.host.guarded(() => this.#update());
    this.host.changed();
    const { p, q } = this.#state;
    if (p === null || q === null) return;
    const now = separation(this.#sites, this.#bent, p, q);
    this.host.announcer.say(plain(`${letter.toUpperCase()} is site ${site + 1}. ${ofPair(now, this.#state.bend)}`));
  }

  // The hand

  /** P or Q, by its name, its place or its image; or the picture, to turn it. */
  #grab(at: Point, reach: number): Hold {
    for (const letter of ["q", "p"] as const) {
      const site = this.#state[letter];
      if (site === null || !this.#placesOf(site).some((place) => distance(place, at) <= reach)) continue;
      return {
        move: (to) => {
          const nearest = this.#siteAt(to, Infinity);
          if (nearest !== null && nearest !== this.#state[letter]) this.#setPair(letter, nearest);
        },
      };
    }
    const { side, height } = this.#state;
    return {
      move: ([x, y]) => {
        const [right, down] = [x - at[0], y - at[1]];
        this.#turn(side - DEGREES_PER_PIXEL * right, height + DEGREES_PER_PIXEL * down, "hand");
      },
    };
  }

  /** Where a held site is to be seen: its image, its place in the plane, its name. */
  #placesOf(site: number): Point[] {
    const picture = this.#picture();
    const above = picture.above(site);
    return [picture.surface.place(site), above, [above[0], above[1] - 14]];
  }

  #siteAt(at: Point, reach: number): number | null {
    const { surface } = this.#picture();
    let [best, least] = [null as number | null, Infinity];
    for (let site = 0; site < this.#sites.count; ++site) {
      const away = distance(surface.place(site), at);
      if (surface.isSeen(site) && away < least) [best, least] = [site, away];
    }
    return least <= reach ? best : null;
  }

  #key(event: KeyboardEvent): boolean {
    if (isCommand(event)) return false;
    const step = arrowStep(event);
    const actions: Record<string, () => void> = {
      "0": () => this.#turn(BEGINNING.side, BEGINNING.height),
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
    };
    const turn = step && ((): void => this.#turn(this.#state.side + step[0], this.#state.height + step[1]));
    const action = turn ?? actions[event.key];
    if (action !== undefined) this.host.guarded(action);
    return action !== undefined;
  }

  /** The next site becomes Q. */
  #walk(by: number): void {
    const { count } = this.#sites;
    if (this.#state.q !== null) this.#setPair("q", (this.#state.q + by + count) % count);
  }

  // Files and what can be taken along

  sheet(): Sheet {
    return this.#plate.sheet(this.title);
  }

  /** A sheet has no places on Earth. */
  geojson(): null {
    this.host.messages.show("", "GeoJSON holds places on Earth, and this sheet has none: take the Python lines along.");
    return null;
  }

  python(exchange: Exchange): string {
    return exchange.liftPython(this.#scene(false), this.#picture(), this.origin, SHEET_SIDES[this.named.set]);
  }
}

/** Degrees within which two marks of the ruler stand in each other's way. */
const CLOSE = 27;
