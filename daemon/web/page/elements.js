// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes elements of the document. No text of the daemon's is ever read as HTML.

const SVG = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name === 'on') {
      for (const [event, act] of Object.entries(value)) element.addEventListener(event, act);
    } else if (name === 'value' || name === 'checked') {
      element[name] = value;
    } else {
      element.setAttribute(name, value === true ? '' : value);
    }
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** make('button', {class: 'quiet', on: {click}}, 'Text', child) */
export function make(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function makeSvg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

export function byId(id) {
  return document.getElementById(id);
}

/** While one is open, what lies behind it is out of reach. */
export function isDialogOpen() {
  return document.querySelector('dialog[open]') !== null;
}

/** Changes a text only if it differs, so that nothing is laid out or read aloud for nothing. */
export function tell(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** A checkbox or a select with its label, which is bound to a setting of this name. */
export function boundCheckbox(settings, name, label, hint) {
  const box = make('input', {type: 'checkbox', checked: settings.get(name)});
  box.addEventListener('change', () => settings.set(name, box.checked));
  settings.watch(name, (value) => { box.checked = value; });
  return make('label', {class: 'check', title: hint}, box, make('span', {}, label));
}

export function boundSelect(settings, name, label, options) {
  const list = make('select', {}, ...options.map(
    ([value, text]) => make('option', {value}, text)));
  list.value = String(settings.get(name));
  const isNumber = typeof settings.get(name) === 'number';
  list.addEventListener('change', () =>
    settings.set(name, isNumber ? Number(list.value) : list.value));
  settings.watch(name, (value) => { list.value = String(value); });
  return make('label', {class: 'field'}, make('span', {}, label), list);
}
