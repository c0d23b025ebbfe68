/** The Sphere room: sites on a ball, and in the plane that they are projected to (Theorem 1, and the insertion). */

import type { Places } from "./globe_scene.ts";
import { find, plain, say } from "../dom.ts";
import { placeOf } from "../drawing/ball.ts";
import type { Named } from "../drawing/names.ts";
import { regionsOf, type Switch } from "../drawing/parts.ts";
import type { Pen, Sheet } from "../drawing/pen.ts";
import { Plate, type Reason } from "../drawing/plate.ts";
import type { Exchange } from "../exchange.ts";
import type { Place } from "../fields.ts";
import type { MoebiusMap } from "../kernel/api.ts";
import type { Room, RoomHost } from "../room.ts";
import { sphereSets, type Stored } from "../sets.ts";
import { lonLatOf, type Vector } from "../space.ts";
import { arrowed, arrowStep, grabBall, keyFactor, lensGestures, type Magnifiable } from "../view/ball_hand.ts";
import { distance, follow, isCommand, type Gestures, type Hold, type Place as Point } from "../view/hand.ts";
import { betweenSights, imageOf, lensMap, magnified, scaleAt, sightMap, sourceOf, type Sight } from "../view/lens.ts";
import { Motion } from "../view/motion.ts";
import { pointUnder, View } from "../view/view.ts";
import { counted, latitude, longitude, ofFacets } from "../words.ts";
import { Choice, PlaceFields, siteForm, stepControl } from "./controls.ts";
import { edited, SiteRoom, type NamedSites } from "./site_room.ts";
import { ballDrawing, ballLayers, drawMoved, planeDrawing, poleSeen, sphereParts } from "./sphere_drawing.ts";
import type { Drawing, Ground, SphereScene } from "./sphere_drawing.ts";
import { ofBubble, ofDuplicates, ofLens, ofPictures, ofSite, ofStep } from "./sphere_sites.ts";
import { SphereSites, WITHOUT_TRIANGLES, type Bubble, type Insertion } from "./sphere_sites.ts";
import { BEGINNING, directionAt, handPlace, MOST, sightOf, sphereFields } from "./sphere_state.ts";
import type { SphereState } from "./sphere_state.ts";
import { planeFrame, reachAround, Twin, type Around, type PlaneFrame } from "./twin.ts";

/** Sites from which on cells are left out while something moves. */
const MANY = 3_000;

/** What the sum of facets is made of. */
const SUM = ["on the sphere", "in the plane", "\u00a0*P*"] as const;

/** Pixels within which a site is caught to be moved: nearer than a handle, so that the ball can be turned between sites. */
const REACH_OF_SITES = 8;

/** Between the pictures of a file, px. */
const GAP = 32;

/** @param stored Sets that the page carries. @param given The points that it was made for. */
export function sphereRoom(host: RoomHost, stored: Stored, given: Places | null): Room {
  return new SphereRoom(host, sphereSets(stored, given), "lonlat");
}

/** What the hand finds on one of the pictures: the direction under a place, and where one is that is not behind. */
interface Picture {
  under(at: Point): Vector;
  place(direction: Vector): Point | null;
}

class SphereRoom extends SiteRoom<SphereState> implements Room, Magnifiable {
  /** Sites as they were before the changes by hand. */
  #history: NamedSites[] = [];
  readonly #motion = new Motion();
  readonly isNorthUp = true;
  readonly most = MOST;
  #ball!: Plate;
  #plane!: Plate;
  #click!: Choice<SphereState["click"]>;
  #showStep!: ReturnType<typeof stepControl>;
  #showSite!: ReturnType<typeof siteForm>;
  #poleFields!: PlaceFields;
  #viewFields!: PlaceFields;

  protected override now = BEGINNING;
  #around: Around = { reach: 1, middle: [0, 0], outside: 0 };

  // What follows from the state; made anew when it changes.
  #sites = new SphereSites(new Float64Array(0));
  #layers = ballLayers(this.#sites);
  readonly #standing: Named["standing"] = new Map();
  #twin = new Twin([0, 0, 1]);
  #seeing: Uint8Array = new Uint8Array(0);
  #step: Insertion | null = null;
  #bubble: Bubble | null = null;

  override attach(section: HTMLElement): void {
    super.attach(section);
    const { guarded } = this.host;
    this.#ball = this.#plate("ball", () => ballDrawing(this.disc));
    this.#plane = this.#plate("plane", () => planeDrawing(this.#frame));
    this.#poleFields = new PlaceFields(section, "pole", (place) => guarded(() => this.#movePole(place)));
    this.#viewFields = new PlaceFields(section, "view", (place) => guarded(() => this.turn(View.above(...place))));
    this.#click = new Choice(section, "click", () => {
      this.put({ click: this.#click.value });
      this.host.changed();
    });
    this.#showStep = stepControl(section, (count) => guarded(() => this.#setStep(count)));
    this.#showSite = siteForm(section, {
      add: (place) => guarded(() => this.#add(directionAt(place))),
      move: (place) => guarded(() => this.#moveHeld(place)),
      remove: () => guarded(() => this.#remove(this.now.held)),
    });
    find(section, "[data-do=undo]").addEventListener("click", () => this.#undo());
    const under = (at: Point): Vector => this.#twin.inverse(...this.#frame.point(at));
    const place = (point: Vector): Point => this.#frame.place(this.#twin.forward(point));
    follow(this.#plane, { ...this.#gestures({ under, place }), take: () => ({ move: () => {} }) });
    follow(this.#ball, { ...this.#gestures(this.#onBall), ...lensGestures(this, this.#motion) });
  }

  /** A picture whose ground stays where only the pointer or one site moves. */
  #plate(which: string, drawing: () => Drawing): Plate {
    let ground: Ground;
    const paint = (pen: Pen, isMoving: boolean): void => {
      const scene = this.#scene(isMoving);
      ground = { scene, inks: pen.inks };
      drawing().draw(pen, scene, "ground");
    };
    const over = (pen: Pen, isMoving: boolean): void => {
      const scene = this.#scene(isMoving);
      if (ground.scene.sites !== scene.sites) drawMoved(pen, drawing(), scene, ground, this.now.held!);
      drawing().draw(pen, scene, "over");
    };
    const canvas = find<HTMLCanvasElement>(this.section, `#sphere-${which}`);
    return new Plate(canvas, paint, this.host.guarded, document.documentElement, over);
  }

  // State

  protected readonly fields = sphereFields;

  /** Seen as the last ones were, or magnified. */
  protected override beginning({ places }: NamedSites, before = BEGINNING): SphereState {
    return { ...before, step: null, held: null, lens: BEGINNING.lens, ...sightOf(places) };
  }

  protected override begin(named: NamedSites): void {
    this.#history = [];
    this.#click.value = this.now.click;
    this.#take(named);
  }

  /** Shows sites. */
  #take(named: NamedSites, reason: Reason = "state"): void {
    const sites = new SphereSites(named.places);
    this.#sites = sites;
    this.#layers = ballLayers(sites);
    if (this.now.step !== null && this.now.step >= sites.count) this.now = { ...this.now, step: null };
    this.show(named, {
      count: sites.count,
      heads: ["Latitude", "Longitude", "Neighbours"],
      cells: (site) => [...sites.words(site), String(sites.neighborCounts()[site])],
    });
    find(this.section, "[data-show=closing]").hidden = !sites.hasClosing;
    const label = `Sphere with ${counted(sites.count)} ${sites.count === 1 ? "site" : "sites"}`;
    this.#ball.canvas.setAttribute("aria-label", label);
    this.#project(reason === "state");
    this.#update(reason);
  }

  /** The pole has moved, or the sites. The frame of the plane holds nearly all of these; it changes when the hand rests. */
  #project(rests: boolean): void {
    const pole = directionAt(this.now.pole);
    this.#twin = new Twin(pole);
    this.#seeing = this.#sites.seeing(pole);
    if (!rests) return;
    this.#around = reachAround(this.#sites, this.#twin);
    const { outside } = this.#around;
    const words = `${counted(outside)} ${outside === 1 ? "site lies" : "sites lie"} outside the frame, near the pole.`;
    this.out("outside").textContent = outside === 0 ? "" : words;
  }

  // Drawing and words

  redraw(reason: Reason = "state"): void {
    this.#ball.redraw(reason);
    this.#plane.redraw(reason);
  }

  protected override switched(): void {
    this.#update();
  }

  /** Everything that is said and drawn, after the state has changed. */
  #update(reason: Reason = "state"): void {
    const { step, aim } = this.now;
    const facet = step === null && this.isOn("bubble") ? this.#sites.facetAt(aim) : null;
    this.#bubble = facet === null ? null : this.#sites.bubble(facet);
    this.#step = step === null ? null : this.#sites.insertion(step - 1);
    this.#say();
    this.redraw(reason);
  }

  #scene(isMoving: boolean): SphereScene {
    return {
      sites: this.#sites,
      layers: this.#layers,
      named: this.named.names && { names: this.named.names, standing: this.#standing, isMoving },
      view: this.view,
      map: this.#map,
      twin: this.#twin,
      seeing: this.#seeing,
      isOn: this.shown(isMoving, MANY),
      bubble: this.#bubble,
      aim: this.now.aim,
      held: [this.now.held, this.lit].filter((site) => site !== null && site < this.#sites.count) as number[],
      step: this.#step,
    };
  }

  #say(): void {
    const [sites, step, bubble, { held }] = [this.#sites, this.#step, this.#bubble, this.now];
    const { dimension } = sites.delaunay;
    const aimed =
      bubble === null ? "Point at a triangle for the circle round it." : ofBubble(bubble, sites, this.#twin);
    const words = step === null ? [WITHOUT_TRIANGLES[dimension] ?? aimed, ofDuplicates(sites)] : [ofStep(step)];
    say(this.out("sentence"), words.filter(Boolean).join(" "));
    say(this.out("sum"), ofFacets(sites.facetCount - this.#seeingCount, this.#seeingCount, SUM));
    this.out("sum").hidden = step !== null || dimension < 2;
    const isDrawn = (layer: Switch, least = 2): boolean => dimension >= least && step === null && this.isOn(layer);
    const steps = step !== null && step.before.dimension === 2;
    const [onBall, inPlane] = ofPictures({
      triangles: steps || isDrawn("triangles"),
      cells: isDrawn("cells", 1),
      seeing: isDrawn("seeing") && this.#seeingCount > 0,
      steps,
    });
    say(this.out("on-ball"), onBall);
    say(this.out("in-plane"), inPlane);
    const side = imageOf(this.#map, this.#twin.pole)[2] < 0 ? "behind" : "in front";
    say(this.out("pole-side"), `*P*, the pole of projection, lies ${side}.`);
    say(this.out("lens"), ofLens(this.now.lens));
    this.#showStep(this.now.step, sites.count);
    this.#poleFields.value = this.now.pole;
    this.#viewFields.value = this.view.middle;
    this.table.hold([...(bubble?.sites ?? []), ...(held === null ? [] : [held])]);
    find<HTMLButtonElement>(this.section, "[data-do=undo]").disabled = this.#history.length === 0;
    this.#showSite(held === null ? null : [sites.lonlat[2 * held], sites.lonlat[2 * held + 1]]);
  }

  get #seeingCount(): number {
    return this.#seeing.reduce((total, sees) => total + sees, 0);
  }

  // What the hand sees, and what it does

  get disc(): Plate["disc"] {
    return this.#ball.disc;
  }

  get view(): View {
    return this.now.view;
  }

  get sight(): Sight {
    return this.now;
  }

  /** Through the lens, to the axes of the view. */
  get #map(): MoebiusMap {
    return sightMap(this.sight);
  }

  get #frame(): PlaneFrame {
    return planeFrame(1, 1, Math.min(this.#plane.width, this.#plane.height) - 2, this.#around);
  }

  /** Turns the ball, and says it. */
  turn(view: View, reason: Reason = "state"): void {
    this.#see({ view }, reason);
    const [lon, lat] = view.middle;
    this.host.announcer.say(`Seen from ${latitude(lat, 0)}, ${longitude(lon, 0)}`);
  }

  see({ lens, view }: Sight, reason: Reason = "hand"): void {
    this.#see({ lens, view }, reason);
    this.host.announcer.say(plain(ofLens(lens)));
  }

  #gestures(picture: Picture): Gestures {
    return {
      take: (at, reach) => this.#grab(at, reach),
      hover: (at) => at && this.#hover(picture.under(at)),
      click: (at, reach) => this.#press(picture.under(at), this.#siteNear(picture, at, reach)),
      key: (event) => this.#key(event),
    };
  }

  readonly #onBall: Picture = {
    under: (at) => sourceOf(this.#map, pointUnder(this.disc, at)),
    place: (direction) => {
      const point = imageOf(this.#map, direction);
      return point[2] >= 0 ? placeOf(this.disc, point) : null;
    },
  };

  /** The site nearest to what is under a place of a picture, where it is within reach. */
  #siteNear({ under, place }: Picture, at: Point, reach: number): number | null {
    if (this.#sites.count === 0) return null;
    const [site] = this.#sites.delaunay.nearest(under(at));
    const found = place(this.#sites.site(site));
    return found !== null && distance(found, at) <= reach ? site : null;
  }

  /** Takes hold of the pole's handle, a site, or the ball; null beside them. */
  #grab(at: Point, reach: number): Hold | null {
    const pole = poleSeen(this.#map, this.#twin);
    if (pole !== null && distance(placeOf(this.disc, pole), at) <= reach) return this.#grabPole(pole[2] < 0);
    // Where sites lie close, evenly spread, the ball can still be turned between them.
    const times = scaleAt(this.#map, this.#onBall.under(at));
    const spacing = times * this.disc.r * Math.sqrt((4 * Math.PI) / this.#sites.count);
    const near = Math.min(reach, REACH_OF_SITES, spacing / 3);
    const site = this.now.step === null ? this.#siteNear(this.#onBall, at, near) : null;
    if (site === null) return grabBall(this, this.#motion, at);
    const before = this.named;
    return {
      move: (to) => this.host.guarded(() => this.#place(site, this.#onBall.under(to), "pointer")),
      end: () => {
        this.#history.push(before);
        this.#rest();
      },
    };
  }

  /** Over the limb and back in the pole is on the other side. */
  #grabPole(isBehind: boolean): Hold {
    let [behind, wasOut] = [isBehind, false];
    return {
      move: (to) => {
        const isOut = distance(to, [this.disc.x, this.disc.y]) > this.disc.r;
        if (!isOut && wasOut) behind = !behind;
        wasOut = isOut;
        const [x, y, z] = pointUnder(this.disc, to);
        const direction = sourceOf(this.#map, [x, y, behind ? -z : z]);
        this.host.guarded(() => this.#movePole(lonLatOf(direction), false));
      },
      end: () => this.#rest(),
    };
  }

  /** The bubble follows the pointer, unless one is kept. */
  #hover(direction: Vector): void {
    if (this.now.isPinned || this.now.step !== null) return;
    const before = this.#bubble?.facet ?? null;
    this.put({ aim: direction });
    if (this.#sites.facetAt(this.now.aim) === before) return;
    this.host.guarded(() => this.#update("pointer"));
    this.host.changed();
  }

  /** A click. @param site The one within reach. */
  #press(direction: Vector, site: number | null): void {
    const mode = this.now.step === null ? this.#click.value : "keep";
    this.host.guarded(() => {
      if (mode === "add") this.#add(direction);
      else if (mode === "remove") this.#remove(site);
      else this.#keep(direction, site);
    });
  }

  /** The hand has let go: the frame fits again, and what was left out is drawn. */
  #rest(): void {
    this.host.guarded(() => {
      this.#project(true);
      this.#update();
    });
    this.host.changed();
  }

  // What can be done

  #see(sight: Partial<Sight>, reason: Reason): void {
    this.put(sight);
    this.#say();
    this.#ball.redraw(reason);
    this.host.changed();
  }

  /** Flies to another view; why is for others to say. */
  #fly(view: View): void {
    const from = this.sight;
    const to = { lens: from.lens, view };
    this.#motion.fly((t) => this.#see(betweenSights(from, to, t, true), t < 1 ? "flight" : "state"));
  }

  #movePole(place: Place, rests = true): void {
    this.put({ pole: place });
    this.#project(rests);
    this.#update(rests ? "state" : "hand");
    this.host.changed();
    const seeing = this.#seeingCount;
    this.host.announcer.say(`${this.#sites.facetCount - seeing} triangles in the plane, ${seeing} facets see P`);
  }

  #set(change: Partial<SphereState>, held: number | null): void {
    this.put({ ...change, held });
    this.#update();
    this.host.changed();
  }

  /** The bubble there stays, or follows the pointer again where it is the one that was kept. */
  #keep(aim: Vector, site: number | null): void {
    const isPinned = !this.now.isPinned || this.#sites.facetAt(aim) !== this.#bubble?.facet;
    this.#set({ isPinned, aim }, site);
    if (this.#bubble !== null) this.host.announcer.say(ofBubble(this.#bubble, this.#sites, this.#twin));
  }

  /** Places a site elsewhere, or one more, or without a place takes it out; and says so. */
  #edit(site: number, place: Place | null, reason: Reason = "state"): void {
    if (reason === "state") this.#history.push(this.named);
    this.now = { ...this.now, held: place && site };
    this.#take(edited(this.named, site, place), reason);
    this.changed(place === null ? `Site ${site + 1} removed` : ofSite(this.#sites, site, this.named.names?.[site]));
  }

  #place(site: number, direction: Vector, reason?: Reason): void {
    this.put({ aim: direction });
    this.#edit(site, handPlace(lonLatOf(direction), this.now.lens.magnification), reason);
  }

  #moveHeld(place: Place): void {
    if (this.now.held !== null) this.#place(this.now.held, directionAt(place));
  }

  #add(direction: Vector): void {
    this.#place(this.count, direction);
    this.table.reveal(this.count - 1);
  }

  #remove(site: number | null): void {
    if (site !== null) this.#edit(site, null);
  }

  #undo(): void {
    const before = this.#history.pop();
    if (before === undefined) return;
    this.now = { ...this.now, held: null };
    this.host.guarded(() => this.#take(before));
    this.changed("Undone");
  }

  /** Brings a site to the middle of the ball, and holds it. */
  protected override chosen(site: number): void {
    this.put({ held: site, aim: this.#sites.site(site) });
    this.#fly(View.above(...lonLatOf(imageOf(lensMap(this.now.lens), this.#sites.site(site)))));
    this.host.guarded(() => this.#update());
    this.changed(ofSite(this.#sites, site, this.named.names?.[site]));
  }

  #setStep(step: number | null): void {
    this.#set({ step }, null);
    if (this.#step !== null) this.host.announcer.say(ofStep(this.#step));
  }

  // Keys

  #key(event: KeyboardEvent): boolean {
    this.#motion.stop();
    const view = arrowed(this, event);
    const action = view === null ? this.#keyed(event) : () => this.turn(view);
    if (action !== null) this.host.guarded(action);
    return action !== null;
  }

  /** What a key does that does not turn the ball; without sites there is only to add one. */
  #keyed(event: KeyboardEvent): (() => void) | null {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (isCommand(event)) {
      const step = arrowStep(event);
      if (key === "z") return () => this.#undo();
      return step === null ? null : () => this.#nudge(...step);
    }
    const factor = keyFactor(key);
    if (factor !== null) return () => this.see(magnified(this.sight, [0, 0, 1], factor, true, MOST), "state");
    const middle = sourceOf(this.#map, [0, 0, 1]);
    if (key === "0") return () => this.see(BEGINNING, "state");
    if (key === "n") return () => this.#add(middle);
    const withSites: Record<string, () => void> = {
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
      Delete: () => this.#remove(this.now.held),
      Backspace: () => this.#remove(this.now.held),
      Enter: () => this.#press(middle, null),
      Escape: () => this.#set({ isPinned: false }, null),
    };
    return (this.#sites.count > 0 && withSites[key]) || null;
  }

  /** Moves the site that is held by degrees. */
  #nudge(east: number, north: number): void {
    if (this.now.held === null) return;
    const [lon, lat] = this.#sites.lonlat.subarray(2 * this.now.held);
    this.#moveHeld([lon + east, Math.max(-90, Math.min(90, lat + north))]);
  }

  #walk(by: number): void {
    const { count } = this.#sites;
    const site = this.now.held === null ? (by > 0 ? 0 : count - 1) : (this.now.held + by + count) % count;
    this.chosen(site);
    this.table.reveal(site);
  }

  // Files and what can be taken along

  /** Both pictures beside each other. */
  sheet(): Sheet {
    const size = this.#ball.width;
    const { disc } = this;
    const scene = this.#scene(false);
    const frame = planeFrame(size + GAP + 1, 1, size - 2, this.#around);
    return {
      title: this.title,
      width: 2 * size + GAP,
      height: size,
      paint: (pen) => {
        for (const drawing of [ballDrawing(disc), planeDrawing(frame)])
          for (const stratum of ["ground", "over"] as const) drawing.draw(pen, scene, stratum);
      },
    };
  }

  /** Of a step of the insertion, its triangles. */
  geojson(exchange: Exchange): string {
    const { step } = this.now;
    if (step !== null) return exchange.geojson(new SphereSites(this.#sites.lonlat.subarray(0, 2 * step)).triangles());
    return exchange.geojson(regionsOf(sphereParts(this.#scene(false))));
  }

  python(exchange: Exchange): string {
    const { reach, middle } = this.#around;
    const sizes = { size: this.#ball.width, ball: this.disc.r, gap: GAP, reach, middle: middle.join(", ") };
    return exchange.spherePython(this.#scene(false), this.now, this.origin, sizes);
  }
}
