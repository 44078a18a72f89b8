"use strict";
// Planes: a floor is a soft disc with a grid; a wall is translucent, and not there when seen from behind.

const FLOOR = 0.5;  // the least z of a floor's normal

/** `box` is what the bodies fill; the grid's spacing is a round number of metres. */
function addPlanes(parent, run, box) {
  const size = box.size, spacing = niceAbove(size / 12);
  for (const body of run.header.bodies.filter((candidate) => candidate.shape === "plane")) {
    const n = new THREE.Vector3(...body.n), isFloor = n.z > FLOOR;
    const radius = (isFloor ? 2.6 : 1) * size;
    const centre = n.clone().multiplyScalar(body.offset - n.dot(box.centre)).add(box.centre);
    const [a, b] = acrossOf(n.x, n.y, n.z).map((axis) => new THREE.Vector3(...axis));
    const origin = new THREE.Vector2(centre.dot(a), centre.dot(b));
    const mesh = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * radius, 2 * radius),
                                planeMaterial(isFloor ? 0.9 : 0.12, spacing, radius, origin));
    mesh.matrixAutoUpdate = false;
    mesh.matrix.makeBasis(a, b, n).setPosition(centre);
    mesh.renderOrder = 1;
    parent.add(mesh);
  }
  return spacing;
}

/** The first plane that shadows fall on; null if there is none. */
function floorOf(run) {
  const plane = run.header.bodies.find((body) => body.shape === "plane" && body.n[2] > FLOOR);
  return plane ? { n: new THREE.Vector3(...plane.n), offset: plane.offset } : null;
}
