/**
 * The globe in a notebook, as anywidget asks for it: sites in; lens, view and selection in and back.
 * `stereodel/web/assemble.py` writes the constant `CONTENTS` before this module. A notebook loads the module anew for
 * each widget, so that what they share, the compiled kernel, stands where all of them find it.
 */

import { Contents } from "./contents.ts";
import { load } from "./kernel/instance.ts";
import { NotebookGlobe, type Lens, type ViewAngles } from "./notebook_globe.ts";

declare const CONTENTS: Readonly<Record<string, string>>;

/** The part of a widget's model that is used here. */
interface Model {
  get(name: "sites"): DataView;
  get(name: "lens"): Lens;
  get(name: "view"): ViewAngles;
  get(name: "selection"): number[];
  set(name: string, value: unknown): void;
  save_changes(): void;
  on(event: string, heard: () => void): void;
  off(event: string, heard: () => void): void;
}

/** Milliseconds of rest after which Python is told. */
const REST = 100;

const SHARED = Symbol.for("stereodel.web.kernels");

/** The module of this kernel, compiled once for all widgets of the notebook that have the same. */
function compiled(contents: Contents): Promise<WebAssembly.Module> {
  const everywhere = globalThis as unknown as Record<symbol, Map<string, Promise<WebAssembly.Module>> | undefined>;
  const modules = (everywhere[SHARED] ??= new Map());
  const known = modules.get(CONTENTS["kernel"]);
  if (known !== undefined) return known;
  const module = contents.kernel().then((bytes) => WebAssembly.compile(bytes));
  modules.set(CONTENTS["kernel"], module);
  return module;
}

/** Shows a model in an element; the function that is returned lets go of everything. */
async function render({ model, el }: { model: Model; el: HTMLElement }): Promise<() => void> {
  const contents = new Contents((name) => CONTENTS[name] ?? null);
  await load(await compiled(contents));

  let timer: ReturnType<typeof setTimeout> | undefined;
  const globe = new NotebookGlobe(el, await contents.land("110m"), (name, value) => {
    model.set(name, value);
    clearTimeout(timer);
    timer = setTimeout(() => model.save_changes(), REST);
  });
  const heard: Record<string, () => void> = {
    "change:sites": () => globe.showSites(doubles(model.get("sites"))),
    "change:lens": () => globe.showLens(model.get("lens")),
    "change:view": () => globe.showView(model.get("view")),
    "change:selection": () => globe.showSelection(model.get("selection")),
  };
  for (const [event, act] of Object.entries(heard)) {
    act();
    model.on(event, act);
  }
  return () => {
    clearTimeout(timer);
    for (const [event, act] of Object.entries(heard)) model.off(event, act);
    globe.dispose();
  };
}

/** Numbers at any place of a buffer. */
function doubles(view: DataView): Float64Array {
  return new Float64Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength) as ArrayBuffer);
}

export default { render };
