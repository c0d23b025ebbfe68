/** Scripts of the page that are compiled at first need: `exchange.ts` and `lift.ts`. */

import type { Contents } from "./contents.ts";
import { shared } from "page:shared";

/** What such a script offers, when it is first asked for; after a failure the next call tries again. */
export function laterScript<T>(contents: Contents, name: string): () => Promise<T> {
  let loaded: Promise<T> | null = null;
  return () => {
    loaded ??= contents.text(name).then((code) => {
      // Code that the policy of the page allows by its hash.
      const element: HTMLScriptElement & { offers?: T } = document.createElement("script");
      Object.assign(element, { shared, textContent: code });
      document.head.append(element); // runs it, to its end
      element.remove();
      if (element.offers === undefined) throw new Error(`the page's script ${name} did not run`);
      return element.offers;
    });
    loaded.catch(() => (loaded = null));
    return loaded;
  };
}
