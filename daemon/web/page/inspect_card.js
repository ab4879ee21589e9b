// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A card beside what one looks at closely, with all that is known of it, and a mark on it.
import {Vector3} from './three.module.js';
import {LineMarks, PointMarks} from './marks.js';
import {Pace} from './pace.js';
import {byId, make, tell} from './elements.js';
import {freePlace} from './free_place.js';
import {factsOf, metres, nameOfBeam} from './beam_words.js';
import {sentRange} from './scan_shape.js';

export const CURSOR_COLOUR = [0.80, 0.08, 0.62];
const BETWEEN_MS = 100;
const AWAY_PX = 16;
const MARK_PX = 10;
const OTHERS = ['timeline', 'selected', 'notices', 'legend'];

export class InspectCard {
  constructor({stage, scans, settings, world, inspection, pointed, past, handles, ring}) {
    Object.assign(this, {stage, scans, settings, world, inspection, pointed, past, handles, ring});
    this.card = byId('reading');
    this.pace = new Pace(BETWEEN_MS, () => this.tellFacts());
    this.point = new PointMarks(10, {rim_px: 3, order: 6});
    this.ray = new LineMarks();
    this.point.reserve(1);
    this.ray.reserve(2);
    stage.scene.add(this.ray.group, this.point.group);
    byId('reading-close').addEventListener('click', () => inspection.pin(null));
    inspection.addEventListener('changed', () => {
      this.pace.now();
      stage.invalidate();
    });
    past.addEventListener('changed', () => this.pace.ask());
    const makeWay = new ResizeObserver(() => stage.invalidate());
    for (const other of OTHERS) makeWay.observe(byId(other));
    stage.beforeEach(() => this.mark());
    stage.afterEach(() => this.update());
  }

  /** {scan, i} of the beam that is read, if its sensor still has one. */
  get beam() {
    const {target} = this.inspection;
    const scan = target?.kind === 'beam' ? this.scans.scanOf(target.sensor) : null;
    return scan && target.i < scan.beams ? {scan, i: target.i} : null;
  }

  /** Where in W the card belongs, or null. */
  anchor() {
    const {target} = this.inspection;
    if (target?.kind === 'face') return target.place;
    return this.beam && this.pointed.placeAlong(this.beam.scan, this.beam.i, this.reach_m());
  }

  /** To the point that was sent, or to where the beam really ended. */
  reach_m() {
    const {scan, i} = this.beam;
    const sent_m = sentRange(scan, i);
    return sent_m > 0 ? sent_m : this.pointed.reachOf(scan, i);
  }

  mark() {
    const place = this.anchor();
    this.point.show(place ? 1 : 0);
    this.ray.show(this.beam ? 2 : 0);
    if (!place) return;
    this.point.put(0, place.x, place.y, place.z);
    this.point.tint(0, CURSOR_COLOUR, 1);
    if (!this.beam) return;
    const {scan, i} = this.beam;
    [0, this.reach_m()].forEach((range_m, k) => {
      this.ray.putAlong(k, this.pointed.shapeOf(scan), i, range_m);
      this.ray.tint(k, CURSOR_COLOUR, 1);
    });
  }

  update() {
    const place = this.anchor();
    const at = place && this.pointed.project(place);
    this.card.hidden = !at;
    if (!at) return;
    byId('reading-close').hidden = this.inspection.target !== this.inspection.pinned;
    this.pace.ask();
    this.moveTo(at);
  }

  tellFacts() {
    const {target} = this.inspection;
    if (this.beam) {
      const {scan, i} = this.beam;
      tell(byId('reading-name'), `${scan.sensor}, ${nameOfBeam(scan, i)}`);
      this.list(factsOf(scan, i, (id) => this.world.nameOf(id), this.past.looksAt_s - scan.got_s));
    } else if (target?.kind === 'face') {
      tell(byId('reading-name'), target.object.name);
      this.list(this.factsOfFace(target));
    }
  }

  factsOfFace({object, place}) {
    const scan = this.scans.scanOf(this.settings.get('sensor'));
    const sensor = scan && new Vector3(...scan.pose.xyz);
    return [
      ['Material', object.material],
      ...(object.model ? [['Model', object.model]] : []),
      ...(object.robot ? [['Robot', object.robot]] : []),
      ['Place', place.toArray().map((value) => value.toFixed(3)).join(', ') + ' m'],
      ...(sensor ? [['Away', `${metres(sensor.distanceTo(place))} from ${scan.sensor}`]] : []),
    ];
  }

  list(facts) {
    const labels = facts.map(([label]) => label).join();
    const list = byId('reading-facts');
    if (labels !== this.labels) {
      this.labels = labels;
      list.replaceChildren(...facts.map(([label]) => make('div', {}, make('dt', {}, label), make('dd'))));
    }
    facts.forEach(([, text], k) => tell(list.children[k].lastChild, text));
  }

  /** On the page, around the handles and the ring of the selected thing. */
  gripBoxes(view) {
    return [...this.handles.places(), ...this.ring.places()].flatMap(({place, radius_px}) => {
      const at = this.pointed.project(place);
      if (!at) return [];
      const [x, y] = [view.left + at.x, view.top + at.y];
      return [{left: x - radius_px, right: x + radius_px, top: y - radius_px, bottom: y + radius_px}];
    });
  }

  /** Beside the place, on the side that has room, and over nothing else as far as can be. */
  moveTo({x, y}) {
    const view = this.stage.canvas.getBoundingClientRect();
    const {offsetWidth: width, offsetHeight: height} = this.card;
    const at = {x: view.left + x, y: view.top + y};
    const isRight = at.x + AWAY_PX + width < view.right;
    const wanted = {left: isRight ? at.x + AWAY_PX : at.x - AWAY_PX - width, top: at.y + AWAY_PX};
    const mark = {left: at.x - MARK_PX, right: at.x + MARK_PX, top: at.y - MARK_PX, bottom: at.y + MARK_PX};
    const others = OTHERS.map(byId).filter((each) => each.checkVisibility());
    const taken = [mark, ...others.map((each) => each.getBoundingClientRect()), ...this.gripBoxes(view)];
    const {left, top} = freePlace(wanted, {width, height}, view, taken);
    this.card.style.left = `${left - view.left}px`;
    this.card.style.top = `${top - view.top}px`;
  }
}
