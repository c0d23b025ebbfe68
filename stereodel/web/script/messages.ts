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
   */
  show(what: string, text: string, action?: Action): void {
    const line = make("p");
    if (what) line.append(make("b", "", what), " ");
    line.append(text);
    const buttons = make("span", "line");
    if (action) buttons.append(this.#button(action));
    buttons.append(this.#button({ words: "Close", act: () => {} }));
    this.#put(line, buttons);
  }

  /** Asks which columns of a file are meant; `chosen` gets two names. */
  askColumns(
    file: string,
    names: readonly string[],
    kinds: readonly [string, string],
    chosen: (names: [string, string]) => void,
  ): void {
    const selects = kinds.map((kind, k) => {
      const select = make("select", "", ...names.map((name) => make("option", "", name)));
      select.selectedIndex = Math.min(k, names.length - 1);
      return { select, label: make("label", "field column", `${kind} `, select) };
    });
    const line = make("p", "", make("b", "", `Which columns of ${file}?`));
    const buttons = make("span", "line", ...selects.map(({ label }) => label));
    buttons.append(
      this.#button({ words: "Open", act: () => chosen([selects[0].select.value, selects[1].select.value]) }),
      this.#button({ words: "Close", act: () => {} }),
    );
    this.#put(line, buttons);
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

  #put(line: Element, buttons: Element): void {
    const message = make("div", "message", line, buttons);
    message.setAttribute("role", "alert");
    this.#place.replaceChildren(message);
  }
}
