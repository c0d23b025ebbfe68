/** The fields under the table: a site is added at a place, moved there, or removed. */

import { field, find } from "../dom.ts";
import type { Place } from "./sphere_state.ts";

/** What its buttons do. */
export interface SiteFormActions {
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
