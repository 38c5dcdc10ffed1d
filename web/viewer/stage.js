// SPDX-License-Identifier: Apache-2.0
// The picture: the approximation and, where compared, the original, under one camera.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, Group, HemisphereLight, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { fillGeometry } from '../limber-mesh.js';
import { colorNodes } from './colors.js';
import { Ball, Frustum, cameraOf } from './marks.js';

const FLASH_MILLISECONDS = 420;

// A surface and its wireframe, which share a geometry.
class Shape {
  constructor() {
    this.geometry = new BufferGeometry();
    this.material = new MeshStandardMaterial({ roughness: 0.72, metalness: 0, side: 2, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    this.wire = new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.55 });
    this.surface = new Mesh(this.geometry, this.material);
    this.edges = new Mesh(this.geometry, this.wire);
    this.group = new Group().add(this.surface, this.edges);
    for (const mesh of [this.surface, this.edges]) mesh.frustumCulled = false;
    this.data = null;
  }

  fill(data) {
    this.data = data;
    fillGeometry(this.geometry, data);
  }

  // `colorOf(v, array, at)` writes a colour.
  paint(colorOf) {
    const room = this.geometry.getAttribute('position').array.length;
    let attribute = this.geometry.getAttribute('color');
    if (!attribute || attribute.array.length < room) {
      attribute = new BufferAttribute(new Float32Array(room), 3);
      this.geometry.setAttribute('color', attribute);
    }
    for (let v = 0; v < this.data.vertexCount; ++v) colorOf(v, attribute.array, 3 * v);
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, 3 * this.data.vertexCount);
    attribute.needsUpdate = true;
    this.setPainted(true);
  }

  setPainted(isPainted) {
    if (this.material.vertexColors === isPainted) return;
    this.material.vertexColors = isPainted;
    this.material.needsUpdate = true;
  }
}

export class Stage {
  constructor(canvas, { onCamera = () => {} } = {}) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: false });
    this.renderer.setScissorTest(true);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    const key = new DirectionalLight(0xfff2e2, 2.9);
    key.position.set(-1.5, 1.9, 0.7);
    const rim = new DirectionalLight(0xbfd6ff, 1.1);
    rim.position.set(1.6, 0.4, -1.2);
    this.camera.add(key, key.target, rim, rim.target);
    for (const light of [key, rim]) light.target.position.set(0, 0, -1);
    this.scene.add(this.camera, new HemisphereLight(0xdfe8f4, 0x38302a, 0.75), new AmbientLight(0xffffff, 0.12));
    this.approximation = new Shape();
    this.original = new Shape();
    this.frustum = new Frustum();
    this.ball = new Ball();
    this.frozen = null;
    this.scene.add(this.approximation.group, this.original.group, this.frustum, this.ball);
    this.look = { wireframe: false, flat: false, colors: 'none', flash: false };
    this.compare = 'off';
    this.split = 0.5;
    this.up = 'y';
    this.colors = { clay: new Color('#b4b8bd'), wire: new Color('#000'), accent: new Color('#e58a4e') };
    this.isDirty = true;
    this.onCamera = onCamera;
    this.sphere = null;
    this.startControls();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  startControls() {
    const target = this.controls?.target;
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.16;
    this.controls.zoomToCursor = this.compare !== 'side'; // of two pictures the cursor is in one
    if (target) this.controls.target.copy(target);
    this.controls.addEventListener('change', () => {
      this.isDirty = true;
      this.onCamera();
    });
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(globalThis.devicePixelRatio || 1, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.isDirty = true;
    this.onCamera();
  }

  setTheme(colors) {
    for (const [name, value] of Object.entries(colors)) this.colors[name].set(value);
    this.applyLook();
  }

  setLook(look) {
    Object.assign(this.look, look);
    this.applyLook();
  }

  applyLook() {
    for (const shape of [this.approximation, this.original]) {
      shape.material.flatShading = this.look.flat;
      shape.material.needsUpdate = true;
      shape.edges.visible = this.look.wireframe;
      shape.wire.color.copy(this.colors.wire);
    }
    for (const lines of [this.frustum, this.ball]) lines.material.color.copy(this.colors.accent);
    this.repaint();
  }

  // Arrays for a new stream, by node. On their way between nodes are at most as many vertices as the finest level has.
  setStream(info, keepsCamera = false) {
    this.info = info;
    const count = info.nodeCount + info.vertexCount;
    this.table = new Float32Array(3 * count);
    this.flashedAt = new Float64Array(count).fill(-1e9);
    this.errorScale = 0;
    this.approximation.data = null;
    this.original.data = null;
    if (!keepsCamera) this.sphere = null;
  }

  // Nothing is shown until the next setMeshes().
  clear() {
    for (const shape of [this.approximation, this.original]) {
      shape.data = null;
      shape.geometry.setDrawRange(0, 0);
    }
    this.isDirty = true;
  }

  setMeshes(approximation, original, labels) {
    this.approximation.fill(approximation);
    if (original) this.original.fill(original);
    else this.original.data = null;
    this.labels = labels;
    if (this.look.flash && approximation.moved) {
      const now = performance.now();
      for (let v = 0; v < approximation.vertexCount; ++v)
        if (approximation.moved[v]) this.flashedAt[approximation.nodes[v]] = now;
      this.isFlashing = true;
    }
    this.repaint();
    if (!this.sphere) this.fit(false);
  }

  repaint() {
    this.isDirty = true;
    const { approximation, original, look, table } = this;
    if (!approximation.data) return;
    const { clay } = this.colors;
    const mode = look.colors;
    const now = performance.now();
    const isFlashing = look.flash && this.isFlashing;
    for (const shape of [approximation, original]) shape.material.color.copy(mode === 'none' && !isFlashing ? clay : new Color('#fff'));
    if (mode === 'none' && !isFlashing) {
      approximation.setPainted(false);
    } else {
      const { data } = approximation;
      table.fill(0.3); // of nodes that are not drawn
      if (mode !== 'none' && this.hasArrays(mode)) colorNodes(mode, data, this.info.levelSizes.length, this.errorScale, table);
      const isPlain = mode === 'none' || !this.hasArrays(mode);
      const { accent } = this.colors;
      let lively = false;
      approximation.paint((v, array, at) => {
        const node = data.nodes[v];
        const from = 3 * node;
        const age = isFlashing ? (now - this.flashedAt[node]) / FLASH_MILLISECONDS : 1;
        const heat = age < 1 ? (1 - age) * (1 - age) : 0;
        if (heat > 0) lively = true;
        const r = isPlain ? clay.r : table[from], g = isPlain ? clay.g : table[from + 1], b = isPlain ? clay.b : table[from + 2];
        array[at] = r + (accent.r - r) * heat;
        array[at + 1] = g + (accent.g - g) * heat;
        array[at + 2] = b + (accent.b - b) * heat;
      });
      this.isFlashing = lively;
    }
    if (!original.data) return;
    original.material.color.copy(mode === 'none' ? clay : new Color('#fff'));
    if (mode === 'none' || !this.labels || !this.hasArrays(mode)) {
      original.material.color.copy(clay);
      original.setPainted(false);
    } else {
      original.paint((v, array, at) => {
        const from = 3 * this.labels[original.data.nodes[v]];
        array[at] = table[from];
        array[at + 1] = table[from + 1];
        array[at + 2] = table[from + 2];
      });
    }
  }

  hasArrays(mode) {
    const { data } = this.approximation;
    return mode === 'clusters' || (mode === 'levels' && data.levels) || (mode === 'errors' && data.errors);
  }

  // {low, high} of what is shown; null where nothing is.
  box() {
    const { data } = this.original.data ? this.original : this.approximation;
    if (!data || data.vertexCount === 0) return null;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < data.positions.length; ++i) {
      const axis = i % 3;
      low[axis] = Math.min(low[axis], data.positions[i]);
      high[axis] = Math.max(high[axis], data.positions[i]);
    }
    return { low, high };
  }

  // A sphere around what is shown, from the side that shows the most of it.
  fit(isAnimated = true) {
    const box = this.box();
    if (!box) return;
    const low = new Vector3().fromArray(box.low);
    const high = new Vector3().fromArray(box.high);
    const size = high.clone().sub(low);
    const center = low.clone().add(high).multiplyScalar(0.5);
    const radius = Math.max(size.length() / 2, 1e-9);
    const isFirst = !this.sphere;
    this.sphere = { center, radius };
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    if (isFirst || direction.lengthSq() < 0.5) {
      const y = this.up === 'y';
      const depth = y ? size.z : size.y;
      const frontal = size.x >= depth;
      direction.set(frontal ? 0.5 : 0.85, 0.32, frontal ? 0.85 : 0.5).normalize();
      if (!y) direction.set(direction.x, -direction.z, direction.y);
    }
    const to = { target: center, position: center.clone().addScaledVector(direction, this.fitDistance(radius)) };
    if (isAnimated && !isFirst) this.flyTo(to);
    else this.place(to);
  }

  fitDistance(radius) {
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.aspect()));
    return (radius / Math.sin(narrow)) * 0.92;
  }

  flyTo(to) {
    const from = { target: this.controls.target.clone(), position: this.camera.position.clone() };
    this.flight = { from, to, start: performance.now() };
  }

  place({ target, position }) {
    this.controls.target.copy(target);
    this.camera.position.copy(position);
    this.controls.update();
    this.isDirty = true;
    this.onCamera();
  }

  fly(now) {
    if (!this.flight) return;
    const t = Math.min(1, (now - this.flight.start) / 260);
    const eased = 1 - (1 - t) ** 3;
    const { from, to } = this.flight;
    this.place({ target: from.target.clone().lerp(to.target, eased), position: from.position.clone().lerp(to.position, eased) });
    if (t === 1) this.flight = null;
  }

  setUp(axis) {
    this.up = axis;
    this.camera.up.set(0, axis === 'y' ? 1 : 0, axis === 'z' ? 1 : 0);
    this.startControls();
    this.sphere = null;
    this.fit(false);
  }

  setCompare(compare) {
    this.compare = compare;
    this.controls.zoomToCursor = compare !== 'side';
    this.isDirty = true;
  }

  aspect() {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    return (this.compare === 'side' ? w / 2 : w) / Math.max(1, h);
  }

  // Where it is looked from, as the view of a cut says it.
  eye() {
    const { camera, controls, canvas } = this;
    const height = Math.max(1, canvas.clientHeight);
    return {
      camera: { eye: camera.position.toArray(), target: controls.target.toArray(), up: camera.up.toArray(), fov: camera.fov },
      width: Math.max(1, Math.round(height * this.aspect())),
      height,
    };
  }

  // Shows what an eye sees as lines, its picture in a corner, and both from the side; null: no more.
  setFrozen(eye) {
    const back = this.frozen;
    this.frozen = eye;
    this.frustum.visible = eye !== null;
    this.isDirty = true;
    if (!eye) {
      if (back) this.flyTo({ target: new Vector3().fromArray(back.camera.target), position: new Vector3().fromArray(back.camera.eye) });
      return;
    }
    const { camera, controls } = this;
    const { center, radius } = this.sphere ?? { center: controls.target, radius: 1 };
    const arm = camera.position.clone().sub(center);
    this.frustum.set(eye, arm.length() + 0.8 * radius);
    const distance = Math.max(1.15 * this.fitDistance(radius), 1.5 * arm.length());
    const direction = arm.clone().normalize().applyAxisAngle(camera.up, -1.2).addScaledVector(camera.up, 0.25).normalize();
    const target = center.clone().addScaledVector(arm, 0.25);
    this.flyTo({ target, position: target.clone().addScaledVector(direction, distance) });
  }

  // Nearer to a place, from the same side.
  approach(place, part) {
    const arm = this.camera.position.clone().sub(this.controls.target).multiplyScalar(part);
    const target = new Vector3().fromArray(place);
    this.place({ target, position: target.clone().add(arm) });
  }

  setFocus(focus) {
    this.ball.visible = focus !== null;
    if (focus) this.ball.set(focus);
    this.isDirty = true;
  }

  // The place of the surface under the mouse, or null.
  pick(event) {
    const { canvas, camera, approximation } = this;
    if (!approximation.data) return null;
    const bounds = canvas.getBoundingClientRect();
    const x = event.clientX - bounds.left;
    const part = this.compare === 'side' ? (2 * x) % bounds.width : x;
    const pointer = new Vector2((2 * part) / bounds.width - 1, 1 - (2 * (event.clientY - bounds.top)) / bounds.height);
    const ray = new Raycaster();
    ray.setFromCamera(pointer, camera);
    approximation.geometry.boundingSphere = null; // of another frame
    return ray.intersectObject(approximation.surface)[0]?.point.toArray() ?? null;
  }

  // Where the picture of the frozen eye lies, in pixels from the lower left.
  insetBox() {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const aspect = this.frozen.width / this.frozen.height;
    const height = Math.round(Math.min(0.3 * h, (0.34 * w) / aspect));
    return { left: 14, bottom: 14, width: Math.round(height * aspect), height };
  }

  // With the lights of the frozen eye.
  drawInset() {
    const { renderer, camera } = this;
    const { left, bottom, width, height } = this.insetBox();
    const kept = camera.clone(false);
    const eye = cameraOf(this.frozen);
    const wereVisible = [this.frustum.visible, this.ball.visible];
    this.frustum.visible = this.ball.visible = false;
    for (const from of [eye, kept]) {
      camera.position.copy(from.position);
      camera.quaternion.copy(from.quaternion);
      camera.aspect = from.aspect;
      camera.near = kept.near;
      camera.far = kept.far;
      if (from === eye) {
        const distance = eye.position.distanceTo(new Vector3().fromArray(this.frozen.camera.target));
        camera.near = distance / 200;
        camera.far = distance + 8 * (this.sphere?.radius ?? 1);
      }
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
      if (from === kept) break;
      this.approximation.group.visible = true;
      this.original.group.visible = false;
      renderer.setViewport(left, bottom, width, height);
      renderer.setScissor(left, bottom, width, height);
      renderer.render(this.scene, camera);
    }
    [this.frustum.visible, this.ball.visible] = wereVisible;
  }

  // Draws where anything has changed. Gives whether it did.
  draw(now) {
    this.fly(now);
    this.controls.update();
    if (this.isFlashing) this.repaint();
    if (!this.isDirty) return false;
    this.isDirty = false;
    const { renderer, camera, canvas, compare } = this;
    const w = canvas.clientWidth;
    const h = canvas.clientHeight;
    const distance = camera.position.distanceTo(this.controls.target);
    const radius = this.sphere?.radius ?? 1;
    camera.near = Math.max(distance - 6 * radius, distance / 200);
    camera.far = distance + 8 * radius;
    camera.aspect = this.aspect();
    camera.updateProjectionMatrix();
    const show = (shape, viewport, scissor) => {
      this.approximation.group.visible = shape === this.approximation;
      this.original.group.visible = shape === this.original;
      renderer.setViewport(...viewport);
      renderer.setScissor(...scissor);
      renderer.render(this.scene, camera);
    };
    const full = [0, 0, w, h];
    if (compare === 'off' || !this.original.data) {
      show(this.approximation, full, full);
    } else if (compare === 'side') {
      const left = Math.floor(w / 2);
      show(this.original, [0, 0, left, h], [0, 0, left, h]);
      show(this.approximation, [left, 0, w - left, h], [left, 0, w - left, h]);
    } else {
      const left = Math.round(w * this.split);
      show(this.original, full, [0, 0, left, h]);
      show(this.approximation, full, [left, 0, w - left, h]);
    }
    if (this.frozen && this.approximation.data) this.drawInset();
    return true;
  }
}
