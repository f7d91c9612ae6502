// SPDX-License-Identifier: MIT
/// \file
/// What has not been saved, kept in the browser: when the engine and the page are gone, the next page finds it here. Each page keeps its
/// own draft; a draft belongs to nobody when the page that made it is gone.

import type { Script } from "./protocol.js";

export interface Draft {
  page: string; ///< a number of the page that made it
  place: string; ///< folder and file of the script
  script: Script;
  at: string; ///< when, ISO 8601
}

const database = "risorius studio";
const store = "drafts";
const mostDrafts = 20;

function asked<T>(request: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

export class Drafts {
  private readonly page = crypto.randomUUID();
  private readonly opened: Promise<IDBDatabase | null>;

  constructor() {
    const request = indexedDB.open(database, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(store, { keyPath: "page" });
    // A browser that keeps nothing, as in a private window, is no reason not to work.
    this.opened = asked(request).catch(() => null);
    // The lock is held as long as this page lives.
    void navigator.locks.request(`${database} ${this.page}`, () => new Promise(() => {}));
  }

  private async use<T>(mode: IDBTransactionMode, does: (drafts: IDBObjectStore) => IDBRequest<T>): Promise<T | null> {
    const opened = await this.opened;
    if (!opened) return null;
    return asked(does(opened.transaction(store, mode, { durability: "strict" }).objectStore(store))).catch(() => null);
  }

  async keep(place: string, script: Script): Promise<void> {
    await this.use("readwrite", (drafts) => drafts.put({ page: this.page, place, script, at: new Date().toISOString() }));
  }

  /// Everything is saved: this page needs no draft.
  async drop(): Promise<void> {
    await this.forget(this.page);
  }

  async forget(page: string): Promise<void> {
    await this.use("readwrite", (drafts) => drafts.delete(page));
  }

  /// The drafts of a script that pages have left, the latest first. Old ones beyond a number are thrown away.
  async left(place: string): Promise<Draft[]> {
    const all = ((await this.use("readonly", (drafts) => drafts.getAll())) ?? []) as Draft[];
    const held = new Set((await navigator.locks.query()).held?.map((lock) => lock.name));
    const left = all.filter((draft) => !held.has(`${database} ${draft.page}`)).sort((a, b) => (a.at < b.at ? 1 : -1));
    for (const draft of left.splice(mostDrafts)) await this.forget(draft.page);
    return left.filter((draft) => draft.place === place);
  }
}
