/**
 * The globe in a notebook, as anywidget asks for it: places, their look and layers in; lens, view and selection in and back.
 * `stereodel/web/assemble.py` writes the constant `CONTENTS` before this module. A notebook loads the module anew for
 * each widget, so that what they share, the compiled kernel, stands where all of them find it.
 */

import { Contents } from "./contents.ts";
import { load } from "./kernel/instance.ts";
import { NotebookGlobe, TRAITS, type Shown } from "./notebook_globe.ts";
import { GlobeScene } from "./rooms/globe_scene.ts";

declare const CONTENTS: Readonly<Record<string, string>>;

/** The part of a widget's model that is used here. */
interface Model {
  get<K extends keyof Shown>(name: K): Shown[K];
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
  const scene = new GlobeScene("authalic");
  await scene.load(contents);

  let timer: ReturnType<typeof setTimeout> | undefined;
  let isOwn = false; // what the globe tells is shown already
  const globe = new NotebookGlobe(el, scene, (name, value) => {
    isOwn = true;
    model.set(name, value);
    isOwn = false;
    clearTimeout(timer);
    timer = setTimeout(() => model.save_changes(), REST);
  });
  const act = (): void => {
    if (isOwn) return;
    globe.show(Object.fromEntries(TRAITS.map((name) => [name, model.get(name)])) as unknown as Shown);
  };
  act();
  for (const name of TRAITS) model.on(`change:${name}`, act);
  return () => {
    clearTimeout(timer);
    for (const name of TRAITS) model.off(`change:${name}`, act);
    globe.dispose();
  };
}

export default { render };
