// Colour maps of ten stops, interpolated in sRGB: viridis, inferno and magma (Smith and van der Walt 2015).
import { clamp } from '../lib/numbers';

const kStops = {
  viridis: ['440154', '482878', '3e4989', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'],
  inferno: ['000004', '1b0c41', '4a0c6b', '781c6d', 'a52c60', 'cf4446', 'ed6925', 'fb9b06', 'f7d13d', 'fcffa4'],
  magma: ['000004', '180f3e', '451077', '721f81', '9f2f7f', 'cd4071', 'f1605d', 'fd9567', 'fec98d', 'fcfdbf'],
} as const;

/** Of what a pane shows. */
export const kColours = { picture: 'viridis', difference: 'inferno', map: 'magma' } as const;

type ColourMap = keyof typeof kStops;
export const kStopCount = 10;

/** sRGB from 0 to 1, for a shader. */
export function stopsOf(map: ColourMap): Float32Array {
  const channels = kStops[map].flatMap((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255));
  return new Float32Array(channels);
}

export function cssGradient(map: ColourMap): string {
  return `linear-gradient(to right, ${kStops[map].map((hex) => '#' + hex).join(', ')})`;
}

/** The colour at `share` of the map, for a cell of the grid. */
export function colourAt(map: ColourMap, share: number): string {
  const stops = stopsOf(map), at = clamp(share, 0, 1) * (kStopCount - 1);
  const from = Math.min(kStopCount - 2, Math.floor(at)), part = at - from;
  const channel = (c: number): number =>
    Math.round(255 * (stops[3 * from + c]! * (1 - part) + stops[3 * from + 3 + c]! * part));
  return `rgb(${channel(0)} ${channel(1)} ${channel(2)})`;
}
