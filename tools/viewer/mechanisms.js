"use strict";
// Draws the free motion of hinges and sliders: an axis or a line, and its limits.

const AXIS = 22;  // half the length of a hinge's axis [pixels]
const HAND = 30;  // length of the hands that show a hinge's limits [pixels]
const ARC = 16;   // pieces of an arc between two limits

/** Returns v turned by an angle about a unit vector. */
function turnedAbout(axis, angle, v) {
  return rotated([Math.cos(angle / 2), ...axis.map((value) => Math.sin(angle / 2) * value)], v);
}

/** Returns the direction from the axis to j's centre at angle 0, in i's axes; any normal if it is on the axis. */
function zeroDirection(joint) {
  const towards = rotated(joint.rest, joint.p_j.map((value) => -value));
  const along = joint.axis.reduce((sum, value, k) => sum + value * towards[k], 0);
  const across = towards.map((value, k) => value - along * joint.axis[k]), size = Math.hypot(...across);
  return size > 1e-9 * Math.hypot(...towards) ? across.map((value) => value / size) : acrossOf(...joint.axis)[0];
}

/** Returns the lines of a hinge or slider, [from, to] each, in world coordinates; `unit` is a pixel [m]. */
function linesOf(joint, frame, unit) {
  const point = placeOf(frame, joint.i, joint.p_i);
  const world = (v) => frame.q ? rotated(frame.q.subarray(4 * joint.i, 4 * joint.i + 4), v) : v;
  const at = (v, far) => world(v).map((value, k) => point[k] + far * value);
  const limits = (joint.limits || [null, null]).map((limit) => Number.isFinite(limit) ? limit : null);
  if (joint.kind === "slider") return { axis: sliderLine(joint, frame, point, world, limits, unit), marks: limits
    .filter((limit) => limit !== null).map((limit) => crossBar(joint, at, limit, unit)) };
  const axis = [at(joint.axis, -AXIS * unit), at(joint.axis, AXIS * unit)], zero = zeroDirection(joint);
  const tip = (angle) => at(turnedAbout(joint.axis, angle, zero), HAND * unit), marks = [];
  for (const limit of limits) if (limit !== null) marks.push([point, tip(limit)]);
  if (limits.every((limit) => limit !== null)) {
    const [from, to] = limits, angle = (k) => from + Math.min(to - from, 2 * Math.PI) * k / ARC;
    for (let k = 1; k <= ARC; ++k) marks.push([tip(angle(k - 1)), tip(angle(k))]);
  }
  return { axis, marks };
}

/** Returns a slider's line from limit to limit; without a limit it ends beyond the points of both bodies. */
function sliderLine(joint, frame, point, world, limits, unit) {
  const n = world(joint.axis), other = placeOf(frame, joint.j, joint.p_j);
  const shift = n.reduce((sum, value, k) => sum + value * (other[k] - point[k]), 0);
  const from = limits[0] ?? Math.min(0, shift) - AXIS * unit, to = limits[1] ?? Math.max(0, shift) + AXIS * unit;
  return [from, to].map((far) => n.map((value, k) => point[k] + far * value));
}

function crossBar(joint, at, far, unit) {
  const middle = at(joint.axis, far), [a] = acrossOf(...joint.axis), end = at(a, 1), start = at(a, -1);
  return [-1, 1].map((side) => middle.map((value, k) => value + side * 4 * unit * (end[k] - start[k]) / 2));
}
