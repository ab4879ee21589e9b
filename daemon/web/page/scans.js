// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which sensors' scans one wants to see, and their pictures. The daemon sends a sensor's next scan when the last one
// was drawn, so a slow page gets fewer of them and nothing else waits for it.
import {readScan} from './scan_message.js';
import {ScanLayer} from './scan_layer.js';
import {SensorMark} from './sensor_mark.js';

const REDRAWN_BY = ['paint', 'rays', 'points', 'echoes', 'truth', 'through', 'trail_s'];

/** Tells scan (detail: the scan) and shown. */
export class Scans extends EventTarget {
  constructor({stage, connection, settings, world, status}) {
    super();
    this.stage = stage;
    this.connection = connection;
    this.settings = settings;
    this.world = world;
    this.status = status;
    this.layers = new Map();
    this.latest = new Map();
    this.unacknowledged = [];
    this.counts = new Map();
    this.isHeld = false;
    connection.addEventListener('open', () => this.subscribe());
    connection.addEventListener('binary', (event) => this.take(this.known(readScan(event.detail))));
    stage.beforeEach(() => this.draw());
    stage.afterEach(() => this.acknowledge());
    for (const name of REDRAWN_BY) settings.watch(name, () => this.redraw());
  }

  isShown(sensor) {
    return this.layers.has(sensor);
  }

  get shown() {
    return [...this.layers.keys()];
  }

  show(sensor, on) {
    if (on === this.isShown(sensor)) return;
    if (on) this.addLayer(sensor);
    else this.removeLayer(sensor);
    this.subscribe();
    this.stage.invalidate();
    this.dispatchEvent(new Event('shown'));
  }

  addLayer(sensor) {
    const layer = {scan: new ScanLayer(this.settings, (id) => this.world.nameOf(id)), mark: new SensorMark()};
    this.layers.set(sensor, layer);
    this.stage.scene.add(layer.scan.group, layer.mark.group);
  }

  removeLayer(sensor) {
    const {scan, mark} = this.layers.get(sensor);
    this.stage.scene.remove(scan.group, mark.group);
    scan.dispose();
    mark.dispose();
    this.layers.delete(sensor);
    this.latest.delete(sensor);
  }

  subscribe() {
    const scans = {};
    for (const sensor of this.isHeld ? [] : this.layers.keys()) scans[sensor] = {true: true};
    this.connection.send({scans});
  }

  /** From now on scans come only from drawPast(). */
  hold(on) {
    this.isHeld = on;
    this.subscribe();
  }

  drawPast(scan) {
    if (this.layers.has(scan.sensor)) this.latest.set(scan.sensor, scan);
    this.stage.invalidate();
  }

  /** With what never changes of its scanner, and when it came, in Unix time. */
  known(scan) {
    return {...this.status.sensor(scan.sensor)?.identity, ...scan, got_s: Date.now() / 1000};
  }

  take(scan) {
    this.unacknowledged.push(scan.frame);
    this.counts.set(scan.sensor, (this.counts.get(scan.sensor) || 0) + 1);
    if (this.layers.has(scan.sensor) && !this.isHeld) {
      this.latest.set(scan.sensor, scan);
      this.dispatchEvent(new CustomEvent('scan', {detail: scan}));
    }
    this.stage.invalidate();
  }

  draw() {
    for (const [sensor, scan] of this.latest) {
      const layer = this.layers.get(sensor);
      layer.scan.take(scan, scan.time_s);
      layer.mark.take(scan);
    }
    this.latest.clear();
  }

  acknowledge() {
    for (const frame of this.unacknowledged) this.connection.send({ack: frame});
    this.unacknowledged = [];
  }

  redraw() {
    for (const {scan} of this.layers.values()) {
      scan.trail.setLength(this.settings.get('trail_s'));
      scan.redraw();
    }
    this.stage.invalidate();
  }

  /** The scan that is drawn of a sensor now. */
  scanOf(sensor) {
    return this.layers.get(sensor)?.scan.scan || null;
  }

  legendOf(sensor) {
    return this.layers.get(sensor)?.scan.paint?.legend || null;
  }
}
