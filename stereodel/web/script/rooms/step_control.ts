/** How many sites are inserted: a slider, a button back and one on. */

import { field, find } from "../dom.ts";
import { counted } from "../words.ts";

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
