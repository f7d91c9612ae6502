// SPDX-License-Identifier: MIT
/// \file
/// What differs on a hosted page: it says what it is while it loads, and what needs the program on a person's own computer.

import { byId, h } from "./dom.js";
import { hosted } from "./engine_choice.js";

/// A dialog that is made when it is asked for.
function dialog(id: string, title: string, ...text: (string | HTMLElement)[]): HTMLDialogElement {
  const found = document.getElementById(id);
  if (found) return found as HTMLDialogElement;
  const made = h(
    "dialog",
    { id, class: "about", "aria-labelledby": `${id}-title` },
    h("h2", { id: `${id}-title` }, title),
    ...text.map((one) => (typeof one === "string" ? h("p", {}, one) : one)),
    h("form", { method: "dialog" }, h("button", { class: "primary" }, "Close")),
  );
  document.body.append(made);
  return made;
}

const showAbout = () =>
  dialog(
    "about",
    "About this page",
    "This page simulates the face itself: it is Risorius as WebAssembly. Nothing that you do leaves your computer.",
    "You can play and edit scripts, move channels and pull the skin. Save writes the script to your downloads; the program reads it.",
    "A rig of your own mesh, voices, videos and pictures need the program on your own computer: risorius view shows the same page with them.",
    h("p", {}, h("a", { href: "licences/README.txt" }, "Licences of what is inside")),
  ).showModal();

const showNeedsProgram = () =>
  dialog(
    "needs-program",
    "This needs the program",
    "Rigs of your own mesh, videos, pictures, blend shapes and a camera that drives the face need a program on your computer.",
    "Install Risorius and run risorius view. It shows this page, with everything.",
  ).showModal();

/// Makes the page that of an engine without a program.
function use(): void {
  byId("stage").append(h("div", { id: "loading", role: "status" }, h("p", {}, "The face is coming: 1.5 MB."), h("p", { id: "loading-now", class: "hint" })));
  const told = byId("loading-now");
  new MutationObserver(() => (told.textContent = byId("connection").textContent)).observe(byId("connection"), { childList: true, characterData: true, subtree: true });
  new MutationObserver((_, observer) => {
    byId("loading").remove();
    observer.disconnect();
  }).observe(document.body, { attributeFilter: ["data-step"] });

  byId("help").before(h("button", { id: "about-page", class: "quiet", onclick: showAbout }, "About"));
  // Before the listeners of the page, which would ask the engine
  for (const button of ["new-head", "export", "camera-open"])
    byId(button).addEventListener(
      "click",
      (event) => {
        event.stopImmediatePropagation();
        showNeedsProgram();
      },
      { capture: true },
    );
  const [own] = document.querySelectorAll("#open-dialog h3");
  own.textContent = "Of yours";
  byId("lost").querySelector("p")!.textContent = "The engine has ended. You can still edit keys and events: this browser keeps them. Load the page again to go on.";
}
if (hosted) use();
