// SPDX-License-Identifier: MIT
/// \file
/// What the fit has to be told about a mesh: the role of groups whose names do not say it, joined lips, a scan to be mended.

import { byId, h } from "./dom.js";
import type { MeshFrame } from "./protocol.js";

/// What is kept in the browser, for each mesh.
interface Kept {
  role: Record<string, string>; ///< of groups to which the person has given one
  cutLips: boolean;
  repair: boolean;
}

/// "eye_l" -> "left eye"
function inWords(role: string): string {
  const side = role.match(/^(.*)_([lr])$/);
  if (side) return `${inWords(side[1])}, ${side[2] === "l" ? "left" : "right"}`;
  const level = role.match(/^(.*)_(upper|lower)$/);
  if (level) return `${level[2]} ${level[1]}`;
  return role === "gums_tongue" ? "gums and tongue" : role.replace(/_/g, " ");
}

export interface PartsActions {
  changed(): void; ///< of the roles
  point(group: number | null): void;
}

export class NewHeadParts {
  private mesh: MeshFrame | null = null;
  private kept: Kept = { role: {}, cutLips: false, repair: false };
  private name = "";
  private readonly list = byId("newhead-groups");
  private readonly cutLips = byId<HTMLInputElement>("newhead-cut-lips");
  private readonly repair = byId<HTMLInputElement>("newhead-repair");

  constructor(private readonly actions: PartsActions) {
    const keep = () => {
      this.kept.cutLips = this.cutLips.checked;
      this.kept.repair = this.repair.checked;
      this.save();
    };
    this.cutLips.addEventListener("change", keep);
    this.repair.addEventListener("change", keep);
  }

  /// `name`: of what is kept in the browser.
  use(mesh: MeshFrame, name: string): void {
    this.mesh = mesh;
    this.name = name;
    this.kept = { role: {}, cutLips: false, repair: false, ...(JSON.parse(localStorage.getItem(name) ?? "{}") as Partial<Kept>) };
    this.cutLips.checked = this.kept.cutLips;
    this.repair.checked = this.kept.repair;
    const option = (value: string, text: string) => h("option", { value }, text);
    this.list.replaceChildren(
      ...mesh.groups.map((group, index) => {
        const select = h("select", { "aria-label": `What ${group.name} is` }, option("", group.role ? `${inWords(group.role)} (name)` : "not known: hidden"), ...mesh.roles.map((role) => option(role, inWords(role))));
        select.value = this.kept.role[group.name] ?? "";
        select.addEventListener("change", () => {
          if (select.value) this.kept.role[group.name] = select.value;
          else delete this.kept.role[group.name];
          this.save();
          this.write();
          this.actions.changed();
        });
        const show = () => this.actions.point(index);
        const hide = () => this.actions.point(null);
        const row = h("label", { class: "mesh-part", onpointerenter: show, onpointerleave: hide, onfocusin: show, onfocusout: hide }, h("span", { title: group.name }, group.name || "without a name"), select);
        return row;
      }),
    );
    this.write();
  }

  /// Of each group of the mesh.
  get roles(): string[] {
    return (this.mesh?.groups ?? []).map((group) => this.kept.role[group.name] ?? (group.role || "hidden"));
  }

  /// What a message needs.
  get parts(): Record<string, string[]> {
    const parts: Record<string, string[]> = {};
    for (const group of this.mesh?.groups ?? []) {
      const role = this.kept.role[group.name];
      if (role) (parts[role] ??= []).push(group.name);
    }
    return parts;
  }

  get forFit(): Record<string, unknown> {
    return { parts: this.parts, cut_lips: this.kept.cutLips, repair: this.kept.repair };
  }

  /// Opens the list, with the reason why.
  open(): void {
    byId<HTMLDetailsElement>("newhead-parts").open = true;
    byId("newhead-parts").scrollIntoView({ block: "nearest" });
  }

  private save(): void {
    localStorage.setItem(this.name, JSON.stringify(this.kept));
  }

  private write(): void {
    const unknown = (this.mesh?.groups ?? []).filter((group, index) => !group.role && this.roles[index] === "hidden" && !this.kept.role[group.name]).length;
    byId("newhead-parts-count").textContent = !this.mesh ? "" : unknown > 0 ? `: ${unknown} of ${this.mesh.groups.length} groups not known` : `: ${this.mesh.groups.length} ${this.mesh.groups.length === 1 ? "group" : "groups"}`;
    byId("newhead-skin-missing").hidden = !this.mesh || this.roles.includes("skin");
  }
}
