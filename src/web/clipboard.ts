// SPDX-License-Identifier: MIT
/// \file
/// Keys go through the clipboard of the system as text, so that another page can take them.

export interface ClipboardActions {
  copy(): string | null; ///< the selected keys, or null
  remove(): void;
  paste(text: string, mirrored: boolean): boolean; ///< whether the text was keys
}

const inField = (event: ClipboardEvent) => event.target instanceof HTMLInputElement && !["range", "checkbox"].includes(event.target.type);

export function useClipboard(actions: ClipboardActions): void {
  let mirrored = false;
  document.addEventListener("keydown", (event) => (mirrored = event.shiftKey), true);
  for (const type of ["copy", "cut"] as const)
    document.addEventListener(type, (event) => {
      const text = inField(event) || !getSelection()?.isCollapsed ? null : actions.copy();
      if (text === null) return;
      event.clipboardData?.setData("text/plain", text);
      event.preventDefault();
      if (type === "cut") actions.remove();
    });
  document.addEventListener("paste", (event) => {
    if (inField(event) || document.querySelector("dialog[open]")) return;
    if (actions.paste(event.clipboardData?.getData("text/plain") ?? "", mirrored)) event.preventDefault();
  });
}
