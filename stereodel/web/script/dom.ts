/** What the page's own HTML holds; a missing element is a fault of the page and told as one. */

/** The one element below `root` that `selector` finds. */
export function find<T extends Element = HTMLElement>(root: ParentNode, selector: string): T {
  const element = root.querySelector<T>(selector);
  if (element === null) throw new Error(`the page has no element ${selector}`);
  return element;
}

/** An input, select or group of radio buttons below `root`, by name. */
export function field(root: ParentNode, name: string): HTMLInputElement {
  return find<HTMLInputElement>(root, `input[name="${name}"]`);
}

/** A new element with a class (none if empty) or with properties, and content. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  given: string | Partial<HTMLElementTagNameMap[K]> = "",
  ...content: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const properties = typeof given === "string" ? (given === "" ? {} : { className: given }) : given;
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...content);
  return element;
}

/**
 * Writes a sentence with marks into an element: `*P*` is a letter in italics, `_12_` a number of the moment.
 * The content is made of text nodes alone, so that names of files cannot become elements.
 */
export function say(element: Element, text: string): void {
  const parts = text.split(/(\*[^*]+\*|_[^_]+_)/).map((part, k) => {
    if (k % 2 === 0) return part; // between two marks, if only nothing
    return part.startsWith("*") ? make("i", "", part.slice(1, -1)) : make("span", "n", part.slice(1, -1));
  });
  element.replaceChildren(...parts.filter((part) => part !== ""));
}

/** The sentence as plain text, for a live region or a label. */
export function plain(text: string): string {
  return text.replace(/\*([^*]+)\*|_([^_]+)_/g, "$1$2");
}
