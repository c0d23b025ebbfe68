/** The Sphere room: sites on a ball, and in the plane that they are projected to (Theorem 1, and the insertion). */

import { field, find, say } from "../dom.ts";
import { Plate } from "../drawing/plate.ts";
import type { Reason } from "../drawing/plate.ts";
import type { Sheet } from "../drawing/sheet.ts";
import type { Exchange } from "../exchange.ts";
import { lonlatToXyz } from "../kernel/api.ts";
import { MOST_SITES, packPlaces, writeNumber } from "../link.ts";
import type { LinkValues } from "../link.ts";
import type { Room, RoomHost } from "../room.ts";
import { sphereSets } from "../sets.ts";
import type { SiteSet, Stored } from "../sets.ts";
import { SiteTable } from "../table.ts";
import { arrowed, grabBall } from "../view/ball_hand.ts";
import { distance, follow } from "../view/hand.ts";
import type { Gestures, Hold, Place as Point } from "../view/hand.ts";
import { Motion } from "../view/motion.ts";
import { pointUnder, View } from "../view/view.ts";
import { counted, latitude, longitude, wrap } from "../words.ts";
import { listSets, NumberField, showSet, Switches, tellNamed } from "./controls.ts";
import { History } from "./history.ts";
import { placeOf } from "./lines.ts";
import { dot, lonLatOf, row } from "./space.ts";
import type { Vector } from "./space.ts";
import { BallLayers, drawBall, drawPlane } from "./sphere_drawing.ts";
import type { SphereScene, Step } from "./sphere_drawing.ts";
import { SphereSites } from "./sphere_sites.ts";
import type { Bubble } from "./sphere_sites.ts";
import { ofBubble, ofDuplicates, ofFacets, ofStep, withoutTriangles } from "./sphere_words.ts";
import { Twin } from "./twin.ts";

type Place = readonly [number, number];

const CLICKS = ["keep", "add", "remove"] as const;
const SWITCHES = ["triangles", "cells", "bubble", "seeing", "closing"] as const;

/** How the room begins: degrees. */
const POLE: Place = [-150, 53.1];
const VIEW: Place = [0, 0];
const AIM: Place = [-9.94, 3.49];

/** Decimals of a degree to which the view is held. */
const VIEW_DECIMALS = 4;

/** Decimals of a degree to which the hand moves things. */
const HAND_DECIMALS = 3;

/** Sites from which on cells are left out while something moves, and from which on nothing but dots is drawn then. */
const MANY = 3_000;
const VERY_MANY = 100_000;

/** Sites of the plane that may lie outside its frame: one in so many. */
const OUTSIDE = 20;

/** Room around the sites in the frame, and between the pictures of a file, px. */
const ROOM = 1.07;
const GAP = 32;

/** @param stored Sets that the page carries. @param givenName What those are called that the page was made for. */
export function sphereRoom(host: RoomHost, stored: Stored = {}, givenName?: string): Room {
  return new SphereRoom(host, sphereSets(stored, givenName));
}

class SphereRoom implements Room {
  readonly #host: RoomHost;
  readonly #history = new History();
  readonly #releases: (() => void)[] = [];
  #section!: HTMLElement;
  #ball!: Plate;
  #plane!: Plate;
  #table!: SiteTable;
  #switches!: Switches;
  #poleFields!: [NumberField, NumberField];
  #viewFields!: [NumberField, NumberField];
  #select!: HTMLSelectElement;
  readonly #sets: readonly SiteSet[];

  #sites = new SphereSites(new Float64Array(0));
  #set = "gap";
  #file: string | null = null;
  #pole: Place = POLE;
  #view: Place = VIEW;
  /** Where the pointer was last, and whether the bubble there is kept. */
  #aim: Vector = [1, 0, 0];
  #isPinned = false;
  #held: number | null = null;
  #lit: number | null = null;
  /** Sites that are inserted; null for all of them, drawn as what they are in the end. */
  #count: number | null = null;
  #reach = 1;
  readonly #motion = new Motion();
  #layers = new BallLayers(this.#sites);

  // What follows from the state; made anew when it changes.
  #twin = new Twin([0, 0, 1]);
  #seeing: Uint8Array = new Uint8Array(0);
  #step: Step | "done" = "done";
  #bubble: Bubble | null = null;

  constructor(host: RoomHost, sets: readonly SiteSet[]) {
    this.#host = host;
    this.#sets = sets;
  }

  attach(section: HTMLElement): void {
    this.#section = section;
    this.#ball = new Plate(
      find<HTMLCanvasElement>(section, "#sphere-ball"),
      (pen, moving) => drawBall(pen, this.#ball.disc, this.#scene(moving)),
      this.#host.guarded,
    );
    this.#plane = new Plate(
      find<HTMLCanvasElement>(section, "#sphere-plane"),
      (pen, moving) => drawPlane(pen, this.#frame(), this.#scene(moving)),
      this.#host.guarded,
    );
    this.#table = new SiteTable(find(section, ".sites"), {
      chosen: (site) => this.#center(site),
      pointed: (site) => {
        this.#lit = site;
        this.redraw();
      },
    });
    this.#switches = new Switches(section, SWITCHES, () => {
      this.redraw();
      this.#host.changed();
    });
    this.#poleFields = this.#fields("pole", 1, (place) => this.#movePole(place));
    this.#viewFields = this.#fields("view", 1, (place) => this.#turn(place));
    this.#select = listSets(section, this.#sets, (set) => this.#guarded(() => this.#begin(set)));
    for (const choice of section.querySelectorAll<HTMLInputElement>("input[name=click]")) {
      choice.addEventListener("change", () => this.#host.changed());
    }
    this.#stepControls();
    this.#siteForm();
    find(section, "[data-do=undo]").addEventListener("click", () => this.#undo());
    this.#releases.push(follow(this.#ball, this.#ballGestures()), follow(this.#plane, this.#planeGestures()));
  }

  #fields(name: string, decimals: number, typed: (place: Place) => void): [NumberField, NumberField] {
    const value = (part: string): number => field(this.#section, `${name}-${part}`).valueAsNumber;
    const act = (): void => {
      const place: Place = [value("lon"), value("lat")];
      if (place.every(Number.isFinite)) this.#guarded(() => typed(place));
    };
    return [
      new NumberField(this.#section, `${name}-lon`, decimals, act),
      new NumberField(this.#section, `${name}-lat`, decimals, act),
    ];
  }

  // State

  state(): Record<string, string> {
    const state: Record<string, string> = {};
    const places = this.#sites.lonlat;
    if (this.#set !== "own") state["set"] = this.#set;
    else if (places.length <= 2 * MOST_SITES) state["sites"] = packPlaces(places);
    else state["file"] = this.#file ?? "sites";
    const put = (name: string, value: Place, otherwise: Place): void => {
      if (value[0] === otherwise[0] && value[1] === otherwise[1]) return;
      state[`${name}-lon`] = writeNumber(value[0], 4);
      state[`${name}-lat`] = writeNumber(value[1], 4);
    };
    put("pole", this.#pole, POLE);
    put("view", this.#view, VIEW);
    const aim = lonLatOf(this.#aim).map((degrees) => Number(degrees.toFixed(3))) as unknown as Place;
    if (this.#isPinned) {
      put("aim", aim, AIM);
      state["pin"] = "1";
    }
    if (this.#count !== null) state["step"] = String(this.#count);
    if (this.#switches.turned) state["turned"] = this.#switches.turned;
    const click = this.#clickMode;
    if (click !== "keep") state["click"] = click;
    return state;
  }

  restore(values: LinkValues): void {
    const place = (name: string, otherwise: Place): Place => [
      values.number(`${name}-lon`, -360, 360, otherwise[0]),
      values.number(`${name}-lat`, -90, 90, otherwise[1]),
    ];
    const [pole, view, aim] = [place("pole", POLE), place("view", VIEW), place("aim", AIM)];
    const click = values.word("click", CLICKS, "keep");
    const name = values.word("set", [...this.#sets.map((set) => set.name), "own"], this.#sets[0].name);
    const own = values.lonlat("sites");
    const lonlat = own ?? (this.#sets.find((set) => set.name === name) ?? this.#sets[0]).make();
    const count = values.whole("step", 1, lonlat.length / 2, 0);
    this.#history.clear();
    [this.#pole, this.#view, this.#isPinned] = [pole, view, values.has("pin")];
    this.#aim = directionAt(aim);
    this.#count = count === 0 || count === lonlat.length / 2 ? null : count;
    this.#held = null;
    this.#file = null;
    this.#switches.turned = values.text("turned", "");
    for (const choice of this.#section.querySelectorAll<HTMLInputElement>("input[name=click]"))
      choice.checked = choice.value === click;
    this.#take(lonlat, own === null ? name : "own");
    tellNamed(this.#host.messages, values, "file");
  }

  /** A set of the list, seen as it was. */
  #begin(set: SiteSet): void {
    this.#history.clear();
    this.#count = this.#held = null;
    this.#file = null;
    this.#take(set.make(), set.name);
    this.#host.changed(true);
  }

  /** Other sites. */
  #take(lonlat: Float64Array, set: string, reason: Reason = "state"): void {
    this.#sites = new SphereSites(lonlat);
    this.#layers = new BallLayers(this.#sites);
    this.#set = set;
    if (this.#count !== null && this.#count >= this.#sites.count) this.#count = null;
    showSet(this.#select, set, set === "own" ? (this.#file ?? "Your own sites") : null);
    const { sites } = this;
    this.#table.show({
      count: sites.count,
      heads: ["Latitude", "Longitude", "Neighbours"],
      cells: (site) => [
        latitude(sites.lonlat[2 * site + 1]),
        longitude(sites.lonlat[2 * site]),
        String(sites.neighborCounts[site]),
      ],
    });
    find(this.#section, "[data-out=count]").textContent =
      sites.count === 1 ? "The site" : `The ${counted(sites.count)} sites`;
    find(this.#section, "[data-show=closing]").hidden = !sites.hasClosing;
    this.#ball.canvas.setAttribute(
      "aria-label",
      `Sphere with ${counted(sites.count)} ${sites.count === 1 ? "site" : "sites"}`,
    );
    this.#project();
    if (reason !== "hand") this.#rescale();
    this.#update(reason);
  }

  private get sites(): SphereSites {
    return this.#sites;
  }

  /** The pole has moved, or the sites. */
  #project(): void {
    const pole = directionAt(this.#pole);
    this.#twin = new Twin(pole);
    this.#seeing = this.#sites.seeing(pole);
  }

  /** The frame of the plane holds nearly all sites; it changes only when the hand rests. */
  #rescale(): void {
    const sizes = Array.from({ length: this.#sites.count }, (_, k) =>
      Math.max(...this.#twin.forward(this.#sites.site(k)).map(Math.abs)),
    );
    sizes.sort((a, b) => a - b);
    const nearly = sizes[Math.floor(((OUTSIDE - 1) / OUTSIDE) * (sizes.length - 1))] ?? 1;
    const all = sizes[sizes.length - 1] ?? 1;
    this.#reach = ROOM * (all < 2 * nearly ? all : nearly) || 1;
    this.#outside(sizes.filter((size) => size > this.#reach).length);
  }

  #outside(count: number): void {
    const words =
      count === 0
        ? ""
        : `${count === 1 ? "One site lies" : `${counted(count)} sites lie`} outside the frame, near the pole.`;
    find(this.#section, "[data-out=outside]").textContent = words;
  }

  // Drawing

  redraw(reason: Reason = "state"): void {
    this.#ball.redraw(reason);
    this.#plane.redraw(reason);
  }

  /** Everything that is said and drawn, after the state has changed. */
  #update(reason: Reason = "state"): void {
    this.#bubble = this.#findBubble();
    this.#step = this.#findStep();
    this.#say();
    this.redraw(reason);
  }

  #findBubble(): Bubble | null {
    if (!this.#switches.isOn("bubble") || this.#count !== null) return null;
    const facet = this.#sites.facetAt(this.#aim);
    return facet === null ? null : this.#sites.bubble(facet);
  }

  #findStep(): Step | "done" {
    if (this.#count === null) return "done";
    const site = this.#count - 1;
    const insertion = this.#sites.insertion(site);
    const seeing = (facets: Int32Array | undefined): Uint8Array =>
      facets === undefined ? new Uint8Array(0) : this.#sites.seeing(this.#twin.pole, facets);
    return { site, insertion, beforeSeeing: seeing(insertion?.before), fanSeeing: seeing(insertion?.fan) };
  }

  #scene(isMoving: boolean): SphereScene {
    const { count } = this.#sites;
    const isOn = (name: string): boolean => this.#switches.isOn(name);
    const dotsAlone = isMoving && count > VERY_MANY;
    return {
      sites: this.#sites,
      layers: this.#layers,
      view: this.#seen,
      twin: this.#twin,
      seeing: this.#seeing,
      shown: {
        triangles: isOn("triangles") && !dotsAlone,
        cells: isOn("cells") && !(isMoving && count > MANY),
        seeing: isOn("seeing") && !dotsAlone,
        closing: isOn("closing") && !dotsAlone,
      },
      bubble: this.#bubble,
      held: [this.#held, this.#lit].filter((site) => site !== null && site < count) as number[],
      step: this.#step,
      reach: this.#reach,
    };
  }

  get #seen(): View {
    return View.above(...this.#view);
  }

  #frame(): { x: number; y: number; size: number } {
    return { x: 1, y: 1, size: Math.min(this.#plane.width, this.#plane.height) - 2 };
  }

  #guarded(body: () => void): void {
    this.#host.guarded(body);
  }

  // Words

  #say(): void {
    const { sites } = this;
    const alone = withoutTriangles(sites);
    const sentence = find(this.#section, "[data-out=sentence]");
    const step = this.#step;
    const words =
      step !== "done"
        ? ofStep(step.insertion, step.site)
        : (alone ??
          (this.#bubble === null
            ? "Point at a triangle for the circle round it."
            : ofBubble(this.#bubble, sites, this.#twin)));
    say(sentence, [words, step === "done" ? ofDuplicates(sites) : ""].filter(Boolean).join(" "));
    const sum = find(this.#section, "[data-out=sum]");
    const seeing = this.#seeing.reduce((total, sees) => total + sees, 0);
    say(sum, alone === null ? ofFacets(sites.facetCount, seeing) : "");
    sum.hidden = step !== "done" || alone !== null;
    const isBehind = dot(this.#twin.pole, directionAt(this.#view)) < 0;
    say(
      find(this.#section, "[data-out=pole-side]"),
      `*P*, the pole of projection, lies ${isBehind ? "behind" : "in front"}.`,
    );
    this.#showStep();
    this.#poleFields[0].value = this.#pole[0];
    this.#poleFields[1].value = this.#pole[1];
    this.#viewFields[0].value = this.#view[0];
    this.#viewFields[1].value = this.#view[1];
    this.#table.hold([...(this.#bubble?.sites ?? []), ...(this.#held === null ? [] : [this.#held])]);
    find<HTMLButtonElement>(this.#section, "[data-do=undo]").disabled = this.#history.isEmpty;
    this.#showSite();
  }

  // The hand

  #ballGestures(): Gestures {
    return {
      take: (at, reach) => (distance(at, this.#middle) <= this.#ball.disc.r + reach ? this.#grab(at, reach) : null),
      hover: (at) =>
        this.#hover(at === null || distance(at, this.#middle) > this.#ball.disc.r ? null : this.#directionAt(at)),
      click: (at, reach) => this.#click(this.#directionAt(at), this.#siteAt(at, reach)),
      key: (event) => this.#key(event),
    };
  }

  #planeGestures(): Gestures {
    return {
      take: () => ({ move: () => {} }),
      hover: (at) => this.#hover(at === null ? null : this.#planeDirection(at)),
      click: (at, reach) => this.#click(this.#planeDirection(at), this.#planeSiteAt(at, reach)),
    };
  }

  get #middle(): Point {
    return [this.#ball.disc.x, this.#ball.disc.y];
  }

  #directionAt(at: Point): Vector {
    return this.#seen.onBall(pointUnder(this.#ball.disc, at));
  }

  #planeDirection(at: Point): Vector {
    const { x, y, size } = this.#frame();
    const scale = (2 * this.#reach) / size;
    return this.#twin.inverse((at[0] - x - size / 2) * scale, (y + size / 2 - at[1]) * scale);
  }

  /** The visible site within reach of a point of the ball, or null. */
  #siteAt(at: Point, reach: number): number | null {
    if (this.#sites.count === 0) return null;
    const [site] = this.#sites.delaunay.nearest(this.#directionAt(at));
    const point = this.#seen.seen(this.#sites.site(site));
    return point[2] >= 0 && distance(placeOf(this.#ball.disc, point), at) <= reach ? site : null;
  }

  #planeSiteAt(at: Point, reach: number): number | null {
    if (this.#sites.count === 0) return null;
    const [site] = this.#sites.delaunay.nearest(this.#planeDirection(at));
    const [u, v] = this.#twin.forward(this.#sites.site(site));
    const { x, y, size } = this.#frame();
    const scale = size / 2 / this.#reach;
    return Math.hypot(x + size / 2 + scale * u - at[0], y + size / 2 - scale * v - at[1]) <= reach ? site : null;
  }

  /** The bubble follows the pointer, unless one is kept. */
  #hover(direction: Vector | null): void {
    if (direction === null || this.#isPinned || this.#count !== null) return;
    const before = this.#bubble?.facet;
    this.#aim = direction;
    if (this.#sites.facetAt(direction) === (before ?? null)) return;
    this.#guarded(() => this.#update());
  }

  /** The pole's handle, a site, or the ball. */
  #grab(at: Point, reach: number): Hold | null {
    const { disc } = this.#ball;
    const pole = this.#seen.seen(this.#twin.pole);
    if (distance(placeOf(disc, pole), at) <= reach) return this.#grabPole(pole[2] < 0);
    const site = this.#count === null ? this.#siteAt(at, Math.min(reach, REACH_OF_SITES, this.#spacing / 3)) : null;
    if (site !== null) return this.#grabSite(site);
    const room = this;
    const ball = {
      disc,
      isNorthUp: true,
      get view() {
        return room.#seen;
      },
      turn: (view: View, reason: Reason) => this.#turn(view.middle, reason),
    };
    return grabBall(ball, this.#motion, at);
  }

  /** Pixels between sites that are spread evenly: where they lie close, the ball can still be turned between them. */
  get #spacing(): number {
    return this.#ball.disc.r * Math.sqrt((4 * Math.PI) / this.#sites.count);
  }

  /** Over the limb and back in the pole is on the other side. */
  #grabPole(isBehind: boolean): Hold {
    const { disc } = this.#ball;
    let [behind, wasOut] = [isBehind, false];
    return {
      move: (to) => {
        const isOut = distance(to, this.#middle) > disc.r;
        if (!isOut && wasOut) behind = !behind;
        wasOut = isOut;
        const [x, y, z] = pointUnder(disc, to);
        this.#guarded(() => this.#movePole(lonLatOf(this.#seen.onBall([x, y, behind ? -z : z])), false));
      },
      end: () => this.#rest(),
    };
  }

  #grabSite(site: number): Hold {
    let isFirst = true;
    return {
      move: (to) => {
        if (isFirst) this.#history.push(this.#sites.lonlat);
        isFirst = false;
        this.#guarded(() => this.#moveSite(site, this.#directionAt(to), "hand"));
      },
      end: () => this.#rest(),
    };
  }

  #click(direction: Vector, site: number | null): void {
    this.#guarded(() => {
      const mode = this.#count === null ? this.#clickMode : "keep";
      if (mode === "add") this.#add(direction);
      else if (mode === "remove") {
        if (site !== null) this.#remove(site);
      } else {
        this.#held = site;
        this.#isPinned = !this.#isPinned || this.#sites.facetAt(direction) !== this.#bubble?.facet;
        this.#aim = direction;
        this.#update();
        this.#host.changed();
        if (this.#bubble !== null) this.#host.announcer.say(ofBubble(this.#bubble, this.#sites, this.#twin));
      }
    });
  }

  get #clickMode(): (typeof CLICKS)[number] {
    const chosen = this.#section.querySelector<HTMLInputElement>("input[name=click]:checked")?.value;
    return CLICKS.find((mode) => mode === chosen) ?? "keep";
  }

  /** The hand has let go: the frame fits again, and what was left out is drawn. */
  #rest(): void {
    this.#guarded(() => {
      this.#rescale();
      this.#update();
    });
    this.#host.changed();
  }

  // What can be done

  #turn(place: Place, reason: Reason = "state"): void {
    this.#view = [exact(wrap(place[0])), exact(place[1])];
    this.#say();
    this.#ball.redraw(reason);
    this.#host.changed();
    this.#host.announcer.say(`Seen from ${latitude(place[1], 0)}, ${longitude(place[0], 0)}`);
  }

  /** Flies to another view. */
  #fly(to: Place): void {
    const from = this.#view;
    const east = wrap(to[0] - from[0]);
    this.#motion.fly((t) =>
      this.#turn([from[0] + t * east, from[1] + t * (to[1] - from[1])], t < 1 ? "flight" : "state"),
    );
  }

  #movePole(place: Place, rests = true): void {
    this.#pole = [rounded(wrap(place[0])), rounded(place[1])];
    this.#project();
    if (rests) this.#rescale();
    this.#update(rests ? "state" : "hand");
    this.#host.changed();
    const seeing = this.#seeing.reduce((total, sees) => total + sees, 0);
    this.#host.announcer.say(`${this.#sites.facetCount - seeing} triangles in the plane, ${seeing} facets see P`);
  }

  #moveSite(site: number, direction: Vector, reason: Reason = "state"): void {
    const lonlat = this.#sites.lonlat.slice();
    lonlat.set(lonLatOf(direction).map(rounded), 2 * site);
    this.#held = site;
    this.#aim = direction;
    this.#take(lonlat, "own", reason);
    this.#host.changed();
    this.#host.announcer.say(`Site ${site + 1}: ${latitude(lonlat[2 * site + 1])}, ${longitude(lonlat[2 * site])}`);
  }

  #add(direction: Vector): void {
    this.#history.push(this.#sites.lonlat);
    const { count } = this.#sites;
    const lonlat = new Float64Array(2 * count + 2);
    lonlat.set(this.#sites.lonlat);
    lonlat.set(lonLatOf(direction).map(rounded), 2 * count);
    this.#held = count;
    this.#take(lonlat, "own");
    this.#table.reveal(count);
    this.#host.changed();
    const same = this.#sites.sameAs(count);
    this.#host.announcer.say(
      same === null
        ? `Site ${count + 1} added, ${this.#sites.neighborCounts[count]} neighbours`
        : `Site ${count + 1} lies exactly on site ${same + 1} and counts once.`,
    );
  }

  #remove(site: number): void {
    this.#history.push(this.#sites.lonlat);
    const lonlat = this.#sites.lonlat.filter((_, k) => k >> 1 !== site);
    this.#held = null;
    this.#take(lonlat, "own");
    this.#host.changed();
    this.#host.announcer.say(`Site ${site + 1} removed`);
  }

  #undo(): void {
    const before = this.#history.pop();
    if (before === null) return;
    this.#held = null;
    this.#guarded(() => this.#take(before, "own"));
    this.#host.changed();
    this.#host.announcer.say("Undone");
  }

  /** Brings a site to the middle of the ball, and holds it. */
  #center(site: number): void {
    this.#held = site;
    this.#aim = this.#sites.site(site);
    this.#fly([this.#sites.lonlat[2 * site], this.#sites.lonlat[2 * site + 1]]);
    this.#guarded(() => this.#update());
    this.#host.changed();
  }

  // Keys

  /** Whether a key is one of the drawing's. */
  #key(event: KeyboardEvent): boolean {
    this.#motion.stop();
    const view = arrowed({ disc: this.#ball.disc, view: this.#seen, isNorthUp: true, turn: () => {} }, event);
    if (view !== null) this.#guarded(() => this.#turn(view.middle));
    else if (event.ctrlKey && event.key.startsWith("Arrow"))
      this.#guarded(() => this.#nudge(event.key, event.shiftKey ? 1 : 5));
    else if (event.ctrlKey && event.key.toLowerCase() === "z") this.#undo();
    else return !event.ctrlKey && this.#act(event.key);
    return true;
  }

  /** Moves the site that is held by degrees. */
  #nudge(key: string, step: number): void {
    if (this.#held === null) return;
    const east = key === "ArrowLeft" ? -step : key === "ArrowRight" ? step : 0;
    const north = key === "ArrowDown" ? -step : key === "ArrowUp" ? step : 0;
    const [lon, lat] = this.#sites.lonlat.subarray(2 * this.#held, 2 * this.#held + 2);
    this.#history.push(this.#sites.lonlat);
    this.#moveSite(this.#held, directionAt([lon + east, Math.max(-90, Math.min(90, lat + north))]));
  }

  /** Whether a key does something. */
  #act(key: string): boolean {
    const { count } = this.#sites;
    const middle = directionAt(this.#view);
    const actions: Record<string, () => void> = {
      "0": () => this.#turn(VIEW),
      n: () => this.#add(middle),
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
      Delete: () => this.#held !== null && this.#remove(this.#held),
      Backspace: () => this.#held !== null && this.#remove(this.#held),
      Enter: () => this.#click(middle, null),
      Escape: () => {
        this.#isPinned = false;
        this.#held = null;
        this.#update();
        this.#host.changed();
      },
    };
    const action = actions[key.length === 1 ? key.toLowerCase() : key];
    if (action === undefined || (count === 0 && key !== "n" && key !== "0")) return false;
    this.#guarded(action);
    return true;
  }

  #walk(by: number): void {
    const { count } = this.#sites;
    const site = this.#held === null ? (by > 0 ? 0 : count - 1) : (this.#held + by + count) % count;
    this.#center(site);
    this.#table.reveal(site);
    this.#host.announcer.say(
      `Site ${site + 1}, ${latitude(this.#sites.lonlat[2 * site + 1])}, ${longitude(this.#sites.lonlat[2 * site])}, ` +
        `${this.#sites.neighborCounts[site]} neighbours`,
    );
  }

  // Controls below the drawing

  #stepControls(): void {
    const slider = field(this.#section, "step");
    slider.addEventListener("input", () => this.#guarded(() => this.#setStep(slider.valueAsNumber)));
    const by = (change: number) => () =>
      this.#guarded(() => this.#setStep((this.#count ?? this.#sites.count) + change));
    find(this.#section, "[data-do=back]").addEventListener("click", by(-1));
    find(this.#section, "[data-do=next]").addEventListener("click", by(1));
  }

  #setStep(count: number): void {
    const { count: all } = this.#sites;
    const least = Math.min(4, all);
    this.#count = count >= all ? null : Math.max(least, count);
    this.#held = null;
    this.#update();
    this.#host.changed();
    if (this.#step !== "done") this.#host.announcer.say(ofStep(this.#step.insertion, this.#step.site));
  }

  #showStep(): void {
    const { count } = this.#sites;
    const now = this.#count ?? count;
    const slider = field(this.#section, "step");
    slider.min = String(Math.min(4, count));
    slider.max = String(count);
    slider.value = String(now);
    slider.disabled = count < 5;
    const words = `site ${counted(now)} of ${counted(count)}`;
    slider.setAttribute("aria-valuetext", words);
    find(this.#section, "[data-out=step]").textContent = words;
    find<HTMLButtonElement>(this.#section, "[data-do=back]").disabled = now <= Math.min(4, count);
    find<HTMLButtonElement>(this.#section, "[data-do=next]").disabled = now >= count;
  }

  #siteForm(): void {
    const form = find<HTMLFormElement>(this.#section, "[data-form=site]");
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const place: Place = [field(form, "lon").valueAsNumber, field(form, "lat").valueAsNumber];
      const what = event.submitter?.getAttribute("value") ?? "add";
      this.#guarded(() => {
        if (what === "remove" && this.#held !== null) this.#remove(this.#held);
        else if (what === "move" && this.#held !== null) {
          this.#history.push(this.#sites.lonlat);
          this.#moveSite(this.#held, directionAt(place));
        } else if (what === "add") this.#add(directionAt(place));
      });
    });
  }

  /** The fields under the table show the site that is held. */
  #showSite(): void {
    const form = find<HTMLFormElement>(this.#section, "[data-form=site]");
    for (const button of form.querySelectorAll<HTMLButtonElement>("button")) {
      button.disabled = button.value !== "add" && this.#held === null;
    }
    if (this.#held === null || form.contains(document.activeElement)) return;
    field(form, "lon").value = String(this.#sites.lonlat[2 * this.#held]);
    field(form, "lat").value = String(this.#sites.lonlat[2 * this.#held + 1]);
  }

  // Files and what can be taken along

  open(file: File, exchange: Exchange): Promise<void> {
    return exchange.openPoints(file, "lonlat", this.#host.messages, (points) => {
      this.#guarded(() => {
        this.#history.clear();
        this.#file = points.file;
        this.#count = this.#held = null;
        this.#take(points.places, "own");
        this.#host.changed(true);
      });
    });
  }

  /** Both pictures beside each other. */
  sheet(): Sheet {
    const size = this.#ball.width;
    const { disc } = this.#ball;
    const scene = this.#scene(false);
    return {
      title: find(this.#section, "h1").textContent ?? "",
      width: 2 * size + GAP,
      height: size,
      weight: 1,
      paint: (pen) => {
        drawBall(pen, disc, scene);
        drawPlane(pen, { x: size + GAP + 1, y: 1, size: size - 2 }, scene);
      },
    };
  }

  geojson(exchange: Exchange): string {
    return exchange.sitesGeojson(this.#sites);
  }

  python(exchange: Exchange): string {
    const aim = this.#bubble === null ? null : lonLatOf(this.#aim);
    return exchange.spherePython(this.#sites, { file: this.#file, pole: this.#pole, view: this.#view, aim });
  }

  dispose(): void {
    this.#motion.stop();
    for (const release of this.#releases) release();
    this.#ball.dispose();
    this.#plane.dispose();
  }
}

/** Pixels within which a site is caught to be moved: nearer than a handle, so that the ball can be turned between sites. */
const REACH_OF_SITES = 8;

/** The direction of a place, as the kernel and Python have it. */
function directionAt([lon, lat]: Place): Vector {
  return row(lonlatToXyz([lon, lat]), 0);
}

/** A view as a link holds it, so that the link shows the same pixels: 1e-4 degrees are invisible. */
function exact(degrees: number): number {
  return Number(degrees.toFixed(VIEW_DECIMALS));
}

function rounded(degrees: number): number {
  return Number(degrees.toFixed(HAND_DECIMALS));
}
