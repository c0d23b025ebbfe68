/**
 * Exact Delaunay triangulations and Voronoi diagrams of the plane and the sphere, and conformal maps.
 *
 * The module `stereodel.wasm` lies beside this file; bundlers find it by the expression below.
 *
 * @example
 * import { load, SphericalDelaunay } from "stereodel";
 * await load();
 * const triangulation = SphericalDelaunay.fromLonlat([0, 0, 90, 0, 180, 0, -90, 0, 0, 90, 0, -90]);
 */

import { load as loadFrom, type KernelSource } from "./instance.ts";

export * from "./api.ts";

/**
 * Makes the kernel ready; further calls wait for the first one.
 *
 * @param source The module's bytes, its response or the compiled module; by default the file beside this one.
 */
export function load(source?: KernelSource): Promise<void> {
  return loadFrom(source ?? beside());
}

/** A response, or in Node, which does not fetch files, the bytes. */
function beside(): KernelSource {
  const url = new URL("stereodel.wasm", import.meta.url);
  const { process } = globalThis as { process?: { getBuiltinModule?(name: string): NodeFiles } };
  const files = url.protocol === "file:" ? process?.getBuiltinModule?.("node:fs") : undefined;
  return files === undefined ? fetch(url) : files.readFileSync(url);
}

/** What is asked of Node. */
interface NodeFiles {
  readFileSync(file: URL): Uint8Array<ArrayBuffer>;
}
