// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one did, and how to take it back: a list of {what, back()}. Deeds that take their time happen one after the
// other, so that what is undone is what was done last, however fast the keys are.

const MOST = 100;

export class Undo extends EventTarget {
  constructor({world, notices, mover}) {
    super();
    Object.assign(this, {world, notices, mover});
    this.deeds = [];
    this.era = 0;
    this.last = Promise.resolve();
  }

  /** Acts when all that came before is done. */
  inTurn(act) {
    this.last = this.last.then(act, act);
    return this.last;
  }

  /**
   * back is a function that returns a promise. A deed that took its time gives the era that it was begun in: another
   * world may be there by now.
   */
  did(what, back, era = this.era) {
    if (era !== this.era) return;
    this.deeds.push({what, back});
    if (this.deeds.length > MOST) this.deeds.shift();
    this.dispatchEvent(new Event('changed'));
  }

  /** In another world other things have the same names. */
  forget() {
    ++this.era;
    this.deeds = [];
    this.dispatchEvent(new Event('changed'));
  }

  moved(thing, from) {
    this.did(`moved ${thing.name}`, () => this.mover.moveBack(thing, from));
  }

  get next() {
    return this.deeds[this.deeds.length - 1]?.what || null;
  }

  undo() {
    return this.inTurn(() => this.undoLast());
  }

  async undoLast() {
    // Whoever is told of another world by the header may be faster than its objects.
    await this.world.load().catch(() => {});
    const {era} = this;
    const deed = this.deeds.pop();
    this.dispatchEvent(new Event('changed'));
    if (!deed) {
      this.notices.tell('There is nothing to undo.');
      return;
    }
    try {
      await deed.back();
      this.notices.tell(`Undone: ${deed.what}`);
    } catch (error) {
      // The daemon may be away for a moment; what it refuses it will refuse again.
      if (!error.status && era === this.era) this.deeds.push(deed);
      this.dispatchEvent(new Event('changed'));
      this.notices.trouble(`This cannot be undone (${deed.what}): ${error.message}`);
    }
  }
}
