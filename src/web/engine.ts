// SPDX-License-Identifier: MIT
/// \file
/// The connection to `risorius view`. It comes back by itself, with a growing wait.

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

export class RemoteEngine {
  private socket: WebSocket | null = null;
  private wait_ms = 250;
  private next = 1;
  private asked = new Map<number, (error: string | null) => void>();

  constructor(
    private readonly token: string,
    private readonly listener: Listener,
  ) {
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

  /// Ends the connection; it comes back after a while, as after a fault.
  cut(wait_ms: number): void {
    this.wait_ms = wait_ms;
    this.socket?.close();
  }

  /// The page has drawn a pose and is ready for another.
  credit(): void {
    this.send({ type: "credit" });
  }

  private connect(): void {
    const socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => socket.send(JSON.stringify({ type: "hello", token: this.token, protocol: 1 }));
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.listener.connected(false);
      setTimeout(() => this.connect(), this.wait_ms);
      this.wait_ms = Math.min(2 * this.wait_ms, longestWait_ms);
    };
    this.socket = socket;
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.listener.binary(decode(data));
      return;
    }
    const message = JSON.parse(data);
    switch (message.type) {
      case "welcome":
        this.wait_ms = 250;
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
