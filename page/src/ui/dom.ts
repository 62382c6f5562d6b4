// Elements by id, and few ways to make them.

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`no element "${id}"`);
  return element as T;
}

export function make(tag: string, text = '', attributes: Record<string, string> = {}): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = text;
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/** Fills a select with [value, text] pairs; keeps what was chosen where it is still there. */
export function options(select: HTMLSelectElement, pairs: [string, string][]): void {
  const before = select.value;
  select.replaceChildren(...pairs.map(([value, text]) => make('option', text, { value })));
  if (pairs.some(([value]) => value === before)) select.value = before;
}
