/**
 * Sites as a table beside the picture. Rows that are out of sight are not made, so that a million sites cost as much as
 * twenty; readers of the screen hear how many there are.
 */

import { make, say } from "./dom.ts";

/** Rows above and below the visible ones. */
const AROUND = 12;

/** What the table shows of the sites. */
export interface Rows {
  readonly count: number;
  /** What a site is called, with a capital. */
  readonly noun?: string;
  /** Heads of the columns behind the site's number. */
  readonly heads: readonly string[];
  /** Cells of a site, one a head. */
  cells(site: number): readonly string[];
  /** Of the sites, where their file has such a column. */
  readonly names?: readonly string[] | null;
  /** What stands behind the number of a site: a letter, or nothing. */
  mark?(site: number): string;
}

export class SiteTable {
  readonly #place: HTMLElement;
  readonly #table = make("table");
  readonly #head = make("thead");
  readonly #body = make("tbody");
  #rows: Rows = { count: 0, heads: [], cells: () => [] };
  #held: ReadonlySet<number> = new Set();
  /** The first row that is made; none of other sites. */
  #begin = NaN;

  /**
   * @param place scrolls: an element of the class `sites`.
   * @param chosen The number of a site was pressed.
   * @param pointed The pointer or the focus is on a row; null when it leaves.
   */
  constructor(place: HTMLElement, chosen: (site: number) => void, pointed: (site: number | null) => void) {
    this.#place = place;
    this.#table.append(this.#head, this.#body);
    place.append(this.#table);
    place.addEventListener("scroll", () => this.#fill(), { passive: true });
    this.#body.addEventListener("click", (event) => {
      const site = siteOf(event.target);
      if (site !== null && (event.target as Element).closest("button")) chosen(site);
    });
    for (const type of ["pointerover", "focusin", "pointerleave", "focusout"] as const) {
      this.#body.addEventListener(type, ({ target }) => pointed(/(over|in)$/.test(type) ? siteOf(target) : null));
    }
  }

  /** Shows other sites. */
  show(rows: Rows): void {
    const before = this.#rows;
    this.#rows = rows;
    if (rows.heads === before.heads && rows.count === before.count && rows.names === before.names) {
      // As while a site is dragged: cells change in a fraction of the time in which rows are made.
      for (const row of this.#made) {
        const cells = row.querySelectorAll("td:not(.name)");
        rows.cells(Number(row.dataset["site"])).forEach((words, k) => {
          if (cells[k].textContent !== words) cells[k].textContent = words;
        });
      }
      return;
    }
    this.#table.hidden = rows.count === 0;
    this.#table.ariaRowCount = String(rows.count + 1);
    const heads = [rows.noun ?? "Site", ...(rows.names ? ["Name"] : []), ...rows.heads].map((head) => {
      const cell = make("th", { className: head === "Name" ? "name" : "", scope: "col" });
      say(cell, head);
      return cell;
    });
    this.#head.replaceChildren(make("tr", "", ...heads));
    this.#begin = NaN;
    this.#fill();
  }

  /** Marks the sites that are held, by a dot and by colour. */
  hold(sites: Iterable<number>): void {
    const held = new Set(sites);
    if (held.size === this.#held.size && [...held].every((site) => this.#held.has(site))) return;
    this.#held = held;
    for (const row of this.#made) row.className = held.has(Number(row.dataset["site"])) ? "on" : "";
  }

  /** Brings a row into sight. */
  reveal(site: number): void {
    const [top, height] = [site * this.#height, this.#height];
    const least = top + height - this.#place.clientHeight + this.#head.offsetHeight;
    this.#place.scrollTop = Math.min(top, Math.max(least, this.#place.scrollTop));
    this.#fill();
  }

  get #made(): HTMLElement[] {
    return [...this.#body.querySelectorAll<HTMLElement>("tr[data-site]")];
  }

  get #height(): number {
    return this.#made[0]?.offsetHeight || 28;
  }

  /** Makes the rows that can be seen. */
  #fill(): void {
    const [height, { count }] = [this.#height, this.#rows];
    const visible = Math.ceil((this.#place.clientHeight || 250) / height);
    const first = Math.floor(this.#place.scrollTop / height) - AROUND;
    const begin = Math.max(0, Math.min(first, count - visible));
    if (Math.abs(begin - this.#begin) < AROUND / 2) return;
    this.#begin = begin;
    const end = Math.min(count, begin + visible + 2 * AROUND);
    const focused = siteOf(document.activeElement);
    const rows = Array.from({ length: end - begin }, (_, k) => this.#row(begin + k));
    const width = this.#head.querySelectorAll("th").length;
    this.#body.replaceChildren(gap(begin * height, width), ...rows, gap((count - end) * height, width));
    this.#body.querySelector<HTMLElement>(`tr[data-site="${focused}"] button`)?.focus({ preventScroll: true });
  }

  #row(site: number): HTMLElement {
    const { noun = "Site", names } = this.#rows;
    const name = names?.[site];
    const ariaLabel = `${noun} ${site + 1}${name ? `, ${name}` : ""}`;
    const button = make("button", { type: "button", ariaLabel }, String(site + 1));
    const head = make("th", { scope: "row" }, button);
    const mark = this.#rows.mark?.(site);
    if (mark) head.append(" ", make("i", "", mark));
    const row = make(
      "tr",
      { className: this.#held.has(site) ? "on" : "", ariaRowIndex: String(site + 2) },
      head,
      ...(name === undefined ? [] : [make("td", { className: "name", title: name }, name)]),
      ...this.#rows.cells(site).map((cell) => make("td", "", cell)),
    );
    row.dataset["site"] = String(site);
    return row;
  }
}

function gap(height: number, width: number): HTMLElement {
  const cell = make("td", { colSpan: width });
  cell.style.height = `${height}px`;
  return make("tr", { className: "gap", hidden: height <= 0, ariaHidden: "true" }, cell);
}

function siteOf(target: EventTarget | null): number | null {
  const row = target instanceof Element ? target.closest<HTMLElement>("tr[data-site]") : null;
  return row === null ? null : Number(row.dataset["site"]);
}
