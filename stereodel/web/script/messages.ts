/** What the page says: one line under the head of what went wrong, and what a screen reader hears. */

import { make, plain } from "./dom.ts";

/** A button of a message: its words and what it does; the message closes. */
export interface Action {
  readonly words: string;
  readonly act: () => void;
}

export type Messages = ReturnType<typeof messagesIn>;

export function messagesIn(place: Element) {
  const close = (): void => place.replaceChildren();
  /**
   * Shows a line, instead of the one before.
   * @param what begins the line in the colour of what is held: a file, a row. May be empty.
   * @param text the words, which are never taken for HTML.
   * @param inputs stand before the buttons: what the action asks for.
   */
  const show = (what: string, text: string, action?: Action, inputs: readonly Node[] = []): void => {
    const line = make("p", "", ...(what ? [make("b", "", what), " "] : []), text);
    const buttons = [...(action ? [action] : []), { words: "Close", act: () => {} }].map(({ words, act }) => {
      const button = make("button", { className: "quiet", type: "button" }, words);
      button.addEventListener("click", () => {
        close();
        act();
      });
      return button;
    });
    place.replaceChildren(
      make("div", { className: "message", role: "alert" }, line, make("span", "line", ...inputs, ...buttons)),
    );
  };
  return { show, close };
}

/** Milliseconds without a change after which a sentence is spoken. */
const REST = 600;

export type Announcer = ReturnType<typeof announcerIn>;

/** @param region An element with `role="status"`. */
export function announcerIn(region: Element) {
  let timer: ReturnType<typeof setTimeout> | undefined;
  /** Says a sentence after a while without another; marks of `say` are taken out. */
  const say = (sentence: string): void => {
    clearTimeout(timer);
    timer = setTimeout(() => (region.textContent = plain(sentence)), REST);
  };
  return { say };
}
