// SPDX-License-Identifier: Apache-2.0
// Reads replay.bin (docs/results.md): shapes once, then the joints' positions over time.

// Bytes of a base64 text.
function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// {links, base, shapes: Float32Array, meshes, t_s: Float64Array, width, states: Float32Array}.
// Throws where the bytes are no replay, or not a whole one.
function readReplay(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const magic = String.fromCharCode(...bytes.subarray(0, 8));
  if (magic !== 'FPREPLAY' || view.getUint32(8, true) !== 1) throw new Error('no replay of version 1');
  const headLength = view.getUint32(12, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(16, 16 + headLength)));
  let at = 16 + headLength;
  const take = (Type, count) => {
    const part = new Type(bytes.slice(at, at + count * Type.BYTES_PER_ELEMENT).buffer);
    at += count * Type.BYTES_PER_ELEMENT;
    return part;
  };
  const shapes = take(Float32Array, head.shapes * 18);
  const meshes = head.meshes.map(({vertices, faces}) => (
      {vertices: take(Float32Array, 3 * vertices), faces: take(Uint32Array, 3 * faces)}));

  const varint = () => {
    let value = 0, scale = 1, byte;
    do {
      if (at >= bytes.length) throw new Error('the replay is cut off');
      byte = bytes[at++];
      value += (byte & 0x7f) * scale;
      scale *= 128;
    } while (byte & 0x80);
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  };
  const width = head.per.length;
  const t_s = new Float64Array(head.states), states = new Float32Array(head.states * width);
  const last = new Float64Array(width), step = new Float64Array(width);
  let t_ms = 0;
  for (let i = 0; i < head.states; ++i) {
    t_ms += varint();
    t_s[i] = t_ms / 1000;
    for (let k = 0; k < width; ++k) {
      step[k] += varint();
      last[k] += step[k];
      states[i * width + k] = last[k] / head.per[k];
    }
  }
  if (at !== bytes.length) throw new Error('the replay has bytes beyond its end');
  return {links: head.links, base: head.base, plan: head.plan || [], shapes, meshes, t_s, width, states};
}

// The way of the robot's base, to a few centimetres: [[x, y], ..].
function wayOf(replay) {
  const joint = baseJointOf(replay);
  const way = [];
  if (!joint) return way;
  for (let i = 0; i < replay.t_s.length; ++i) {
    const [x, y] = [0, 1].map(k => replay.states[i * replay.width + joint.first + k]);
    const last = way[way.length - 1];
    if (!last || Math.hypot(x - last[0], y - last[1]) > 0.03 || i + 1 === replay.t_s.length) way.push([x, y]);
  }
  return way;
}

// The joint on which the robot's base is free to move; undefined: there is none.
function baseJointOf({links, base}) { return links[base].joints.find(({type}) => type === 'free'); }

// The state at or before a time, and how far the next is begun: [index, fraction].
function stateAt(t_s, time_s) {
  let low = 0, high = t_s.length - 1;
  if (time_s <= t_s[0]) return [0, 0];
  if (time_s >= t_s[high]) return [high, 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t_s[middle] <= time_s) low = middle; else high = middle;
  }
  return [low, (time_s - t_s[low]) / (t_s[high] - t_s[low])];
}
