// Peers in JavaScript, in the conversation of benchmarks/processes.py.
//
//     node node_peer.mjs NAME FILE
//
// FILE holds doubles. Reading and conversion to what the peer wants stay outside the measured time.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { createInterface } from 'node:readline';

// The packages are beside the other peers, not beside this file.
const installed = createRequire(new URL('../.peers/node/package.json', import.meta.url));

const peers = {
    // Triangles and half-edges.
    delaunator: async (values) => {
        const { default: Delaunator } = await import(installed.resolve('delaunator'));
        return () => new Delaunator(values).triangles;
    },
    // Triangles, edges, neighbours and polygons, from [longitude, latitude] in degrees.
    'd3-geo-voronoi': async (values) => {
        const { geoDelaunay } = await import(installed.resolve('d3-geo-voronoi'));
        const points = [];
        for (let i = 0; i + 2 < values.length; i += 3) {
            const [x, y, z] = values.subarray(i, i + 3);
            points.push([(Math.atan2(y, x) * 180) / Math.PI, (Math.atan2(z, Math.hypot(x, y)) * 180) / Math.PI]);
        }
        return () => geoDelaunay(points).triangles.flat();
    },
};

const highWater = () => 1024 * Number(/VmHWM:\s*(\d+)/.exec(readFileSync('/proc/self/status', 'ascii'))[1]);

function timed(call, repetitions) {
    writeFileSync('/proc/self/clear_refs', '5'); // lowers the mark to what is resident now
    const before = highWater();
    const seconds = [];
    let corners;
    for (let k = 0; k < repetitions; k += 1) {
        const begin = process.hrtime.bigint();
        corners = call();
        seconds.push(Number(process.hrtime.bigint() - begin) / 1e9);
    }
    const peak = highWater() - before;
    return { seconds, points: new Set(corners).size, triangles: corners.length / 3, peak };
}

const [name, file] = process.argv.slice(2);
const bytes = readFileSync(file);
const values = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
const call = await peers[name](values);
const version = JSON.parse(readFileSync(new URL(`../.peers/node/node_modules/${name}/package.json`, import.meta.url))).version;
console.log(JSON.stringify({ version }));
for await (const line of createInterface({ input: process.stdin })) {
    console.log(JSON.stringify(timed(call, Number(line.split(' ')[1]))));
}
