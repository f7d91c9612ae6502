// SPDX-License-Identifier: MIT
// What the page does with scripts, without browser and engine: copies, mirrors and moves of keys, edits while the engine is gone.
//
//   node edits.mjs RISORIUS PACKAGES SOURCE_FOLDER

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";

const [, packages, source] = process.argv.slice(2);
const { build } = await import(join(resolve(packages), "esbuild/lib/main.js"));
async function load(name) {
  const made = await build({ entryPoints: [join(source, `src/web/${name}.ts`)], bundle: true, format: "esm", write: false, logLevel: "error" });
  return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].contents).toString("base64")}`);
}
const keys = await load("key_edits");
const scripts = await load("script_edits");

let failed = 0;
function test(name, body) {
  try {
    body();
    console.log(`ok    ${name}`);
  } catch (error) {
    failed++;
    console.log(`FAIL  ${name}\n${error.stack}`);
  }
}

/// A generator of numbers in [0, 1) from a seed: mulberry32.
function random(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const known = (name) => ["mouthSmileLeft", "mouthSmileRight", "jawLeft", "jawRight", "jawOpen"].includes(name);
const script = {
  duration_s: 2,
  channels: {
    "AU12.l": { keys: [[0.5, 0], [0.75, 0.6], [1, 0]], interpolation: "linear" },
    "AU12.r": { keys: [[0.2, 0.1], [0.75, 0.3]] },
    head_yaw_deg: { keys: [[0, 0], [1, 20]] },
    AU4: { keys: [[0, 0.4]] },
  },
};
const place = (channel, index) => ({ channel, index });

test("the other side has other names, and turns change their sign", () => {
  const mirror = (name) => keys.mirroredChannel(name, known);
  assert.deepEqual(mirror("AU12.l"), { channel: "AU12.r", sign: 1 });
  assert.deepEqual(mirror("gaze_yaw_deg.r"), { channel: "gaze_yaw_deg.l", sign: -1 });
  assert.deepEqual(mirror("gaze_pitch_deg.r"), { channel: "gaze_pitch_deg.l", sign: 1 });
  assert.deepEqual(mirror("head_roll_deg"), { channel: "head_roll_deg", sign: -1 });
  assert.deepEqual(mirror("mouthSmileLeft"), { channel: "mouthSmileRight", sign: 1 });
  for (const both of ["AU12", "jawOpen", "head_pitch_deg", "eyesLeft"]) assert.equal(mirror(both), null);
});

test("a mirrored copy that is mirrored again is the copy", () => {
  const copied = keys.copiedKeys([place("AU12.l", 0), place("AU12.l", 1), place("head_yaw_deg", 1), place("AU4", 0)], script);
  const once = keys.mirroredCopy(copied, known);
  assert.notDeepEqual(once, copied);
  assert.deepEqual(keys.mirroredCopy(once, known), copied);
});

test("pasted keys begin at the playhead, replace what is at their times, and leave the rest", () => {
  const copied = keys.copiedKeys([place("AU12.l", 0), place("AU12.l", 1)], script);
  assert.deepEqual(copied.tracks["AU12.l"].keys, [[0, 0], [0.25, 0.6]]);
  const { edits, put, late } = keys.pastedKeys(copied, script, 0.75);
  assert.equal(late, 0);
  assert.deepEqual(edits, [{ path: "/channels/AU12.l/keys", value: [[0.5, 0], [0.75, 0], [1, 0.6]] }]);
  assert.deepEqual(put, [place("AU12.l", 1), place("AU12.l", 2)]);
});

test("a channel that was not there takes the interpolation of the copy", () => {
  const copied = keys.copiedKeys([place("AU12.l", 1)], script);
  const { edits } = keys.pastedKeys(copied, { duration_s: 2 }, 0.1);
  assert.deepEqual(edits, [
    { path: "/channels", value: {} },
    { path: "/channels/AU12.l", value: { interpolation: "linear", keys: [[0.1, 0.6]] } },
  ]);
});

test("keys after the end are left out, and counted", () => {
  const copied = keys.copiedKeys([place("AU12.l", 0), place("AU12.l", 2)], script);
  assert.equal(keys.pastedKeys(copied, script, 1.8).late, 1);
  assert.deepEqual(keys.pastedKeys(copied, script, 2.5), { edits: [], put: [], late: 2 });
});

test("mirrored keys: the other side does the same, at the same times", () => {
  const { edits, put } = keys.mirroredKeys([place("AU12.l", 0), place("AU12.l", 1), place("AU4", 0)], script, known);
  assert.deepEqual(edits, [{ path: "/channels/AU12.r/keys", value: [[0.2, 0.1], [0.5, 0], [0.75, 0.6]] }]);
  assert.equal(put.length, 2);
  assert.deepEqual(keys.mirroredKeys([place("head_yaw_deg", 1)], script, known).edits, [{ path: "/channels/head_yaw_deg/keys", value: [[0, 0], [1, -20]] }]);
});

test("only keys are read from the clipboard", () => {
  const copied = keys.copiedKeys([place("AU12.l", 0)], script);
  assert.deepEqual(keys.readCopiedKeys(JSON.stringify(copied)), copied);
  for (const text of ["", "hello", "{}", "null", '{"format":"risorius-keys","tracks":{"AU1":{"keys":[["0",1]]}}}', '{"format":"risorius-keys","tracks":{"AU1":{"keys":[]}}}'])
    assert.equal(keys.readCopiedKeys(text), null, text);
});

test("keys move between their neighbours, together", () => {
  const move = (by_s, byPart = 0) => ({ by_s, byPart, snapped: (t) => t, range: () => [0, 1] });
  const times = (edits) => edits[0].value.map((key) => key[0]);
  assert.deepEqual(times(keys.movedKeys([place("AU12.l", 0), place("AU12.l", 1)], script, move(5))), [0.998, 0.999, 1]);
  assert.deepEqual(times(keys.movedKeys([place("AU12.l", 1)], script, move(-5))), [0.5, 0.501, 1]);
  assert.equal(keys.movedKeys([place("AU12.l", 1)], script, move(0, 0.7))[0].value[1][1], 1);
});

test("a channel without keys goes", () => {
  assert.deepEqual(keys.removedKeys([place("AU4", 0)], script), [{ path: "/channels/AU4" }]);
});

/// A script from a seed, with names that need care in pointers.
function anyScript(seed) {
  const next = random(seed);
  const out = { format: "risorius-script", version: 1, rig: "r.json", duration_s: 1 + Math.floor(4 * next()) };
  if (next() < 0.8) out.channels = {};
  for (const name of ["AU1", "AU2.l", "a/b", "t~1"])
    if (out.channels && next() < 0.6) out.channels[name] = { keys: Array.from({ length: 1 + Math.floor(3 * next()) }, (_, i) => [i, Math.round(4 * next()) / 4]) };
  if (next() < 0.6) out.events = Array.from({ length: Math.floor(3 * next()) }, () => ({ blink: {}, start_s: Math.round(9 * next()) }));
  if (next() < 0.3) out.view = { camera: next() < 0.5 ? "front" : "eye" };
  return out;
}

test("the edits between two scripts make one of the other, 500 times", () => {
  let most = 0;
  for (let seed = 0; seed < 500; seed++) {
    const [a, b] = [anyScript(seed), anyScript(1000 + seed)];
    const edits = scripts.editsBetween(a, b);
    most = Math.max(most, edits.length);
    const before = structuredClone(a);
    assert.deepEqual(scripts.appliedEdits(a, edits), b, `seed ${seed}`);
    assert.deepEqual(a, before);
    assert.deepEqual(scripts.editsBetween(a, a), []);
  }
  assert.ok(most > 4);
});

test("edits keep the rig of the script, and refuse places that are not there", () => {
  assert.deepEqual(scripts.editsBetween({ rig: "a", duration_s: 1 }, { rig: "b", duration_s: 1 }), []);
  assert.throws(() => scripts.appliedEdits({ duration_s: 1 }, [{ path: "/channels/AU1", value: 1 }]), /expected a place/);
  assert.throws(() => scripts.appliedEdits({ duration_s: 1, events: [] }, [{ path: "/events/1", value: 1 }]), /index in \[0, 0\]/);
});

test("straight samples go through the keys", () => {
  const at = (track) => scripts.straightSamples(track, 2, 5);
  assert.deepEqual(at({ keys: [[0.5, 0], [1.5, 1]] }), [0, 0, 0.5, 1, 1]);
  assert.deepEqual(at({ keys: [[0.5, 0], [1.5, 1]], interpolation: "step" }), [0, 0, 0, 1, 1]);
});

// Landmarks of a new head, with the adult, whose landmarks were placed with it. Its mesh is in mm.

const model = await load("landmark_model");
const vertices = readFileSync(join(source, "models/adult/head.obj"), "utf8").split("\n").filter((line) => line.startsWith("v ")).map((line) => line.split(" ").slice(1, 4).map(Number));
const adult = Object.fromEntries(Object.entries(JSON.parse(readFileSync(join(source, "models/adult/landmarks.json"), "utf8")).landmarks).map(([id, { vertex }]) => [id, vertices[vertex]]));
const far = (a, b) => Math.hypot(...a.map((one, k) => one - b[k]));
const snap = (p) => vertices.reduce((best, v) => (far(v, p) < far(best, p) ? v : best));
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];

test("a similarity is found again from its points", () => {
  const next = random(7);
  for (let round = 0; round < 20; round++) {
    const points = Array.from({ length: 6 }, () => [next() - 0.5, next() - 0.5, next() - 0.5]);
    const [a, b, s] = [6 * next(), 6 * next(), 0.1 + 10 * next()];
    const turned = ([x, y, z]) => {
      const [u, v] = [Math.cos(a) * x - Math.sin(a) * y, Math.sin(a) * x + Math.cos(a) * y];
      return [s * u + 3, s * (Math.cos(b) * v - Math.sin(b) * z) - 1, s * (Math.sin(b) * v + Math.cos(b) * z) + 2];
    };
    const found = model.similarity(points, points.map(turned));
    for (const p of points) assert.ok(far(found(p), turned(p)) < 1e-6 * s, `round ${round}: ${far(found(p), turned(p))}`);
  }
});

test("seven landmarks propose the other thirteen of the adult", () => {
  const one = new model.LandmarkModel(snap);
  for (const id of ["prn", "n", "me", "ex_l", "ex_r", "ch_l", "ch_r"]) one.put(id, adult[id], false);
  assert.equal(one.propose(model.required), 13);
  assert.deepEqual(one.missing, []);
  const errors = model.required.filter((id) => one.places[id].found === "proposed").map((id) => far(one.places[id].at, adult[id]));
  console.log(`      proposed landmarks: median ${median(errors).toFixed(1)} mm, largest ${Math.max(...errors).toFixed(1)} mm`);
  assert.ok(median(errors) < 5 && Math.max(...errors) < 15, `${errors.map((e) => e.toFixed(1))}`);
});

test("the partner on the other side is proposed by a mirror", () => {
  const one = new model.LandmarkModel(snap);
  for (const id of ["prn", "n", "me", "sn"]) one.put(id, adult[id], true);
  one.put("ch_l", adult.ch_l, true);
  assert.equal(one.places.ch_r.found, "mirrored");
  // The midline alone says little about the plane; a pair says it all.
  const first = far(one.places.ch_r.at, adult.ch_r);
  one.put("ch_r", adult.ch_r, true);
  const errors = ["ex", "en", "ps", "pi", "t"].map((id) => {
    one.put(`${id}_l`, adult[`${id}_l`], true);
    return far(one.places[`${id}_r`].at, adult[`${id}_r`]);
  });
  console.log(`      mirrored: ${first.toFixed(1)} mm from the midline alone, then at most ${Math.max(...errors).toFixed(1)} mm`);
  assert.ok(first < 12 && Math.max(...errors) < 3, `${first} ${errors}`);
  // A partner that a person has placed stays.
  one.put("ch_l", adult.ex_l, true);
  assert.deepEqual(one.places.ch_r.at, adult.ch_r);
});

test("landmarks: 300 random changes undone and done again", () => {
  const next = random(3);
  const one = new model.LandmarkModel(snap);
  one.put("n", adult.n, false);
  const start = structuredClone(one.places);
  const states = [start];
  const ids = model.required;
  for (let i = 0; i < 150; i++) {
    const id = ids[Math.floor(next() * ids.length)];
    if (next() < 0.2) one.remove(id);
    else one.put(id, vertices[Math.floor(next() * vertices.length)], false);
    if (JSON.stringify(one.places) !== JSON.stringify(states[states.length - 1])) states.push(structuredClone(one.places));
  }
  for (let i = states.length - 2; i >= 0; i--) {
    while (JSON.stringify(one.places) !== JSON.stringify(states[i])) assert.ok(one.undo());
  }
  assert.deepEqual(one.places, start);
  while (one.redo());
  assert.deepEqual(one.places, states[states.length - 1]);
});

process.exit(failed ? 1 : 0);
