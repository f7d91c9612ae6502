// SPDX-License-Identifier: MIT
/// \file
/// Which engine a page has: the page of `risorius view` is connected with it, a hosted page computes the face itself.

import { RemoteEngine } from "./engine.js";
import type { Engine, Listener } from "./engine.js";
import { LocalEngine } from "./local_engine.js";

/// Whether this page has no program behind it: its <html> has data-engine="local".
export const hosted = document.documentElement.dataset.engine === "local";

/// `word` is what stands behind the # of the address: the token of `risorius view`, or the sample that a hosted page opens.
export function makeEngine(word: string, listener: Listener): Engine {
  return hosted ? new LocalEngine(word, listener) : new RemoteEngine(word, listener);
}
