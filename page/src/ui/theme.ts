// Colours of the drawing, light and dark; those of the page around it are in style.css.
import type { OverlayStyle } from '../scene/overlay';
import type { Theme } from '../scene/view';

export type ThemeName = 'light' | 'dark';

export const themes: Record<ThemeName, Theme> = {
  light: {
    paper: [255, 255, 255], edge: [27, 31, 39], held: [190, 194, 201], none: [222, 217, 204],
    ink: [20, 24, 32], tension: [196, 30, 30], compression: [22, 78, 168],
  },
  dark: {
    paper: [20, 23, 28], edge: [10, 12, 15], held: [74, 80, 90], none: [96, 99, 104],
    ink: [240, 242, 246], tension: [255, 110, 96], compression: [122, 178, 255],
  },
};

export const css = (c: number[]): string => `rgb(${c.join(',')})`;

export function overlayStyle(): OverlayStyle {
  const style = getComputedStyle(document.documentElement);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return { ink: of('--ink'), faint: of('--faint'), halo: of('--paper'), accent: of('--accent'), font: 'system-ui, "DejaVu Sans", sans-serif' };
}

export function themeAtStart(): ThemeName {
  return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}
