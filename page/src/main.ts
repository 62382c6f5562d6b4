import { App, ASK_EVERY } from './app';
import { readResults, type Results } from './data/results';
import { Absent, PageSource, ServedSource, type Source } from './data/source';
import { byId } from './ui/dom';
import { showWaiting } from './ui/waiting';

/** A run that is served may have no frame yet, or go while it is read. */
async function served(): Promise<[Source, Results]> {
  const fault = byId('fault');
  for (;;) {
    const source = new ServedSource();
    const results = await readResults(source).catch((error: Error) => error);
    fault.hidden = true;
    if (!(results instanceof Error)) return [source, results];
    if (results instanceof Absent) {
      showWaiting(results);
    } else {
      fault.hidden = false;
      fault.textContent = results.message;
    }
    await new Promise((resolve) => setTimeout(resolve, ASK_EVERY));
  }
}

async function inside(): Promise<[Source, Results]> {
  const source = new PageSource();
  return [source, await readResults(source)];
}

async function start(): Promise<void> {
  const [source, results] = await (document.getElementById('edda-run') === null ? served() : inside());
  // For tests and for the curious.
  Object.assign(window, { edda: new App(source, results) });
}

start().catch((error: unknown) => {
  const fault = byId('fault');
  fault.hidden = false;
  fault.textContent = error instanceof Error ? error.message : String(error);
  console.error(error);
});
