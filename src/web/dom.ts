// SPDX-License-Identifier: MIT
/// \file
/// Makes elements of the page. Text is always text: names from files are never read as HTML.

type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | ((event: any) => void) | undefined>;

/// h("button", {class: "plain", onclick: f}, "Open"). An attribute that is false or undefined is left out.
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

export function byId<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found as T;
}

/// A number for a field: as few digits as tell it apart at the given step.
export function shown(value: number, digits = 2): string {
  return Number(value.toFixed(digits)).toString();
}

export function clamp(value: number, min: number, max: number): number {
  return Math.min(max, Math.max(min, value));
}
