// What is said while the served folder has nothing to show.
import { byId } from './dom';

export function showWaiting(why: Error): void {
  byId('fault').hidden = true;
  const chip = byId('status');
  chip.textContent = `waiting: ${why.message}`;
  chip.title = why.message;
  chip.classList.remove('bad');
}
