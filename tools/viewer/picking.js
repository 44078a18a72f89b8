"use strict";
// Finds the body under the pointer, and the point of it.

const NEAR = 12;  // largest distance of a click from a point mass [pixels]

/** Returns { run, body, place, local }, with the point in world and body axes; null if no body is there. */
function pick(picture, x, y) {
  const { run, ray } = picture.rayAt(x, y);
  const frame = picture.frames[run], unit = picture.camera.pixel(picture.panel(run).height);
  let best = null;
  for (const [body, form] of picture.parts[run].bodies.forms.entries()) {
    if (!form.kind || 3 * body >= frame.x.length) continue;
    const turn = frame.q ? frame.q.subarray(4 * body, 4 * body + 4) : NO_TURN;
    const back = [turn[0], -turn[1], -turn[2], -turn[3]], x0 = placeOf(frame, body);
    const origin = rotated(back, ray.origin.toArray().map((value, axis) => value - x0[axis]));
    const along = rotated(back, ray.direction.toArray());
    const distance = form.kind === "box" ? intoBox(origin, along, form.sides)
      : intoBall(origin, along, form.kind === "point" ? NEAR * unit : form.radius);
    if (distance !== null && (!best || distance < best.distance)) {
      const local = form.kind === "point" ? [0, 0, 0] : origin.map((value, axis) => value + distance * along[axis]);
      best = { run, body, distance, local, place: placeOf(frame, body, local) };
    }
  }
  return best;
}

function intoBall(origin, along, radius) {
  const b = origin.reduce((sum, value, axis) => sum + value * along[axis], 0);
  const inside = b * b - origin.reduce((sum, value) => sum + value * value, 0) + radius * radius;
  return inside >= 0 && -b - Math.sqrt(inside) > 0 ? -b - Math.sqrt(inside) : null;
}

function intoBox(origin, along, sides) {
  let enter = 0, leave = Infinity;
  for (let axis = 0; axis < 3; ++axis) {
    const ends = [-1, 1].map((end) => (end * sides[axis] - origin[axis]) / along[axis]).sort((a, b) => a - b);
    enter = Math.max(enter, ends[0]);
    leave = Math.min(leave, ends[1]);
  }
  return enter <= leave && enter > 0 ? enter : null;
}
