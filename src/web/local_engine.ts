// SPDX-License-Identifier: MIT
/// \file
/// The engine of a hosted page: a worker with the program as WebAssembly. It speaks as `risorius view` does. What needs a program on the
/// computer is refused, with the reason.

import { h } from "./dom.js";
import { Engine } from "./engine.js";
import type { Listener } from "./engine.js";

/// The entry of the list of scripts that asks for a file.
export const fromThisComputer = "a file of this computer…";
const largestScript_bytes = 1_000_000;

/// What the worker tells besides the messages of the engine.
export interface WorkerNote {
  note: "loading" | "samples" | "saved" | "failed";
  text: string;
  names?: string[];
  script?: string;
}

/// Why a message cannot be answered here.
function needsProgram(type: string): string {
  const why: Record<string, string> = {
    say: "A voice is a program on your computer",
    meshes: "A rig of your own mesh is made by a program on your computer",
    fit: "A rig of your own mesh is made by a program on your computer",
    render: "Videos are made by a program on your computer",
    still: "Pictures are made by a program on your computer",
  };
  return `${why[type] ?? "This is done by a program on your computer"}: install Risorius and run risorius view.`;
}

const answered = new Set(
  "edit undo redo override release key play pause seek pull pull_to pull_end sights select credit".split(" "),
);

export class LocalEngine extends Engine {
  private worker: Worker | null = null;
  private samples: string[] = [];
  private running = false;

  constructor(
    private readonly first: string,
    listener: Listener,
  ) {
    super(listener);
    this.start();
  }

  get open(): boolean {
    return this.running;
  }

  send(message: Record<string, any>): void {
    if (answered.has(message.type)) this.worker?.postMessage(message);
    else if (message.type === "files") this.reply({ type: "files", scripts: [fromThisComputer], samples: this.samples });
    else if (message.type === "open" && message.path === fromThisComputer) this.askForFile();
    else if (message.type === "open" || message.type === "save") this.worker?.postMessage(message);
    else this.reply({ type: "error", id: message.id ?? null, message: needsProgram(String(message.type)) });
  }

  /// Cameras need the program: their button says so.
  sendBytes(): void {}

  cut(wait_ms: number): void {
    this.worker?.terminate();
    this.worker = null;
    this.running = false;
    this.listener.connected(false);
    setTimeout(() => this.start(), wait_ms);
  }

  /// As an engine answers: later.
  private reply(message: Record<string, unknown>): void {
    setTimeout(() => this.take(JSON.stringify(message)));
  }

  private start(): void {
    const worker = new Worker("engine_worker.js");
    worker.onmessage = ({ data }: MessageEvent<string | ArrayBuffer | WorkerNote>) => {
      if (worker !== this.worker) return;
      if (typeof data === "object" && "note" in data) this.takeNote(data);
      else {
        this.running = true;
        this.take(data);
      }
    };
    worker.onerror = (event) => this.fail(event.message);
    worker.postMessage({ type: "open", sample: this.first, quality: new URLSearchParams(location.search).get("quality") });
    this.worker = worker;
  }

  private takeNote(note: WorkerNote): void {
    if (note.note === "loading") document.getElementById("connection")!.textContent = note.text;
    if (note.note === "samples") this.samples = note.names ?? [];
    if (note.note === "failed") this.fail(note.text);
    if (note.note === "saved") this.download(note.text, note.script ?? "");
  }

  /// The engine is gone: what has been edited stays in the page.
  private fail(reason: string): void {
    this.worker?.terminate();
    this.worker = null;
    this.running = false;
    this.listener.connected(false);
    document.getElementById("connection")!.textContent = "no engine";
    this.reply({ type: "error", id: null, message: `The engine has ended: ${reason}. Load the page again.` });
  }

  private download(name: string, script: string): void {
    const url = URL.createObjectURL(new Blob([script], { type: "application/json" }));
    h("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  private askForFile(): void {
    const input = h("input", { type: "file", accept: ".json,application/json" });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (!file) return;
      if (file.size > largestScript_bytes)
        this.reply({ type: "error", id: null, message: `${file.name}: expected a script of at most 1 MB, found ${(file.size / 1e6).toFixed(1)} MB` });
      else void file.text().then((text) => this.worker?.postMessage({ type: "open", name: file.name, text }));
    });
    input.click();
  }
}
