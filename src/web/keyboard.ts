// SPDX-License-Identifier: MIT
/// \file
/// The keys of the page, where no dialog is open and no text is typed.

export interface KeyActions {
  save(): void;
  undo(): void;
  redo(): void;
  selectAll(): void;
  playOrPause(): void;
  step(frames: number): void;
  toStart(): void;
  makeKey(): void;
  toggleSecondView(): void;
  mirror(): void;
  record(): void;
  toggleHand(): void;
  search(): void;
  help(): void;
  letGo(): void;
  camera(index: number): void;
}

/// Whether a key that is pressed there belongs to a text. K makes a key of a number that is being typed.
function typesIn(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLInputElement) || ["range", "checkbox"].includes(target.type)) return false;
  return !(target.type === "number" && key === "k" && target.closest(".row"));
}

export function useKeyboard(actions: KeyActions): void {
  const plain: Record<string, () => void> = {
    ",": () => actions.step(-1),
    ".": () => actions.step(1),
    home: actions.toStart,
    v: actions.toggleSecondView,
    m: actions.mirror,
    r: actions.record,
    h: actions.toggleHand,
    "/": actions.search,
    "?": actions.help,
    escape: actions.letGo,
  };
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    const command = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    const typing = typesIn(event.target, key);
    if (command && key === "s") actions.save();
    else if (command && (key === "y" || (key === "z" && event.shiftKey))) actions.redo();
    else if (command && key === "z" && !typing) actions.undo();
    else if (command && key === "a" && !typing) actions.selectAll();
    else if (command || typing || event.target instanceof HTMLSelectElement) return;
    else if (key === " " && !(event.target instanceof HTMLButtonElement)) actions.playOrPause();
    else if (key === "k") {
      // What is typed counts when its field is left.
      const field = event.target instanceof HTMLInputElement && event.target.type === "number" ? event.target : null;
      field?.blur();
      actions.makeKey();
      field?.focus();
    } else if (plain[key]) plain[key]();
    else if (/^[1-8]$/.test(key)) actions.camera(Number(key) - 1);
    else return;
    event.preventDefault();
  });
}
