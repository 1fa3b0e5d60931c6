// The line below the pictures that explains their colours.
import { h } from '../lib/dom';
import { numberText, percentText } from '../lib/numbers';
import { cssGradient } from './colours';
import { kDecades, type ViewerState } from './viewer_state';

const kLeastOfMap = 2 ** -10;  // gallery/site/difference_maps.cpp

export function legendOf(viewer: ViewerState, a: number, b: number): (HTMLElement | string)[] {
  const mode = viewer.choice.mode();
  const ramp = h('span', { class: 'ramp' });
  const isFalse = viewer.isFalseColour();
  const map = viewer.mapOf(a, b);
  if (map) {
    const white = viewer.white(a, b), { least, block, mantissaBits } = map.picture;
    ramp.style.background = cssGradient('magma');
    return [h('span', {}, isFalse ? numberText(white * 10 ** -kDecades) : '0'), ramp, h('span', {}, numberText(white)),
      h('span', {}, `${map.title}: ${map.meaning}; the largest is ${numberText(map.worst.value)}, and what is under ${numberText(Math.max(least, kLeastOfMap))} counts as 0${mantissaBits < 4 ? `; to ± ${percentText(2 ** -(mantissaBits + 1))}` : ''}${block > 1 ? `; each ${block} × ${block} pixels by their largest` : ''}`)];
  }
  if (mode === 'diff') {
    const white = viewer.white(a, b), measure = viewer.choice.measure(), peak = viewer.isFloat ? viewer.pictures.largestOf(b, b, 'value') : NaN;
    if (measure === 'signed') ramp.style.background = 'linear-gradient(to right, rgb(76 166 255), rgb(15 15 15), rgb(255 115 51))';
    else if (isFalse) ramp.style.background = cssGradient('inferno');
    const low = measure === 'signed' ? '−' + numberText(white) : isFalse ? numberText(white * 10 ** -kDecades) : '0';
    const share = measure === 'relative' ? percentText(white) : numberText(white) + (Number.isFinite(peak) ? ` = ${percentText(white / peak)} of the peak` : '');
    return [h('span', {}, low), ramp, h('span', {}, share), missingMap(viewer) ?? precisionNote(viewer, a, b)];
  }
  if (isFalse) {
    const { top } = viewer.look(a, b);
    ramp.style.background = cssGradient('viridis');
    return [h('span', {}, numberText(top * 10 ** -kDecades)), ramp, h('span', {}, numberText(top) + ', logarithmic')];
  }
  return [h('span', {}, `radiance times ${numberText(2 ** viewer.choice.stops())}, as sRGB`)];
}

/** Why the difference of values is shown in place of a chosen map. */
function missingMap(viewer: ViewerState): HTMLElement | undefined {
  const asked = viewer.choice.mapAsked(), there = asked && viewer.choice.comparison(viewer.choice.engine('a'), viewer.choice.engine('b'))?.maps.some((m) => m.id === asked.value);
  return !asked ? undefined : h('span', {}, there ? viewer.isFloat ? `${asked.label} is on its way` : `${asked.label} needs float pictures`
    : `|a − b|: ${asked.label} was made of ours and each engine`);
}

/** The precision of a difference on this page, which stores differences from ours. */
function precisionNote(viewer: ViewerState, a: number, b: number): HTMLElement {
  const stored = [a, b].flatMap((i) => { const p = viewer.pictures.all.get(i); return p?.fromOurs ? [p] : []; });
  if (stored.length === 0) return h('span', {}, viewer.isFloat || a === b ? '' : 'the recorded picture');
  const bits = Math.min(...stored.map((p) => p.mantissaBits)), least = Math.max(...stored.map((p) => p.least));
  return h('span', {}, `to ± ${percentText(2 ** -(bits + 1))}${least > 0 ? `, nothing under ${numberText(least)}` : ''} of what float32 has`);
}
