// SPDX-License-Identifier: MIT
/// \file
/// Files that are dropped onto the page go into the folder of the project, in pieces: a script or a rig is opened, of a mesh a rig can be
/// made. A hosted page opens scripts only.

import { byId } from "./dom.js";
import { hosted } from "./engine_choice.js";

export interface DropActions {
  ask(message: Record<string, unknown>): Promise<string | null>;
  send(message: Record<string, unknown>): void;
  bytes(piece: ArrayBuffer): void;
  tell(text: string): void;
}

const piece_bytes = 500_000;
const header_bytes = 8;
const pieceOfFile = 2; ///< the kind of its messages

/// What belongs to a mesh goes before it, and what is opened last.
function inOrder(files: File[]): File[] {
  const rank = (file: File) => (/\.json$/i.test(file.name) ? 2 : /\.(mtl|png|jpe?g|bin)$/i.test(file.name) ? 0 : 1);
  return files.sort((a, b) => rank(a) - rank(b));
}

export function useDrop(actions: DropActions): void {
  const place = byId("drop");
  let inside = 0; // elements that the pointer has entered
  const carriesFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  const show = (yes: boolean) => (place.hidden = !yes);
  document.addEventListener("dragenter", (event) => {
    if (!carriesFiles(event)) return;
    inside++;
    show(true);
  });
  document.addEventListener("dragleave", (event) => {
    if (carriesFiles(event) && --inside <= 0) show(false);
  });
  document.addEventListener("dragover", (event) => carriesFiles(event) && event.preventDefault());
  document.addEventListener("drop", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    inside = 0;
    show(false);
    void take(inOrder([...event.dataTransfer!.files]));
  });

  async function take(files: File[]): Promise<void> {
    for (const file of files) {
      if (hosted) actions.send({ type: "open", name: file.name, text: await file.text() });
      else if (!(await send(file, false))) return;
    }
  }

  /// False: it was refused.
  async function send(file: File, replace: boolean): Promise<boolean> {
    const wrong = await actions.ask({ type: "drop", name: file.name, bytes: file.size, replace });
    if (wrong && /consent to replace/.test(wrong) && !replace) return confirm(`${file.name} exists already. Replace it?`) ? send(file, true) : false;
    if (wrong) {
      actions.tell(wrong);
      return false;
    }
    const whole = await file.arrayBuffer();
    for (let at = 0; at < whole.byteLength; at += piece_bytes) {
      const part = new Uint8Array(whole, at, Math.min(piece_bytes, whole.byteLength - at));
      const piece = new Uint8Array(header_bytes + part.length);
      new DataView(piece.buffer).setUint32(0, pieceOfFile, true);
      piece.set(part, header_bytes);
      actions.bytes(piece.buffer);
      // The server takes so many messages a second.
      await new Promise((next) => setTimeout(next, 20));
    }
    return true;
  }
}
