// SPDX-License-Identifier: MIT
/// \file
/// What computes the face: a page sends it messages and listens to it. RemoteEngine is the connection to `risorius view`, which comes
/// back by itself, with a growing wait; local_engine.ts has the one that runs in the page.

import { decode } from "./protocol.js";
import type { Binary, DocumentMessage, State, Welcome } from "./protocol.js";

export interface Listener {
  welcome(message: Welcome): void;
  document(message: DocumentMessage): void;
  state(message: State): void;
  binary(message: Binary): void;
  other(message: Record<string, any>): void;
  connected(yes: boolean): void;
}

const longestWait_ms = 8000;

export abstract class Engine {
  private next = 1;
  private asked = new Map<number, (error: string | null) => void>();

  constructor(protected readonly listener: Listener) {}

  abstract get open(): boolean;
  abstract send(message: Record<string, unknown>): void;
  /// Ends the connection; it comes back after a while, as after a fault.
  abstract cut(wait_ms: number): void;

  /// Sends a picture of a camera.
  abstract sendBytes(bytes: ArrayBuffer): void;

  /// Sends a message with a number, and tells what is wrong with it, if anything.
  ask(message: Record<string, unknown>): Promise<string | null> {
    const id = this.next++;
    return new Promise((resolve) => {
      this.asked.set(id, resolve);
      this.send({ ...message, id });
      // An answer is sent only for what cannot be done.
      setTimeout(() => {
        if (this.asked.delete(id)) resolve(null);
      }, 1500);
    });
  }

  /// The page has drawn a pose and is ready for another.
  credit(): void {
    this.send({ type: "credit" });
  }

  protected take(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.listener.binary(decode(data));
      return;
    }
    const message = JSON.parse(data);
    switch (message.type) {
      case "welcome":
        this.listener.connected(true);
        this.listener.welcome(message);
        break;
      case "document":
        this.listener.document(message);
        break;
      case "state":
        this.listener.state(message);
        break;
      case "error": {
        const answer = this.asked.get(message.id);
        this.asked.delete(message.id);
        if (answer) answer(message.message);
        this.listener.other(message);
        break;
      }
      default:
        this.listener.other(message);
    }
  }
}

export class RemoteEngine extends Engine {
  private socket: WebSocket | null = null;
  private wait_ms = 250;

  constructor(
    private readonly token: string,
    listener: Listener,
  ) {
    super(listener);
    this.connect();
  }

  get open(): boolean {
    return this.socket !== null && this.socket.readyState === WebSocket.OPEN;
  }

  send(message: Record<string, unknown>): void {
    if (this.open) this.socket!.send(JSON.stringify(message));
  }

  sendBytes(bytes: ArrayBuffer): void {
    if (this.open) this.socket!.send(bytes);
  }

  cut(wait_ms: number): void {
    this.wait_ms = wait_ms;
    this.socket?.close();
  }

  private connect(): void {
    const socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(JSON.stringify({ type: "hello", token: this.token, protocol: 1 }));
    socket.onmessage = (event) => {
      this.wait_ms = 250;
      this.take(event.data);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.listener.connected(false);
      setTimeout(() => this.connect(), this.wait_ms);
      this.wait_ms = Math.min(2 * this.wait_ms, longestWait_ms);
    };
    this.socket = socket;
  }
}
