// Which frame is shown, and when the next one is.
import type { Frames } from '../data/frames';

/** A run lasts so long at speed 1, s; few frames are not stretched to slides. */
const LENGTH = 12;
const MOST_SECONDS_A_FRAME = 0.25;

export class Player {
  index = 0;
  playing = false;
  /** Times the usual one; 0: each frame, as fast as it can be drawn. */
  speed = 1;
  private clock = 0; // run time reached, s
  private last = 0; // of the screen, ms

  constructor(private times: number[], private readonly frames: Frames, private readonly changed: () => void) {
    this.index = times.length - 1;
  }

  setTimes(times: number[]): void {
    this.times = times;
  }
  get time(): number {
    return this.times[this.index] ?? 0;
  }
  get end(): number {
    return this.times.length - 1;
  }

  go(index: number): void {
    this.index = Math.max(0, Math.min(this.end, index));
    if (this.index === this.end) this.playing = false;
    this.clock = this.time;
    this.changed();
  }
  seek(time: number): void {
    let best = 0;
    this.times.forEach((t, k) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = k;
    });
    this.go(best);
  }
  toggle(): void {
    if (!this.playing && this.index === this.end) this.go(0);
    this.playing = !this.playing;
    this.clock = this.time;
    this.last = 0;
    this.changed();
  }

  /** At each frame of the screen. `now` in ms. */
  tick(now: number): void {
    if (!this.playing) return;
    const passed = this.last === 0 ? 0 : Math.min(now - this.last, 250) / 1000;
    this.last = now;
    const next = this.speed === 0 ? Math.min(this.index + 1, this.end) : this.after(passed);
    this.frames.prepare(Array.from({ length: 8 }, (_, k) => next + k + 1).filter((k) => k <= this.end));
    if (next === this.index) return;
    if (this.frames.ready(next) === undefined) {
      this.frames.want(next).catch(() => {});
      this.clock = this.time; // the run waits for its frame
      return;
    }
    this.index = next;
    if (next === this.end) this.playing = false;
    this.changed();
  }

  private after(passed: number): number {
    const span = this.times[this.end] - this.times[0];
    const seconds = Math.min(LENGTH, MOST_SECONDS_A_FRAME * this.end);
    this.clock += (passed * this.speed * span) / Math.max(seconds, 1e-9);
    let k = this.index;
    while (k < this.end && this.times[k + 1] <= this.clock * (1 + 1e-12)) ++k;
    return k;
  }
}
