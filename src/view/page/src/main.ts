import { App } from './app';
import { PageSource, ServedSource } from './data/source';
import { byId } from './ui/dom';

/** A run that is served may have no frame yet. */
async function begin(source: ServedSource): Promise<void> {
  const fault = byId('fault');
  for (;;) {
    const answer = await source.run().catch((error: Error) => error);
    fault.hidden = !(answer instanceof Error);
    if (!(answer instanceof Error)) return;
    fault.textContent = answer.message;
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}

async function start(): Promise<void> {
  const served = document.getElementById('edda-run') === null;
  const source = served ? new ServedSource() : new PageSource();
  if (source instanceof ServedSource) await begin(source);
  const app = await App.open(source);
  // For tests and for the curious.
  Object.assign(window, { edda: app });
}

start().catch((error: unknown) => {
  const fault = byId('fault');
  fault.hidden = false;
  fault.textContent = error instanceof Error ? error.message : String(error);
  console.error(error);
});
