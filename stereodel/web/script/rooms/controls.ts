/** Native inputs of a room: numbers in fields, switches, sets. */

import { field, find } from "../dom.ts";
import type { LinkValues } from "../link.ts";
import type { Messages } from "../messages.ts";
import { counted } from "../words.ts";
import type { Place } from "./sphere_state.ts";

/** A field of numbers: what is typed and valid is told, and what the hand does is shown. */
export class NumberField {
  readonly #input: HTMLInputElement;
  readonly #decimals: number;

  /**
   * @param typed gets each valid number; the browser keeps to `min` and `max`.
   * @param when Whether it does so while the reader types, or at the end.
   */
  constructor(
    root: ParentNode,
    name: string,
    decimals: number,
    typed: (value: number) => void,
    when: "input" | "change" = "input",
  ) {
    this.#input = field(root, name);
    this.#decimals = decimals;
    this.#input.addEventListener(when, () => {
      if (this.#input.value !== "" && this.#input.validity.valid) typed(this.#input.valueAsNumber);
    });
  }

  /** Shows a number, or that there is none, unless one is being typed. */
  set value(value: number | null) {
    if (document.activeElement !== this.#input) this.#input.value = value?.toFixed(this.#decimals) ?? "";
  }

  set max(value: number) {
    this.#input.max = String(value);
  }
}

/** Two fields of a place, longitude and latitude in degrees. */
export class PlaceFields {
  readonly #fields: readonly [NumberField, NumberField];

  /** @param name Of the fields, before `-lon` and `-lat`. @param typed gets each valid place. */
  constructor(
    root: ParentNode,
    name: string,
    typed: (place: readonly [number, number]) => void,
    when: "input" | "change" = "input",
  ) {
    const names = [`${name}-lon`, `${name}-lat`] as const;
    const act = (): void => {
      const [lon, lat] = names.map((part) => field(root, part).valueAsNumber);
      if (Number.isFinite(lon) && Number.isFinite(lat)) typed([lon, lat]);
    };
    this.#fields = [new NumberField(root, names[0], 1, act, when), new NumberField(root, names[1], 1, act, when)];
  }

  set value([lon, lat]: readonly [number, number]) {
    [this.#fields[0].value, this.#fields[1].value] = [lon, lat];
  }
}

/** One of some words: a group of radio buttons. */
export class Choice<T extends string> {
  readonly #inputs: readonly HTMLInputElement[];
  readonly #words: readonly T[];

  constructor(root: ParentNode, name: string, words: readonly T[], changed: () => void) {
    this.#inputs = [...root.querySelectorAll<HTMLInputElement>(`input[name=${name}]`)];
    this.#words = words;
    for (const input of this.#inputs) input.addEventListener("change", changed);
  }

  get value(): T {
    const chosen = this.#inputs.find((input) => input.checked)?.value;
    return this.#words.find((word) => word === chosen) ?? this.#words[0];
  }

  set value(word: T) {
    for (const input of this.#inputs) input.checked = input.value === word;
  }
}

/** Switches of a room by name. */
export class Switches {
  readonly #inputs: ReadonlyMap<string, HTMLInputElement>;

  constructor(root: ParentNode, names: readonly string[], changed: (name: string) => void) {
    this.#inputs = new Map(names.map((name) => [name, field(root, name)]));
    for (const [name, input] of this.#inputs) input.addEventListener("change", () => changed(name));
  }

  set(name: string, isOn: boolean): void {
    this.#inputs.get(name)!.checked = isOn;
  }

  /** Whether something is drawn. */
  isOn(name: string): boolean {
    return this.#inputs.get(name)!.checked;
  }

  /** Names of those that differ from the way the room begins. */
  get turned(): string {
    const turned = [...this.#inputs].filter(([, { checked, defaultChecked }]) => checked !== defaultChecked);
    return turned.map(([name]) => name).join(",");
  }

  /** Turns those of a link, and all others back. */
  set turned(names: string) {
    const turned = names.split(",");
    for (const [name, input] of this.#inputs) input.checked = input.defaultChecked !== turned.includes(name);
  }
}

/** What a link may name and does not hold: a file of sites, a picture. */
export const NAMED = { file: "sites", picture: "pixels" };

/** Says that a link names something that it does not hold, where it does. */
export function tellNamed(messages: Messages, values: LinkValues, what: keyof typeof NAMED): void {
  if (!values.has(what)) return;
  const words = `is named by this link, which does not hold its ${NAMED[what]}. Open the file here.`;
  messages.show(values.text(what, ""), words);
}

/** What its buttons do. */
interface SiteFormActions {
  add(place: Place): void;
  move(place: Place): void;
  remove(): void;
}

export class SiteForm {
  readonly #form: HTMLFormElement;

  constructor(root: ParentNode, actions: SiteFormActions) {
    const form = find<HTMLFormElement>(root, "[data-form=site]");
    this.#form = form;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const place: Place = [field(form, "lon").valueAsNumber, field(form, "lat").valueAsNumber];
      const what = event.submitter?.getAttribute("value") ?? "add";
      if (what === "remove") actions.remove();
      else if (what === "move") actions.move(place);
      else actions.add(place);
    });
  }

  /** Shows the place of the site that is held, unless it is being typed; without one there is nothing to move. */
  show(place: Place | null): void {
    const form = this.#form;
    for (const button of form.querySelectorAll<HTMLButtonElement>("button")) {
      button.disabled = button.value !== "add" && place === null;
    }
    if (place === null || form.contains(document.activeElement)) return;
    field(form, "lon").value = String(place[0]);
    field(form, "lat").value = String(place[1]);
  }
}

/** Sites from which on there are steps: four make the first facets. */
const FIRST = 4;

export class StepControl {
  readonly #root: ParentNode;
  #count = 0;
  #all = 0;

  /** @param chosen gets the number of sites that are inserted, or null for all of them. */
  constructor(root: ParentNode, chosen: (count: number | null) => void) {
    this.#root = root;
    const set = (count: number): void => chosen(count >= this.#all ? null : Math.max(this.#least, count));
    const slider = field(root, "step");
    slider.addEventListener("input", () => set(slider.valueAsNumber));
    find(root, "[data-do=back]").addEventListener("click", () => set(this.#count - 1));
    find(root, "[data-do=next]").addEventListener("click", () => set(this.#count + 1));
  }

  /** Shows that so many of all sites are inserted; null for all. */
  show(count: number | null, all: number): void {
    [this.#count, this.#all] = [count ?? all, all];
    const slider = field(this.#root, "step");
    slider.min = String(this.#least);
    slider.max = String(all);
    slider.value = String(this.#count);
    slider.disabled = all <= FIRST;
    const words = all === 0 ? "no sites" : `site ${counted(this.#count)} of ${counted(all)}`;
    slider.setAttribute("aria-valuetext", words);
    find(this.#root, "[data-out=step]").textContent = words;
    find<HTMLButtonElement>(this.#root, "[data-do=back]").disabled = this.#count <= this.#least;
    find<HTMLButtonElement>(this.#root, "[data-do=next]").disabled = this.#count >= all;
  }

  get #least(): number {
    return Math.min(FIRST, this.#all);
  }
}
