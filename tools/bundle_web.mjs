// Usage: node tools/bundle_web.mjs OUTPUT
// Bundle the scripts and styles of stereodel/web/script into the folder OUTPUT by the esbuild of its node_modules.
//
// The page's first script, page.js, is all that it takes to see and move it. Others are compiled at first need: those of
// LATER, what files take and the Lift room. Nothing is in the page twice: what the later scripts use of the first is
// handed over as one object. The modules of the first are found, then the names that the others import of these; the
// first one gets them as the module `page:shared`, and in the others they are taken out of the object that stands at
// their script element (later_script.ts).

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const FOLDER = resolve(dirname(fileURLToPath(import.meta.url)), "../stereodel/web/script");
const { build } = createRequire(join(FOLDER, "package.json"))("esbuild");

/** Scripts that are compiled at first need. */
const LATER = ["exchange", "lift"];

const HOW = {
  absWorkingDir: FOLDER,
  bundle: true,
  charset: "utf8",
  dropLabels: ["CHECK"], // of arguments from programs (kernel/checks.ts)
  legalComments: "none",
  loader: { ".txt": "text" },
  logLevel: "warning",
  metafile: true,
  target: "es2022",
};

/** The module `page:shared`: an object of names from modules, each of them once. */
function sharing(names) {
  const imports = [...names].map(
    ([module, those]) => `import { ${those.join(", ")} } from ${JSON.stringify(`./${module}`)};`,
  );
  const all = [...names.values()].flat();
  const twice = all.filter((name, k) => all.indexOf(name) !== k);
  if (twice.length > 0)
    throw new Error(`modules of the first script share two things called ${twice.join(", ")}; rename one`);
  return `${imports.join("\n")}\nexport const shared = { ${all.join(", ")} };`;
}

/** Reads `page:shared` as a text. */
const withShared = (text) => ({
  name: "shared",
  setup(to) {
    to.onResolve({ filter: /^page:shared$/ }, () => ({ path: "shared", namespace: "page" }));
    to.onLoad({ filter: /.*/, namespace: "page" }, () => ({ contents: text, resolveDir: FOLDER }));
  },
});

/** A later script as one module, which imports from `first:MODULE` what the first one has; and the modules in it. */
async function later(name, first) {
  const outside = {
    name: "outside",
    setup(to) {
      to.onResolve({ filter: /^\./ }, ({ path, resolveDir, kind }) => {
        const module = relative(FOLDER, join(resolveDir, path));
        if (kind === "entry-point" || !first.has(module)) return undefined;
        return { path: `first:${module}`, external: true, sideEffects: false };
      });
    },
  };
  const how = { entryPoints: [`${name}.ts`], format: "esm", write: false, plugins: [outside] };
  const { metafile, outputFiles } = await build({ ...HOW, ...how });
  return { name, code: outputFiles[0].text, modules: modulesOf(metafile) };
}

/** Whether a module is a list of other modules' exports, and nothing by itself. */
function isIndex(module) {
  const text = readFileSync(join(FOLDER, module), "utf8").replace(/\/\*.*?\*\//gs, "");
  return text.replace(/export (type )?\{[^}]*\} from "[^"]+";/g, "").trim() === "";
}

/** Modules that a bundle has something of. */
function modulesOf({ outputs }) {
  const [{ inputs }] = Object.values(outputs);
  const scripts = Object.keys(inputs).filter((path) => path.endsWith(".ts"));
  return scripts.filter((path) => inputs[path].bytesInOutput > 0 && !isIndex(path));
}

/** The names that scripts import of the first, by modules. */
function namesOf(scripts) {
  const names = new Map();
  const code = scripts.map((script) => script.code).join("\n");
  for (const [line, list, module] of code.matchAll(/^import(?:\s*\{([^}]*)\} from)? .*?"first:([^"]+)";$/gm)) {
    if (list === undefined) throw new Error(`a later script must import by name, and not: ${line}`);
    const those = list.split(",").map((name) => name.trim().split(" as ")[0]);
    names.set(module, [...new Set([...(names.get(module) ?? []), ...those])].sort());
  }
  return new Map([...names].sort());
}

/** Refuses modules of two later scripts: they belong to the first. */
function disjoint(scripts) {
  const all = scripts.flatMap(({ modules }) => modules);
  const twice = all.filter((module, k) => all.indexOf(module) !== k);
  if (twice.length > 0) throw new Error(`two later scripts have ${twice.join(", ")}; import it in the first one, too`);
}

/** Takes what a later script imports of the first out of the object that is handed over. */
const handedOver = (names) => ({
  name: "handed over",
  setup(to) {
    to.onResolve({ filter: /^first:/ }, ({ path }) => ({ path, namespace: "first" }));
    to.onLoad({ filter: /.*/, namespace: "first" }, ({ path }) => ({
      contents: `export const { ${names.get(path.replace("first:", "")).join(", ")} } = document.currentScript.shared;`,
    }));
  },
});

const output = resolve(process.argv[2]);
const finished = (name, how) => build({ ...HOW, minify: true, outfile: join(output, name), ...how });

const alone = { entryPoints: ["main.ts"], write: false, plugins: [withShared("export const shared = {};")] };
const first = new Set(modulesOf((await build({ ...HOW, ...alone })).metafile));
const scripts = await Promise.all(LATER.map((name) => later(name, first)));
disjoint(scripts);
const all = namesOf(scripts);
await finished("page.js", { entryPoints: ["main.ts"], format: "iife", plugins: [withShared(sharing(all))] });
for (const script of scripts) {
  const { name, code } = script;
  await finished(`${name}.js`, { stdin: { contents: code }, format: "iife", plugins: [handedOver(namesOf([script]))] });
}
await finished("widget.js", { entryPoints: ["widget.ts"], format: "esm" });
await finished("page.css", { entryPoints: ["page.css"] });
await finished("widget.css", { entryPoints: ["widget.css"] });
