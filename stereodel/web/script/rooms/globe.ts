/** The Globe room: the Earth through a fisheye, or one bubble of it sent onto another. */

import { field, find, plain, say } from "../dom.ts";
import { regionsOf } from "../drawing/parts.ts";
import type { Sheet } from "../drawing/pen.ts";
import type { Reason } from "../drawing/plate.ts";
import type { Exchange } from "../exchange.ts";
import type { Latitude } from "../kernel/api.ts";
import type { LinkValues } from "../link.ts";
import type { Painted } from "../panorama.ts";
import type { Room, RoomHost } from "../room.ts";
import { angle, directionOf, lonLatOf, type Vector } from "../space.ts";
import { fitted } from "../view/fit.ts";
import { capToCap, lensMap, scaleAt } from "../view/lens.ts";
import { View } from "../view/view.ts";
import { counted, latitude, longitude, scale } from "../words.ts";
import { Choice, mark, NumberField, PlaceFields, tellNamed } from "./controls.ts";
import { BubbleGlobe, FisheyeGlobe, fiveViews, type GlobeHost } from "./globe_plates.ts";
import { GlobeScene, type Places } from "./globe_scene.ts";
import { BEGINNING, beginningOf, GLOBE, placeWords, PRESETS, sideView, sightWords } from "./globe_state.ts";
import type { GlobeState } from "./globe_state.ts";
import { area, placeSentence, toldOf, valueWords } from "./owner.ts";
import { TableRoom, tableOf, tableValues } from "./site_room.ts";

/** Steps of the slider for a magnification of ten times. */
const SLIDER_TEN = 50;

/** Degrees by which a pointer may be off the one that it was. */
const UNMOVED = 1e-6;

/** Places up to which their cells are drawn from the beginning. */
const MOST_WITH_CELLS = 2000;

export class GlobeRoom extends TableRoom implements Room, GlobeHost {
  readonly scene: GlobeScene;
  /** The drawing stands alone in a frame of another page. */
  readonly place = document.documentElement;
  readonly isFramed = document.documentElement.classList.contains("framed");
  /** What the room begins with: places that are there, fitted. */
  beginning = BEGINNING;
  readonly #heading: string;
  #state = BEGINNING;
  #globe!: FisheyeGlobe;
  #views!: ReturnType<typeof fiveViews>;
  #bubbles!: readonly BubbleGlobe[];
  #lens!: Choice<GlobeState["lens"]>;
  /** The focus, or the middle of the bubble. */
  #focus!: PlaceFields;
  #radii!: readonly NumberField[];
  readonly #given: Places | null;
  /** The places and the picture that were opened last: a step back is one without, the next one forward shows them. */
  #opened: Places | null = null;
  #picture: Painted | null = null;

  /** @param given The points that the page was made for. */
  constructor(host: RoomHost, given: Places | null, latitude: Latitude) {
    super(host);
    [this.scene, this.#given] = [new GlobeScene(latitude), given];
    this.#heading = find(document, "#globe-title").textContent ?? "";
  }

  /** Over bubbles and places of the reader's own, only once anybody has pointed at the globe. */
  get hasPointed(): boolean {
    const { lens, pointer } = this.#state;
    return (lens === "fisheye" && this.scene.places === null) || angle(pointer, BEGINNING.pointer) > UNMOVED;
  }

  get isNorthUp(): boolean {
    return this.switches.isOn("north");
  }

  get shown(): GlobeState {
    return this.#state;
  }

  override attach(section: HTMLElement): void {
    super.attach(section);
    const { guarded } = this.host;
    const canvas = (id: string): HTMLCanvasElement => find(section, `#${id}`);
    this.#globe = new FisheyeGlobe(canvas("globe-plate"), this);
    const views = [...section.querySelectorAll<HTMLButtonElement>(".views button")];
    this.#views = fiveViews(views, this);
    this.#bubbles = (["before", "after"] as const).map(
      (which) => new BubbleGlobe(canvas(`globe-${which}`), which, this),
    );
    const lens = (): void => this.set({ lens: this.#lens.value, pointer: BEGINNING.pointer }, "state", true);
    this.#lens = new Choice(section, "lens", () => guarded(lens));
    const center = (place: readonly [number, number]): void => this.#center(directionOf(...place));
    this.#focus = new PlaceFields(section, "focus", (place) => guarded(() => center(place)), "change");
    this.#radii = (["from", "to"] as const).map((which) => {
      const set = (radius: number): void => this.set({ [which]: { ...this.#state[which], radius } }, "state");
      return new NumberField(section, `${which}-radius`, 1, (value) => guarded(() => set(value)), "change");
    });
    const on = (target: Element, act: () => void, type = "click"): void =>
      target.addEventListener(type, () => guarded(act));
    const slider = field(section, "mag");
    const magnify = (): void => {
      const { lens, view } = this.#state.sight;
      this.#globe.see({ lens: { ...lens, magnification: 10 ** (slider.valueAsNumber / SLIDER_TEN) }, view });
    };
    on(slider, magnify, "input");
    for (const button of section.querySelectorAll<HTMLButtonElement>(".presets button")) {
      on(button, () => {
        const begin = button.value === "places" ? this.beginning : PRESETS[button.value];
        const isHere = this.#state.lens === "fisheye" && begin.lens === "fisheye";
        if (isHere && begin.sight !== undefined) this.#globe.fly(begin.sight);
        else this.set(begin, "state", true);
      });
    }
    on(find(section, "[data-do=earth]"), () => this.#paintedBy(null));
    for (const button of views) {
      on(button, () => {
        const { lens } = this.#state.sight;
        this.#globe.fly({ lens, view: sideView(Number(button.value), lens.focus) });
      });
    }
    this.#show(this.#given);
    void this.scene.load(this.host.contents).then(() => this.redraw()); // until then the globe is water
  }

  state(isWhole: boolean): Record<string, string> {
    const { places, picture } = this.scene;
    const { from, to, before, after, ...fisheye } = this.#state;
    const { lonlat, name, names = null, values = new Map() } = places ?? NO_PLACES;
    return {
      ...GLOBE.write(fisheye.lens === "fisheye" ? fisheye : this.#state),
      ...(places !== this.#given && places && tableValues({ places: lonlat, name, names, values }, isWhole)),
      ...this.switches.values,
      ...(picture === null ? {} : { picture: picture.name }),
    };
  }

  restore(values: LinkValues): void {
    GLOBE.read(values, BEGINNING); // throws before anything is changed
    const table = tableOf(values, "lonlat");
    const again = values.get("file") === this.#opened?.name ? this.#opened : null;
    this.#show(
      table === null ? (again ?? this.#given) : { ...table, name: table.name ?? "sites", lonlat: table.places },
    );
    const state = GLOBE.read(values, this.beginning);
    this.switches.restore(values);
    if (this.scene.places === null) this.switches.set("cells", false);
    this.#globe.motion.stop();
    const { messages } = this.host;
    if (again === null) tellNamed(messages, values, "file");
    this.scene.picture = values.get("picture") === this.#picture?.name ? this.#picture : null;
    if (this.scene.picture === null) tellNamed(messages, values, "picture");
    this.set(state, "state");
  }

  redraw(reason: Reason = "state"): void {
    if (this.#state.lens === "bubble") for (const bubble of this.#bubbles) bubble.plate.redraw(reason);
    else {
      this.#globe.plate.redraw(reason);
      if (reason !== "pointer") this.#views(reason);
    }
  }

  open(file: File, exchange: Exchange): Promise<void> {
    const { messages, guarded } = this.host;
    if (file.type.startsWith("image/")) {
      return exchange.openPanorama(file, messages, (picture) => this.#paintedBy((this.#picture = picture)));
    }
    return exchange.openPoints(file, "lonlat", this.host, ({ places: lonlat, names, values }) => {
      guarded(() => {
        this.#show({ name: file.name, lonlat, names, values });
        this.set(this.beginning, "state", true);
      });
    });
  }

  sheet(): Sheet {
    const { plate } = this.#state.lens === "bubble" ? this.#bubbles[1] : this.#globe;
    const { places } = this.scene;
    return { ...plate.sheet(this.#label(), !!places?.owner), owner: places?.owner ?? null };
  }

  geojson(exchange: Exchange): string | null {
    const { places, parts, latitude } = this.scene;
    return places === null ? this.#noPlaces() : exchange.geojson(regionsOf(parts), latitude);
  }

  csv(exchange: Exchange): string | null {
    const { places } = this.scene;
    if (places === null) return this.#noPlaces();
    return exchange.csv(["lon", "lat"], places.lonlat, places.names, places.values);
  }

  #noPlaces(): null {
    this.host.messages.show("", "There are no places and no cells yet: open a file of your own.");
    return null;
  }

  python(exchange: Exchange): string {
    const { disc } = this.#state.lens === "bubble" ? this.#bubbles[0] : this.#globe;
    return exchange.globePython(this.#state, this.scene, this.isOn, 2 * disc.r, this.hasPointed);
  }

  /** A picture covers the Earth, or no longer. */
  #paintedBy(picture: Painted | null): void {
    this.scene.picture = picture;
    this.set({}, "state", true);
  }

  /** What the owner says of the places stands beside the drawing; without an owner the room has its own words. */
  #tell({ owner, isolines }: Places): void {
    find(this.section, "h1").textContent = owner?.title || this.#heading;
    find(this.section, ".lead").hidden = !!owner?.title;
    this.out("source").textContent = owner?.source ?? "";
    this.switches.offer("fills", owner?.inks !== undefined);
    this.switches.offer("isolines", !!isolines);
    const legend = find(this.section, ".legend");
    legend.innerHTML = owner?.legend ?? ""; // of the page itself, which has no other scripts
    legend.hidden = !owner?.legend;
    document.documentElement.style.setProperty("--legend", `${legend.offsetHeight}px`);
  }

  #show(places: Places | null): void {
    if (places !== null && places === this.scene.places) return;
    this.scene.show(places);
    if (places !== this.#given) this.#opened = places ?? this.#opened;
    this.switches.offer("cells", places !== null);
    this.switches.offer("names", !!places?.names);
    for (const part of ["[data-show=places]", "[value=places]"]) find(this.section, part).hidden = places === null;
    const { lonlat, names = null, name, owner } = places ?? NO_PLACES;
    this.switches.begin("cells", places !== null && lonlat.length <= 2 * MOST_WITH_CELLS && !owner?.inks);
    this.switches.begin("tissot", places === null);
    this.beginning = beginningOf(fitted(lonlat));
    this.#tell(places ?? NO_PLACES);
    const told = toldOf(places ?? NO_PLACES);
    const count = lonlat.length / 2;
    const words = count === 0 ? "No places in" : count === 1 ? "The place of" : `The ${counted(count)} places of`;
    this.out("places").textContent = `${words} ${name}`;
    this.out("latitude").textContent = AREAS[this.scene.latitude];
    this.table.show({
      count,
      noun: "Place",
      names,
      heads: ["Latitude", "Longitude", ...told.map(([title]) => title), "Cell, km²"],
      cells: (place) => [
        latitude(lonlat[2 * place + 1]),
        longitude(lonlat[2 * place]),
        ...told.map(([, column]) => valueWords(column[place])),
        area(this.scene.area(place)),
      ],
    });
  }

  protected override pointed(place: number | null): void {
    if (place !== null) this.host.announcer.say(placeSentence(this.scene, place));
    this.hover(place);
  }

  /** The pointer is on a place, or on none. */
  hover(place: number | null): void {
    if (this.scene.lit === place) return;
    this.scene.lit = place;
    this.redraw("pointer");
    this.#write();
  }

  /** Brings a place to the middle, and the lens to it. */
  protected override chosen(place: number): void {
    const [lon, lat] = this.scene.places!.lonlat.subarray(2 * place);
    this.#center(directionOf(lon, lat), View.above(lon, lat));
  }

  /** Brings the lens to a direction, or the bubble that is taken. */
  #center(direction: Vector, view = this.#state.sight.view): void {
    if (this.#state.lens === "bubble") this.set({ from: { ...this.#state.from, center: direction } }, "state");
    else this.#globe.fly({ lens: { ...this.#state.sight.lens, focus: direction }, view });
  }

  /** Another state: the drawings, the words, the controls and the link follow. */
  set(change: Partial<GlobeState>, reason: Reason, isStep = false): void {
    this.#state = GLOBE.settle({ ...this.#state, ...change });
    this.redraw(reason);
    this.#write();
    this.host.changed(isStep);
    const { lens, sight } = this.#state;
    if (reason !== "pointer") this.host.announcer.say(lens === "bubble" ? this.#words : sightWords(sight));
  }

  /** Something is drawn, or no longer; north is up again, or may turn. */
  protected override switched(name: string): void {
    const { sight, before, after } = this.#state;
    const isLeveled = name === "north" && this.switches.isOn(name);
    const level = { sight: { ...sight, view: sight.view.northUp }, before: before.northUp, after: after.northUp };
    this.set(isLeveled ? level : {}, "state");
  }

  #write(): void {
    const { lens, sight, pointer, from, to } = this.#state;
    const { magnification, focus } = sight.lens;
    const strength = scale(magnification);
    this.#lens.value = lens;
    const slider = field(this.section, "mag");
    slider.value = String(SLIDER_TEN * Math.log10(magnification));
    slider.ariaValueText = `${strength} times`;
    this.out("mag").textContent = strength;
    this.#focus.value = lonLatOf(lens === "bubble" ? from.center : focus);
    [from, to].forEach(({ radius }, k) => (this.#radii[k].value = radius));
    this.out("tissot").hidden = !this.switches.isOn("tissot");
    find(this.section, "[data-show=picture]").hidden = this.scene.picture === null;
    this.switches.offer("land", this.scene.picture === null);
    const [ruler, here] = [this.out("scale"), scaleAt(lensMap(sight.lens), pointer)];
    const share = magnification > 1 ? Math.log(here) / Math.log(magnification) : 0;
    mark(ruler, ".mark-at.first", magnification > 1 ? scale(1 / magnification) : "");
    mark(ruler, ".mark-at.last", magnification > 1 ? strength : "");
    mark(ruler, ".needle", `${scale(here)}×`, 50 * (share + 1));
    find(this.section, "#globe-plate").setAttribute("aria-label", this.#label());
    const { lit } = this.scene;
    const told = lit === null ? this.#words : placeSentence(this.scene, lit);
    say(this.out("pointer"), told);
    // In a frame there is no room for it but where the pointer is.
    if (this.isFramed) find(this.section, ".globe-spread canvas").title = lit === null ? "" : plain(told);
  }

  /** How large everything is, in the middle and at the rim of the bubble or where the pointer is. */
  get #words(): string {
    const { lens, sight, pointer, from, to } = this.#state;
    if (lens === "bubble") {
      // Where the scale is S in the middle, it is that of the circles' own sizes at the rim.
      const rim = Math.sin((to.radius * Math.PI) / 180) / Math.sin((from.radius * Math.PI) / 180);
      const middle = scale(capToCap(from, to).magnification);
      return `In the middle of the bubble everything is _${middle}_ times as large, at its rim _${scale(rim)}_ times.`;
    }
    const { magnification, focus } = sight.lens;
    if (magnification === 1) return "Nothing is magnified: every place has its size on a plain globe.";
    const [where, at] = this.hasPointed ? ["pointer", pointer] : ["focus", focus];
    const here = `_${scale(scaleAt(lensMap(sight.lens), at))}_ times as large as on a plain globe`;
    const there = this.hasPointed ? `; at the focus _${scale(magnification)}_ times` : "";
    const far = `on the far side _${scale(1 / magnification)}_ times`;
    return `At the ${where}, _${placeWords(at)}_, everything is ${here}${there}, ${far}.`;
  }

  #label(): string {
    const { sight, lens, from, to } = this.#state;
    if (lens === "fisheye") return `Globe through a fisheye, ${sightWords(sight)}`;
    return `Globe with the bubble of ${from.radius.toFixed(1)}° sent onto one of ${to.radius.toFixed(1)}°`;
  }
}

const NO_PLACES: Places = { name: "", lonlat: new Float64Array(0) };

/** What the areas of cells are, by the kind of latitude. */
const AREAS: Record<Latitude, string> = {
  spherical: "Areas with latitudes taken as those of a sphere (spherical).",
  geodetic: "Areas on a sphere with the directions from the centre of the ellipsoid (geodetic).",
  authalic: "Areas are those of the ellipsoid WGS84 (authalic).",
};
