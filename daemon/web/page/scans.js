// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Which sensors' scans one wants to see, and their pictures. The chosen one is drawn with rays. The daemon sends a
// sensor's next scan when the last one was drawn, so a slow page gets fewer of them and nothing else waits for it.
import {MaterialLooks} from './material_looks.js';
import {ofScanner} from './colours.js';
import {paintOf} from './paints.js';
import {readScan} from './scan_message.js';
import {ScanLayer} from './scan_layer.js';
import {SensorMark} from './sensor_mark.js';

const REDRAWN_BY = ['paint', 'rays', 'behind', 'fans', 'points', 'echoes', 'truth', 'through', 'trail_s'];

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
    this.colours = new Map();
    this.unacknowledged = [];
    this.counts = new Map();
    this.isDrawn = false;
    this.paint = null;
    this.words = {
      nameOfObject: (id) => world.nameOf(id),
      colourOfSensor: (sensor) => this.colourOf(sensor),
      materialLooks: new MaterialLooks(world),
    };
    this.isHeld = false;
    this.lastChosen = null;
    connection.addEventListener('open', () => this.subscribe());
    connection.addEventListener('binary', (event) => this.take(this.known(readScan(event.detail))));
    stage.beforeEach(() => this.draw());
    stage.afterEach(() => this.acknowledge());
    for (const name of REDRAWN_BY) settings.watch(name, () => this.redraw());
    settings.watch('sensor', () => this.choose());
    status.addEventListener('changed', () => {
      this.leaveGone();
      this.warn();
    });
    world.addEventListener('changed', () => this.redraw());
  }

  isShown(sensor) {
    return this.layers.has(sensor);
  }

  get shown() {
    return [...this.layers.keys()];
  }

  /** The one that the user has chosen, or the first of those that are shown. */
  get chosen() {
    const wanted = this.settings.get('sensor');
    return this.isShown(wanted) ? wanted : this.shown[0];
  }

  /** It keeps its colour, whoever comes and goes. */
  colourOf(sensor) {
    for (const {name} of this.status.sensors) {
      if (!this.colours.has(name)) this.colours.set(name, this.colours.size);
    }
    return ofScanner(this.colours.get(sensor) || 0);
  }

  show(sensor, on) {
    this.showAll([sensor], on);
  }

  showAll(sensors, on) {
    const others = sensors.filter((sensor) => this.isShown(sensor) !== on);
    if (!others.length) return;
    for (const sensor of others) on ? this.addLayer(sensor) : this.removeLayer(sensor);
    this.subscribe();
    this.choose();
    this.warn();
    this.dispatchEvent(new Event('shown'));
  }

  /**
   * Anybody may take a sensor away, the chosen one as well. In the past it was still there. One that was never there is
   * left to whoever chose it.
   */
  leaveGone() {
    if (this.isHeld) return;
    const {sensors} = this.status;
    this.showAll(this.shown.filter((name) => !this.status.sensor(name)), false);
    const chosen = this.settings.get('sensor');
    if (!sensors.length || this.status.sensor(chosen) || chosen !== this.lastChosen) return;
    const next = this.shown[0] || sensors[0].name;
    this.show(next, true);
    this.settings.set('sensor', next);
  }

  addLayer(sensor) {
    const colour = this.colourOf(sensor);
    const layer = {scan: new ScanLayer(this.settings, colour), mark: new SensorMark(colour)};
    this.layers.set(sensor, layer);
    this.stage.scene.add(layer.scan.group, layer.mark.group);
  }

  /** Of faults that act. */
  warn() {
    for (const [sensor, {mark}] of this.layers) {
      const isFaulty = this.status.sensor(sensor)?.faults.length > 0;
      if (mark.warn(isFaulty)) this.stage.invalidate();
    }
  }

  choose() {
    const wanted = this.settings.get('sensor');
    if (this.status.sensor(wanted)) this.lastChosen = wanted;
    for (const [sensor, {scan}] of this.layers) scan.choose(sensor === this.chosen);
    this.redraw();
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
    this.leaveGone();
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
    if (!this.latest.size) return;
    for (const [sensor, scan] of this.latest) {
      const layer = this.layers.get(sensor);
      layer.scan.take(scan);
      layer.scan.space(this.stage.pixelAt(scan.pose.xyz));
      layer.mark.take(scan);
    }
    this.mixPaint();
    for (const sensor of this.latest.keys()) this.layers.get(sensor).scan.drawNew(this.paint);
    this.latest.clear();
  }

  /** Of all scans that are drawn. */
  mixPaint() {
    const scans = [...this.layers.values()].map(({scan}) => scan.scan).filter(Boolean);
    this.paint = scans.length ? paintOf(this.settings.get('paint'), scans, this.words) : null;
  }

  acknowledge() {
    if (this.unacknowledged.length && !this.isDrawn) {
      this.isDrawn = true;
      performance.mark('first scan');
    }
    for (const frame of this.unacknowledged) this.connection.send({ack: frame});
    this.unacknowledged = [];
  }

  redraw() {
    const extent = this.world.extent();
    this.mixPaint();
    for (const {scan} of this.layers.values()) {
      scan.bound(extent);
      scan.trail.setLength(this.settings.get('trail_s'));
      scan.redraw(this.paint);
    }
    this.stage.invalidate();
  }

  /** The scan of a sensor that came last, drawn or not. */
  newestOf(sensor) {
    return this.latest.get(sensor) || this.scanOf(sensor);
  }

  /** The scan that is drawn of a sensor now. */
  scanOf(sensor) {
    return this.layers.get(sensor)?.scan.scan || null;
  }

  get legend() {
    return this.paint?.legend || null;
  }
}
