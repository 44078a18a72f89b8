"use strict";
// Draws the paths of bodies as lines, in films with few bodies.

const FEW = 3;     // up to this many bodies, paths are shown by default
const MOST = 50;   // with more bodies, paths are not available

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

  /** Draws the paths up to the frame. */
  draw(frame, shown) {
    const count = shown ? this.run.frames.indexOf(frame) + 1 : 0;
    for (const line of this.lines) {
      line.visible = count > 1;
      line.geometry.setDrawRange(0, count);
    }
  }
}
