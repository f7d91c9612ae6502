// SPDX-License-Identifier: MIT
/// \file
/// What is made of the script: a video, a picture of the present moment, blend shapes of the rig. The program makes them in a
/// process of its own; here are the questions, the progress and the result.

import { cameras } from "./cameras.js";
import { byId, h } from "./dom.js";
import type { State, Welcome } from "./protocol.js";

export type Made = "video" | "picture" | "shapes";

/// What the engine tells about a job.
export interface Job {
  what: Made;
  state: "running" | "done" | "failed" | "cancelled";
  fraction: number;
  text: string;
  out: string; ///< below the folder of the project
  script?: string; ///< the draft that was rendered, when the script was not saved
}

export interface ExportActions {
  /// Returns what is wrong with the message, or null.
  ask(message: Record<string, unknown>): Promise<string | null>;
}

const qualities = ["draft", "preview", "video", "fine"];
const named: Record<Made, string> = { video: "Render", picture: "Take the picture", shapes: "Make the shapes" };
const playable = /\.(mp4|webm|png)$/;

export class Export {
  private readonly dialog = byId<HTMLDialogElement>("export-dialog");
  private what: Made = "video";
  private welcome: Welcome | null = null;
  private state: State | null = null;
  private job: Job | null = null;
  private url = "";
  /// A name that the person has typed stays.
  private readonly names: Partial<Record<Made, string>> = {};

  constructor(private readonly actions: ExportActions) {
    for (const what of Object.keys(named) as Made[]) byId(`export-${what}`).addEventListener("click", () => this.choose(what));
    byId("export-start").addEventListener("click", () => void this.start(false));
    byId("export-replace").addEventListener("click", () => void this.start(true));
    byId("export-cancel").addEventListener("click", () => void this.actions.ask({ type: "cancel" }));
    this.dialog.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || !(event.target instanceof HTMLInputElement) || byId<HTMLButtonElement>("export-start").disabled) return;
      event.preventDefault();
      void this.start(false);
    });
    byId("export-close").addEventListener("click", () => this.dialog.close());
    byId("export-out").addEventListener("input", () => (this.names[this.what] = byId<HTMLInputElement>("export-out").value));
    const camera = byId<HTMLSelectElement>("export-camera");
    camera.append(h("option", { value: "" }, "as the script"), ...cameras.map(({ name }) => h("option", { value: name.replaceAll(" ", "_") }, name)));
  }

  useWelcome(welcome: Welcome): void {
    this.welcome = welcome;
    byId("export-folder").textContent = welcome.folder;
    const select = byId<HTMLSelectElement>("export-quality");
    select.replaceChildren(...qualities.map((one) => h("option", { value: one }, one === welcome.quality ? `${one}, as it is played here` : one)));
    select.value = welcome.quality;
  }

  useState(state: State): void {
    this.state = state;
    if (this.dialog.open) this.describe();
  }

  show(): void {
    if (!this.dialog.open) this.dialog.showModal();
    this.choose(this.job?.state === "running" ? this.job.what : this.what);
  }

  private choose(what: Made): void {
    this.what = what;
    for (const one of Object.keys(named)) byId(`export-${one}`).setAttribute("aria-checked", String(one === what));
    for (const field of this.dialog.querySelectorAll<HTMLElement>("[data-for]")) field.hidden = !field.dataset.for!.split(" ").includes(what);
    const stem = (this.welcome?.file ?? "script.json").replace(/\.json$/, "");
    const usual: Record<Made, string> = { video: `${stem}.mp4`, picture: `${stem}.png`, shapes: `${stem.replace(/[^/]*$/, "")}shapes` };
    byId<HTMLInputElement>("export-out").value = this.names[what] ?? usual[what];
    this.tell("");
    this.describe();
    this.write();
  }

  private describe(): void {
    const moved = Object.keys(this.state?.overrides ?? {}).length > 0;
    const texts: Record<Made, string> = {
      video: "The script as it is played, by the renderer of the program.",
      picture: `The moment at the playhead, ${(this.state?.t_s ?? 0).toFixed(2)} s, by the renderer of the program.`,
      shapes: "Blend shapes of the rig, made from the simulation, with a report of their accuracy. They take some minutes.",
    };
    const note = moved && this.what !== "shapes" ? " Sliders that are orange are not in the script: K makes keys of them." : "";
    const place = byId("export-about");
    if (place.textContent !== texts[this.what] + note) place.textContent = texts[this.what] + note;
  }

  private async start(replace: boolean): Promise<void> {
    const field = (id: string) => byId<HTMLInputElement | HTMLSelectElement>(`export-${id}`).value.trim();
    const size = byId<HTMLInputElement>("export-size");
    if (this.what !== "shapes" && !size.checkValidity()) return this.tell("The size is width x height in pixels, such as 640x480.", true);
    const common = { out: field("out"), quality: field("quality"), replace };
    const view = { ...(field("size") ? { size: field("size") } : {}), ...(field("camera") ? { camera: field("camera") } : {}) };
    const still_s = Math.round((this.state?.t_s ?? 0) * 1e6) / 1e6;
    const messages: Record<Made, Record<string, unknown>> = {
      video: { type: "render", ...common, ...view, sound: byId<HTMLInputElement>("export-sound").checked },
      picture: { type: "render", ...common, ...view, still_s },
      shapes: { type: "shapes", ...common, set: field("set") },
    };
    this.tell("");
    this.drop();
    byId("export-replace").hidden = true;
    const wrong = await this.actions.ask(messages[this.what]);
    if (!wrong) return;
    const exists = /consent to replace/.test(wrong);
    this.tell(exists ? `${field("out")} exists already.` : wrong, true);
    byId("export-replace").hidden = !exists;
  }

  useJob(job: Job): void {
    const ended = this.job?.state === "running" && job.state !== "running";
    this.job = job;
    this.write();
    if (job.state === "running") return;
    const place = `${this.welcome?.folder}/${job.out}`;
    if (job.state === "done") {
      const draft = job.script ? ` The script as it was rendered is beside it, as ${job.script}.` : "";
      this.tell(job.what === "shapes" ? `The shapes are in ${place}.` : `${place} is ready.${draft}`);
      if (ended && playable.test(job.out)) void this.actions.ask({ type: "result" }).then((wrong) => wrong && this.tell(wrong, true));
    } else if (job.state === "cancelled") this.tell("Cancelled. Nothing was written.");
    else this.tell(job.text.trim() || "It could not be made.", true);
  }

  /// The video or the picture itself.
  useFile(name: string, type: string, bytes: Uint8Array): void {
    this.drop();
    this.url = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
    const shown = type.startsWith("image/") ? h("img", { src: this.url, alt: `The rendered face, ${name}` }) : h("video", { src: this.url, controls: true, loop: true, "aria-label": name });
    byId("export-result").replaceChildren(shown);
  }

  private drop(): void {
    byId("export-result").replaceChildren();
    if (this.url) URL.revokeObjectURL(this.url);
    this.url = "";
  }

  private write(): void {
    const running = this.job?.state === "running";
    byId("export-running").hidden = !running;
    const start = byId<HTMLButtonElement>("export-start");
    start.textContent = named[this.what];
    start.disabled = running;
    byId<HTMLProgressElement>("export-progress").value = this.job?.fraction ?? 0;
    const percent = `${Math.round(100 * (this.job?.fraction ?? 0))} %`;
    byId("export-left").textContent = running ? `${this.job!.out}: ${percent} ${this.job!.text}` : "";
    byId("export").textContent = running ? percent : "Render";
    byId("export").classList.toggle("running", running);
  }

  private tell(text: string, bad = false): void {
    const place = byId("export-told");
    place.textContent = text;
    place.classList.toggle("bad", bad);
    byId("export-replace").hidden = true;
  }
}
