// SPDX-License-Identifier: MIT
/// \file
/// The page of `risorius view`: connects the engine with stage, channels and timeline.

import { Camera } from "./camera.js";
import { cameras } from "./cameras.js";
import { Channels } from "./channels.js";
import { useClipboard } from "./clipboard.js";
import { byId, h, shown } from "./dom.js";
import { makeEngine } from "./engine_choice.js";
import { Export } from "./export.js";
import type { Job } from "./export.js";
import { useDrop } from "./drop.js";
import { download, Files } from "./files.js";
import type { Sight } from "./head.js";
import "./hosted.js";
import { Hover } from "./hover.js";
import { Keeper } from "./keeper.js";
import { useKeyboard } from "./keyboard.js";
import type { Edit } from "./key_edits.js";
import { showLegend } from "./legend.js";
import { NewHead } from "./newhead.js";
import type { Binary, DocumentMessage, Pose, Scene, State, Vec, Welcome } from "./protocol.js";
import { Recorder } from "./record.js";
import { SmileTest } from "./smile_test.js";
import { SpeechSound } from "./speech.js";
import { Stage } from "./stage.js";
import { sentenceOf } from "./sentence.js";
import { Timeline } from "./timeline.js";
import type { Speech } from "./timeline_canvas.js";

let welcome: Welcome | null = null;
let script: DocumentMessage | null = null;
let scene: Scene | null = null;
let state: State | null = null;
let pose: Pose | null = null;

function say(text: string, good = false, for_s = good ? 2.5 : 7): void {
  const place = byId("message");
  place.textContent = text;
  place.classList.toggle("good", good);
  place.hidden = false;
  clearTimeout(Number(place.dataset.timer));
  place.dataset.timer = String(setTimeout(() => (place.hidden = true), 1000 * for_s));
}

const stage = new Stage(byId("stage"), {
  begin: (pull, vertex, point_m) =>
    engine.send({
      type: "pull",
      pull,
      vertex,
      point_m,
      stiffness_n_per_m: Number(byId<HTMLSelectElement>("stiffness").value),
      record: byId<HTMLInputElement>("record").checked,
    }),
  move: (pull, point_m) => {
    moves.set(pull, point_m);
    if (performance.now() - sentMoves_ms > step_ms) sendMoves();
  },
  end: (pull) => {
    sendMoves();
    engine.send({ type: "pull_end", pull });
  },
  pick: (muscle) => channels.reveal(muscle),
});

// The pointer may move more often than the face: one message a step, and not only when there is a picture.
const step_ms = 1000 / 60;
const moves = new Map<number, Vec>();
let sentMoves_ms = 0;
function sendMoves(): void {
  if (moves.size > 0) sentMoves_ms = performance.now();
  for (const [pull, point_m] of moves) engine.send({ type: "pull_to", pull, point_m });
  moves.clear();
}
function everyPicture(): void {
  sendMoves();
  requestAnimationFrame(everyPicture);
}
requestAnimationFrame(everyPicture);

const channels = new Channels(byId("channels"), {
  override: (channel, value) => engine.send({ type: "override", channel, value }),
  release: (channel) => engine.send(channel ? { type: "release", channel } : { type: "release" }),
  key: (channel) => engine.send({ type: "key", channel }),
  select,
});

/// The muscle whose force and length are shown: the one that was chosen, while the pointer is on no other.
let chosen = "";
function select(channel: string): void {
  chosen = channel;
  engine.send({ type: "select", channel });
}

const hover = new Hover(byId("stage"), {
  probe: (event) => stage.probe(event),
  highlight: (muscle) => {
    stage.highlight(muscle);
    channels.highlight(muscle);
  },
  ask: (muscle) => {
    if (welcome?.steers) engine.send({ type: "select", channel: muscle?.replace(/\.[lr]$/, "") ?? chosen });
  },
});

const timeline = new Timeline(byId("timeline"), {
  edit,
  seek,
  say: (text) => (byId("twin").textContent = text),
  tell: (text) => say(text),
});

const speech = new SpeechSound();
let said: Speech | null = null;

const keeper = new Keeper({ edit, show: takeDocument, say });

const files = new Files({ send: (message) => engine.send(message), ask: (message) => engine.ask(message), file: () => welcome?.file ?? null });

const making = new Export({ ask: (message) => engine.ask(message) });

const camera = new Camera({ ask: (message) => engine.ask(message), send: (message) => engine.send(message), picture: (bytes) => engine.sendBytes(bytes) });

const recorder = new Recorder({
  send: (message) => engine.send(message),
  play: () => !state?.playing && playOrPause(),
  script: () => script?.script ?? null,
  say: (text) => say(text, true),
});

const newHead = new NewHead({
  ask: (message) => engine.ask(message),
  open: (path, smile) => {
    if (smile) smileTest.want();
    engine.send({ type: "open", path });
  },
});

const smileTest = new SmileTest({
  override: (channel, value) => engine.send({ type: "override", channel, value }),
  say: (text) => say(text, true, 12),
  reveal: (channel) => channels.reveal(channel),
});

function edit(edits: Edit[], gesture?: string): void {
  if (engine.open) engine.send(gesture ? { type: "edit", edits, gesture } : { type: "edit", edits });
  else keeper.editAlone(edits, gesture);
}

function undo(): void {
  if (engine.open) engine.send({ type: "undo" });
  else keeper.undoAlone();
}

// What the engine says

function takeWelcome(message: Welcome): void {
  welcome = message;
  document.body.dataset.kind = message.kind ?? "face";
  offerWhatIsThere(message.kind === "body");
  keeper.useWelcome(message);
  byId("file-name").textContent = message.kind === "body" ? message.rig : (message.file ?? `new script for ${message.rig}`);
  byId("folder").textContent = message.folder;
  document.title = `${message.file ?? message.rig} – Risorius studio`;
  channels.use(message);
  making.useWelcome(message);
  timeline.useChannels(message.channels);
  const add = byId<HTMLSelectElement>("add");
  add.replaceChildren(h("option", { value: "" }, "event…"), h("option", { value: "blink" }, "blink"), h("option", { value: "say" }, "say a text…"));
  for (const { name } of message.expressions) add.append(h("option", { value: `expression ${name}` }, name.replaceAll("_", " ")));
  if (!message.start) byId<HTMLDialogElement>("open-dialog").close();
  if (!message.steers) say("Another page steers; this one looks.");
  else if (message.mesh) newHead.show(message.folder, message.mesh);
  else if (message.start) engine.send({ type: "files" });
}

/// A soft body has neither muscles nor eyes.
function offerWhatIsThere(isBody: boolean): void {
  for (const option of byId<HTMLSelectElement>("sight").options) option.hidden = option.disabled = isBody && !["skin", "wire"].includes(option.value);
  for (const id of ["camera", "second-camera"])
    for (const option of byId<HTMLSelectElement>(id).options) option.hidden = option.disabled = isBody && cameras[Number(option.value)].middle !== undefined;
}

/// Documents may come faster than pictures: the last one is shown.
function takeDocument(message: DocumentMessage): void {
  if (!waitingDocument) requestAnimationFrame(showDocument);
  waitingDocument = true;
  script = message;
}

let waitingDocument = false;

function showDocument(): void {
  waitingDocument = false;
  const message = script!;
  byId("dirty").hidden = !message.dirty;
  byId<HTMLButtonElement>("undo").disabled = !message.undo;
  byId<HTMLButtonElement>("redo").disabled = !message.redo;
  const duration = byId<HTMLInputElement>("duration");
  if (document.activeElement !== duration) duration.value = shown(message.duration_s, 3);
  channels.useDocument(message);
  timeline.useDocument(message);
  timeline.useState(state ?? emptyState);
}

let toldLoad = 0;

function write(id: string, text: string): void {
  const place = byId(id);
  if (place.textContent !== text) place.textContent = text;
}

const emptyState = { t_s: 0, computed_s: 0 } as State;

function takeState(message: State): void {
  const started = state === null || state.playing !== message.playing;
  state = message;
  write("clock", `${message.t_s.toFixed(2)} s`);
  if (started) {
    const play = byId("play");
    play.classList.toggle("playing", message.playing);
    play.setAttribute("aria-label", message.playing ? "Pause" : "Play");
  }
  write("busy", message.computing ? `computing ${message.computed_s.toFixed(1)} s` : "");
  const late = message.step_ms > 1000 / 60;
  const connection = byId("connection");
  // Twice a second is often enough for a number that is read.
  if (performance.now() - toldLoad > 500) {
    toldLoad = performance.now();
    write("connection", `${message.step_ms.toFixed(1)} ms a step`);
  }
  connection.classList.toggle("late", late);
  channels.useState(message);
  hover.useState(message);
  recorder.useState(message);
  making.useState(message);
  timeline.useState(message);
  speech.follow(message.t_s, message.playing);
  stage.showPulls(message.pulls);
  smileTest.useState(message);
}

function takeBinary(message: Binary): void {
  switch (message.kind) {
    case "scene": {
      scene = message.scene;
      stage.use(scene);
      hover.useScene(scene);
      fillLandmarks(scene);
      smileTest.useScene(scene);
      setSight(byId<HTMLSelectElement>("sight").value as Sight);
      break;
    }
    case "picture":
      stage.head?.usePicture(message.picture);
      stage.changed();
      break;
    case "sound":
      void speech.use(message.bytes).then((sound) => {
        if (said) timeline.useSpeech((said = { ...said, ...sound }));
      });
      break;
    case "skull":
      stage.head?.useSkull(message.skull);
      if (pose) stage.take(pose);
      write("busy", "");
      break;
    case "mesh":
      newHead.useMesh(message.mesh);
      break;
    case "file":
      making.useFile(message.name, message.type, message.bytes);
      break;
    case "muscles":
      stage.head?.useMuscles(message.muscles);
      break;
    case "pose":
      pose = message.pose;
      stage.take(pose);
      channels.meters(pose);
      hover.usePose(pose);
      smileTest.usePose(pose);
      // The state of the same moment came before.
      if (state && welcome && (state.resting || !state.playing)) write("twin", sentenceOf(state, pose, welcome.columns));
      // The next pose is asked for when this one is on the screen.
      requestAnimationFrame(() => engine.credit());
      document.body.dataset.step = String(pose.step);
  }
}

function takeOther(message: Record<string, any>): void {
  if (message.type === "error" && !document.querySelector("#export-dialog[open]") && !newHead.useError(String(message.message))) say(String(message.message));
  if (message.type === "saved") {
    byId("file-name").textContent = message.path;
    if (welcome) {
      welcome.file = message.path;
      keeper.useName(welcome.folder, message.path);
    }
    say(`Saved ${message.path}`, true);
  }
  if (message.type === "speech") {
    speech.expect(Number(message.start_s));
    const any = message.sound || message.phones.length > 0;
    said = any ? { start_s: message.start_s, phones: message.phones, words: message.words, samples: null, rate_hz: 1 } : null;
    timeline.useSpeech(said);
  }
  if (message.type === "steers" && welcome) welcome.steers = true;
  if (message.type === "steers") say("This page steers now.", true);
  if (message.type === "camera") camera.useState(message);
  if (message.type === "performed") camera.usePerformed(message);
  if (message.type === "job") making.useJob(message as Job);
  if (message.type === "voice") {
    if (message.state === "running") say(`The mouths of this rig are simulated first, once, for some minutes: ${Math.round(100 * Number(message.fraction))} %. You can go on working.`, true);
    else if (message.state === "failed") say(String(message.text));
  }
  if (message.type === "dropped" && message.mesh) {
    byId<HTMLDialogElement>("open-dialog").close();
    newHead.show(welcome?.folder ?? "", message.path);
  }
  if (message.type === "dropped" && !message.mesh) say(`${message.path} is in the folder now.`, true);
  if (message.type === "meshes") newHead.useMeshes(message.files);
  if (message.type === "landmarks_saved") newHead.useSaved(message.path);
  if (message.type === "landmarks_found") newHead.useFound(message);
  if (message.type === "fit") newHead.useFit(message);
  if (message.type === "files") files.showList(message.scripts, message.samples);
  if (message.type === "thumbnail") files.useThumbnail(message as unknown as Record<string, string>);
}

function connected(yes: boolean): void {
  const place = byId("connection");
  place.classList.toggle("on", yes);
  place.classList.toggle("lost", !yes);
  if (!yes) place.textContent = "no engine";
  byId("lost").hidden = yes || script === null;
  if (!yes) keeper.lost();
}

const engine = makeEngine(location.hash.slice(1), {
  welcome: takeWelcome,
  document: (message) => {
    takeDocument(message);
    keeper.useDocument(message);
  },
  state: takeState,
  binary: takeBinary,
  other: takeOther,
  connected,
});

// What the person does

function setSight(sight: Sight): void {
  byId<HTMLSelectElement>("sight").value = sight;
  stage.show(sight);
  engine.send({ type: "sights", strain: sight === "strain", muscles: sight === "muscles", skull: sight === "skull" });
  if (sight === "skull" && stage.head && !stage.head.hasSkull) say("The bones are being estimated. This takes some seconds.", true);
  showLegend(sight, scene?.strain_colours ?? []);
}

function fillLandmarks(now: Scene): void {
  const select = byId<HTMLSelectElement>("landmark");
  select.replaceChildren(h("option", { value: "" }, "landmark…"));
  for (const id of Object.keys(now.landmarks).sort()) select.append(h("option", { value: id }, id));
}

function setHand(on: boolean): void {
  stage.hand = on;
  byId("stage").classList.toggle("hand", on);
  byId("tool-hand").setAttribute("aria-checked", String(on));
  byId("tool-turn").setAttribute("aria-checked", String(!on));
}

/// On a narrow stage, what is about pulling is below a button.
function openPullOptions(open: boolean): void {
  byId("pull-options").setAttribute("aria-expanded", String(open));
  byId("pull-fields").classList.toggle("open", open);
}
document.addEventListener("pointerdown", (event) => {
  if (!(event.target as HTMLElement).closest(".pull-options")) openPullOptions(false);
});

let lastSecond = "3"; // the profile

/// The number of a named camera beside the main view, or "".
function showSecond(index: string): void {
  if (index) lastSecond = index;
  byId<HTMLSelectElement>("second-camera").value = index;
  stage.showSecond(index ? Number(index) : null);
}

function playOrPause(): void {
  // Browsers let a page sound only after a gesture: this is one.
  speech.allow();
  if (state?.playing) engine.send({ type: "pause" });
  else
    engine.send({
      type: "play",
      rate: Number(byId<HTMLSelectElement>("rate").value),
      loop: byId<HTMLInputElement>("loop").checked,
    });
}

/// Where the playhead was sent last, s: the engine may not be there yet when the next step comes.
let sought: { t_s: number; at_ms: number } | null = null;
const seekTakes_ms = 1500;

function seek(t_s: number): void {
  sought = { t_s, at_ms: performance.now() };
  engine.send({ type: "seek", t_s });
  if (!state?.playing && said?.samples) {
    speech.allow();
    speech.scrub(t_s);
  }
}

function step(frames: number): void {
  if (!state || !script) return;
  const fresh = sought && !state.playing && performance.now() - sought.at_ms < seekTakes_ms;
  const from = fresh ? Math.round(sought!.t_s * 60) / 60 : state.t_s;
  seek(Math.min(script.duration_s, Math.max(0, from + frames / 60)));
}

function addEvent(choice: string): void {
  if (!choice || !script || !state) return;
  if (choice === "say") {
    // Browsers let a page sound only after a gesture: this is one.
    speech.allow();
    byId<HTMLDialogElement>("say-dialog").returnValue = ""; // of the last time
    byId<HTMLDialogElement>("say-dialog").showModal();
    byId<HTMLInputElement>("say-text").select();
    return;
  }
  const start_s = Math.round(state.t_s * 1000) / 1000;
  const event = choice === "blink" ? { blink: {}, start_s } : { expression: choice.slice("expression ".length), start_s };
  const events = script.script.events;
  const edits: { path: string; value: unknown }[] = events ? [] : [{ path: "/events", value: [] }];
  edits.push({ path: `/events/${events?.length ?? 0}`, value: event });
  edit(edits);
}

function on(id: string, type: string, does: () => void): void {
  byId(id).addEventListener(type, does);
}
on("play", "click", playOrPause);
on("to-start", "click", () => seek(0));
on("undo", "click", undo);
on("redo", "click", () => engine.send({ type: "redo" }));
on("save", "click", () => files.save());
on("export", "click", () => making.show());
on("open", "click", () => engine.send({ type: "files" }));
on("new-head", "click", () => newHead.show(welcome?.folder ?? ""));
on("help", "click", () => byId<HTMLDialogElement>("help-dialog").showModal());
on("copy", "click", () => script && download(script.script));
on("tool-turn", "click", () => setHand(false));
on("tool-hand", "click", () => setHand(true));
on("pull-options", "click", () => openPullOptions(byId("pull-options").getAttribute("aria-expanded") !== "true"));
on("sight", "change", () => setSight(byId<HTMLSelectElement>("sight").value as Sight));
on("camera", "change", () => stage.look(Number(byId<HTMLSelectElement>("camera").value)));
on("second-camera", "change", () => showSecond(byId<HTMLSelectElement>("second-camera").value));
on("snap", "change", () => (timeline.snapKeys = byId<HTMLInputElement>("snap").checked));
on("duration", "change", () => {
  const value = Number(byId<HTMLInputElement>("duration").value);
  edit([{ path: "/duration_s", value }]);
});
on("landmark", "change", () => {
  const choice = byId<HTMLSelectElement>("landmark");
  if (choice.value && !stage.grabLandmark(choice.value)) say(`Tissue does not move the landmark ${choice.value}.`);
  choice.value = "";
  openPullOptions(false);
});
on("add", "change", () => {
  const select = byId<HTMLSelectElement>("add");
  addEvent(select.value);
  select.value = "";
});
byId<HTMLDialogElement>("say-dialog").addEventListener("close", () => {
  if (byId<HTMLDialogElement>("say-dialog").returnValue !== "say") return;
  speech.allow();
  engine.send({ type: "say", text: byId<HTMLInputElement>("say-text").value, voice: byId<HTMLInputElement>("say-voice").value });
});
// Not the first button of a form: that is the one which Enter presses.
for (const button of document.querySelectorAll<HTMLButtonElement>("[data-close]")) button.addEventListener("click", () => button.closest("dialog")!.close());
const cameraSelect = byId<HTMLSelectElement>("camera");
cameras.forEach(({ name }, index) => {
  cameraSelect.append(h("option", { value: index }, `${index + 1}  ${name}`));
  byId("second-camera").append(h("option", { value: index }, `+ ${name}`));
});
for (const tab of document.querySelectorAll<HTMLButtonElement>(".tabs button"))
  tab.addEventListener("click", () => {
    document.body.dataset.panel = tab.dataset.panel;
    for (const one of document.querySelectorAll<HTMLButtonElement>(".tabs button"))
      one.setAttribute("aria-pressed", String(one === tab));
  });

useKeyboard({
  save: () => files.save(),
  undo,
  redo: () => engine.send({ type: "redo" }),
  selectAll: () => timeline.selectAll(),
  playOrPause,
  step,
  toStart: () => seek(0),
  makeKey: () => channels.lastName && channels.makeKey(channels.lastName),
  toggleSecondView: () => showSecond(byId<HTMLSelectElement>("second-camera").value ? "" : lastSecond),
  mirror: () => timeline.mirror(),
  record: () => recorder.toggle(),
  toggleHand: () => setHand(!stage.hand),
  search: () => channels.focusSearch(),
  help: () => byId<HTMLDialogElement>("help-dialog").showModal(),
  letGo: () => stage.letGoOfAll(),
  camera: (index) => {
    cameraSelect.value = String(index);
    stage.look(index);
  },
});
useDrop({
  ask: (message) => engine.ask(message),
  send: (message) => engine.send(message),
  bytes: (piece) => engine.sendBytes(piece),
  tell: (text) => say(text),
});
useClipboard({ copy: () => timeline.copy(), remove: () => timeline.remove(), paste: (text, mirrored) => timeline.paste(text, mirrored) });

// The engine that is started again has another address, which differs only behind the #: the browser would not load it.
window.addEventListener("hashchange", () => location.reload());
window.addEventListener("beforeunload", (event) => {
  if (script?.dirty) event.preventDefault();
});

// For tests: where a vertex is on the screen, and what the engine has said.
(window as any).studio = {
  screenOf: (vertex: number, inSecond?: boolean) => stage.screenOf(vertex, inSecond),
  probe: (at: { clientX: number; clientY: number }) => stage.probe(at),
  scene: () => scene,
  state: () => state,
  script: () => script,
  pose: () => pose,
  sounds: () => speech.sounds,
  scrubbed: () => speech.scrubbed,
  said: () => said,
  newHead: () => newHead.debug,
  camera: () => camera.debug,
  sendBytes: (bytes: ArrayBuffer) => engine.sendBytes(bytes),
  mandible: (at: Vec) => stage.head?.mandiblePoint(at)?.toArray() ?? null,
  ask: (message: Record<string, unknown>) => engine.ask(message),
  cut: (wait_ms: number) => engine.cut(wait_ms),
};
