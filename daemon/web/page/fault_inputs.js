// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Inputs for what the members of a fault can be. Each is {element, value()}; value() is undefined of one that is left
// to its default, and throws what is wrong in words.
import {make} from './elements.js';

const WAYS = {
  rate: ['share, %', 'such as 1'],
  at: ['at offsets', 'such as 0, 17'],
  every: ['every N', 'such as 64'],
};
const COMMANDS = ['MD', 'ME', 'GD', 'GE', 'HD', 'HE', 'ND', 'NE', 'VV', 'PP', 'II', 'BM', 'QT', 'RS', 'RB'];

/** name: of the member; spec: of fault_fields; example: what it begins with, or undefined. */
export function faultInput(name, spec, example) {
  return MAKERS[spec.type](name, spec, example);
}

const MAKERS = {words, number, share, vector, flag, code, status, bytes, steps};

function field(name, {about}, ...inputs) {
  return make('div', {class: 'field', title: about}, make('span', {}, name), make('span', {class: 'row'}, ...inputs));
}

function numberInput(label, {least, most, inside, whole, fallback = 'none'}, example) {
  return make('input', {type: 'number', 'aria-label': label, min: inside ? least + 0.001 : least, max: most,
    step: whole ? 1 : 'any', placeholder: String(fallback), value: example ?? ''});
}

/** Of an input that holds what is no number nothing can be read, and nothing must be left out for it. */
function numberOf(input, label) {
  if (!input.checkValidity()) throw new Error(`${label}: ${input.validationMessage}`);
  return input.value === '' ? undefined : input.valueAsNumber;
}

function words(name, spec, example) {
  const first = spec.fallback ? make('option', {value: ''}, `${spec.fallback} (default)`) : null;
  const list = make('select', {name, 'aria-label': name}, ...(first ? [first] : []),
    ...spec.words.filter((word) => word !== spec.fallback).map((value) => make('option', {value}, value)));
  list.value = example === spec.fallback ? '' : example ?? list.value;
  return {element: field(name, spec, list), value: () => list.value || undefined};
}

function number(name, spec, example) {
  const input = numberInput(`${name} in ${spec.unit}`, spec, example);
  input.name = name;
  return {element: field(name, spec, input, make('span', {class: 'unit'}, spec.unit)),
    value: () => numberOf(input, name)};
}

/** The daemon has shares from 0 to 1. */
function share(name, spec, example) {
  const input = numberInput(`${name} in %`, {least: 0, most: 100, fallback: spec.fallback}, percentOf(example));
  input.name = name;
  return {element: field(name, spec, input, make('span', {class: 'unit'}, '%')),
    value: () => shareOf(numberOf(input, name))};
}

function percentOf(rate) {
  return rate === undefined ? undefined : Number((100 * rate).toPrecision(6));
}

function shareOf(percent) {
  return percent === undefined ? undefined : percent / 100;
}

function vector(name, spec, example = []) {
  const inputs = ['x', 'y', 'z'].map((axis, i) => numberInput(`${name}: about ${axis} in ${spec.unit}`,
    {least: -spec.most, most: spec.most, fallback: 0}, example[i]));
  return {
    element: field(name, spec, ...inputs, make('span', {class: 'unit'}, spec.unit)),
    value: () => {
      const values = inputs.map((input) => numberOf(input, name));
      return values.some((each) => each !== undefined) ? values.map((each) => each ?? 0) : undefined;
    },
  };
}

function flag(name, spec, example) {
  const box = make('input', {type: 'checkbox', name, 'aria-label': name, checked: Boolean(example)});
  return {element: field(name, spec, box, make('span', {class: 'dim'}, spec.about)),
    value: () => box.checked || undefined};
}

function textInput(name, spec, example, pattern, title) {
  const input = make('input', {name, 'aria-label': name, autocomplete: 'off', spellcheck: 'false', pattern, title,
    placeholder: spec.fallback, value: example ?? '', list: `list-of-${spec.type}`});
  return {element: field(name, spec, input), input, value: () => {
    if (!input.checkValidity()) throw new Error(`${name}: ${title}`);
    return input.value.trim() || undefined;
  }};
}

function code(name, spec, example) {
  const made = textInput(name, spec, example, '[A-Z%][A-Z0-9%]{0,3}', 'the code of a command, such as MD');
  made.element.append(make('datalist', {id: 'list-of-code'}, ...COMMANDS.map((value) => make('option', {value}))));
  return made;
}

function status(name, spec, example) {
  return textInput(name, spec, example, '[0-9A-Z]{2}', 'two of 0-9 and A-Z');
}

function bytes(name, spec, example = {}) {
  const [begun] = Object.keys(example);
  const list = make('select', {'aria-label': `${name}: which`},
    ...spec.ways.map((way) => make('option', {value: way}, WAYS[way][0])));
  list.value = begun ?? spec.ways[0];
  const text = make('input', {'aria-label': name, name, autocomplete: 'off', value: shownBytes(begun, example[begun])});
  const hint = () => { text.placeholder = WAYS[list.value][1]; };
  list.addEventListener('change', () => { text.value = ''; hint(); });
  hint();
  return {element: field(name, spec, list, text), value: () => readBytes(name, list.value, text.value, spec)};
}

function shownBytes(way, value) {
  if (value === undefined) return '';
  return way === 'rate' ? String(percentOf(value)) : [value].flat().join(', ');
}

function readBytes(name, way, text, {least, most}) {
  const numbers = text.split(/[,\s]+/).filter(Boolean).map(Number);
  const fits = (each) => way === 'rate' ? each >= 0 && each <= 100
    : Number.isInteger(each) && each >= Math.max(least, way === 'every' ? 1 : 0) && each <= most;
  if (!numbers.length || !numbers.every(fits) || (way !== 'at' && numbers.length > 1)) {
    throw new Error(`${name}: ${way === 'rate' ? 'a number from 0 to 100' : `whole numbers from ${least} to ${most}`}`);
  }
  if (way === 'rate') return {rate: shareOf(numbers[0])};
  return {[way]: way === 'at' ? numbers : numbers[0]};
}

function steps(name, spec, example = []) {
  const inputs = ['first', 'last'].map((which, i) =>
    numberInput(`${which} step`, {...spec, whole: true, fallback: spec.fallback ?? which}, example[i]));
  return {
    element: field(name, spec, inputs[0], make('span', {class: 'dim'}, 'to'), inputs[1]),
    value: () => {
      const [first, last] = inputs.map((input) => numberOf(input, name));
      if ((first === undefined) !== (last === undefined)) throw new Error(`${name}: both ends of the sector, or none`);
      return first === undefined ? undefined : [first, last];
    },
  };
}
