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

/** A linear value as a display has it, both from 0 to 1. */
export const encoded = (v: number): number => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);

/** Three numbers a stop, from 0 to 255. */
export const stopsOf = (map: ColourMap): number[] =>
  kStops[map].flatMap((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

/** Red, green and blue at `share` of the stops. */
export function between(stops: readonly number[], share: number): number[] {
  const last = stops.length / 3 - 1, at = clamp(share, 0, 1) * last, from = Math.min(last - 1, Math.floor(at)), part = at - from;
  return [0, 1, 2].map((c) => stops[3 * from + c]! * (1 - part) + stops[3 * from + 3 + c]! * part);
}

export const cssColour = (rgb: readonly number[]): string => `rgb(${rgb.map(Math.round).join(' ')})`;

export function cssGradient(map: ColourMap): string {
  return `linear-gradient(to right, ${kStops[map].map((hex) => '#' + hex).join(', ')})`;
}

export const colourAt = (map: ColourMap, share: number): string => cssColour(between(stopsOf(map), share));
