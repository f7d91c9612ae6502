// SPDX-License-Identifier: MIT
/// \file
/// What the colours on the stage mean, in a corner of it.

import { byId, h } from "./dom.js";
import { activationColour } from "./head.js";
import type { Sight } from "./head.js";
import type { Vec } from "./protocol.js";

const width_px = 170;

export function showLegend(sight: Sight, strainColours: Vec[]): void {
  const legend = byId("legend");
  legend.hidden = sight !== "strain" && sight !== "muscles";
  if (legend.hidden) return;
  const canvas = h("canvas", { width: width_px, height: 10, "aria-hidden": true });
  const context = canvas.getContext("2d")!;
  for (let x = 0; x < width_px; x++) {
    const part = x / (width_px - 1);
    const c = strainColours[Math.round(255 * part)] ?? [0, 0, 0];
    context.fillStyle =
      sight === "muscles" ? `#${activationColour(part).getHexString()}` : `rgb(${c.map((v) => Math.round(255 * v)).join(",")})`;
    context.fillRect(x, 0, 1, 10);
  }
  const ends = sight === "muscles" ? ["0", "1"] : ["−0.4", "0.4"];
  legend.replaceChildren(
    sight === "muscles" ? "activation" : "principal strain of the skin",
    canvas,
    h("div", {}, h("span", {}, ends[0]), h("span", {}, ends[1])),
    ...(sight === "muscles" ? [h("p", {}, "Point at a muscle: its name, force and length. A click opens its row.")] : []),
  );
}
