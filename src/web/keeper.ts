// SPDX-License-Identifier: MIT
/// \file
/// Loses no edit: keeps drafts of what is not saved, takes edits while the engine is gone, and gives both back to the engine.

import { byId } from "./dom.js";
import { Drafts } from "./drafts.js";
import type { Draft } from "./drafts.js";
import type { Edit } from "./key_edits.js";
import { appliedEdits, editsBetween, straightSamples } from "./script_edits.js";
import type { DocumentMessage, Welcome } from "./protocol.js";

export interface KeeperActions {
  edit(edits: Edit[]): void;
  show(document: DocumentMessage): void;
  say(text: string, good?: boolean): void;
}

const between_ms = 150; ///< two writes of a draft

export class Keeper {
  private readonly drafts = new Drafts();
  private place = "";
  private steers = false;
  private first = true; ///< the next document is the first of its connection
  private document: DocumentMessage | null = null;
  private before: DocumentMessage[] = []; ///< what undo goes back to while the engine is gone
  private gesture = ""; ///< of the last edit without the engine
  private offline = false;
  private waiting = 0;
  private found: Draft | null = null;

  constructor(private readonly actions: KeeperActions) {
    byId("restore").addEventListener("click", () => this.restore());
    byId("forget").addEventListener("click", () => void this.forget());
  }

  useWelcome(welcome: Welcome): void {
    const place = `${welcome.folder}/${welcome.file ?? `new script for ${welcome.rig}`}`;
    // Another script is open now: edits of the old one do not fit it, and stay in their draft.
    if (place !== this.place) this.before = [];
    this.place = place;
    this.steers = welcome.steers;
    this.first = true;
  }

  /// A script that was saved under a name has its drafts there.
  useName(folder: string, file: string): void {
    this.place = `${folder}/${file}`;
  }

  useDocument(message: DocumentMessage): void {
    const mine = this.offline && this.before.length > 0 ? this.document : null;
    this.document = message;
    this.offline = false;
    this.before = [];
    if (this.first) {
      this.first = false;
      const edits = mine && this.steers ? editsBetween(message.script, mine.script) : [];
      if (edits.length > 0) {
        this.actions.edit(edits);
        this.actions.say("The engine is back, and has your edits.", true);
        return;
      }
      void this.offer();
    }
    this.keep();
  }

  lost(): void {
    this.offline = true;
  }

  /// Makes edits without the engine, of which only the shape of curves is missing. What cannot be done is said.
  editAlone(edits: Edit[], gesture = ""): void {
    const now = this.document;
    if (!now) return;
    try {
      const script = appliedEdits(now.script, edits);
      if (!gesture || gesture !== this.gesture) this.before.push(now);
      this.gesture = gesture;
      const curves = { ...now.curves };
      for (const [channel, track] of Object.entries(script.channels ?? {}))
        if (track.keys !== now.script.channels?.[channel]?.keys) curves[channel] = straightSamples(track, script.duration_s, 256);
      this.document = { ...now, script, curves, duration_s: script.duration_s, dirty: true, undo: true, redo: false };
      this.actions.show(this.document);
      this.keep();
    } catch (error) {
      this.actions.say(String((error as Error).message));
    }
  }

  undoAlone(): void {
    const last = this.before.pop();
    if (!last) return;
    this.gesture = "";
    this.document = { ...last, undo: this.before.length > 0, redo: false, dirty: last.dirty };
    this.actions.show(this.document);
    this.keep();
  }

  private keep(): void {
    if (this.waiting) return;
    const write = () => {
      const now = this.document!;
      void (now.dirty ? this.drafts.keep(this.place, now.script) : this.drafts.drop());
    };
    write();
    this.waiting = window.setTimeout(() => {
      this.waiting = 0;
      write();
    }, between_ms);
  }

  // Drafts that pages have left

  private async offer(): Promise<void> {
    const place = this.place;
    for (const draft of await this.drafts.left(place)) {
      if (place !== this.place) return;
      // The engine lived on, or the script has been saved since.
      if (editsBetween(this.document!.script, draft.script).length === 0) await this.drafts.forget(draft.page);
      else if (this.steers) return this.ask(draft);
    }
    this.ask(null);
  }

  private ask(draft: Draft | null): void {
    this.found = draft;
    byId("found").hidden = draft === null;
    if (draft) byId("found-when").textContent = new Date(draft.at).toLocaleString("en-GB", { dateStyle: "medium", timeStyle: "short" });
  }

  private restore(): void {
    const draft = this.found;
    if (!draft || !this.document) return;
    this.actions.edit(editsBetween(this.document.script, draft.script));
    this.actions.say("Restored. Undo takes it back.", true);
    void this.forget();
  }

  private async forget(): Promise<void> {
    const draft = this.found;
    this.ask(null);
    if (draft) await this.drafts.forget(draft.page);
    await this.offer();
  }
}
