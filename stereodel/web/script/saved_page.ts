/** The page as a file with a state in it: its own source, in which the state of any length is one more text. */

import { make } from "./dom.ts";

/** @param source The document as it was before its script ran. @param state As a link without its `#`. */
export async function savedPage(source: Node, state: string): Promise<Blob> {
  const page = source.cloneNode(true) as HTMLElement;
  page.querySelector("#block-state")?.remove();
  const block = make("script", { type: "text/plain", id: "block-state" }, await packed(state));
  page.querySelector("#block-kernel")!.before(block, "\n");
  return new Blob(["<!doctype html>\n", page.outerHTML, "\n"], { type: "text/html" });
}

/** Text as `Contents` reads it: base64 of deflated bytes. */
async function packed(text: string): Promise<string> {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}
