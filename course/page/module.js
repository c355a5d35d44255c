// SPDX-License-Identifier: MIT
// The project's own C++, compiled to WebAssembly: spheres in, a trace out.
"use strict";

class Tracer {
  constructor(exports) {
    this.exports = exports;
  }

  static async load(base64) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const {instance} = await WebAssembly.instantiate(bytes, {});
    instance.exports._initialize();
    return new Tracer(instance.exports);
  }

  /** Runs all stages on spheres [[x, y, z, r], ...]. `side` is for rule lowest_cell. */
  trace(spheres, rule, side) {
    const {memory, room_for, trace, text_length, grid_numbers} = this.exports;
    const room = room_for(spheres.length);
    new Float32Array(memory.buffer, room, 4 * spheres.length).set(spheres.flat());
    const text = trace(RULES.indexOf(rule), side);
    const bytes = new Uint8Array(memory.buffer, text, text_length());
    const [x, y, z, cellSide, column] = new Float64Array(memory.buffer, grid_numbers(), 5);
    const found = JSON.parse(new TextDecoder().decode(bytes));
    return {...found, rule, spheres, corner: [x, y, z], side: cellSide, column};
  }
}
