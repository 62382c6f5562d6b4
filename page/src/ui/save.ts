// The drawing as a picture file: title, blocks, marks and legend.
import type { View } from '../scene/view';
import { headLines } from './text';

/** Of the first line of the title, and of each further one, px. */
const HEAD = 34;
const LINE = 20;
const FONT = '600 15px system-ui, "DejaVu Sans", sans-serif';

/** `rest`: what follows the title, and is never cut. */
export function savePicture(name: string, view: View, ratio: number, title: string, rest: string, paper: string, ink: string,
                            paint: (g: CanvasRenderingContext2D) => void): void {
  const { width, height } = view.camera;
  const canvas = document.createElement('canvas');
  const g = canvas.getContext('2d')!;
  g.font = FONT;
  const lines = headLines((text) => g.measureText(text).width, title, rest, width - 24, 3);
  const head = HEAD + LINE * (lines.length - 1);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round((height + head) * ratio);
  g.scale(ratio, ratio);
  g.fillStyle = paper;
  g.fillRect(0, 0, width, height + head);
  g.fillStyle = ink;
  g.font = FONT;
  lines.forEach((line, k) => g.fillText(line, 12, 22 + LINE * k, width - 24));
  g.translate(0, head);
  view.copyTo(g, 0, 0, width, height, ratio);
  paint(g);
  canvas.toBlob((blob) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob!);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }, 'image/png');
}
