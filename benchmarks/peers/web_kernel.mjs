// The kernel of the web and its peers in one process of Node, in turn: milliseconds of the
// processor, the best of some rounds.
//
//     node web_kernel.mjs SCRIPT SIZES ROUNDS
//
// SCRIPT: the folder stereodel/web/script, whose node_modules hold the peers.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, sizes, rounds] = process.argv.slice(2);
const script = (file) => import(new URL(file, pathToFileURL(`${folder}/`)));
const { load } = await script("kernel/instance.ts");
const { PlanarDelaunay, SphericalDelaunay, SphericalVoronoi, xyzToLonlat } =
  await script("kernel/api.ts");
const { geoDelaunay: ours, geoVoronoi: diagram } = await script(
  "kernel/d3.ts",
);
const { geoDelaunay: theirs, geoVoronoi } = await script(
  "node_modules/d3-geo-voronoi/src/index.js",
);
const { default: Delaunator } = await script(
  "node_modules/delaunator/index.js",
);
const compiling = performance.now();
await load(readFileSync(`${folder}/../built/stereodel.wasm`));
const compiled = performance.now() - compiling;

// Uniform directions and points: the generator of Park and Miller, so that all runs see the same.
let state = 1;
const uniform = () => (state = (state * 48271) % 2147483647) / 2147483647;

function direction() {
  const [z, angle] = [2 * uniform() - 1, 2 * Math.PI * uniform()];
  const across = Math.sqrt(1 - z * z);
  return [across * Math.cos(angle), across * Math.sin(angle), z];
}

/** Reads every corner, by index: iterators leave more behind than some of what is measured. */
function read({ features }) {
  let sum = 0;
  for (const { geometry } of features) {
    const ring = geometry.coordinates[0];
    for (let k = 0; k < ring.length; ++k) sum += ring[k][0] + ring[k][1];
  }
  return sum;
}

/** Milliseconds of the processor, collections of garbage included. */
function spent() {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1e3;
}

const rows = [];
for (const size of sizes.split(",").map(Number)) {
  const xyz = Float64Array.from(Array.from({ length: size }, direction).flat());
  const xy = Float64Array.from({ length: 2 * size }, uniform);
  const lonlat = xyzToLonlat(xyz);
  const places = Array.from({ length: size }, (_, k) => [
    lonlat[2 * k],
    lonlat[2 * k + 1],
  ]);
  const made = new SphericalDelaunay(xyz);
  const tasks = {
    sphere: () => new SphericalDelaunay(xyz),
    cells: () => new SphericalVoronoi(made),
    both: () => new SphericalVoronoi(new SphericalDelaunay(xyz)),
    plane: () => new PlanarDelaunay(xy),
    // What theirs makes at once, ours makes when asked.
    "d3, ours": () => {
      const { edges, triangles, centers, neighbors, polygons, mesh, hull } =
        ours(places);
      return [edges, triangles, centers, neighbors, polygons, mesh, hull];
    },
    "d3, theirs": () => theirs(places),
    // The polygons of all cells from longitude and latitude, each in its own form.
    polygons: () => SphericalVoronoi.fromLonlat(lonlat),
    // As GeoJSON, every corner of every feature read.
    "d3, polygons, ours": () => read(diagram(places).polygons()),
    "d3, polygons": () => read(geoVoronoi(places).polygons()),
    delaunator: () => new Delaunator(xy),
  };
  const best = Object.fromEntries(
    Object.keys(tasks).map((name) => [name, Infinity]),
  );
  for (let round = 0; round < Number(rounds); ++round) {
    for (const [name, task] of Object.entries(tasks)) {
      const begin = spent();
      task();
      best[name] = Math.min(best[name], spent() - begin);
    }
  }
  rows.push({ size, ...best });
}
console.log(JSON.stringify({ compiled, rows }));
