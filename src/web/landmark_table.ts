// SPDX-License-Identifier: MIT
/// \file
/// The landmarks of a head in words, from the table of the toolkit (rigs/standard/landmarks.json), which the build puts into the page.

import table from "../../rigs/standard/landmarks.json";

import type { Vec } from "./protocol.js";

export interface Landmark {
  id: string;
  name: string;
  side: string; ///< "L", "R" or "M"
  region: string;
  xyz_mm: Vec; ///< on the standard head
  core: boolean;
  definition: string;
}

export const landmarkTable = table.landmarks as unknown as Landmark[];
const byName = new Map(landmarkTable.map((one) => [one.id, one]));

export function landmarkNamed(id: string): Landmark | undefined {
  return byName.get(id);
}

/// "cheilion, left"
export function landmarkLabel(id: string): string {
  const one = byName.get(id);
  if (!one) return id;
  return one.name.replaceAll("_", " ") + (one.side === "L" ? ", left" : one.side === "R" ? ", right" : "");
}
