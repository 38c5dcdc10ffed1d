// SPDX-License-Identifier: Apache-2.0
import type { CutOptions, MeshData, ModuleSource, StreamInfo } from './player.js';

export interface Shown {
  frame: number;
  /** one for each cut that was asked for; the arrays are the page's own until recycle() */
  meshes: MeshData[];
  /** milliseconds on the worker */
  times: { seek: number; cut: number };
  /** of the stream, so far */
  bytesThere: number;
}

/**
 * A player on a worker. Events: 'info' (detail: {info, sizes, keys}, of each frame known: bytes, and 1 where it is a
 * key), 'progress' (detail: {bytesThere, size, there}), 'failure' (detail: LimberError; loading has ended).
 */
export class WorkerPlayer extends EventTarget {
  constructor(options?: { workerUrl?: string | URL; workerType?: WorkerType; module?: ModuleSource });
  /** null until header and mesh are there */
  readonly info: StreamInfo | null;

  /**
   * An address, a file that was chosen or dropped, or bytes. Resolves when header and mesh are there. From a server that
   * gives ranges, what is shown is loaded first, then the rest, until `prefetch` bytes are there.
   */
  open(from: string | URL | Blob | ArrayBuffer | ArrayBufferView, options?: { prefetch?: number }): Promise<StreamInfo>;

  /** Waits for the bytes it needs. null where another show() came before it could be answered. */
  show(frame: number, cuts: CutOptions[]): Promise<Shown | null>;

  /** Gives the arrays back, so that nothing is allocated for the next frames. */
  recycle(shown: Shown): void;
  close(): void;
}
