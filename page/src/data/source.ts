// Where the run comes from: this page, or the program that serves it.
import { fromBase64, inflate } from './inflate';
import type { Run } from './run';
import type { Job } from './worker';

/** A run that has no frame yet, or that is being cleared for another: it is asked for again. */
export class Absent extends Error {}

export interface Source {
  run(): Promise<Run>;
  /** A chunk's bytes, inflated; undefined where there is none. */
  chunk(name: string): Promise<Uint8Array | undefined>;
  /** How the worker gets a frame. */
  job(frame: number): Job;
}

/** What a served chunk's status is where its run has gone. */
export const GONE = 204;

export class PageSource implements Source {
  async run(): Promise<Run> {
    return JSON.parse(this.text('run')!) as Run;
  }
  async chunk(name: string): Promise<Uint8Array | undefined> {
    const text = this.text(name);
    return text === undefined ? undefined : inflate(fromBase64(text));
  }
  job(frame: number): Job {
    return { index: frame, text: this.text(`frame-${frame}`) };
  }
  private text(name: string): string | undefined {
    return document.getElementById(`edda-${name}`)?.textContent ?? undefined;
  }
}

export class ServedSource implements Source {
  /** Of the run that was asked for first: the page shows no other. */
  private name?: string;

  async run(): Promise<Run> {
    const reply = await fetch('run');
    if (!reply.ok) throw new Error(await reply.text());
    const answer = (await reply.json()) as Run | { waiting: string };
    if ('waiting' in answer) throw new Absent(answer.waiting);
    this.name ??= answer.run;
    return answer;
  }
  async chunk(name: string): Promise<Uint8Array | undefined> {
    const reply = await fetch(this.address(name));
    if (reply.status === GONE) throw new Absent('the folder holds another run now');
    if (reply.status === 404) return undefined;
    if (!reply.ok) throw new Error(await reply.text());
    return inflate(new Uint8Array(await reply.arrayBuffer()));
  }
  job(frame: number): Job {
    return { index: frame, url: this.address(`frame-${frame}`) };
  }
  private address(name: string): string {
    return new URL(`chunk/${name}?run=${encodeURIComponent(this.name ?? '')}`, location.href).href;
  }
}
