// SPDX-License-Identifier: MIT
// Builds a face with the engine of a hosted page, in Node.js, and measures its steps: with the pose of each, as a script is computed.
//
//   node measure_engine.mjs WEB_BUILD_FOLDER SCRIPT.json [FRAMES]

import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";

const [build, script, frames = "150"] = process.argv.slice(2);
const source = resolve(dirname(new URL(import.meta.url).pathname), "../..");
const built = resolve(build);
const createEngine = createRequire(import.meta.url)(join(built, "engine.js"));
const engine = await createEngine({ wasmBinary: readFileSync(join(built, "engine.wasm")) });

const put = (path, from = path) => {
  engine.FS.mkdirTree(dirname(path));
  engine.FS.writeFile(path, readFileSync(from));
};
for (const name of readdirSync(join(source, "rigs/standard"))) put(`/rigs/standard/${name}`, join(source, "rigs/standard", name));
engine.FS.mkdirTree("/models");
const path = resolve(script);
const rig = resolve(dirname(path), JSON.parse(readFileSync(path, "utf8")).rig);
put(path);
put(rig);
// Whatever the rig names and is there
JSON.parse(readFileSync(rig, "utf8"), (_, value) => {
  if (typeof value === "string" && /\.\w+$/.test(value) && existsSync(resolve(dirname(rig), value))) put(resolve(dirname(rig), value));
});

const output = () => Buffer.from(engine.HEAPU8.slice(engine._studio_output(), engine._studio_output() + engine._studio_output_size()));
function call(name, input = "") {
  const bytes = Buffer.from(input);
  engine.HEAPU8.set(bytes, engine._studio_input(bytes.length));
  const done = engine[`_studio_${name}`]();
  if (!done) throw new Error(output().toString());
}
// Of processor time: what other programs take does not count.
const used_ms = () => process.cpuUsage().user / 1000;
let begin = used_ms();
call("open", path);
console.log(`built in ${((used_ms() - begin) / 1000).toFixed(2)} s`);
call("receive", JSON.stringify({ type: "play" }));
const warm = 60; // steps until the machine's own code is the fast one
let poses = 0;
for (let frame = 0; frame < warm + Number(frames); frame++) {
  if (frame === warm) begin = used_ms();
  if (!engine._studio_tick()) continue;
  call("pose");
  if (frame >= warm) poses++;
}
const took = used_ms() - begin;
console.log(`${poses} steps with their poses: ${(took / poses).toFixed(1)} ms each, ${((1000 * poses) / took).toFixed(0)} a second`);
console.log(`memory ${(engine.HEAPU8.length / 1e6).toFixed(0)} MB`);
