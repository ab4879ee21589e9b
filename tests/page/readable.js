// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a page must not have, for page.evaluate(): texts that are hard to read, and things to press without a name.

/** Contrast as WCAG has it, of each text that is seen with what lies under it. */
export function poorContrasts() {
  const rgb = (css) => css.match(/[\d.]+/g).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((each) => each / 255)
    .map((each) => each <= 0.03928 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4)
    .reduce((sum, each, k) => sum + each * [0.2126, 0.7152, 0.0722][k], 0);
  const under = (element) => {
    for (let each = element; each; each = each.parentElement) {
      const colour = rgb(getComputedStyle(each).backgroundColor);
      if (colour.length < 4 || colour[3] > 0.8) return colour;
    }
    return [255, 255, 255];
  };
  const found = [];
  for (const element of document.querySelectorAll('body *')) {
    const hasText = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!hasText || !element.checkVisibility() || element.closest('option')) continue;
    const style = getComputedStyle(element);
    const [a, b] = [light(rgb(style.color)), light(under(element))].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < 4.5) found.push(`${element.textContent.trim().slice(0, 30)}: ${ratio.toFixed(1)}`);
    if (parseFloat(style.fontSize) < 12) found.push(`${element.textContent.trim().slice(0, 30)}: small`);
  }
  return found;
}

export function withoutName() {
  return [...document.querySelectorAll('button, select, input:not([type=file]), canvas, [role=tab]')]
    .filter((element) => element.checkVisibility() && !(element.getAttribute('aria-label') ||
      element.getAttribute('aria-labelledby') || element.textContent.trim() ||
      element.closest('label')?.textContent.trim() || element.matches('.picture')))
    .map((element) => element.outerHTML);
}

/** What is folded is shown. */
export function unfold() {
  for (const each of document.querySelectorAll('details')) each.open = true;
}
