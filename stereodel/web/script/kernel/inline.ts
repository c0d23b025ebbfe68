/** The package with its module inside the script: no second file, no request. */

import bytes from "../../built/stereodel.wasm";
import { load as loadFrom } from "./instance.ts";

export * from "./api.ts";

/** Makes the kernel ready; further calls wait for the first one. */
export function load(): Promise<void> {
  return loadFrom(bytes);
}
