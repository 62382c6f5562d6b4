// Frames by number: unpacked beside, ahead of the play, and forgotten when there are too many.
import type { Frame } from './frame';
import type { Mesh } from './mesh';
import type { Run } from './run';
import { Absent, type Source } from './source';
import type { Done, Job, Setup } from './worker';
import workerCode from 'worker:./worker.ts';

const MOST_BYTES = 384e6;

export class Frames {
  private readonly worker: Worker;
  private readonly kept = new Map<number, Frame>(); // oldest use first
  private readonly waiting = new Map<number, { resolve: (f: Frame) => void; reject: (e: Error) => void }[]>();
  private queue: number[] = [];
  private busy = 0;

  /** `absent`: numbers that the run's frames have not, zeros as they were packed. */
  constructor(private readonly source: Source, private readonly mesh: Mesh, private readonly absent: Run['absent']) {
    this.worker = new Worker(URL.createObjectURL(new Blob([workerCode], { type: 'text/javascript' })));
    this.worker.onmessage = ({ data }: MessageEvent<Done>) => this.done(data);
    this.worker.postMessage({ blocks: mesh.blocks, edgeBegin: mesh.edgeBegin, reach: mesh.reach, zones: mesh.zones } satisfies Setup);
  }

  /** Frames that may be kept. */
  get room(): number {
    return Math.max(4, Math.floor(MOST_BYTES / (72 * this.mesh.parts + 40 * 4 * this.mesh.blocks + 1)));
  }

  ready(index: number): Frame | undefined {
    const frame = this.kept.get(index);
    if (frame !== undefined) {
      this.kept.delete(index);
      this.kept.set(index, frame);
    }
    return frame;
  }

  want(index: number): Promise<Frame> {
    const frame = this.ready(index);
    if (frame !== undefined) return Promise.resolve(frame);
    return new Promise((resolve, reject) => {
      const others = this.waiting.get(index);
      if (others !== undefined) {
        others.push({ resolve, reject });
        return;
      }
      this.waiting.set(index, [{ resolve, reject }]);
      this.queue.push(index);
      this.next();
    });
  }

  /** Those that will be wanted soon. */
  prepare(indices: number[]): void {
    const ahead = Math.min(this.room - 2, 8);
    for (const index of indices.slice(0, ahead)) if (!this.kept.has(index)) this.want(index).catch(() => {});
  }

  private next(): void {
    // Two at a time: one is fetched while the other is unpacked.
    while (this.busy < 2 && this.queue.length > 0) {
      ++this.busy;
      this.worker.postMessage(this.source.job(this.queue.shift()!) satisfies Job);
    }
  }

  private done(done: Done): void {
    --this.busy;
    const waiting = this.waiting.get(done.index) ?? [];
    this.waiting.delete(done.index);
    if (done.frame !== undefined) {
      for (const name of this.absent) if (name in done.frame) done.frame[name as 'omega'].fill(NaN);
      this.kept.set(done.index, done.frame);
      for (const oldest of this.kept.keys()) {
        if (this.kept.size <= this.room) break;
        this.kept.delete(oldest);
      }
      for (const w of waiting) w.resolve(done.frame);
    } else {
      const error = done.absent ? new Absent(done.error) : new Error(done.error);
      for (const w of waiting) w.reject(error);
    }
    this.next();
  }
}
