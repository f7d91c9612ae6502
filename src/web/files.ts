// SPDX-License-Identifier: MIT
/// \file
/// Opens and saves scripts: the dialogs, and a copy for when the engine is gone.

import { byId, h } from "./dom.js";
import { hosted } from "./engine_choice.js";
import type { Script } from "./protocol.js";

export interface FileActions {
  send(message: Record<string, unknown>): void;
  /// Returns what is wrong with the message, or null.
  ask(message: Record<string, unknown>): Promise<string | null>;
  file(): string | null; ///< of the script that is open
}

export class Files {
  private readonly dialog = byId<HTMLDialogElement>("save-dialog");
  private readonly pictures = new Map<string, string>(); ///< by what is opened
  private readonly places = new Map<string, HTMLImageElement>();

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
    this.dialog.returnValue = ""; // of the last time
    this.dialog.showModal();
    name.select();
  }

  showList(scripts: string[], samples: string[]): void {
    const dialog = byId<HTMLDialogElement>("open-dialog");
    const entry = (text: string, what: Record<string, string>) => {
      const key = JSON.stringify(what);
      const picture = h("img", { alt: "", class: "thumbnail" });
      this.places.set(key, picture);
      this.showPicture(key);
      if (!hosted) this.actions.send({ type: "thumbnail", ...what });
      return h("li", {}, h("button", { onclick: () => (dialog.close(), this.actions.send({ type: "open", ...what })) }, ...(hosted ? [] : [picture]), text));
    };
    this.places.clear();
    const list = (id: string, entries: HTMLElement[]) =>
      byId(id).replaceChildren(...(entries.length > 0 ? entries : [h("li", { class: "hint" }, "none")]));
    list("scripts", scripts.map((path) => entry(path, { path })));
    list("samples", samples.map((sample) => entry(sample.replaceAll("_", " "), { sample })));
    if (!dialog.open) dialog.showModal();
  }

  /// The engine has made the picture of a script.
  useThumbnail(message: Record<string, string>): void {
    const key = JSON.stringify("sample" in message ? { sample: message.sample } : { path: message.path });
    this.pictures.set(key, message.png);
    this.showPicture(key);
  }

  private showPicture(key: string): void {
    const [place, png] = [this.places.get(key), this.pictures.get(key)];
    if (place && png) place.src = `data:image/png;base64,${png}`;
  }
}

/// A copy without the engine: the browser saves it where it saves files.
export function download(script: Script): void {
  const text = JSON.stringify(script, null, 2) + "\n";
  const link = h("a", { href: URL.createObjectURL(new Blob([text], { type: "application/json" })), download: "script.json" });
  link.click();
}
