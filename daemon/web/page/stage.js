// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The canvas and what is drawn on it, only when something has changed.
import {Color, PerspectiveCamera, Scene, WebGLRenderer} from './three.module.js';

const SHARPEST = 2;
const FIELD_OF_VIEW_DEG = 50;
// A picture that a processor draws takes it 40 ms. With one for each scan little would be left for scipd.
const SOFTWARE_PERIOD_MS = 50;

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    const software = drawsInSoftware();
    this.renderer = new WebGLRenderer({canvas, antialias: !software});
    this.period_ms = software ? SOFTWARE_PERIOD_MS : 0;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.05, 2000);
    this.camera.up.set(0, 0, 1);
    this.before = [];
    this.after = [];
    this.waiting = false;
    this.frames = 0;
    this.drawn_ms = performance.now();
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement);
    this.fit();
  }

  /** Asks for a picture; many calls make one. */
  invalidate() {
    if (this.waiting) return;
    this.waiting = true;
    const draw = () => requestAnimationFrame((now_ms) => this.draw(now_ms));
    const early_ms = this.drawn_ms + this.period_ms - performance.now();
    if (early_ms > 0) setTimeout(draw, early_ms);
    else draw();
  }

  /** act(seconds since the last picture) before each picture. */
  beforeEach(act) {
    this.before.push(act);
  }

  afterEach(act) {
    this.after.push(act);
  }

  draw(now_ms) {
    this.waiting = false;
    const past_s = Math.min(Math.max((now_ms - this.drawn_ms) / 1000, 0), 0.25);
    this.drawn_ms = now_ms;
    for (const act of this.before) act(past_s);
    this.renderer.render(this.scene, this.camera);
    this.frames += 1;
    for (const act of this.after) act();
  }

  setBackground(colour) {
    this.scene.background = new Color(colour);
    this.invalidate();
  }

  fit() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, SHARPEST));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /** A promise of the present picture as a PNG. */
  picture() {
    this.renderer.render(this.scene, this.camera);
    return new Promise((done) => this.canvas.toBlob(done, 'image/png'));
  }

  /** How long a pixel of the canvas is at a place. */
  pixelAt([x, y, z]) {
    const distance_m = this.camera.position.distanceTo({x, y, z});
    return 2 * distance_m * Math.tan(this.camera.fov * Math.PI / 360) / this.canvas.clientHeight;
  }

  /** Where on the canvas a pointer is, from -1 to 1 as WebGL has it. */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return {
      x: 2 * (event.clientX - box.left) / box.width - 1,
      y: 1 - 2 * (event.clientY - box.top) / box.height,
    };
  }
}

/** Smooth edges cost a processor most of its pictures, and a graphics card nothing. */
function drawsInSoftware() {
  const context = document.createElement('canvas').getContext('webgl');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
