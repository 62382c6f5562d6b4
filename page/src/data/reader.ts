// Reads what src/view/bytes.hpp writes.

export class Reader {
  private at = 0;
  private readonly view: DataView;
  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number {
    return this.bytes.length - this.at;
  }
  u8(): number {
    return this.bytes[this.at++];
  }
  u32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  f32(): number {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }
  take(count: number): Uint8Array {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
  varint(): number {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = this.u8();
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  }
  zigzag(): number {
    const twice = this.varint();
    return twice % 2 === 0 ? twice / 2 : -(twice + 1) / 2;
  }
  u32s(count: number): Uint32Array {
    return new Uint32Array(this.copied(4 * count));
  }
  f32s(count: number): Float32Array {
    return new Float32Array(this.copied(4 * count));
  }
  f64s(count: number): Float64Array {
    return new Float64Array(this.copied(8 * count));
  }
  private copied(size: number): ArrayBuffer {
    return this.take(size).slice().buffer as ArrayBuffer;
  }

  /** A column of 16 bits: zigzagged whole numbers, all low bytes before all high bytes. */
  whole16(count: number, scale: number): Float32Array {
    const low = this.take(count);
    const high = this.take(count);
    const values = new Float32Array(count);
    for (let k = 0; k < count; ++k) {
      const twice = low[k] | (high[k] << 8);
      values[k] = scale * (twice & 1 ? -((twice + 1) >> 1) : twice >> 1);
    }
    return values;
  }
  /** A column of f32 in four planes of bytes. */
  single(count: number): Float32Array {
    const planes = this.take(4 * count);
    const bytes = new Uint8Array(4 * count);
    for (let plane = 0; plane < 4; ++plane) {
      for (let k = 0; k < count; ++k) bytes[4 * k + plane] = planes[plane * count + k];
    }
    return new Float32Array(bytes.buffer);
  }
}
