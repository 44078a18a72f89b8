"use strict";
// Draws planes: a floor as a soft disc with a grid, a wall as a pane, visible from its front, of the size of the scene.

const FLOOR = 0.5;  // the least z of a floor's normal

/** Adds the planes of a run with the bounding box `box`. Returns the spacing of the floor's grid, a round number. */
function addPlanes(parent, run, box) {
  const spacing = niceAbove(box.size / 12);
  for (const body of run.header.bodies.filter((candidate) => candidate.shape === "plane")) {
    const n = new THREE.Vector3(...body.n);
    const centre = n.clone().multiplyScalar(body.offset - n.dot(box.centre)).add(box.centre);
    const mesh = n.z > FLOOR ? floor(n, centre, box, spacing) : wall(n, centre, box);
    mesh.matrixAutoUpdate = false;
    parent.add(mesh);
  }
  return spacing;
}

function floor(n, centre, box, spacing) {
  const radius = 2.6 * box.size, [a, b] = acrossOf(n.x, n.y, n.z).map((axis) => new THREE.Vector3(...axis));
  const origin = new THREE.Vector2(centre.dot(a), centre.dot(b));
  const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * radius, 2 * radius),
                              floorMaterial(spacing, radius, origin));
  mesh.matrix.makeBasis(a, b, n).setPosition(centre);
  mesh.renderOrder = 1;
  return mesh;
}

function wall(n, centre, box) {
  const up = new THREE.Vector3(0, 0, 1).addScaledVector(n, -n.z);
  if (up.lengthSq() < 1e-6) up.set(0, 1, 0);  // a ceiling
  up.normalize();
  const across = new THREE.Vector3().crossVectors(up, n), half = box.high.clone().sub(box.low).multiplyScalar(0.5);
  const [wide, tall] = [across, up].map((axis) =>
    Math.abs(axis.x) * half.x + Math.abs(axis.y) * half.y + Math.abs(axis.z) * half.z);
  const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * wide, 2 * tall), wallMaterial());
  mesh.matrix.makeBasis(across, up, n).setPosition(centre);
  mesh.renderOrder = 3;
  return mesh;
}

/** Returns the first plane that receives shadows; null if there is none. */
function floorOf(run) {
  const plane = run.header.bodies.find((body) => body.shape === "plane" && body.n[2] > FLOOR);
  return plane ? { n: new THREE.Vector3(...plane.n), offset: plane.offset } : null;
}
