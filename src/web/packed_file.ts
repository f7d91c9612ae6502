// SPDX-License-Identifier: MIT
/// \file
/// Files that lie beside a hosted page, packed by gzip, so that their weight does not depend on the server.

/// Fetches NAME.gz and unpacks it. A server may have unpacked it already.
export async function fetchPacked(name: string): Promise<Uint8Array> {
  const answer = await fetch(`${name}.gz`);
  if (!answer.ok) throw new Error(`${name}.gz: expected a file beside the page, found ${answer.status} ${answer.statusText}`);
  const bytes = new Uint8Array(await answer.arrayBuffer());
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}
