"use strict";
// The camera: fits the view to the whole run, orbits, pans, zooms, and follows a body.

const FIELD = 32 * Math.PI / 180;  // the vertical field of view

/** Returns the bounding box of all bodies but planes over the run: low, high, centre, and size, its diagonal. */
function boundsOf(runs) {
  const places = [[], [], []], radii = [];
  for (const run of runs) {
    const forms = run.header.bodies.map(formOf);
    const every = Math.max(1, Math.ceil(run.frames.length * forms.length / 200000));
    for (let k = 0; k < run.frames.length; k += every) {
      takePlaces(places, run.frames[k].x, forms);
      takeJoints(places, run.frames[k], run.header.joints);
    }
    radii.push(...forms.filter((form) => form.kind).map((form) => form.radius));
    for (const curve of run.header.curves)
      for (const point of triples(curve.points)) places.forEach((axis, k) => axis.push(point[k]));
  }
  const radius = radii.reduce((largest, value) => Math.max(largest, value), 0);
  return boxOf(places.map(extent), radius);
}

function takePlaces(places, x, forms) {
  for (let body = 0; 3 * body < x.length; ++body)
    if (forms[body].kind && Number.isFinite(x[3 * body] + x[3 * body + 1] + x[3 * body + 2]))
      places.forEach((axis, k) => axis.push(x[3 * body + k]));
}

/** Adds both ends of each joint, since a rod may reach far beyond the centres of its bodies. */
function takeJoints(places, frame, joints) {
  for (const joint of joints)
    for (const end of [placeOf(frame, joint.i, joint.p_i), placeOf(frame, joint.j, joint.p_j)])
      if (end.every(Number.isFinite)) places.forEach((axis, k) => axis.push(end[k]));
}

/** Returns the least and the largest value, without the outliers if a few values are far away. */
function extent(values) {
  if (!values.length) return [0, 0];
  const sorted = Float64Array.from(values).sort(), at = (part) => sorted[Math.floor(part * (sorted.length - 1))];
  const ends = [sorted[0], lastOf(sorted)], most = [at(0.05), at(0.95)];
  return ends[1] - ends[0] > 20 * (most[1] - most[0]) && most[1] > most[0] ? most : ends;
}

function boxOf(extents, radius) {
  const low = new THREE.Vector3(...extents.map(([least]) => least - radius));
  const high = new THREE.Vector3(...extents.map(([, most]) => most + radius));
  const size = low.distanceTo(high);
  if (!(size > 0)) return { ...boxOf([[-0.5, 0.5], [-0.5, 0.5], [-0.5, 0.5]], 0), empty: true };
  return { low, high, size, centre: low.clone().add(high).multiplyScalar(0.5) };
}

/** Returns the direction of the best view: along the thinnest side of the box, or from a corner. */
function directionFor(box, hasFloor) {
  const side = box.high.clone().sub(box.low), thin = 0.2 * Math.max(side.x, side.y, side.z);
  const up = hasFloor ? 0.28 : 0.12;
  if (side.z < 0.06 * box.size && !hasFloor) return new THREE.Vector3(0.12, -0.55, 0.9).normalize();
  if (side.y <= thin) return new THREE.Vector3(0.22, -1, up).normalize();
  if (side.x <= thin) return new THREE.Vector3(1, -0.22, up).normalize();
  return new THREE.Vector3(0.5, -0.85, hasFloor ? 0.42 : 0.3).normalize();
}

class Camera {
  constructor(canvas) {
    this.eye = new THREE.PerspectiveCamera(FIELD * 180 / Math.PI, 1, 0.01, 100);
    this.eye.up.set(0, 0, 1);
    this.orbit = new THREE.OrbitControls(this.eye, canvas);
    this.orbit.enableKeys = false;  // the arrow keys step through the frames
    this.followed = null;
  }

  /** Places the camera so that the box fills this part of the view. */
  fit(box, direction, aspect, part) {
    this.eye.aspect = aspect;
    const right = new THREE.Vector3().crossVectors(direction, this.eye.up).normalize();
    const top = new THREE.Vector3().crossVectors(right, direction).normalize();
    const tall = Math.tan(FIELD / 2) * part, wide = tall * aspect;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(...["x", "y", "z"].map((axis, k) => (corner >> k & 1 ? box.high : box.low)[axis]))
        .sub(box.centre);
      distance = Math.max(distance, p.dot(direction) + Math.abs(p.dot(right)) / wide,
                          p.dot(direction) + Math.abs(p.dot(top)) / tall);
    }
    this.orbit.target.copy(box.centre);
    this.eye.position.copy(direction).multiplyScalar(distance).add(box.centre);
    this.eye.near = 0.01 * distance;
    this.eye.far = 40 * Math.max(distance, box.size);
    this.orbit.minDistance = 0.03 * distance;
    this.orbit.maxDistance = 12 * distance;
    this.eye.updateProjectionMatrix();
    this.orbit.update();
    this.fitted = this.eye.position.clone();
  }

  untouched() {
    return this.fitted && this.fitted.distanceTo(this.eye.position) < 1e-6 * this.fitted.length();
  }

  /** Moves the camera with the followed body, to its new place. */
  keepUpWith(place) {
    if (!place || !place.every(Number.isFinite)) return;
    const moved = new THREE.Vector3(...place).sub(this.orbit.target);
    this.orbit.target.add(moved);
    this.eye.position.add(moved);
    this.orbit.update();
  }

  /** Returns the size of a pixel at the point in the middle of the view [m]. */
  pixel(height) {
    return 2 * Math.tan(FIELD / 2) * this.eye.position.distanceTo(this.orbit.target) / Math.max(1, height);
  }
}
