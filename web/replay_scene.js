// SPDX-License-Identifier: Apache-2.0
// A replay's scene in three.js: one group a link, its shapes merged by how they look, so that a
// robot of 200 shapes is some twenty meshes.

// MuJoCo's types of geoms.
const kGeom = {plane: 0, sphere: 2, capsule: 3, ellipsoid: 4, cylinder: 5, box: 6, mesh: 7};
const kLook = {plain: 0, tiles: 1, wheel: 2, wall: 3};
const kShapeFloats = 18;

// A shape's surface in its own frame, as MuJoCo has it: z is the axis of what is round.
function surfaceOf(type, size, mesh) {
  switch (type) {
    case kGeom.sphere: return new THREE.SphereGeometry(size[0], 20, 12);
    case kGeom.ellipsoid: return new THREE.SphereGeometry(1, 20, 12).scale(size[0], size[1], size[2]);
    case kGeom.capsule:
      return new THREE.CapsuleGeometry(size[0], 2 * size[1], 4, 10).rotateX(Math.PI / 2);
    case kGeom.cylinder:
      return new THREE.CylinderGeometry(size[0], size[0], 2 * size[1], 28).rotateX(Math.PI / 2);
    case kGeom.plane: return new THREE.PlaneGeometry(2 * size[0], 2 * size[1]);
    case kGeom.mesh: {
      const surface = new THREE.BufferGeometry();
      surface.setAttribute('position', new THREE.BufferAttribute(mesh.vertices.slice(), 3));
      surface.setIndex(new THREE.BufferAttribute(mesh.faces, 1));
      const flat = surface.toNonIndexed();  // edges stay sharp
      flat.computeVertexNormals();
      return flat;
    }
    default: return new THREE.BoxGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
  }
}

// Positions, normals and colours of many shapes, in one geometry.
class Merger {
  constructor() {
    this.positions = [];
    this.normals = [];
    this.colours = [];
  }
  // `shade(x, y, z)`: factor on the colour at a point of the shape's own frame.
  add(surface, matrix, rgb, shade) {
    const whole = surface.index ? surface.toNonIndexed() : surface;
    const own = whole.attributes.position.array.slice();
    whole.applyMatrix4(matrix);
    this.positions.push(whole.attributes.position.array);
    this.normals.push(whole.attributes.normal.array);
    const colours = new Float32Array(own.length);
    for (let i = 0; i < own.length; i += 3) {
      // A face is of one shade: that of its middle.
      const face = i - i % 9;
      const middle = [0, 1, 2].map(k => (own[face + k] + own[face + 3 + k] + own[face + 6 + k]) / 3);
      const factor = shade ? shade(middle) : 1;
      for (let k = 0; k < 3; ++k) colours[i + k] = rgb[k] * factor;
    }
    this.colours.push(colours);
  }
  geometry() {
    const join = parts => {
      const all = new Float32Array(parts.reduce((n, part) => n + part.length, 0));
      let at = 0;
      for (const part of parts) {
        all.set(part, at);
        at += part.length;
      }
      return new THREE.BufferAttribute(all, 3);
    };
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', join(this.positions));
    geometry.setAttribute('normal', join(this.normals));
    geometry.setAttribute('color', join(this.colours));
    return geometry;
  }
}

// Two dark wedges, so that it is seen that a smooth wheel turns.
function wheelShade([x, y]) {
  const turn = (Math.atan2(y, x) / Math.PI + 1) * 4;  // eighths
  return Math.floor(turn) % 4 === 0 ? 0.45 : 1;
}

// Tiles of half a metre, on whatever lies level: the joint is darker.
function tilesMaterial() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 128;
  const pen = canvas.getContext('2d');
  pen.fillStyle = '#e6e0d6';
  pen.fillRect(0, 0, 128, 128);
  pen.strokeStyle = '#bdb8ad';
  pen.lineWidth = 2;
  pen.strokeRect(0, 0, 128, 128);
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 4;
  return new THREE.MeshLambertMaterial({map: texture, vertexColors: false});
}

// {root, links: [Group], walls: [Mesh]}: a Poser sets where the links are.
function buildReplayScene(replay) {
  const root = new THREE.Group();
  const links = replay.links.map(() => {
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    root.add(group);
    return group;
  });
  const mergers = new Map();  // by link, look and transparency
  const walls = [];
  const matrix = new THREE.Matrix4();
  for (let i = 0; i < replay.shapes.length; i += kShapeFloats) {
    const [type, link, mesh, look, r, g, b, a] = replay.shapes.subarray(i, i + 8);
    const size = replay.shapes.subarray(i + 8, i + 11);
    const [x, y, z, qw, qx, qy, qz] = replay.shapes.subarray(i + 11, i + 18);
    matrix.compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(qx, qy, qz, qw),
                   new THREE.Vector3(1, 1, 1));
    const tiles = look === kLook.tiles, wall = look === kLook.wall;
    const key = `${link} ${tiles} ${wall} ${a < 0.995 ? a.toFixed(2) : 1}`;
    if (!mergers.has(key)) mergers.set(key, {link, tiles, wall, alpha: a, merger: new Merger()});
    mergers.get(key).merger.add(surfaceOf(type, size, replay.meshes[mesh]), matrix,
                                new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace).toArray(),
                                look === kLook.wheel ? wheelShade : null);
  }
  for (const {link, tiles, wall, alpha, merger} of mergers.values()) {
    const geometry = merger.geometry();
    const glass = alpha < 0.995;
    let material;
    if (tiles) {
      material = tilesMaterial();
      const p = geometry.attributes.position.array;
      const uv = new Float32Array(p.length / 3 * 2);
      for (let i = 0; i < p.length / 3; ++i) {
        uv[2 * i] = 2 * p[3 * i];
        uv[2 * i + 1] = 2 * p[3 * i + 1];
      }
      geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
    } else {
      material = new THREE.MeshLambertMaterial(
          {vertexColors: true, transparent: glass, opacity: alpha, depthWrite: !glass});
    }
    const shape = new THREE.Mesh(geometry, material);
    links[link].add(shape);
    if (wall && !glass) walls.push(shape);
  }
  return {root, links, walls};
}

// Sets all links to the state between `index` and the next.
class Poser {
  constructor(replay, links) {
    this.replay = replay;
    this.links = links;
    this.world = replay.links.map(() => new THREE.Matrix4());
    this.fixed = replay.links.map(({pos, quat}) => new THREE.Matrix4().compose(
        new THREE.Vector3(...pos), new THREE.Quaternion(quat[1], quat[2], quat[3], quat[0]),
        new THREE.Vector3(1, 1, 1)));
    this.one = new THREE.Vector3(1, 1, 1);
  }
  value(index, fraction, k) {
    const {states, width, t_s} = this.replay;
    const a = states[index * width + k];
    if (fraction === 0 || index + 1 >= t_s.length) return a;
    return a + fraction * (states[(index + 1) * width + k] - a);
  }
  quaternion(index, fraction, first) {
    const {states, width, t_s} = this.replay;
    const read = i => {
      const at = i * width + first;
      return new THREE.Quaternion(states[at + 1], states[at + 2], states[at + 3], states[at]).normalize();
    };
    const q = read(index);
    return fraction === 0 || index + 1 >= t_s.length ? q : q.slerp(read(index + 1), fraction);
  }
  pose(index, fraction) {
    const joint = new THREE.Matrix4(), shift = new THREE.Matrix4();
    this.replay.links.forEach((link, i) => {
      const world = this.world[i];
      if (link.parent < 0) world.identity();
      else world.multiplyMatrices(this.world[link.parent], this.fixed[i]);
      for (const {type, first, anchor, axis, zero} of link.joints) {
        if (type === 'free') {
          world.compose(new THREE.Vector3(...[0, 1, 2].map(k => this.value(index, fraction, first + k))),
                        this.quaternion(index, fraction, first + 3), this.one);
          continue;
        }
        if (type === 'slide') {
          const by = this.value(index, fraction, first) - zero;
          world.multiply(joint.makeTranslation(axis[0] * by, axis[1] * by, axis[2] * by));
          continue;
        }
        if (type === 'hinge')
          joint.makeRotationAxis(new THREE.Vector3(...axis), this.value(index, fraction, first) - zero);
        else
          joint.makeRotationFromQuaternion(this.quaternion(index, fraction, first));
        world.multiply(shift.makeTranslation(...anchor)).multiply(joint)
            .multiply(shift.makeTranslation(-anchor[0], -anchor[1], -anchor[2]));
      }
      this.links[i].matrix.copy(world);
    });
  }
  // Where the robot's base is now.
  base() { return this.world[this.replay.base]; }
}
