// SPDX-License-Identifier: Apache-2.0

/** Where player.wasm comes from; beside player.js by default. */
export type ModuleSource = string | URL | ArrayBuffer | ArrayBufferView | WebAssembly.Module;

/** Compiles the module, once for each source. Player.create() calls it; call it earlier to load it in advance. */
export function loadModule(source?: ModuleSource): Promise<WebAssembly.Module>;

export type LimberErrorCode =
  | 'bad-stream' | 'unsupported' | 'no-memory' | 'wrong-call' | 'no-module' | 'network';

/** One line: the place in the stream and the rule broken. */
export class LimberError extends Error {
  readonly code: LimberErrorCode;
  constructor(code: LimberErrorCode, message: string);
}

export interface StreamInfo {
  /** null where it is not known yet */
  frameCount: number | null;
  /** frames 0 to this - 1 are known; with an index, their bytes need not be there */
  availableFrames: number;
  /** that the source gave to frame 0 */
  firstFrameNumber: number;
  framesPerSecond: number;
  /** no vertex is further from the original, in units of the input; 0: lossless */
  tolerance: number;
  /** of the bounding box of frame 0, in units of the input */
  diagonal: number;
  /** bytes; null where it is not known */
  size: number | null;
  bytesThere: number;
  hasIndex: boolean;
  keyInterval: number;
  /** of the finest level */
  vertexCount: number;
  triangleCount: number;
  /** of all levels */
  nodeCount: number;
  /** finest level first */
  levelSizes: number[];
}

export interface FrameInfo {
  /** the frame at or before this one where seeking starts */
  key: number;
  isThere: boolean;
  /** of the frame's chunk in the stream, in bytes */
  offset: number;
  size: number;
}

export type Point = readonly [number, number, number] | Float32Array | Float64Array;

/**
 * How a cut is looked at: where its errors matter, and by how much. All criteria combine. With a camera errors are in
 * pixels, without one in percent of the frame's bounding box diagonal.
 */
export interface View {
  /** fov: vertical, in degrees, up to 120; by default from (0, 0, 5) to the origin, y up, 24 degrees */
  camera?: { eye: Point; target: Point; up?: Point; fov?: number };
  /** of the camera's picture, in pixels; 1200 x 900 by default */
  width?: number;
  height?: number;
  /** with a camera; at least 1: how many times smaller an error must be on the silhouette */
  silhouettes?: number;
  /** with a camera; at least 1: how many times larger it may be where the surface faces away */
  facingAway?: number;
  /** Finest in a ball; one radius beyond it errors may be `outside` (32) times larger. */
  focus?: { center: Point; radius: number; outside?: number };
  /** Finest at and before one place of an axis; at and beyond another errors may be `coarsest` (64) times larger. */
  along?: { axis: 'x' | 'y' | 'z'; from: number; to: number; coarsest?: number };
}

export interface CutOptions {
  /** Which of the members below chooses; 'level' by default. */
  by?: 'level' | 'vertices' | 'triangles' | 'error';
  /** 0 is the finest; clamped to the top */
  level?: number;
  /** at most so many vertices or triangles */
  budget?: number;
  /** root mean square distance in percent of the frame's bounding box diagonal; with a view the largest, in its unit */
  errorBound?: number;
  /** at least 1, 1.6 by default: how many times better, in squared error, a change between frames must be */
  hysteresis?: number;
  view?: View | null;
  /** by error with a view: measure until the bound is kept (many times slower) instead of estimating; false by default */
  hold?: boolean;
  /** by vertices or triangles with a view: the error that no budget is spent on going below; 0 by default */
  enough?: number;
  /**
   * How many frames a change takes: vertices move there from where they were. 0, by default, and 1: at once. Changes are
   * on their way while each update is of the frame after the one before, or of the same, with the same options above but
   * for hysteresis and view; else the cut is shown as it is. Meanwhile there are more vertices than a budget says.
   */
  blend?: number;
  /** what to fetch besides positions, normals, indices and nodes */
  fetch?: { levels?: boolean; errors?: boolean; moved?: boolean; labels?: boolean };
}

/** The arrays of Cut.update() lie in the module's memory: use or copy them before the next call on the player. */
export interface MeshData {
  frame: number;
  vertexCount: number;
  triangleCount: number;
  /** nodes, of all levels, that changed their parents in this frame; 0 at a key */
  swapCount: number;
  /** root mean square distance to the surface, in units of the input; 0 where errors are not fetched */
  rmsError: number;
  /** with a view: the largest error that is seen, held or estimated, in the view's unit; 0 without */
  seenError: number;
  /** [3 x vertexCount] */
  positions: Float32Array;
  /** [3 x vertexCount], of length 1 */
  normals: Float32Array;
  /** [3 x triangleCount], counter-clockwise seen from outside */
  indices: Uint32Array;
  /**
   * [vertexCount]: the same number is the same vertex from frame to frame; from StreamInfo.nodeCount on it is one on its
   * way, until it arrives, with level and errors of where it goes
   */
  nodes: Uint32Array;
  /** [vertexCount]: 0 is the finest */
  levels: Uint8Array | null;
  /** [vertexCount]: distance to the part of the surface that the vertex stands for, in units of the input */
  errors: Float32Array | null;
  /** [vertexCount]: 1 where this frame's swaps gave the vertex another part of the surface */
  moved: Uint8Array | null;
  /** [StreamInfo.vertexCount]: the node that stands for each vertex of the input */
  labels: Uint32Array | null;
}

/** limber/player.h; errors are thrown as LimberError. */
export class Player {
  static create(source?: ModuleSource): Promise<Player>;
  destroy(): void;

  /** Bytes in their order, as they arrive. True once header and mesh are there. */
  append(bytes: ArrayBuffer | ArrayBufferView): boolean;
  /** How long the whole stream is. */
  setSize(size: number): boolean;
  /** Bytes from any place of a stream whose size is known. */
  supply(offset: number, bytes: ArrayBuffer | ArrayBufferView): boolean;
  /** The first bytes that are missing to show a frame (by default: to know all frames); null where none are. size 0:
   * all from there on. */
  missing(frame?: number): { offset: number; size: number } | null;

  /** null until header and mesh are there */
  readonly info: StreamInfo | null;
  /** null where the frame is not available yet */
  frame(number: number): FrameInfo | null;
  /** null before the first is there */
  readonly shownFrame: number | null;
  /** False, and nothing changes, where bytes for that are missing. */
  seek(frame: number): boolean;
  /** False where the next frame is not there, or there is none. */
  step(): boolean;
  createCut(): Cut;
}

export class Cut {
  /** Cuts the frame shown; null where none is. */
  update(options?: CutOptions): MeshData | null;
  destroy(): void;
}
