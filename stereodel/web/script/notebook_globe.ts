/** A globe in a place of its own, such as the output of a cell: the fisheye of the Globe room, of what a model has. */

import { make, plain, say } from "./dom.ts";
import { arcLayer, lineArcs, regionLayer, spotLayer, type Layer } from "./drawing/ball.ts";
import type { IsOn } from "./drawing/parts.ts";
import type { Reason } from "./drawing/plate.ts";
import { lonlatToXyz } from "./kernel/api.ts";
import { FisheyeGlobe, type GlobeHost } from "./rooms/globe_plates.ts";
import type { GlobeScene } from "./rooms/globe_scene.ts";
import { BEGINNING, sightField, sightWords, type GlobeState } from "./rooms/globe_state.ts";
import { placeSentence, type Owner } from "./rooms/owner.ts";
import { directionOf, lonLatOf } from "./space.ts";
import { isCommand } from "./view/hand.ts";
import { imageOf, lensMap, MOST } from "./view/lens.ts";
import { View } from "./view/view.ts";
import { counted } from "./words.ts";

/** Shapes of one ink: rows of places, and of a region a place and whether that is in it. */
interface Shapes {
  readonly kind: "region" | "line" | "point";
  readonly ink: string;
  readonly lonlat: DataView;
  readonly offsets: readonly number[];
  readonly place: readonly [number, number];
  readonly inside: boolean;
}

/** Traits of a model. */
export const TRAITS = ["sites", "names", "look", "layers", "lens", "view", "selection"] as const;

/** What a model has. */
export interface Shown extends Record<(typeof TRAITS)[number], unknown> {
  /** Longitude and latitude in turn, degrees: doubles at any place of a buffer. */
  sites: DataView;
  names: readonly string[];
  look: Partial<Owner>;
  layers: readonly Shapes[];
  /** A fisheye, by the arguments of `stereodel.fisheye`. */
  lens: { readonly focus: readonly [number, number]; readonly magnification: number };
  /** By the arguments of `stereodel.drawing.View`. */
  view: { readonly lon: number; readonly lat: number; readonly roll: number };
  /** Numbers of sites. */
  selection: readonly number[];
}

/** Hears what a hand has changed. */
type Changed = <K extends keyof Shown>(name: K, value: Shown[K]) => void;

/** Radius of the points of a layer, pixels. */
const POINT = 3;

const KEYS = "arrows turn, + and − magnify, F sets the focus, comma and full stop walk the sites, Enter selects";
const HINT = "Drag to turn; after a click the wheel magnifies; a double click sets the focus.";

export class NotebookGlobe implements GlobeHost {
  readonly scene: GlobeScene;
  readonly place = make("div", "stereodel-globe");
  readonly hasPointed = false; // no circle at the pointer
  readonly host = {
    guarded: (body: () => void): void => {
      body();
      this.place.dataset["frames"] = String(this.#globe.plate.frames + 1);
    },
  };
  readonly #canvas = make("canvas", {
    tabIndex: 0,
    role: "application",
    ariaRoleDescription: "globe to turn",
    ariaDescription: `${HINT} Keys: ${KEYS}, 0 takes the lens off`,
  });
  readonly #status = make("p", { role: "status" });
  readonly #legend = make("div", "legend");
  readonly #globe: FisheyeGlobe;
  readonly #changed: Changed;
  readonly #themes: MutationObserver; // notebooks change colours by attributes of the body
  #state = BEGINNING;
  #shown: Shown | null = null;

  constructor(element: HTMLElement, scene: GlobeScene, changed: Changed) {
    [this.scene, this.#changed] = [scene, changed];
    this.place.append(this.#canvas, this.#status, this.#legend, make("p", "hint", HINT));
    element.append(this.place);
    this.#globe = new FisheyeGlobe(this.#canvas, this);
    this.#themes = new MutationObserver(() => this.#globe.plate.redraw("colours"));
    this.#themes.observe(document.body, { attributes: true });
    this.#canvas.addEventListener("pointerdown", (event) => {
      event.preventDefault(); // the notebook would take the focus
      this.#canvas.focus({ preventScroll: true });
    });
    this.place.addEventListener("keydown", (event) => {
      if (event.defaultPrevented) event.stopPropagation(); // the notebook has keys of its own
    });
  }

  /** Shows what a model has. */
  show(shown: Shown): void {
    const { sites, names, look, layers, lens, view, selection } = shown;
    const isNew = (name: keyof Shown): boolean => shown[name] !== this.#shown?.[name];
    if (isNew("sites") || isNew("names") || isNew("look")) {
      const lonlat = doubles(sites);
      const count = lonlat.length / 2;
      const fitting = look.ink === undefined || look.ink.length === count ? look : {};
      const owner = { title: "", source: "", ...fitting };
      this.scene.show({
        name: "",
        lonlat,
        names: names.length === count ? names : null,
        values: new Map(look.columns),
        owner,
      });
    }
    if (isNew("layers")) this.scene.layers = layers.map(layerOf);
    const sight = {
      lens: { ...lens, focus: directionOf(...lens.focus) },
      view: View.above(view.lon, view.lat, view.roll),
    };
    this.#state = { ...this.#state, sight };
    if (isNew("look")) this.#legend.innerHTML = look.legend ?? ""; // of the script's own side
    [this.#shown, this.scene.selected] = [shown, selection];
    this.#update("state");
  }

  dispose(): void {
    this.#globe.motion.stop();
    this.#themes.disconnect();
    this.#globe.plate.dispose();
    this.place.remove();
  }

  get shown(): GlobeState {
    return this.#state;
  }

  /** Without a lens. */
  get beginning(): GlobeState {
    const { lens, view } = this.#state.sight;
    return { ...this.#state, sight: { lens: { ...lens, magnification: 1 }, view } };
  }

  /** North stays up until it is turned away from Python. */
  get isNorthUp(): boolean {
    return this.#state.sight.view.roll === 0;
  }

  /** A plain globe has no focus to be seen. */
  get isFramed(): boolean {
    return this.#state.sight.lens.magnification === 1;
  }

  readonly isOn: IsOn = (layer) =>
    layer !== "tissot" && layer !== "fills" && (layer !== "cells" || !this.scene.places?.owner?.inks);

  /** What a hand has changed is shown as it is told, to the last digit. */
  set(change: Partial<GlobeState>, reason: Reason): void {
    const { sight: before } = this.#state;
    const asked = { ...before, ...change.sight };
    const field = sightField(Math.min(1, before.lens.magnification), Math.max(MOST, before.lens.magnification));
    this.#state = { ...this.#state, ...change, sight: field.settle(asked) };
    const told = field.write(asked);
    const number = (name: string): number => Number(told[name] ?? 0);
    const focus = [number("focuslon"), number("focuslat")] as const;
    if (asked.lens !== before.lens) this.#changed("lens", { focus, magnification: number("s") });
    const view = { lon: number("viewlon"), lat: number("viewlat"), roll: number("viewroll") };
    if (asked.view !== before.view) this.#changed("view", view);
    if (reason !== "pointer") this.#update(reason);
  }

  hover(place: number | null): void {
    if (this.scene.lit === place) return;
    this.scene.lit = place;
    this.#update("pointer");
  }

  /** Selects the place that is lit, or no longer. */
  press(): void {
    const { lit, selected } = this.scene;
    if (lit === null) return;
    this.#select(selected.includes(lit) ? selected.filter((each) => each !== lit) : [...selected, lit]);
  }

  key(event: KeyboardEvent): boolean {
    const acts: Record<string, () => void> = {
      ",": () => this.#walk(-1),
      ".": () => this.#walk(1),
      Enter: () => this.press(),
      Escape: () => this.#select([]),
    };
    const act = isCommand(event) ? undefined : acts[event.key];
    act?.();
    return act !== undefined;
  }

  #select(selection: readonly number[]): void {
    this.scene.selected = selection;
    this.#changed("selection", selection);
    this.#update("state");
  }

  /** To the next site in either direction, which comes to the middle of the view. */
  #walk(step: number): void {
    const { lonlat } = this.scene.places!;
    const count = lonlat.length / 2;
    if (count === 0) return;
    const place = (Math.max(this.scene.lit ?? -1, step < 0 ? 0 : -1) + step + count) % count;
    const image = imageOf(lensMap(this.#state.sight.lens), directionOf(lonlat[2 * place], lonlat[2 * place + 1]));
    this.#globe.turn(View.above(...lonLatOf(image)), "state");
    this.hover(place);
  }

  #update(reason: Reason): void {
    const { lit, selected, places } = this.scene;
    const count = (places?.lonlat.length ?? 0) / 2;
    const chosen = selected.length === 0 ? "" : `, selected: ${selected.slice(0, 5).join(", ")}`;
    const sites = count === 0 ? "" : `; ${counted(count)} ${count === 1 ? "site" : "sites"}${chosen}`;
    const words = sightWords(this.#state.sight) + sites;
    say(this.#status, lit === null ? words : placeSentence(this.scene, lit));
    this.#canvas.ariaLabel = plain(words);
    this.#globe.plate.redraw(reason);
  }
}

function layerOf({ kind, ink, lonlat, offsets, place, inside }: Shapes): Layer {
  const [places, whole] = [doubles(lonlat), Uint32Array.from(offsets)];
  if (kind === "line") return arcLayer("line", lineArcs({ lonlat: places, offsets: whole }), ink);
  const points = lonlatToXyz(places);
  if (kind === "region") return regionLayer("tint", "coast", points, whole, directionOf(...place), inside, ink);
  const count = places.length / 2;
  return spotLayer(points, new Array<number>(count).fill(POINT), new Array<string>(count).fill(ink));
}

function doubles({ buffer, byteOffset, byteLength }: DataView): Float64Array {
  return new Float64Array(buffer.slice(byteOffset, byteOffset + byteLength));
}
