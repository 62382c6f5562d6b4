// From where to where values are shown, so that a few giants do not make all others look alike: the rule of
// src/report/drawn_range.cpp.

export type Ends = [number, number];

/** Part of the weight that may lie beyond either end. */
const BEYOND = 0.01;
/** An arrow that is longer than the longest meant is drawn so many times as long as that at most. */
export const LONGEST_BEYOND = 1.5;

/** Smallest and largest value of what weighs something; of nothing [Infinity, -Infinity]. */
export function endsOf(values: ArrayLike<number>, weights: ArrayLike<number>): Ends {
  let [low, high] = [Infinity, -Infinity];
  for (let k = 0; k < values.length; ++k) {
    if (!(weights[k] > 0)) continue;
    if (values[k] < low) low = values[k];
    if (values[k] > high) high = values[k];
  }
  return [low, high];
}

/** The least value beyond which, in the direction of `sign`, no more than BEYOND of the weight lies. */
function innerEnd(values: ArrayLike<number>, weights: ArrayLike<number>, [low, high]: Ends, sign: number): number {
  let rest = 0;
  for (let k = 0; k < values.length; ++k) if (weights[k] > 0 && values[k] === values[k]) rest += BEYOND * weights[k];
  let [near, far] = sign > 0 ? [low, high] : [-high, -low];
  while (far > near) {
    const middle = near + 0.5 * (far - near);
    // Values on either side of the middle that come next to it, and what lies beyond it.
    let [above, below, after] = [Infinity, -Infinity, 0];
    for (let k = 0; k < values.length; ++k) {
      const v = sign * values[k];
      if (!(weights[k] > 0)) continue;
      if (v > middle) {
        after += weights[k];
        if (v < above) above = v;
      } else if (v > below) below = v;
    }
    if (after <= rest) far = below;
    else near = above;
  }
  return sign * far;
}

/** The ends to draw by: all values, but for those that lie far beyond nearly all others. */
export function drawnEnds(values: ArrayLike<number>, weights: ArrayLike<number>): Ends {
  const all = endsOf(values, weights);
  if (!(all[1] > all[0])) return all;
  const [low, high] = [innerEnd(values, weights, all, -1), innerEnd(values, weights, all, 1)];
  const size = Math.max(Math.abs(low), Math.abs(high));
  // Where all but a few lie still, those few are what there is to see.
  if (size <= 1e-6 * Math.max(Math.abs(all[0]), Math.abs(all[1]))) return all;
  const [far, kept] = [size, 0.5 * size];
  return [all[0] < low - far ? low - kept : all[0], all[1] > high + far ? high + kept : all[1]];
}
