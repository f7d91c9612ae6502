// SPDX-License-Identifier: MIT
/// \file
/// Opens and saves scripts: the dialogs, and a copy for when the engine is gone.

import { byId, h } from "./dom.js";
import type { Script } from "./protocol.js";

export interface FileActions {
  send(message: Record<string, unknown>): void;
  /// Returns what is wrong with the message, or null.
  ask(message: Record<string, unknown>): Promise<string | null>;
  file(): string | null; ///< of the script that is open
}

export class Files {
  private readonly dialog = byId<HTMLDialogElement>("save-dialog");

  constructor(private readonly actions: FileActions) {
    this.dialog.addEventListener("close", () => {
      if (this.dialog.returnValue !== "save") return;
      const path = byId<HTMLInputElement>("save-name").value;
      this.actions.send({ type: "save", path, overwrite: path === this.actions.file() });
    });
  }

  save(): void {
    if (!this.actions.file()) return this.askName();
    void this.actions.ask({ type: "save" }).then((error) => {
      if (error && /changed meanwhile/.test(error)) this.askName();
    });
  }

  private askName(): void {
    const name = byId<HTMLInputElement>("save-name");
    name.value = this.actions.file() ?? "script.json";
    this.dialog.showModal();
    name.select();
  }

  showList(scripts: string[], samples: string[]): void {
    const dialog = byId<HTMLDialogElement>("open-dialog");
    const entry = (text: string, message: Record<string, unknown>) =>
      h("li", {}, h("button", { onclick: () => (dialog.close(), this.actions.send(message)) }, text));
    const list = (id: string, entries: HTMLElement[]) =>
      byId(id).replaceChildren(...(entries.length > 0 ? entries : [h("li", { class: "hint" }, "none")]));
    list("scripts", scripts.map((path) => entry(path, { type: "open", path })));
    list("samples", samples.map((sample) => entry(sample.replaceAll("_", " "), { type: "open", sample })));
    if (!dialog.open) dialog.showModal();
  }
}

/// A copy without the engine: the browser saves it where it saves files.
export function download(script: Script): void {
  const text = JSON.stringify(script, null, 2) + "\n";
  const link = h("a", { href: URL.createObjectURL(new Blob([text], { type: "application/json" })), download: "script.json" });
  link.click();
}
