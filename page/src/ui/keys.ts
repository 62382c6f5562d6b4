// What the keys do; the same list is shown as help.
import { byId, make } from './dom';

export interface Key {
  keys: string[];
  shown: string;
  does: string;
  act: () => void;
}

export function listenToKeys(keys: Key[]): void {
  byId('key-list').replaceChildren(
    ...keys.map((key) => {
      const row = make('tr');
      const name = make('td');
      name.append(make('kbd', key.shown));
      row.append(name, make('td', key.does));
      return row;
    }),
  );
  document.addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || byId<HTMLDialogElement>('keys').open) return;
    const target = e.target as HTMLElement;
    // Keys that mean something to what has the focus stay with it.
    if (target.matches('select, input[type="number"]')) return;
    if (target.matches('input[type="range"]') && e.key.startsWith('Arrow')) return;
    if (target.matches('button, input[type="checkbox"]') && (e.key === ' ' || e.key === 'Enter')) return;
    const key = keys.find((k) => k.keys.includes(e.key.length === 1 ? e.key.toLowerCase() : e.key));
    if (key === undefined) return;
    e.preventDefault();
    key.act();
  });
}
