// What part of the plane is seen. Lengths in m from the scene's origin, pixels of the screen.

export interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

export class Camera {
  x = 0;
  y = 0;
  /** Pixels per m. */
  scale = 1;
  width = 1;
  height = 1;

  /** All of the box, clear of `right` pixels at the right edge. */
  fit(box: Box, right = 0, margin = 0.06): void {
    const w = Math.max(box.x1 - box.x0, 1e-12);
    const h = Math.max(box.y1 - box.y0, 1e-12);
    const width = Math.max(this.width - right, 0.4 * this.width);
    this.scale = Math.min(width / w, this.height / h) * (1 - 2 * margin);
    this.x = 0.5 * (box.x0 + box.x1) + (0.5 * (this.width - width)) / this.scale;
    this.y = 0.5 * (box.y0 + box.y1);
  }
  /** Keeps what is in the middle there. */
  resize(width: number, height: number): void {
    const before = Math.min(this.width, this.height);
    this.scale *= before > 1 ? Math.min(width, height) / before : 1;
    this.width = width;
    this.height = height;
  }
  /** Keeps what lies at the pixel there. */
  zoom(factor: number, px: number, py: number): void {
    const [x, y] = this.at(px, py);
    this.scale *= factor;
    const [x1, y1] = this.at(px, py);
    this.x += x - x1;
    this.y += y - y1;
  }
  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
  at(px: number, py: number): [number, number] {
    return [this.x + (px - 0.5 * this.width) / this.scale, this.y - (py - 0.5 * this.height) / this.scale];
  }
  px(x: number, y: number): [number, number] {
    return [0.5 * this.width + (x - this.x) * this.scale, 0.5 * this.height - (y - this.y) * this.scale];
  }
}
