// SPDX-License-Identifier: MIT
/// \file
/// The worker of a hosted page: loads the engine (src/risorius/view/wasm/exports.cpp), fetches the files that a script needs when it is
/// opened, and makes a step every 1/60 s, as the server of `risorius view` does.

import { fetchPacked } from "./packed_file.js";

/// engine.js, which Emscripten makes
interface Machine {
  HEAPU8: Uint8Array;
  FS: { mkdirTree(path: string): void; writeFile(path: string, bytes: Uint8Array | string): void };
  _studio_input(bytes: number): number;
  _studio_output(): number;
  _studio_output_size(): number;
  _studio_tick(): number;
  [name: string]: any;
}
declare function importScripts(...urls: string[]): void;
declare function createEngine(options: Record<string, unknown>): Promise<Machine>;

/// pack.json: what lies beside the page (tools/web/build_hosted.sh).
interface Pack {
  rigs: Record<string, { rig: string; files: string[]; pictures: string[]; skull: string | null }>;
  samples: Record<string, { script: string; rig: string; files: string[] }>;
  first: string;
}

const page = self as unknown as { postMessage(message: unknown, transfer?: Transferable[]): void };
const tick_ms = 1000 / 60;
const firstCredit = 2;

let machine: Machine;
let pack: Pack;
let isOpen = false;
let opened = 0; ///< scripts so far
let file = ""; ///< name of the script
let credit = firstCredit;
let poseWaits = true;
let step_ms = 0;
let hasMuscles = false;
let hasSkull = false;
let bones: string | null = null; ///< the file with the bones of the rig

/// Where a script of a person lies; messages name it as he does.
const ownFolder = `/own${"/folder".repeat(12)}`;
let ownName = "";
const inOwnWords = (words: string) => words.replaceAll(`${ownFolder}/script.json`, ownName);

const text = new TextDecoder();
const note = (kind: string, words: string, more: Record<string, unknown> = {}) => page.postMessage({ note: kind, text: words, ...more });

/// Calls a function of the engine with an input; throws what it complains of.
function call(name: string, input?: string): Uint8Array {
  if (input !== undefined) {
    const bytes = new TextEncoder().encode(input);
    const at = machine._studio_input(bytes.length);
    machine.HEAPU8.set(bytes, at);
  }
  const done = machine[`_studio_${name}`]();
  const at = machine._studio_output();
  const out = machine.HEAPU8.slice(at, at + machine._studio_output_size());
  if (!done) throw new Error(text.decode(out));
  return out;
}
const told = (name: string, input?: string) => text.decode(call(name, input));
const sendBytes = (name: string) => {
  const bytes = call(name).buffer as ArrayBuffer;
  page.postMessage(bytes, [bytes]);
};
const sendError = (id: unknown, words: string) => page.postMessage(JSON.stringify({ type: "error", id: id ?? null, message: words }));

// Files

const there = new Set<string>();
async function place(path: string): Promise<void> {
  if (there.has(path)) return;
  const bytes = await fetchPacked(`data/${path}`);
  put(`/${path}`, bytes);
  there.add(path);
}
function put(path: string, bytes: Uint8Array | string): void {
  machine.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")) || "/");
  machine.FS.writeFile(path, bytes);
}

/// The rig of the pack that a script of a person means: the one whose folder has the same name.
function rigOf(script: string): string {
  let named = "";
  try {
    named = String(JSON.parse(script).rig ?? "");
  } catch {
    throw new Error("expected a script, which is JSON, found something else");
  }
  const found = Object.entries(pack.rigs).find(([name]) => named.split(/[\\/]/).at(-2) === name);
  if (!found) throw new Error(`rig: expected one that this page has (${Object.keys(pack.rigs).join(", ")}), found "${named}"`);
  return found[0];
}

/// The path that a name means, seen from a folder.
function resolved(folder: string, name: string): string {
  const parts: string[] = [];
  for (const part of `${name.startsWith("/") ? "" : folder}/${name.replaceAll("\\", "/")}`.split("/"))
    if (part === "..") parts.pop();
    else if (part && part !== ".") parts.push(part);
  return `/${parts.join("/")}`;
}

/// Puts a script of a person into a folder of its own, and the rig where the script looks for it.
async function placeOwn(script: string, rig: Pack["rigs"][string]): Promise<string> {
  put(`${ownFolder}/script.json`, script);
  const at = resolved(ownFolder, String(JSON.parse(script).rig));
  const rigFolder = rig.rig.slice(0, rig.rig.lastIndexOf("/"));
  const up = "../".repeat(rigFolder.split("/").length);
  put(at, await fetchPacked(`data/${rig.rig}`));
  for (const name of rig.files) put(resolved(at.slice(0, at.lastIndexOf("/")), up + name), await fetchPacked(`data/${name}`));
  return `${ownFolder}/script.json`;
}

async function open(message: Message): Promise<void> {
  if (message.quality) told("quality", message.quality);
  let path: string;
  let rig: string;
  let name: string;
  if (message.text !== undefined) {
    ownName = message.name ?? "script.json";
    rig = rigOf(message.text);
    path = await placeOwn(message.text, pack.rigs[rig]);
    name = ownName;
  } else {
    const known = message.sample && pack.samples[message.sample] ? message.sample : pack.first;
    const sample = pack.samples[known];
    rig = sample.rig;
    path = `/${sample.script}`;
    name = `${known}.json`;
    await Promise.all([sample.script, ...sample.files].map(place));
  }
  note("loading", "loading the face");
  await Promise.all([pack.rigs[rig].rig, ...pack.rigs[rig].files].map(place));
  note("loading", "building the face");
  const welcome = JSON.parse(told("open", path));
  isOpen = true;
  file = name;
  opened++;
  hasMuscles = hasSkull = false;
  page.postMessage(JSON.stringify({ ...welcome, steers: true, folder: "your downloads", file }));
  sendBytes("scene");
  page.postMessage(told("document"));
  credit = firstCredit;
  poseWaits = true;
  bones = pack.rigs[rig].skull;
  // What the parts are painted with comes after the face, which moves meanwhile.
  for (const path of pack.rigs[rig].pictures) void sendFile(path);
}

/// Sends a message that lies in a file, for the script that is open now.
async function sendFile(path: string): Promise<void> {
  const now = opened;
  const bytes = (await fetchPacked(`data/${path}`)).slice().buffer as ArrayBuffer;
  if (now === opened) page.postMessage(bytes, [bytes]);
}

// Messages

interface Message {
  type: string;
  id?: number;
  [key: string]: any;
}

function save(message: Message): void {
  if (message.path) file = String(message.path);
  note("saved", file.split("/").at(-1)!, { script: told("save") });
  page.postMessage(JSON.stringify({ type: "saved", path: file }));
  page.postMessage(told("document"));
}

function answer(message: Message): void {
  if (message.type === "credit") credit = Math.min(credit + 1, firstCredit);
  else if (message.type === "save") save(message);
  else {
    for (const reply of JSON.parse(told("receive", JSON.stringify(message))) as string[]) page.postMessage(inOwnWords(reply));
    poseWaits = true;
    if (message.type !== "sights") return;
    if (message.muscles && !hasMuscles) sendBytes("muscles");
    hasMuscles ||= message.muscles;
    if (message.skull && !hasSkull) {
      if (bones) void sendFile(bones);
      else sendBytes("skull");
    }
    hasSkull ||= message.skull;
  }
}

let opening: Promise<void> = Promise.resolve();
self.addEventListener("message", ({ data }: MessageEvent<Message>) => {
  if (data.type === "open") {
    opening = opening.then(() => open(data)).catch((error: Error) => {
      if (isOpen) sendError(data.id, inOwnWords(error.message));
      else note("failed", error.message);
      ownName = file; // the script that stays open
    });
  } else if (isOpen) {
    try {
      answer(data);
    } catch (error) {
      sendError(data.id, inOwnWords((error as Error).message));
    }
  }
});

// The clock

function tick(due: number): void {
  if (isOpen) {
    const begin = performance.now();
    const moved = machine._studio_tick() === 1;
    if (moved) step_ms += 0.1 * (performance.now() - begin - step_ms);
    for (const event of JSON.parse(told("events")) as string[]) page.postMessage(event);
    poseWaits ||= moved;
    if (poseWaits && credit > 0) {
      poseWaits = false;
      credit--;
      page.postMessage(JSON.stringify({ ...JSON.parse(told("state")), step_ms: Math.round(10 * step_ms) / 10 }));
      sendBytes("pose");
    }
  }
  const next = Math.max(due + tick_ms, performance.now() - 2 * tick_ms);
  setTimeout(() => guarded(next), Math.max(0, next - performance.now()));
}
/// A fault of the engine itself ends it: its memory cannot be trusted any more.
function guarded(due: number): void {
  try {
    tick(due);
  } catch (error) {
    note("failed", (error as Error).message);
  }
}

async function start(): Promise<void> {
  note("loading", "loading the engine");
  importScripts("engine.js");
  const [listed, wasmBinary] = await Promise.all([fetch("pack.json"), fetchPacked("engine.wasm")]);
  pack = await listed.json();
  note("samples", "", { names: Object.keys(pack.samples) });
  machine = await createEngine({ wasmBinary });
  guarded(performance.now());
}
opening = start().catch((error: Error) => note("failed", error.message));
