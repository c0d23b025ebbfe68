/** One line under the head that says what went wrong; the state before stays. */

import { make } from "./dom.ts";

/** A button of a message: its words and what it does; the message closes. */
export interface Action {
  readonly words: string;
  readonly act: () => void;
}

export class Messages {
  readonly #place: Element;

  constructor(place: Element) {
    this.#place = place;
  }

  /**
   * Shows a line, instead of the one before.
   *
   * @param what begins the line in the colour of what is held: a file, a row. May be empty.
   * @param text the words, which are never taken for HTML.
   * @param inputs stand before the buttons: what the action asks for.
   */
  show(what: string, text: string, action?: Action, inputs: readonly Node[] = []): void {
    const line = make("p");
    if (what) line.append(make("b", "", what), " ");
    line.append(text);
    const buttons = make("span", "line", ...inputs);
    if (action) buttons.append(this.#button(action));
    buttons.append(this.#button({ words: "Close", act: () => {} }));
    const message = make("div", "message", line, buttons);
    message.setAttribute("role", "alert");
    this.#place.replaceChildren(message);
  }

  close(): void {
    this.#place.replaceChildren();
  }

  #button(action: Action): HTMLButtonElement {
    const button = make("button", "quiet", action.words);
    button.type = "button";
    button.addEventListener("click", () => {
      this.close();
      action.act();
    });
    return button;
  }
}
