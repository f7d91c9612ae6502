// SPDX-License-Identifier: MIT
/// \file
/// A new head: choose a mesh of the folder, put its landmarks by clicks, and fit a rig from them. What is placed is kept in the browser.

import { byId, h } from "./dom.js";
import { landmarkLabel, landmarkNamed, landmarkTable } from "./landmark_table.js";
import { LandmarkModel, mapOf, required } from "./landmark_model.js";
import type { Places } from "./landmark_model.js";
import { NewHeadParts } from "./newhead_parts.js";
import { NewHeadStage } from "./newhead_stage.js";
import type { MeshFrame, Vec } from "./protocol.js";

export interface NewHeadActions {
  /// Returns what is wrong with the message, or null.
  ask(message: Record<string, unknown>): Promise<string | null>;
  /// `smile`: and sees how it smiles.
  open(rig: string, smile: boolean): void;
}

/// What the command line says, with the words of this page.
function inThePage(text: string): string {
  return text
    .replace(/\(--cut-lips cuts them\)/g, "(“Cut lips that are joined” cuts them)")
    .replace(/\(--repair mends/g, "(“Repair” mends")
    .replace(/\(the option part gives it one: [^)]*\)/g, "(give it one under “Scan and parts”)")
    .replace(/\(--part [^)]*\)/g, "(say so under “Scan and parts”)");
}

const step_mm = 0.5;
const further = landmarkTable.filter((one) => one.core && !required.includes(one.id)).map((one) => one.id);

export class NewHead {
  private readonly dialog = byId<HTMLDialogElement>("newhead");
  private stage: NewHeadStage | null = null;
  private model: LandmarkModel | null = null;
  private mesh: MeshFrame | null = null;
  private chosen = required[0];
  private folder = "";
  private asked = ""; ///< mesh that is opened when the list is there
  private rig = ""; ///< that the last fit has made
  private readonly meshes = byId<HTMLSelectElement>("newhead-mesh");
  private readonly list = byId("newhead-list");
  private readonly parts = new NewHeadParts({
    changed: () => this.stage?.useRoles(this.parts.roles),
    point: (group) => this.stage?.point(group),
  });

  constructor(private readonly actions: NewHeadActions) {
    this.meshes.addEventListener("change", () => this.meshes.value && void this.load(this.meshes.value));
    const click = (id: string, does: () => void) => byId(id).addEventListener("click", does);
    click("newhead-close", () => this.dialog.close());
    click("newhead-accept", () => this.accept());
    click("newhead-remove", () => this.do(() => this.model!.remove(this.chosen)));
    click("newhead-undo", () => this.do(() => this.model!.undo()));
    click("newhead-redo", () => this.do(() => this.model!.redo()));
    click("newhead-propose", () => this.propose());
    click("newhead-find", () => void this.find());
    click("newhead-save", () => void this.send("save_landmarks", false));
    click("newhead-fit", () => void this.send("fit", false));
    click("newhead-cancel", () => void this.actions.ask({ type: "cancel_fit" }));
    click("newhead-open", () => this.openRig(false));
    click("newhead-smile", () => this.openRig(true));
    this.dialog.addEventListener("keydown", (event) => this.shortcut(event));
  }

  /// Shows the page; the meshes of the folder come as an answer. `mesh`: the one that is opened.
  show(folder: string, mesh = ""): void {
    this.folder = folder;
    this.asked = mesh;
    if (!this.dialog.open) this.dialog.showModal();
    void this.actions.ask({ type: "meshes" });
    this.write();
  }

  private openRig(smile: boolean): void {
    this.dialog.close();
    this.actions.open(this.rig, smile);
  }

  useMeshes(files: string[]): void {
    const asked = this.asked;
    this.asked = "";
    const now = asked || this.meshes.value;
    this.meshes.replaceChildren(h("option", { value: "" }, files.length > 0 ? "choose a mesh…" : "no mesh in this folder"), ...files.map((file) => h("option", { value: file }, file)));
    this.meshes.value = now;
    if (asked && this.meshes.value === asked) void this.load(asked);
  }

  private async load(path: string): Promise<void> {
    this.tell("Reading the mesh…");
    const wrong = await this.actions.ask({ type: "mesh", path });
    if (wrong) this.tell(wrong, true);
  }

  useMesh(mesh: MeshFrame): void {
    this.stage ??= new NewHeadStage(byId("newhead-stage"), {
      put: (at) => this.put(at),
      choose: (id) => this.choose(id, false),
      key: (event) => this.key(event),
    });
    this.mesh = mesh;
    this.parts.use(mesh, this.keptName.replace("landmarks", "parts"));
    this.stage.use(mesh, this.parts.roles);
    this.model = new LandmarkModel((p) => this.stage!.snap(p));
    this.showResult(false);
    const kept = localStorage.getItem(this.keptName);
    if (kept) this.model.places = JSON.parse(kept) as Places;
    this.chosen = this.model.missing[0] ?? required[0];
    this.tell(kept ? `${Object.keys(this.model.places).length} landmarks as you left them.` : "Click the mesh where the landmark is. Drag turns the head.");
    this.write();
    this.flyTo(this.chosen);
  }

  private get keptName(): string {
    return `risorius landmarks ${this.folder}/${this.mesh?.file}`;
  }

  private do(does: () => unknown): void {
    if (!this.model) return;
    does();
    localStorage.setItem(this.keptName, JSON.stringify(this.model.places));
    this.write();
  }

  private get mirror(): boolean {
    return byId<HTMLInputElement>("newhead-mirror").checked;
  }

  private put(at: Vec): void {
    const moved = this.model?.places[this.chosen]?.found === "placed";
    this.do(() => this.model!.put(this.chosen, at, this.mirror));
    this.tell("");
    if (!moved) this.next();
  }

  private accept(): void {
    this.do(() => this.model!.accept(this.chosen));
    this.next();
  }

  private next(): void {
    const model = this.model!;
    const id = model.missing[0] ?? model.unchecked[0];
    if (id) this.choose(id, true);
    else if (!id) this.tell("All landmarks are checked. Fit makes a rig of them.");
  }

  private choose(id: string, fly: boolean): void {
    this.chosen = id;
    this.write();
    if (fly) this.flyTo(id);
  }

  private flyTo(id: string): void {
    const at = this.model?.guess(id);
    if (!at || !this.stage) return;
    const placed = Object.fromEntries(Object.entries(this.model!.places).map(([key, place]) => [key, place.at]));
    const map = mapOf(placed);
    if (!map) return;
    // From where the landmark faces on the standard head, mm
    const [x, y, z] = landmarkNamed(id)!.xyz_mm;
    const away = map([x + 0.3 * x, y + 0.12 * y, z + 0.3 * (z - 10)]);
    const direction = [0, 1, 2].map((k) => away[k] - at[k]) as Vec;
    const [top, bottom] = [map([0, 100, 0]), map([0, 0, 0])];
    this.stage.fly(at, direction, 1.1 * Math.hypot(...top.map((one, k) => one - bottom[k])));
  }

  private propose(): void {
    let count = 0;
    this.do(() => (count = this.model!.propose(byId<HTMLInputElement>("newhead-all").checked ? [...required, ...further] : required)));
    if (count > 0) this.tell(`${count} landmarks proposed. Look at each: drag it where it belongs, or Enter takes it.`);
    else this.tell("Put four landmarks first, on both sides and on the midline.", true);
    if (count > 0) this.next();
  }

  private async find(): Promise<void> {
    const wrong = await this.actions.ask({ type: "find_landmarks", parts: this.parts.parts });
    if (wrong) this.tell(wrong, true);
  }

  useFound(message: Record<string, any>): void {
    const running = message.state === "running";
    byId<HTMLButtonElement>("newhead-find").disabled = running;
    if (running) return this.tell("Looking for the face…");
    if (message.state !== "done") return this.tell(String(message.text), true);
    if (message.path !== this.mesh?.file || !this.model) return;
    let found = { count: 0, toCheck: 0 };
    this.do(() => (found = this.model!.useFound(message.landmarks)));
    this.next();
    this.stage?.focus(); // Enter takes a landmark
    if (found.toCheck > 0) this.tell(`${found.count} landmarks found. Some that a rig needs are to be checked: drag them where they belong, or Enter takes them.`);
    else this.tell(`${found.count} landmarks found. You can fit.`);
  }

  private async send(type: "fit" | "save_landmarks", replace: boolean): Promise<void> {
    const landmarks = Object.fromEntries(Object.entries(this.model!.places).map(([id, place]) => [id, place.at]));
    const quick = byId<HTMLInputElement>("newhead-quick").checked;
    const wrong = await this.actions.ask({ type, landmarks, quick, replace, ...this.parts.forFit });
    if (!wrong) return;
    const names = /consent to replace/.test(wrong) ? [...wrong.matchAll(/"([^"]+)"/g)].map(([, name]) => name) : [];
    const question = names.length === 1 ? `${names[0]} exists already. Replace it?` : `${names.join(" and ")} exist already. Replace them?`;
    if (names.length > 0 && confirm(question)) await this.send(type, true);
    else if (names.length === 0) this.tell(wrong, true);
  }

  useSaved(path: string): void {
    this.tell(`Saved ${path}.`);
  }

  useFit(message: Record<string, any>): void {
    const running = message.state === "running";
    byId<HTMLButtonElement>("newhead-fit").disabled = running;
    byId("newhead-running").hidden = !running;
    const percent = `${Math.round(100 * Number(message.fraction))} %`;
    byId("new-head").textContent = running ? `New head ${percent}` : "New head";
    if (running) {
      byId<HTMLProgressElement>("newhead-progress").value = Number(message.fraction);
      byId("newhead-left").textContent = `${percent} ${message.text}`;
      this.showResult(false);
      return this.tell(`Fitting a rig to ${message.path}`);
    }
    const done = message.state === "done";
    const cancelled = message.state === "cancelled";
    this.rig = String(message.rig);
    this.tell(done ? `The rig is ${this.rig}.` : cancelled ? "Cancelled. No rig was written." : "No rig could be made.", !done && !cancelled);
    byId("newhead-text").textContent = cancelled ? "" : inThePage(String(message.text).trim());
    if (!done && /--(part|cut-lips|repair)\b/.test(message.text)) this.parts.open();
    this.write();
    this.showResult(done);
    if (done) byId("newhead-smile").focus();
    byId("newhead-text").scrollIntoView({ block: "start" });
  }

  /// The buttons for the rig that has been made.
  private showResult(yes: boolean): void {
    byId("newhead-open").hidden = byId("newhead-smile").hidden = !yes;
  }

  /// What the engine could not do; false when this page is not open.
  useError(text: string): boolean {
    if (!this.dialog.open) return false;
    if (!/consent to replace/.test(text)) this.tell(text, true);
    return true;
  }

  private tell(text: string, bad = false): void {
    const place = byId("newhead-told");
    place.textContent = text;
    place.classList.toggle("bad", bad);
    byId("newhead-text").textContent = "";
  }

  // Keys

  private shortcut(event: KeyboardEvent): void {
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    if (!this.model) return;
    if (command && (key === "y" || (key === "z" && event.shiftKey))) this.do(() => this.model!.redo());
    else if (command && key === "z") this.do(() => this.model!.undo());
    else if (key === "m" && !command) byId<HTMLInputElement>("newhead-mirror").click();
    else return;
    event.preventDefault();
  }

  private key(event: KeyboardEvent): boolean {
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    const at = this.model?.places[this.chosen]?.at;
    if (arrow && at) {
      const step = (event.shiftKey ? 10 : 1) * step_mm * this.model!.unitsPerMm(this.stage!.size);
      this.do(() => this.model!.put(this.chosen, this.stage!.nudged(at, arrow[0] * step, arrow[1] * step), false));
    } else if (event.key === "Enter" && at) this.accept();
    else if (event.key === "Delete" || event.key === "Backspace") this.do(() => this.model!.remove(this.chosen));
    else return false;
    return true;
  }

  // What is shown

  private write(): void {
    const model = this.model;
    const places = model?.places ?? {};
    this.stage?.show(places, this.chosen);
    const one = landmarkNamed(this.chosen)!;
    const here = places[this.chosen];
    byId("newhead-name").textContent = `${landmarkLabel(this.chosen)} (${this.chosen})`;
    byId("newhead-definition").textContent = one.definition;
    byId<HTMLButtonElement>("newhead-accept").disabled = !here || here.found === "placed" || here.found === "found";
    byId<HTMLButtonElement>("newhead-remove").disabled = !here;
    byId<HTMLButtonElement>("newhead-undo").disabled = !model?.canUndo;
    byId<HTMLButtonElement>("newhead-redo").disabled = !model?.canRedo;
    for (const id of ["newhead-save", "newhead-propose"]) byId<HTMLButtonElement>(id).disabled = !model || Object.keys(places).length === 0;
    byId<HTMLButtonElement>("newhead-find").disabled = !model;
    const missing = model?.missing.length ?? required.length;
    byId<HTMLButtonElement>("newhead-fit").disabled = missing > 0 || !byId("newhead-running").hidden;
    const unchecked = model?.unchecked.length ?? 0;
    byId("newhead-count").textContent = `${required.length - missing} of ${required.length} required${unchecked > 0 ? `, ${unchecked} to be checked` : ""}`;
    byId("newhead-count").classList.toggle("live", unchecked > 0);
    const entry = (id: string) =>
      h("li", {}, h("button", { class: `landmark ${places[id]?.found ?? "none"}`, "aria-current": id === this.chosen ? "true" : undefined, "data-id": id, title: landmarkLabel(id), onclick: () => this.choose(id, true) }, landmarkLabel(id).replace(/^(.*), (l|r)\w+$/, (_, name, side) => `${side.toUpperCase()} ${name}`)));
    const open = this.list.querySelector("details")?.open ?? false;
    this.list.replaceChildren(
      h("ul", { class: "landmarks", "aria-label": "Required landmarks" }, ...required.map(entry)),
      h("details", { open }, h("summary", {}, "More landmarks make the fit better"), h("ul", { class: "landmarks" }, ...further.map(entry))),
    );
    this.list.querySelector("[aria-current]")?.scrollIntoView({ block: "nearest" });
    this.drawMap();
  }

  /// The standard head from the front and from its left side, with the landmark in question.
  private drawMap(): void {
    const canvas = byId<HTMLCanvasElement>("newhead-map");
    const context = canvas.getContext("2d")!;
    context.clearRect(0, 0, canvas.width, canvas.height);
    const scale = canvas.height / 260;
    const half = canvas.width / 2;
    const dot = (x: number, y_mm: number, colour: string, radius: number) => {
      context.fillStyle = colour;
      context.beginPath();
      context.arc(x, (140 - y_mm) * scale, radius, 0, 7);
      context.fill();
    };
    for (const last of [false, true])
      for (const one of landmarkTable) {
        if ((one.id === this.chosen) !== last) continue;
        const [x, y, z] = one.xyz_mm;
        const [colour, radius] = last ? ["#ffffff", 5] : [this.model?.places[one.id] ? "#57c785" : "#5a6270", 2];
        dot(half / 2 + x * scale, y, colour, radius);
        if (one.side !== "R") dot(1.55 * half - (z - 20) * scale, y, colour, radius);
      }
    context.fillStyle = "#a9b1bc";
    context.font = "12px system-ui, sans-serif";
    context.fillText("front", 4, 14);
    context.fillText("left side", half + 4, 14);
  }

  /// For tests
  get debug() {
    return { places: this.model?.places, chosen: this.chosen, screenOf: (at: Vec) => this.stage?.screenOf(at), vertices: this.mesh?.vertices, guess: (id: string) => this.model?.guess(id) };
  }
}
