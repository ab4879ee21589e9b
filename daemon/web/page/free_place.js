// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a card covers as little as can be of what else lies on the view. Boxes are {left, top, right, bottom}, in
// pixels.

const MARGIN_PX = 6;

/** {left, top} for a card of {width, height}: the place nearest to the wanted one. All of it is within the view. */
export function freePlace(wanted, {width, height}, view, others) {
  const within = (at, least, most) => Math.max(Math.min(at, most - MARGIN_PX), least + MARGIN_PX);
  const lefts = [wanted.left, ...others.flatMap(({left, right}) => [left - width - MARGIN_PX, right + MARGIN_PX])];
  const tops = [wanted.top, ...others.flatMap(({top, bottom}) => [top - height - MARGIN_PX, bottom + MARGIN_PX])];
  const places = lefts.flatMap((left) => tops.map((top) => ({
    left: within(left, view.left, view.right - width), top: within(top, view.top, view.bottom - height)})));
  const covered = ({left, top}) => others.reduce((sum, other) =>
    sum + commonArea({left, top, right: left + width, bottom: top + height}, other), 0);
  const away = ({left, top}) => Math.hypot(left - wanted.left, top - wanted.top);
  return places.map((place) => ({place, covered: covered(place), away: away(place)}))
    .reduce((best, each) => (each.covered - best.covered || each.away - best.away) < 0 ? each : best).place;
}

function commonArea(a, b) {
  const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const up = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return Math.max(across, 0) * Math.max(up, 0);
}
