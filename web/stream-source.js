// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a stream come from: an address, a file that was chosen or dropped, or memory. All give
// { size, read(offset, size, take, signal) }: `size` is null where only all of it, in order, can be had; `take` is called
// with each part as it arrives.
import { LimberError } from './player.js';

const FIRST_READ = 1 << 16;

const networkError = (what) => new LimberError('network', what);

// What has arrived of a response. A connection that breaks is an error with the code 'network'.
async function readBody(response, offset, take) {
  const reader = response.body.getReader();
  let at = offset;
  for (;;) {
    let part;
    try {
      part = await reader.read();
    } catch (error) {
      if (error.name === 'AbortError') throw error;
      throw networkError('the connection was lost while the stream was loading');
    }
    if (part.done) return;
    take(at, part.value);
    at += part.value.length;
  }
}

async function request(url, range, signal) {
  let response;
  try {
    response = await fetch(url, { headers: range ? { Range: `bytes=${range}` } : {}, signal });
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw networkError('there is no connection to the server');
  }
  if (!response.ok) throw networkError(`the server says: ${response.status} ${response.statusText}`);
  return response;
}

// The first request tells what the server can: its answer, already under way, is the first that is read.
async function openUrl(url) {
  let first = await request(url, `0-${FIRST_READ - 1}`);
  const whole = /\/(\d+)$/.exec(first.headers.get('Content-Range') ?? '');
  const size = first.status === 206 && whole ? Number(whole[1]) : null;
  return {
    size,
    firstRead: Math.min(FIRST_READ, size ?? FIRST_READ),
    async read(offset, length, take, signal) {
      if (first && offset === 0) {
        const response = first;
        first = null;
        return readBody(response, 0, take);
      }
      if (size === null) return readBody(await request(url, null, signal), 0, take);
      const response = await request(url, `${offset}-${offset + length - 1}`, signal);
      if (response.status !== 206) throw networkError('the server no longer gives parts of the stream');
      return readBody(response, offset, take);
    },
  };
}

function openBlob(blob) {
  return {
    size: blob.size,
    firstRead: FIRST_READ,
    async read(offset, length, take) {
      let bytes;
      try {
        bytes = await blob.slice(offset, offset + length).arrayBuffer();
      } catch {
        throw networkError('the file cannot be read any more');
      }
      take(offset, new Uint8Array(bytes));
    },
  };
}

function openBytes(bytes) {
  const all = ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
  return {
    size: all.length,
    firstRead: FIRST_READ,
    async read(offset, length, take) {
      take(offset, all.subarray(offset, offset + length));
    },
  };
}

export async function openSource(from) {
  if (typeof from === 'string' || from instanceof URL) return openUrl(String(from));
  if (typeof Blob !== 'undefined' && from instanceof Blob) return openBlob(from);
  return openBytes(from);
}
