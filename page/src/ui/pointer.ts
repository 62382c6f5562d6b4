// Moving, zooming and clicking on the drawing with mouse, touch or keys.
import type { Camera } from '../scene/camera';

export interface PointerActions {
  moved(): void;
  clicked(x: number, y: number): void;
  fit(): void;
}

export function listenToPointer(element: HTMLElement, camera: Camera, actions: PointerActions): void {
  const down = new Map<number, { x: number; y: number }>();
  let travelled = 0;
  const place = (e: PointerEvent | WheelEvent) => {
    const box = element.getBoundingClientRect();
    return { x: e.clientX - box.left, y: e.clientY - box.top };
  };

  element.addEventListener('pointerdown', (e) => {
    if (e.button !== 0) return;
    element.setPointerCapture(e.pointerId);
    down.set(e.pointerId, place(e));
    travelled = down.size > 1 ? Infinity : 0;
    element.classList.add('moving');
  });
  element.addEventListener('pointermove', (e) => {
    const before = down.get(e.pointerId);
    if (before === undefined) return;
    const now = place(e);
    const other = [...down].find(([id]) => id !== e.pointerId)?.[1];
    if (other !== undefined) {
      const apart = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
      camera.zoom(apart(now) / Math.max(apart(before), 1), other.x, other.y);
    } else {
      camera.pan(now.x - before.x, now.y - before.y);
    }
    travelled += Math.hypot(now.x - before.x, now.y - before.y);
    down.set(e.pointerId, now);
    actions.moved();
  });
  const up = (e: PointerEvent) => {
    if (!down.delete(e.pointerId)) return;
    if (down.size === 0) element.classList.remove('moving');
    if (e.type === 'pointerup' && travelled < 4) actions.clicked(place(e).x, place(e).y);
  };
  element.addEventListener('pointerup', up);
  element.addEventListener('pointercancel', up);
  element.addEventListener(
    'wheel',
    (e) => {
      e.preventDefault();
      const lines = e.deltaMode === 1 ? 16 * e.deltaY : e.deltaY;
      camera.zoom(Math.exp(-0.0015 * lines), place(e).x, place(e).y);
      actions.moved();
    },
    { passive: false },
  );
  element.addEventListener('dblclick', () => actions.fit());
}
