"use strict";
// Draws joints: rods coloured by tension, dots for other joints, axes of hinges and sliders, and curves of answers.

const ROD = 2;  // half the width of a rod on the screen [pixels]
const FORCES = { distance: 1, rope: 1, ball: 3, hinge: 3, slider: 2, weld: 3 };  // number of first rows that are forces

/** Returns the tension of each joint [N], T = -λ/h as in Eq. (6.7); for joints other than distances, the force. */
function tensions(run, frame) {
  const h = run.header.method.h / (run.header.method.substeps || 1);
  let row = 0;
  return run.header.joints.map((joint) => {
    const first = row;
    const forces = FORCES[joint.kind] || 0;
    row += joint.rows || forces;
    if (row > frame.jointImpulses.length) return 0;
    const lambda = frame.jointImpulses.subarray(first, first + forces);
    return (joint.kind === "distance" ? -lambda[0] : joint.kind === "rope" ? lambda[0] : Math.hypot(...lambda)) / h;
  });
}

/** Returns the tension that 99 % of the run stay below, so that one jolt does not turn everything else grey. */
function tensionScale(run) {
  if (!run.header.joints.length) return 0;
  const every = Math.ceil(run.frames.length / 200);
  const sizes = run.frames.filter((_, k) => k % every === 0)
    .flatMap((frame) => tensions(run, frame).map(Math.abs)).filter((size) => size > 0 && Number.isFinite(size));
  sizes.sort((a, b) => a - b);
  return sizes.length ? sizes[Math.floor(0.99 * (sizes.length - 1))] : 0;
}

class Joints {
  constructor(parent, run, style) {
    this.run = run;
    const material = bodyMaterial([], style.opacity);  // unlit, since the colour shows the tension
    const pipe = new THREE.CylinderBufferGeometry(1, 1, 1, 8, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.rods = new Crowd(parent, pipe, material, style.order);
    this.dots = new Crowd(parent, new THREE.SphereBufferGeometry(1, 12, 8), material, style.order);
    this.curves = new Crowd(parent, pipe, bodyMaterial([], 0.6), 4);
    this.colours = { rod: colourOf(palette().rod), pull: colourOf(palette().pull), push: colourOf(palette().push),
                     curve: colourOf(palette().curve), dot: colourOf(palette().edge),
                     motor: colourOf(palette().impulse) };
    this.lines = run.header.curves.map((curve) => triples(curve.points));
    this.scale = tensionScale(run);
    this.lengths = run.header.joints.map((joint) => joint.length).filter((length) => length > 0).sort((a, b) => a - b);
  }

  /** Returns the factor, at most 1, that shrinks dots and rods where joints are close together. */
  closeness(unit) {
    const typical = this.lengths[this.lengths.length >> 1];
    return typical ? Math.min(1, typical / (14 * unit)) : 1;
  }

  draw(frame, unit, withCurves) {
    this.rods.begin();
    this.dots.begin();
    this.curves.begin();
    const pull = tensions(this.run, frame), width = ROD * unit * Math.max(0.6, this.closeness(unit));
    for (const [k, joint] of this.run.header.joints.entries()) {
      const a = placeOf(frame, joint.i, joint.p_i), b = placeOf(frame, joint.j, joint.p_j);
      if (![...a, ...b].every(Number.isFinite)) continue;
      const colour = this.colourOfTension(pull[k]);
      if (joint.kind === "distance" || joint.kind === "rope") this.rods.addBetween(...a, ...b, width, colour);
      else {
        this.rods.addBetween(...placeOf(frame, joint.i), ...a, 0.6 * width, colour);
        this.rods.addBetween(...placeOf(frame, joint.j), ...b, 0.6 * width, colour);
        this.dots.addBall(...a, 1.6 * width, this.colours.dot);
        if (joint.kind === "hinge" || joint.kind === "slider") this.drawFree(joint, frame, unit);
      }
    }
    if (withCurves)
      for (const points of this.lines)
        for (let k = 1; k < points.length; ++k)
          this.curves.addBetween(...points[k - 1], ...points[k], 0.8 * unit, this.colours.curve);
    for (const crowd of [this.rods, this.dots, this.curves]) crowd.end();
  }

  /** Draws the free axis of a joint, in another colour if a motor drives it. */
  drawFree(joint, frame, unit) {
    const { axis, marks } = linesOf(joint, frame, unit);
    this.rods.addBetween(...axis[0], ...axis[1], 0.8 * unit, joint.motor ? this.colours.motor : this.colours.dot);
    for (const [from, to] of marks) this.rods.addBetween(...from, ...to, 0.8 * unit, this.colours.dot);
  }

  colourOfTension(tension) {
    const part = this.scale ? clamp(tension / this.scale, -1, 1) : 0;
    return this.colours.rod.clone().lerp(part < 0 ? this.colours.push : this.colours.pull, Math.abs(part) ** 0.8);
  }
}

/** Returns the place of a body's point, given in its axes (Default: its centre). NaN if there is no such body. */
function placeOf(frame, body, point) {
  const x = [0, 1, 2].map((axis) => 3 * body < frame.x.length ? frame.x[3 * body + axis] : NaN);
  if (!point) return x;
  const turned = frame.q ? rotated(frame.q.subarray(4 * body, 4 * body + 4), point) : point;
  return x.map((value, axis) => value + turned[axis]);
}

/** Returns v turned by the unit quaternion (w, x, y, z): v + 2 r × (r × v + w v). */
function rotated([w, x, y, z], [a, b, c]) {
  const p = [y * c - z * b + w * a, z * a - x * c + w * b, x * b - y * a + w * c];
  return [a + 2 * (y * p[2] - z * p[1]), b + 2 * (z * p[0] - x * p[2]), c + 2 * (x * p[1] - y * p[0])];
}
