// SPDX-License-Identifier: Apache-2.0
// The replay on a canvas: orbit, follow, show a time. Keeps no clock of its own (drive_clock.js).

// Whether this browser draws in 3D.
function hasWebGl() {
  try {
    const canvas = document.createElement('canvas');
    return Boolean(canvas.getContext('webgl2'));
  } catch {
    return false;
  }
}

const kHalfWidth_m = 0.2;  // of a robot, about

class ReplayView {
  // `marks`: places of events, {x, y, tone}. `plan`: [[x, y], ..]. Throws where there is no WebGL.
  constructor(canvas, replay, plan, marks) {
    this.canvas = canvas;
    this.replay = replay;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color('#d7e0e8');
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#b9b1a4', 2.1));
    const sun = new THREE.DirectionalLight('#fff6e8', 1.5);
    sun.position.set(-3, -4, 9);
    this.scene.add(sun);
    const {root, links, walls} = buildReplayScene(replay);
    this.walls = walls;
    this.ray = new THREE.Raycaster();
    this.scene.add(root);
    this.poser = new Poser(replay, links);
    this.addWay(plan, 0x1f5fa8, 0.004);
    this.addTrail();
    for (const mark of marks) this.addMark(mark);

    this.camera = new THREE.PerspectiveCamera(40, 1, 0.02, 400);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.497 * Math.PI;  // not from below the floor
    this.controls.minDistance = 0.15;
    this.controls.maxDistance = 80;
    this.controls.addEventListener('change', () => this.draw());
    this.follow = true;
    this.poser.pose(0, 0);
    this.look(2.4);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(canvas.parentElement);
    this.resize();
  }

  // A browser has room for some sixteen of these.
  dispose() {
    this.observer.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  // A thin ribbon on the floor.
  addWay(points, colour, z) {
    if (points.length < 2) return;
    const half = 0.012, position = [];
    for (let i = 0; i + 1 < points.length; ++i) {
      const [[ax, ay], [bx, by]] = [points[i], points[i + 1]];
      const length = Math.hypot(bx - ax, by - ay);
      if (length < 1e-6) continue;
      const nx = -(by - ay) / length * half, ny = (bx - ax) / length * half;
      const corners = [[ax + nx, ay + ny], [ax - nx, ay - ny], [bx - nx, by - ny], [bx + nx, by + ny]];
      for (const k of [0, 1, 2, 0, 2, 3]) position.push(...corners[k], z);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
    this.scene.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(
        {color: colour, transparent: true, opacity: 0.55, side: THREE.DoubleSide, depthWrite: false})));
  }

  // Where the robot has been, up to the time that is shown.
  addTrail() {
    const {t_s, states, width} = this.replay;
    const joint = baseJointOf(this.replay);
    if (!joint) return;
    const points = new Float32Array(3 * t_s.length);
    for (let i = 0; i < t_s.length; ++i)
      for (let k = 0; k < 3; ++k)
        points[3 * i + k] = states[i * width + joint.first + k] + (k === 2 ? 0.008 : 0);
    this.trail = new THREE.BufferGeometry();
    this.trail.setAttribute('position', new THREE.BufferAttribute(points, 3));
    this.scene.add(new THREE.Line(this.trail, new THREE.LineBasicMaterial({color: 0xc2410c})));
  }

  addMark({x, y}) {
    const ring = new THREE.Mesh(new THREE.RingGeometry(0.16, 0.2, 40),
                                new THREE.MeshBasicMaterial({color: 0xb83a2f, side: THREE.DoubleSide}));
    ring.position.set(x, y, 0.012);
    this.scene.add(ring);
  }

  // From so many metres off, from above, on the first side from which no wall hides the robot; if
  // there is one, on a side where no wall stands between.
  look(distance) {
    const place = new THREE.Vector3().setFromMatrixPosition(this.poser.base());
    let eye = null, best = -1;
    for (let eighth = 0; eighth < 8; ++eighth) {
      const turn = (5 + [0, 1, -1, 2, -2, 3, -3, 4][eighth]) * Math.PI / 4;
      const from = place.clone().add(new THREE.Vector3(
          0.82 * Math.cos(turn), 0.82 * Math.sin(turn), 0.57).multiplyScalar(distance));
      const worth = this.isHidden(from, place) ? 0 : this.isBehindWall(from, place) ? 1 : 2;
      if (worth > best) [eye, best] = [from, worth];
    }
    this.controls.target.copy(place);
    this.camera.position.copy(eye);
    this.controls.update();
  }
  // Whether it looks over a wall.
  isBehindWall(eye, place) {
    const way = eye.clone().sub(place).setZ(0);
    this.ray.set(place.clone().setZ(place.z + 0.1), way.clone().normalize());
    this.ray.far = way.length();
    return this.ray.intersectObjects(this.walls).length > 0;
  }
  // Whether a wall hides its middle, or one of its sides.
  isHidden(eye, place) {
    const across = new THREE.Vector3(-(place.y - eye.y), place.x - eye.x, 0).setLength(kHalfWidth_m);
    return [-1, 0, 1].some(side => {
      const way = place.clone().setZ(place.z + 0.1).addScaledVector(across, side).sub(eye);
      this.ray.set(eye, way.clone().normalize());
      this.ray.far = way.length();
      return this.ray.intersectObjects(this.walls).length > 0;
    });
  }
  // The whole way from straight above.
  lookFromAbove() {
    const box = new THREE.Box3().setFromBufferAttribute(this.trail.attributes.position);
    const middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
    this.controls.target.copy(middle);
    const high = 0.75 * Math.max(size.y, size.x / this.camera.aspect) / Math.tan(Math.PI / 9) + 1;
    this.camera.position.set(middle.x, middle.y - 0.01 * high, high);
    this.controls.update();
  }

  show(time_s) {
    const before = new THREE.Vector3().setFromMatrixPosition(this.poser.base());
    const [index, fraction] = stateAt(this.replay.t_s, time_s);
    this.poser.pose(index, fraction);
    if (this.trail) this.trail.setDrawRange(0, index + 1);
    if (this.follow) {
      const by = new THREE.Vector3().setFromMatrixPosition(this.poser.base()).sub(before);
      this.camera.position.add(by);
      this.controls.target.add(by);
      this.controls.update();
    }
    this.draw();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (width < 2 || height < 2) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    // A wall between the eye and the robot is of thin glass.
    const hidden = this.isHidden(this.camera.position,
                                 new THREE.Vector3().setFromMatrixPosition(this.poser.base()));
    for (const {material} of this.walls) {
      if (material.transparent !== hidden) material.needsUpdate = true;
      material.transparent = hidden;
      material.opacity = hidden ? 0.25 : 1;
      material.depthWrite = !hidden;
    }
    this.renderer.render(this.scene, this.camera);
  }
}
