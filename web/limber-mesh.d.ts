// SPDX-License-Identifier: Apache-2.0
import type { BufferGeometry, Material, Mesh } from 'three';
import type { CutOptions, MeshData, StreamInfo } from './player.js';
import type { WorkerPlayer } from './worker-player.js';

/** Puts a mesh into a geometry that is used again from frame to frame. */
export function fillGeometry(geometry: BufferGeometry, data: MeshData): void;

/** A mesh that follows a stream: call update() in each frame of the page. Dispatches 'failure' with an error. */
export class LimberMesh extends Mesh {
  constructor(
    from: string | URL | Blob | ArrayBuffer | ArrayBufferView,
    options?: { cut?: CutOptions; material?: Material; player?: WorkerPlayer },
  );
  readonly player: WorkerPlayer;
  /** Resolves when the first frame is shown. */
  readonly ready: Promise<this>;
  readonly info: StreamInfo | null;
  /** What is shown; its arrays are gone. */
  readonly data: MeshData | null;
  /** Takes effect at the next frame. */
  cut: CutOptions;
  /** Seconds from the first frame. */
  time: number;
  update(seconds: number): void;
  showFrame(frame: number): Promise<void>;
  dispose(): void;
}
