// SPDX-License-Identifier: Apache-2.0
// A THREE.Mesh whose geometry follows a stream. The types are in limber-mesh.d.ts.
import { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial, Sphere, Vector3 } from 'three';
import { WorkerPlayer } from './worker-player.js';

// Puts values into an attribute that has room for them, in a new one otherwise. Gives whether it is new.
function fill(geometry, name, values, itemSize) {
  const old = name === 'index' ? geometry.index : geometry.getAttribute(name);
  const isNew = !old || old.array.length < values.length;
  let attribute = old;
  if (isNew) {
    attribute = new BufferAttribute(new values.constructor(Math.ceil((values.length * 1.25) / itemSize) * itemSize), itemSize);
    if (name === 'index') geometry.setIndex(attribute);
    else geometry.setAttribute(name, attribute);
  }
  attribute.array.set(values);
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, values.length);
  attribute.needsUpdate = true;
  return isNew;
}

// Shows one mesh of a player. The geometry keeps its memory from frame to frame, and grows by a quarter more than needed.
export function fillGeometry(geometry, data) {
  const replaced = [
    fill(geometry, 'position', data.positions, 3),
    fill(geometry, 'normal', data.normals, 3),
    fill(geometry, 'index', data.indices, 1),
  ];
  if (replaced.some(Boolean)) geometry.dispatchEvent({ type: 'dispose' }); // frees what the replaced ones had on the GPU
  geometry.setDrawRange(0, data.indices.length);
}

export class LimberMesh extends Mesh {
  constructor(from, { cut = { by: 'vertices', budget: 5000 }, material = new MeshStandardMaterial(), player } = {}) {
    super(new BufferGeometry(), material);
    this.cut = cut;
    this.player = player ?? new WorkerPlayer();
    this.info = null;
    this.data = null;
    this.time = 0;
    this.isWaiting = false;
    this.frustumCulled = false; // until the first frame says where it is
    this.ready = this.player.open(from).then(async (info) => {
      this.info = info;
      await this.showFrame(0);
      return this;
    });
    this.ready.catch(() => {});
  }

  // Goes on by so many seconds, around the end. A frame that is not there yet is waited for.
  update(seconds) {
    if (!this.info || this.isWaiting) return;
    const count = this.info.frameCount ?? this.info.availableFrames;
    this.time = (this.time + seconds) % (count / this.info.framesPerSecond);
    const frame = Math.min(count - 1, Math.floor(this.time * this.info.framesPerSecond));
    if (frame !== this.data?.frame) this.showFrame(frame).catch((error) => this.dispatchEvent({ type: 'failure', error }));
  }

  async showFrame(frame) {
    this.isWaiting = true;
    try {
      const shown = await this.player.show(frame, [this.cut]);
      if (!shown) return;
      [this.data] = shown.meshes;
      fillGeometry(this.geometry, this.data);
      this.geometry.boundingSphere ??= new Sphere(new Vector3(), 0);
      boundSphere(this.data.positions, this.geometry.boundingSphere);
      this.frustumCulled = true;
      this.player.recycle(shown);
    } finally {
      this.isWaiting = false;
    }
  }

  dispose() {
    this.player.close();
    this.geometry.dispose();
  }
}

function boundSphere(positions, sphere) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    const axis = i % 3;
    if (positions[i] < low[axis]) low[axis] = positions[i];
    if (positions[i] > high[axis]) high[axis] = positions[i];
  }
  if (positions.length === 0) return;
  sphere.center.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
  sphere.radius = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
}
