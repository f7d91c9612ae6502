// SPDX-License-Identifier: MIT
/// \file
/// Records what is done by hand while the script plays: channels and pulls. The engine makes keys of it; here is the button.

import { byId } from "./dom.js";
import { sameJson } from "./script_edits.js";
import type { Script, State } from "./protocol.js";

export interface RecordActions {
  send(message: Record<string, unknown>): void;
  play(): void;
  script(): Script | null;
  say(text: string): void;
}

export class Recorder {
  private readonly button = byId<HTMLButtonElement>("record-take");
  private on = false;
  private before: Script | null = null;

  constructor(private readonly actions: RecordActions) {
    this.button.addEventListener("click", () => this.toggle());
  }

  /// Begins a take at the playhead, or ends it.
  toggle(): void {
    if (this.on) return this.actions.send({ type: "pause" });
    this.actions.send({ type: "record", on: true });
    this.actions.play();
  }

  useState(state: State): void {
    if (state.recording === this.on) return;
    this.on = state.recording;
    this.button.setAttribute("aria-pressed", String(this.on));
    this.button.setAttribute("aria-label", this.on ? "End the recording" : "Record");
    const now = this.actions.script();
    if (this.on) this.before = now;
    else this.actions.say(this.told(this.before, now));
  }

  private told(before: Script | null, now: Script | null): string {
    const channels = Object.keys(now?.channels ?? {}).filter((name) => !sameJson(now!.channels![name], before?.channels?.[name]));
    const pulls = (now?.pulls?.length ?? 0) - (before?.pulls?.length ?? 0);
    const parts = [...channels, ...(pulls > 0 ? [pulls === 1 ? "one pull" : `${pulls} pulls`] : [])];
    return parts.length > 0 ? `Recorded ${parts.join(", ")}. Undo takes it back.` : "Nothing was moved, so nothing was recorded.";
  }
}
