/** Native inputs of a room: numbers in fields, switches, sets. */

import { field, find, make } from "../dom.ts";
import type { Place } from "../fields.ts";
import type { LinkValues } from "../link.ts";
import type { Messages } from "../messages.ts";
import { counted } from "../words.ts";

/** While the reader types, or at the end. */
type When = "input" | "change";

/**
 * A field of numbers: what is typed is told, and what the hand does is shown. Beyond its ends the field says where these
 * are, and when the reader is done it takes the nearer one.
 */
export class NumberField {
  readonly #input: HTMLInputElement;
  readonly #decimals: number;
  readonly #reason = make("span", { className: "reason", role: "status" });
  #shown: string;

  /** @param typed gets each number between the ends. */
  constructor(root: ParentNode, name: string, decimals: number, typed: (value: number) => void, when: When = "input") {
    const input = field(root, name);
    [this.#input, this.#decimals, this.#shown] = [input, decimals, input.value];
    for (const type of ["input", "change"] as const) {
      input.addEventListener(type, () => {
        const [now, isDone] = [input.valueAsNumber, type === "change"];
        const taken = Math.max(Number(input.min || -Infinity), Math.min(Number(input.max || Infinity), now));
        if (isDone && taken !== now) input.value = Number.isNaN(now) ? this.#shown : String(taken);
        if (taken === now ? type === when : isDone && !Number.isNaN(now)) typed(taken);
        if (taken !== now || !isDone) this.#tell(taken, now, isDone);
      });
    }
  }

  /** Says below the field which end a number is beyond. */
  #tell(end: number, number: number, isDone: boolean): void {
    const words = end > number ? `${end} is the least.` : end < number ? `${end} is the most.` : "";
    this.#input.ariaInvalid = words === "" || isDone ? null : "true";
    this.#reason.textContent = words.replace("-", "\u2212");
    this.#input.closest("label")?.after(this.#reason);
  }

  /** Shows a number, or that there is none, unless one is being typed. */
  set value(value: number | null) {
    this.#shown = value?.toFixed(this.#decimals) ?? "";
    if (document.activeElement !== this.#input) this.#input.value = this.#shown;
  }
}

/** Two fields of a place, longitude and latitude in degrees. */
export class PlaceFields {
  readonly #fields: readonly NumberField[];

  /** @param name Of the fields, before `-lon` and `-lat`. @param typed gets each valid place. */
  constructor(root: ParentNode, name: string, typed: (place: Place) => void, when: When = "input") {
    const names = [`${name}-lon`, `${name}-lat`];
    const act = (): void => {
      const [lon, lat] = names.map((part) => field(root, part).valueAsNumber);
      if (Number.isFinite(lon) && Number.isFinite(lat)) typed([lon, lat]);
    };
    this.#fields = names.map((part) => new NumberField(root, part, 1, act, when));
  }

  set value(place: Place) {
    this.#fields.forEach((part, k) => (part.value = place[k]));
  }
}

/** One of some words: a group of radio buttons. */
export class Choice<T extends string> {
  readonly #inputs: readonly HTMLInputElement[];

  constructor(root: ParentNode, name: string, changed: () => void) {
    this.#inputs = [...root.querySelectorAll<HTMLInputElement>(`input[name=${name}]`)];
    for (const input of this.#inputs) input.addEventListener("change", changed);
  }

  get value(): T {
    return this.#inputs.find((input) => input.checked)!.value as T;
  }

  set value(word: T) {
    for (const input of this.#inputs) input.checked = input.value === word;
  }
}

/** Writes a mark of a ruler and, in percent, where it stands. */
export function mark(ruler: ParentNode, name: string, words: string, percent?: number): HTMLElement {
  const element = find(ruler, name);
  element.textContent = words;
  if (percent !== undefined) element.style.setProperty("--at", `${percent.toFixed(2)}%`);
  return element;
}

/** What can be switched in a room, by name: what is drawn, and the like. */
export class Switches {
  readonly #inputs: ReadonlyMap<string, HTMLInputElement>;

  constructor(root: ParentNode, changed: (name: string) => void) {
    const inputs = [...root.querySelectorAll<HTMLInputElement>(".switch input")];
    this.#inputs = new Map(inputs.map((input) => [input.name, input]));
    for (const [name, input] of this.#inputs) input.addEventListener("change", () => changed(name));
  }

  /** Is on, or off, where a link says nothing of it. */
  begin(name: string, isOn: boolean): void {
    Object.assign(this.#inputs.get(name)!, { checked: isOn, defaultChecked: isOn });
  }

  set(name: string, isOn: boolean): void {
    this.#inputs.get(name)!.checked = isOn;
  }

  /** Whether there is anything to switch. */
  offer(name: string, isThere: boolean): void {
    const input = this.#inputs.get(name)!;
    input.disabled = !isThere;
    input.closest<HTMLElement>(".switch")!.hidden = !isThere && name !== "cells";
  }

  isOn(name: string): boolean {
    return this.#inputs.get(name)!.checked;
  }

  /** What a link says: names of those that are on. */
  get values(): Record<string, string> {
    return { on: [...this.#inputs.keys()].filter((name) => this.isOn(name)).join(",") };
  }

  /** As a link says, or as the room begins. */
  restore(values: LinkValues): void {
    const on = values.get("on")?.split(",");
    for (const [name, input] of this.#inputs) input.checked = on?.includes(name) ?? input.defaultChecked;
  }
}

/** What a link may name and does not hold: a file of sites, a picture. */
export const NAMED = { file: "sites", picture: "pixels" };

/** Says that a link names something that it does not hold, where it does. */
export function tellNamed(messages: Messages, values: LinkValues, what: keyof typeof NAMED): void {
  const name = values.get(what);
  const words = `is named by this link, which does not hold its ${NAMED[what]}. Open the file here.`;
  if (name !== undefined) messages.show(name, words);
}

/** The form of a site; what is returned shows the place of the site that is held: without one there is nothing to move. */
export function siteForm(
  root: ParentNode,
  actions: Readonly<Record<"add" | "move" | "remove", (place: Place) => void>>,
): (place: Place | null) => void {
  const form = find<HTMLFormElement>(root, "[data-form=site]");
  const [lon, lat] = [field(form, "lon"), field(form, "lat")];
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const what = event.submitter?.getAttribute("value") as keyof typeof actions | null | undefined;
    actions[what ?? "add"]([lon.valueAsNumber, lat.valueAsNumber]);
  });
  return (place) => {
    for (const button of form.querySelectorAll<HTMLButtonElement>("button")) {
      button.disabled = button.value !== "add" && place === null;
    }
    if (place === null || form.contains(document.activeElement)) return; // being typed
    [lon.value, lat.value] = place.map(String);
  };
}

/** Sites from which on there are steps: four make the first facets. */
const FIRST = 4;

/**
 * The steps of the insertion; what is returned shows that so many of all sites are inserted, null for all.
 * @param chosen gets their number.
 */
export function stepControl(
  root: ParentNode,
  chosen: (count: number | null) => void,
): (count: number | null, all: number) => void {
  const slider = field(root, "step");
  const [back, next] = ["back", "next"].map((name) => find<HTMLButtonElement>(root, `[data-do=${name}]`));
  const set = (count: number): void => chosen(count >= Number(slider.max) ? null : Math.max(Number(slider.min), count));
  slider.addEventListener("input", () => set(slider.valueAsNumber));
  back.addEventListener("click", () => set(slider.valueAsNumber - 1));
  next.addEventListener("click", () => set(slider.valueAsNumber + 1));
  return (inserted, all) => {
    const [count, least] = [inserted ?? all, Math.min(FIRST, all)];
    [slider.min, slider.max, slider.value] = [least, all, count].map(String);
    slider.disabled = all <= FIRST;
    const words = all === 0 ? "no sites" : `site ${counted(count)} of ${counted(all)}`;
    slider.setAttribute("aria-valuetext", words);
    find(root, "[data-out=step]").textContent = words;
    [back.disabled, next.disabled] = [count <= least, count >= all];
  };
}
