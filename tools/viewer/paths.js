"use strict";
// The way that bodies have come, as lines: of films with few bodies.

const FEW = 3;     // with so many, paths are shown unless they are switched off
const MOST = 50;   // of more bodies they are not drawn

function movingBodies(run) {
  return run.header.bodies.map((body, k) => body.fixed || body.shape === "plane" ? -1 : k).filter((k) => k >= 0);
}

const hasPaths = (run) => !run.live && movingBodies(run).length <= MOST;

class Paths {
  constructor(parent, run) {
    this.run = run;
    const material = new THREE.LineBasicMaterial({ color: palette().path });
    this.lines = (hasPaths(run) ? movingBodies(run) : []).map((body) => {
      const points = new Float32Array(3 * run.frames.length);
      run.frames.forEach((frame, k) => points.set(frame.x.subarray(3 * body, 3 * body + 3), 3 * k));
      const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(points, 3));
      const line = new THREE.Line(geometry, material);
      line.frustumCulled = false;
      parent.add(line);
      return line;
    });
  }

  /** Up to the frame. */
  draw(frame, shown) {
    const count = shown ? this.run.frames.indexOf(frame) + 1 : 0;
    for (const line of this.lines) {
      line.visible = count > 1;
      line.geometry.setDrawRange(0, count);
    }
  }
}
