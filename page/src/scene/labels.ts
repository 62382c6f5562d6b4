// Names beside what they name: each where it hides nothing, else left out.

export interface Rectangle {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

export class Labels {
  private readonly taken: Rectangle[];

  /** `taken`: where no name may stand. */
  constructor(private readonly g: CanvasRenderingContext2D, private readonly width: number, private readonly height: number,
              taken: Rectangle[]) {
    this.taken = [...taken];
  }

  /** Where to write it, the left end of its base line: the first place that is free, given a text's width. */
  place(text: string, places: (width: number) => [number, number][], always = false): [number, number] | undefined {
    const width = this.g.measureText(text).width;
    const wanted = places(width);
    const box = ([x, y]: [number, number]): Rectangle => ({ x0: x - 2, y0: y - 11, x1: x + width + 2, y1: y + 4 });
    const found = wanted.find((at) => this.isFree(box(at))) ?? (always ? wanted[0] : undefined);
    if (found !== undefined) this.taken.push(box(found));
    return found;
  }

  private isFree(b: Rectangle): boolean {
    if (b.x0 < 0 || b.y0 < 0 || b.x1 > this.width || b.y1 > this.height) return false;
    return !this.taken.some((t) => t.x0 < b.x1 && b.x0 < t.x1 && t.y0 < b.y1 && b.y0 < t.y1);
  }
}

/** Round a dot. */
export const beside = (x: number, y: number) => (width: number): [number, number][] => [
  [x + 9, y - 8], [x + 9, y + 18], [x - 9 - width, y - 8], [x - 9 - width, y + 18], [x - 0.5 * width, y - 12], [x - 0.5 * width, y + 22],
];

/** Along a line; first off its middle, where others may cross. */
export const along = (a: [number, number], b: [number, number]) => (): [number, number][] =>
  [0.3, 0.7, 0.15, 0.85, 0.5].map((t) => [a[0] + t * (b[0] - a[0]) + 6, a[1] + t * (b[1] - a[1]) - 6]);
