/** The Lift room: a sheet that bends onto a hemisphere, and how far apart two of its points are there (P10, P13, P7). */

import { field, find, plain, say } from "../dom.ts";
import type { Pen, Point, Sheet } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import type { Exchange } from "../exchange.ts";
import { fields, number, whole, type Fields } from "../fields.ts";
import type { Room, RoomHost } from "../room.ts";
import { arrowStep } from "../view/ball_hand.ts";
import { distance, follow, isCommand, type Hold } from "../view/hand.ts";
import { View } from "../view/view.ts";
import { counted, fixed, ofFacets, wrap } from "../words.ts";
import { mark, NumberField } from "./controls.ts";
import { LiftPicture, type LiftScene } from "./lift_drawing.ts";
import { LiftSites, SHEET_SIDES, sheetSets, type Separation, type Sheet as BentSheet } from "./lift_sites.ts";
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

class LiftRoom extends SiteRoom<LiftState> implements Room {
  #plate!: Plate;
  #fields!: Record<"height" | "side" | Letter, NumberField>;

  #sites = new LiftSites(new Float64Array(0));
  protected override now = BEGINNING;
  #next: Letter = "p";

  override attach(section: HTMLElement): void {
    super.attach(section);
    const paint = (pen: Pen, moving: boolean): void => this.#picture(moving, pen).draw(pen);
    this.#plate = new Plate(find(section, "#lift-plate"), paint, this.host.guarded);
    const number = (name: string, typed: (value: number) => void) => new NumberField(section, name, 0, typed);
    this.#fields = {
      height: number("view-height", (height) => this.#turn(this.now.side, height)),
      side: number("view-side", (side) => this.#turn(side, this.now.height)),
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

  protected readonly fields = liftFields;

  /** P and Q are those of the first picture, or the first and the last site. */
  protected override beginning({ places, set }: NamedSites, before = BEGINNING): LiftState {
    const count = places.length / 2;
    const ends = count < 2 ? { p: null, q: null } : { p: 0, q: count - 1 };
    return { ...before, ...(set === this.sets[0].name ? PAIR : ends) };
  }

  protected override begin(named: NamedSites): void {
    this.#sites = new LiftSites(named.places, SHEET_SIDES[named.set]);
    const { count } = this.#sites;
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
    return this.#sites.sheet(this.now.bend);
  }

  #scene(isMoving: boolean): LiftScene {
    const { height, side, p, q } = this.now;
    const isOn = this.shown(isMoving, MANY);
    const view = View.above(side - 90, height);
    return { sites: this.#sites, sheet: this.#bent, view, isOn, isMoving, p, q, lit: this.lit };
  }

  #picture(isMoving = false, { width, height }: Pick<Pen, "width" | "height"> = this.#plate): LiftPicture {
    return new LiftPicture(this.#scene(isMoving), width, height);
  }

  /** Everything that is said and drawn, after the state has changed. */
  #update(reason: Reason = "state", named = this.named): void {
    const [slider, sheet, words] = [field(this.section, "bend"), this.#bent, ofBend(this.#bent)];
    slider.value = String(this.now.bend);
    slider.setAttribute("aria-valuetext", `corners at ${fixed(this.now.bend, 0)}°: ${words}`);
    this.out("bend").textContent = words;
    this.#showPair();
    this.show(named, {
      count: this.#sites.count,
      heads: ["*x*", "*y*", "Scale"],
      cells: (site) => {
        const [x, y] = this.#sites.place(site);
        return [measured(x, sheet.diagonal), measured(y, sheet.diagonal), fixed(sheet.scale(x, y), 3)];
      },
      mark: (site) => (site === this.now.p ? "P" : site === this.now.q ? "Q" : ""),
    });
    this.table.hold([this.now.p, this.now.q].filter((site) => site !== null));
    const { simplices, dimension } = this.#sites.delaunay;
    const sum = (): string => ofFacets(simplices.length / 3, this.#sites.closing.length / 3, SUM);
    say(this.out("sum"), WITHOUT_TRIANGLES[dimension] ?? sum());
    this.#showView();
    this.redraw(reason);
  }

  #showView(): void {
    [this.#fields.height.value, this.#fields.side.value] = [this.now.height, this.now.side];
  }

  get #pair(): Separation | null {
    const { p, q } = this.now;
    return p === null || q === null ? null : separation(this.#sites, this.#bent, p, q);
  }

  /** The sentence, and the ruler with the bounds and the angle of the moment. */
  #showPair(): void {
    const [bounds, ruler, pair, { bend }] = [find(this.section, ".bounds"), this.out("scale"), this.#pair, this.now];
    bounds.classList.toggle("flat", bend < HEMISPHERE);
    for (const letter of ["p", "q"] as const) this.#fields[letter].value = pair && this.now[letter]! + 1;
    ruler.hidden = pair === null;
    say(this.out("separation"), pair === null ? "Two sites are needed." : ofPair(pair, bend));
    say(this.out("promise"), pair === null ? "" : ofBounds(pair));
    if (pair === null) return;
    const angle = pair.angle === null ? "" : `${fixed(pair.angle, 1)}°`;
    mark(bounds, ".needle", angle, (pair.angle ?? 0) / 1.8).hidden = pair.angle === null;
    const span = `${fixed(pair.low, 1)}° to ${fixed(pair.high, 1)}°`;
    mark(bounds, ".low", span, (pair.low + pair.high) / 3.6);
    for (const [name, degrees] of [
      ["--from", pair.low],
      ["--to", pair.high],
    ] as const) {
      find(bounds, ".span").style.setProperty(name, `${fixed(degrees / 1.8, 2)}%`);
    }
    const label = angle === "" ? "No separation in the plane" : `Separation ${angle}`;
    ruler.setAttribute("aria-label", bend < HEMISPHERE ? label : `${label}; it must lie between ${span}`);
  }

  // What can be done

  #bend(bend: number): void {
    this.put({ bend });
    this.#update("hand");
    this.changed(ofBend(this.#bent));
  }

  #turn(side: number, height: number, reason: Reason = "state"): void {
    this.put({ side: wrap(side), height });
    this.#showView();
    this.redraw(reason);
    this.changed(`Seen from ${fixed(this.now.height, 0)}° above the sheet, turned by ${fixed(this.now.side, 0)}°`);
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
    this.now = { ...this.now, [letter]: site };
    this.host.guarded(() => this.#update());
    this.host.changed();
    const words = this.#pair && ofPair(this.#pair, this.now.bend);
    if (words !== null) this.host.announcer.say(plain(`${letter.toUpperCase()} is site ${site + 1}. ${words}`));
  }

  // The hand

  /** P or Q, by its place or its image; or the picture, to turn it. */
  #grab(at: Point, reach: number): Hold {
    const picture = this.#picture();
    for (const letter of ["q", "p"] as const) {
      const site = this.now[letter];
      const places = site === null ? [] : [picture.surface.place(site), picture.above(site)];
      if (!places.some((place) => distance(place, at) <= reach)) continue;
      return {
        move: (to) => {
          const nearest = this.#siteAt(to, Infinity);
          if (nearest !== null && nearest !== this.now[letter]) this.#setPair(letter, nearest);
        },
      };
    }
    const { side, height } = this.now;
    return {
      move: ([x, y]) => {
        const [right, down] = [x - at[0], y - at[1]];
        this.#turn(side - DEGREES_PER_PIXEL * right, height + DEGREES_PER_PIXEL * down, "hand");
      },
    };
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
    const turn = step && ((): void => this.#turn(this.now.side + step[0], this.now.height + step[1]));
    const action = turn ?? actions[event.key];
    if (action !== undefined) this.host.guarded(action);
    return action !== undefined;
  }

  /** The next site becomes Q. */
  #walk(by: number): void {
    const { count } = this.#sites;
    if (this.now.q !== null) this.#setPair("q", (this.now.q + by + count) % count);
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
