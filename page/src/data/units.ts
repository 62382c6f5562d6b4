// Numbers as people read them. The same rules as the pictures' (src/report/ticks.cpp).

const PREFIXES: [string, number][] = [
  ['G', 1e9], ['M', 1e6], ['k', 1e3], ['', 1], ['m', 1e-3], ['\u00b5', 1e-6], ['n', 1e-9],
];
const WITH_PREFIX = new Set(['m', 'Pa', 'N', 'N m', 'm/s', 'J']);

export interface Scaled {
  unit: string;
  /** Multiply a value in SI by it. */
  factor: number;
}

/** The unit with the prefix that suits the largest value. */
export function scaledUnit(unit: string, largest: number): Scaled {
  if (!WITH_PREFIX.has(unit) || !(largest > 0) || !Number.isFinite(largest)) return { unit, factor: 1 };
  for (const [prefix, size] of PREFIXES) {
    if (unit.startsWith('m') && size > 1) continue; // kilometres would not help
    if (largest >= size * 0.9999) return { unit: prefix + unit, factor: 1 / size };
  }
  return { unit: 'n' + unit, factor: 1e9 };
}

/** Multiples of 1, 2 or 5 times a power of ten within [low, high], about `count` of them. */
export function ticks(low: number, high: number, count: number): { at: number[]; digits: number } {
  const raw = (high - low) / Math.max(count, 1);
  if (!(raw > 0) || !Number.isFinite(raw)) return { at: [], digits: 0 };
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999) ?? 10 * power;
  const at: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) at.push(k * step);
  return { at, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/** `digits` significant ones, without exponent where that stays short. */
export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '\u2013';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e-4 && size < 1e6 ? value.toPrecision(digits) : value.toExponential(digits - 1);
  // 1000 to three digits is 1.00e+3, which nobody writes.
  return (text.includes('e+') ? String(Number(text)) : text).replaceAll('-', '\u2212');
}

/** The same without trailing zeros. */
export function brief(value: number, digits = 4): string {
  const [number, power] = short(value, digits).split('e');
  const text = number.includes('.') ? number.replace(/\.?0+$/, '') : number;
  return power === undefined ? text : `${text}e${power}`;
}

/** With the unit's own prefix: "12.5 mm". */
export function quantity(value: number, unit: string, digits = 4): string {
  if (!Number.isFinite(value)) return '\u2013';
  const scaled = scaledUnit(unit, Math.abs(value));
  const number = short(value * scaled.factor, digits);
  return scaled.unit === '' ? number : `${number} ${scaled.unit}`;
}

/** Of an axis with marks so far apart: as many digits as tell them apart. */
export function tickText(value: number, step: number): string {
  if (!(Math.abs(value) > 1e-6 * step)) return '0';
  // One more than the step's first digit, which may be that of 2.5.
  const digits = Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(step)) + 2;
  return brief(value, Math.max(1, Math.min(digits, 15)));
}
