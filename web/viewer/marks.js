// SPDX-License-Identifier: Apache-2.0
// Lines in the scene: what a frozen eye sees, and the ball in focus.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, PerspectiveCamera, Vector3 } from 'three';

// Corners of the unit picture, around.
const CORNERS = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
const ROUND = 64; // sides of a circle

class Lines extends LineSegments {
  constructor(opacity) {
    super(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity }));
    this.frustumCulled = false;
    this.visible = false;
  }

  // `points`: two for each line.
  setPoints(points) {
    this.geometry.dispose();
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute('position', new BufferAttribute(Float32Array.from(points.flatMap((p) => p.toArray())), 3));
  }
}

// The camera of an eye: {camera: {eye, target, up, fov}, width, height}.
export function cameraOf({ camera, width, height }) {
  const made = new PerspectiveCamera(camera.fov, width / height, 0.01, 100);
  made.up.fromArray(camera.up);
  made.position.fromArray(camera.eye);
  made.lookAt(new Vector3().fromArray(camera.target));
  made.updateMatrixWorld();
  return made;
}

// From the eye to as far as `depth`, and a picture in front of it.
export class Frustum extends Lines {
  constructor() {
    super(0.9);
  }

  set(eye, depth) {
    const camera = cameraOf(eye);
    const slope = Math.tan((camera.fov * Math.PI) / 360);
    const corners = (z) => CORNERS.map(([x, y]) => camera.localToWorld(new Vector3(x * slope * camera.aspect * z, y * slope * z, -z)));
    const points = [];
    const far = corners(depth);
    for (const ring of [corners(depth * 0.12), far]) ring.forEach((corner, i) => points.push(corner, ring[(i + 1) % 4]));
    for (const corner of far) points.push(camera.position.clone(), corner);
    this.setPoints(points);
  }
}

// Three circles.
export class Ball extends Lines {
  constructor() {
    super(0.75);
    const circle = Array.from({ length: ROUND + 1 }, (_, i) => (2 * Math.PI * i) / ROUND).map((a) => [Math.cos(a), Math.sin(a)]);
    const points = [];
    for (let axis = 0; axis < 3; ++axis) {
      for (let i = 0; i < ROUND; ++i) {
        for (const [c, s] of [circle[i], circle[i + 1]]) {
          const place = [0, 0, 0];
          place[axis] = c;
          place[(axis + 1) % 3] = s;
          points.push(new Vector3(...place));
        }
      }
    }
    this.setPoints(points);
  }

  set({ center, radius }) {
    this.position.fromArray(center);
    this.scale.setScalar(radius);
  }
}
