// SPDX-License-Identifier: MIT
// Takes what needs OpenGL or seconds out of `risorius view`, for pages without a program: the pictures of the parts and the bones of a
// rig. Each becomes a file with the bytes of its message (src/risorius/view/scene_frame.h).
//
//   node paint_pictures.mjs RISORIUS RIG.json OUT

import { spawn } from "node:child_process";
import { createHash, randomBytes } from "node:crypto";
import { mkdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { join } from "node:path";

const [program, rig, out] = process.argv.slice(2);
const picture = 3;
const skull = 6;
const longest_ms = 120000;

/// Starts the program and returns the address of its page.
function start() {
  const server = spawn(program, ["view", rig, "--no-browser"], { stdio: ["ignore", "pipe", "inherit"] });
  const address = new Promise((resolve, reject) => {
    let told = "";
    server.stdout.on("data", (data) => {
      const found = (told += data).match(/http:\S+/);
      if (found) resolve(new URL(found[0]));
    });
    server.on("exit", (code) => reject(new Error(`risorius view ended with ${code}`)));
  });
  return { server, address };
}

/// A frame of a client, which is masked. Texts here are shorter than 126 bytes.
function frame(text) {
  const bytes = Buffer.from(text);
  const mask = randomBytes(4);
  return Buffer.concat([Buffer.from([0x81, 0x80 | bytes.length]), mask, bytes.map((b, i) => b ^ mask[i % 4])]);
}

/// Connects, and calls `take` with the payload of each binary message.
function connect(url, take) {
  return new Promise((resolve, reject) => {
    const key = randomBytes(16).toString("base64");
    const asked = request({
      host: url.hostname,
      port: url.port,
      path: "/socket",
      headers: { Connection: "Upgrade", Upgrade: "websocket", "Sec-WebSocket-Version": 13, "Sec-WebSocket-Key": key, Origin: url.origin },
    });
    asked.on("error", reject);
    asked.on("response", (answer) => reject(new Error(`risorius view answered ${answer.statusCode}`)));
    asked.on("upgrade", (answer, socket, head) => {
      const expected = createHash("sha1").update(`${key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest("base64");
      if (answer.headers["sec-websocket-accept"] !== expected) return reject(new Error("risorius view gave no right handshake"));
      let waiting = head;
      let message = [];
      const read = () => {
        while (waiting.length >= 2) {
          let size = waiting[1] & 0x7f;
          const begin = size === 126 ? 4 : size === 127 ? 10 : 2;
          if (waiting.length < begin) return;
          if (size === 126) size = waiting.readUInt16BE(2);
          if (size === 127) size = Number(waiting.readBigUInt64BE(2));
          if (waiting.length < begin + size) return;
          const code = waiting[0] & 0x0f;
          message.push(waiting.subarray(begin, begin + size));
          if (code <= 2 && waiting[0] & 0x80) {
            take(Buffer.concat(message));
            message = [];
          } else if (code > 2) message.pop();
          waiting = waiting.subarray(begin + size);
        }
      };
      socket.on("data", (data) => {
        waiting = Buffer.concat([waiting, data]);
        read();
      });
      socket.on("error", () => {});
      read();
      resolve(socket);
    });
    asked.end();
  });
}

const { server, address } = start();
const url = await address;
const files = new Map();
const done = new Promise((resolve, reject) => {
  setTimeout(() => reject(new Error(`no pictures within ${longest_ms / 1000} s`)), longest_ms).unref();
  // The pictures come together; the bones come when they are ready. What follows at once belongs to them.
  const complete = () => files.has("skull") && files.size > 1 && setTimeout(resolve, 2000);
  void connect(url, (bytes) => {
    if (bytes[0] === 0x7b) return; // a text
    const kind = bytes.readUInt32LE(0);
    if (kind === picture) files.set(JSON.parse(bytes.subarray(8, 8 + bytes.readUInt32LE(4)).toString()).material, bytes);
    if (kind === skull) files.set("skull", bytes);
    complete();
  }).then((socket) => {
    socket.write(frame(JSON.stringify({ type: "hello", token: url.hash.slice(1), protocol: 1 })));
    socket.write(frame(JSON.stringify({ type: "sights", skull: true })));
  }, reject);
});
try {
  await done;
  rmSync(`${out}.new`, { recursive: true, force: true });
  mkdirSync(`${out}.new`, { recursive: true });
  for (const [name, bytes] of files) writeFileSync(join(`${out}.new`, name), bytes);
  rmSync(out, { recursive: true, force: true });
  renameSync(`${out}.new`, out);
} finally {
  server.removeAllListeners("exit");
  server.kill("SIGINT");
}
process.exit(0);
