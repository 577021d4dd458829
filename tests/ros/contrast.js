// Texts that are shown, with the ratio of their contrast to their background (WCAG 2.2, 1.4.3), and controls, with
// that of their border, or of their face, to their surroundings (1.4.11).
const rgba = (text) => {
  const found = /rgba?\(([^)]+)\)/.exec(text);
  if (!found) return null;
  const [r, g, b, a = 1] = found[1].split(/[\s,/]+/).map(Number);
  return [r, g, b, a];
};
const over = (top, below) => [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3])).concat(1);
const luminance = (color) => {
  const [r, g, b] = color.map((x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const ratio = (a, b) => {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
};
const chain = (e) => (e ? [...chain(e.parentElement), e] : []);
/** Colors that can be behind an element: of a gradient both ends. */
const behind = (element) => {
  let all = [[255, 255, 255, 1]];
  for (const e of chain(element)) {
    const style = getComputedStyle(e), plain = rgba(style.backgroundColor), alpha = e === element ? 1 : Number(style.opacity);
    if (plain) all = all.map((below) => over([...plain.slice(0, 3), plain[3] * alpha], below));
    const stops = [...style.backgroundImage.matchAll(/rgba?\([^)]+\)/g)].map((m) => rgba(m[0]));
    if (stops.length) all = all.flatMap((below) => stops.map((stop) => over(stop, below)));
    if (e.tagName === 'svg') all = [...document.querySelectorAll('svg .room-shape')].map((room) => rgba(getComputedStyle(room).fill)).concat(all);
  }
  return all;
};
for (const animation of document.getAnimations()) animation.finish();
const results = [];
for (const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT); walker.nextNode();) {
  const text = walker.currentNode.textContent.trim(), e = walker.currentNode.parentElement;
  if (!text || e.closest('script, noscript, [aria-hidden="true"] option') || e.closest('button, select, input')?.disabled) continue;
  if (!e.checkVisibility({ visibilityProperty: true }) || (!e.getClientRects().length && e.tagName !== 'OPTION')) continue;
  const style = getComputedStyle(e), color = rgba(e instanceof SVGElement ? style.fill : style.color);
  const alpha = chain(e).reduce((product, one) => product * Number(getComputedStyle(one).opacity), 1);
  const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
  const least = Math.min(...behind(e).map((below) => ratio(over([...color.slice(0, 3), color[3] * alpha], below), below)));
  results.push({ text: text.slice(0, 40), of: `${e.tagName}.${e.getAttribute('class') ?? ''}#${e.closest('[id]')?.id}`, ratio: least, needed: large ? 3 : 4.5 });
}
for (const e of document.querySelectorAll('button, select, input, canvas.map, .stick')) {
  const style = getComputedStyle(e), border = rgba(style.borderTopColor), face = rgba(style.backgroundColor);
  if (e.disabled || !e.checkVisibility({ visibilityProperty: true }) || ['range', 'checkbox'].includes(e.type)) continue;
  if (parseFloat(style.borderTopWidth) === 0 && face[3] === 0) continue; // a text that one clicks
  const least = Math.min(...behind(e.parentElement).map((around) => Math.max(
    parseFloat(style.borderTopWidth) > 0 ? ratio(over(border, around), around) : 1, ratio(over(face, around), around))));
  results.push({ text: (e.textContent || e.type || '').slice(0, 40), of: `${e.tagName}.${e.className}`, ratio: least, needed: 3 });
}
return results;
