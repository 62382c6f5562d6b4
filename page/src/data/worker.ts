// Unpacks frames beside the page's own thread.
import { type Beginnings, buffersOf, type Frame, readFrame } from './frame';
import { fromBase64, inflate } from './inflate';
import { Absent, GONE } from './source';

/** First: what is needed of the mesh. */
export type Setup = Beginnings;
/** Then a frame at a time: base64, or where to fetch it. */
export interface Job {
  index: number;
  text?: string;
  url?: string;
}
export interface Done {
  index: number;
  frame?: Frame;
  error?: string;
  /** Its run has gone. */
  absent?: boolean;
}

let mesh: Beginnings;

async function unpack(job: Job): Promise<Frame> {
  if (job.text !== undefined) return readFrame(await inflate(fromBase64(job.text)), mesh);
  const reply = await fetch(job.url!);
  if (reply.status === GONE) throw new Absent(`frame ${job.index} has gone`);
  if (!reply.ok) throw new Error(`frame ${job.index}: ${await reply.text()}`);
  return readFrame(await inflate(new Uint8Array(await reply.arrayBuffer())), mesh);
}

// A worker's own global; the page's types know it as a window.
const self_ = self as unknown as {
  onmessage: (event: MessageEvent<Setup | Job>) => void;
  postMessage: (message: Done, transfer?: Transferable[]) => void;
};

self_.onmessage = async ({ data }) => {
  if ('edgeBegin' in data) {
    mesh = data;
    return;
  }
  try {
    const frame = await unpack(data);
    self_.postMessage({ index: data.index, frame }, buffersOf(frame));
  } catch (error) {
    self_.postMessage({ index: data.index, error: String(error), absent: error instanceof Absent });
  }
};
