// The drawing as a picture file: title, blocks, marks and legend.
import type { View } from '../scene/view';

export function savePicture(name: string, view: View, ratio: number, title: string, paper: string, ink: string,
                            paint: (g: CanvasRenderingContext2D) => void): void {
  const { width, height } = view.camera;
  const head = 34;
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round((height + head) * ratio);
  const g = canvas.getContext('2d')!;
  g.scale(ratio, ratio);
  g.fillStyle = paper;
  g.fillRect(0, 0, width, height + head);
  g.fillStyle = ink;
  g.font = '600 15px system-ui, "DejaVu Sans", sans-serif';
  g.fillText(title, 12, 22, width - 24);
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
