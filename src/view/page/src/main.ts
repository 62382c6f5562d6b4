import { App } from './app';
import { PageSource, ServedSource } from './data/source';
import { byId } from './ui/dom';

async function start(): Promise<void> {
  const served = document.getElementById('edda-run') === null;
  const source = served ? new ServedSource() : new PageSource();
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
