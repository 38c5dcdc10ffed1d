// SPDX-License-Identifier: Apache-2.0
// A player that loads, decodes and cuts on a worker. The types are in worker-player.d.ts.
import { LimberError } from './player.js';
import { serve } from './player-worker.js';

const ARRAYS = ['positions', 'normals', 'indices', 'nodes', 'levels', 'errors', 'moved', 'labels'];

// The same in the page itself.
function connectInPage(receive) {
  let isOpen = true;
  const answer = serve((message) => queueMicrotask(() => isOpen && receive(message)));
  return { send: (message) => answer(message), close: () => (isOpen = false) };
}

// Some places have no workers, or refuse them when they start: what was sent by then is sent again within the page.
function connect({ workerUrl, workerType = 'module' }, receive) {
  let worker;
  try {
    worker = new Worker(workerUrl ?? new URL('player-worker.js', import.meta.url), { type: workerType });
  } catch {
    return connectInPage(receive);
  }
  let unanswered = [];
  const connection = {
    send(message, transfer = []) {
      unanswered?.push(message);
      worker.postMessage(message, transfer);
    },
    close: () => worker.terminate(),
  };
  worker.onmessage = (event) => {
    unanswered = null;
    receive(event.data);
  };
  worker.onerror = (event) => {
    event.preventDefault();
    if (!unanswered) return receive({ type: 'error', code: 'failure', message: event.message ?? 'the worker failed' });
    Object.assign(connection, connectInPage(receive));
    for (const message of unanswered) connection.send(message);
  };
  return connection;
}

export class WorkerPlayer extends EventTarget {
  constructor({ workerUrl, workerType, module } = {}) {
    super();
    this.module = module;
    this.waiting = new Map();
    this.lastId = 0;
    this.info = null;
    this.connection = connect({ workerUrl, workerType }, (message) => this.receive(message));
  }

  // Resolves when header and mesh are there.
  open(from, { prefetch = Infinity } = {}) {
    const opened = new Promise((resolve, reject) => (this.opening = { resolve, reject }));
    const address = from instanceof URL ? from.href : from;
    this.connection.send({ type: 'open', from: address, module: this.module, prefetch });
    return opened;
  }

  show(frame, cuts) {
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.connection.send({ type: 'show', id, frame, cuts });
    });
  }

  recycle(shown) {
    const buffers = shown.meshes.flatMap((mesh) => ARRAYS.map((name) => mesh[name]?.buffer)).filter(Boolean);
    this.connection.send({ type: 'recycle', buffers }, buffers);
  }

  close() {
    this.connection.close();
    for (const { resolve } of this.waiting.values()) resolve(null);
    this.waiting.clear();
  }

  receive(message) {
    switch (message.type) {
      case 'info':
        this.info = message.info;
        this.opening?.resolve(message.info);
        this.opening = null;
        break;
      case 'frame': {
        const waiting = this.waiting.get(message.id);
        this.waiting.delete(message.id);
        waiting?.resolve(message.meshes ? message : null);
        return;
      }
      case 'error': {
        const error = new LimberError(message.code, message.message);
        const waiting = this.waiting.get(message.id);
        if (waiting) {
          this.waiting.delete(message.id);
          waiting.reject(error);
          return;
        }
        this.opening?.reject(error);
        this.opening = null;
        this.dispatchEvent(new CustomEvent('failure', { detail: error }));
        return;
      }
    }
    this.dispatchEvent(new CustomEvent(message.type, { detail: message }));
  }
}
