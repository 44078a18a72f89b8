"use strict";
// Draws the marks that are switched on: contacts, impulses, friction, velocities, pairs, colours.

const LONGEST = 0.2;  // arrow, over the scene's size
const CROWDED = 60;   // contacts, above which arrows of small impulses are left out
const LEAST = 0.2;    // impulse that is still drawn there, over the frame's largest

class Arrows {
  constructor(parent, material, thickness = 1) {
    this.thickness = thickness;
    const shaft = new THREE.CylinderBufferGeometry(1, 1, 1, 8, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const head = new THREE.CylinderBufferGeometry(0, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.shafts = new Crowd(parent, shaft, material, 7);
    this.heads = new Crowd(parent, head, material, 7);
  }

  begin() {
    this.shafts.begin();
    this.heads.begin();
  }

  add(from, vector, scale, unit, colour) {
    const length = Math.hypot(...vector) * scale;
    if (!(length > 2 * unit)) return;
    unit *= this.thickness;
    const head = Math.min(11 * unit, 0.45 * length) / length;
    const tip = from.map((value, axis) => value + vector[axis] * scale);
    const neck = from.map((value, axis) => value + vector[axis] * scale * (1 - head));
    this.shafts.addBetween(...from, ...neck, 1.2 * unit, colour);
    this.heads.addBetween(...neck, ...tip, 4.2 * unit * Math.min(1, head * length / (6 * unit)), colour);
  }

  end() {
    this.shafts.end();
    this.heads.end();
  }
}

class Marks {
  constructor(parent, run, size) {
    Object.assign(this, { run, size });
    const over = (opacity) => Object.assign(bodyMaterial([], opacity), { transparent: true, depthTest: false });
    this.arrows = new Arrows(parent, over(1));
    this.crowded = new Arrows(parent, over(0.6), 0.6);
    this.points = new Crowd(parent, new THREE.SphereBufferGeometry(1, 10, 8), over(1), 8);
    const pipe = new THREE.CylinderBufferGeometry(1, 1, 1, 6, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    this.pipes = new Crowd(parent, pipe, over(1), 6);
    const limits = Object.assign(over(0.22), { side: THREE.DoubleSide });
    this.limits = new Crowd(parent, limitShape(run.header.method.friction_model), limits, 5);
    this.fixed = { impulse: LONGEST * size / typicalLargest(run, impulsesOf),
                   velocity: LONGEST * size / typicalLargest(run, velocitiesOf) };
    const { contact, impulse, velocity, pair } = palette();
    this.colours = { contact: colourOf(contact), impulse: colourOf(impulse), velocity: colourOf(velocity),
                     pair: colourOf(pair) };
    this.mu = [run.header.parameters.mu, run.header.parameters.friction].find(Number.isFinite);
  }

  /** Draws the marks switched on in `shown`; `unit` is the size of a pixel [m]. */
  draw(frame, shown, unit) {
    const all = [this.arrows, this.crowded, this.points, this.pipes, this.limits];
    for (const crowd of all) crowd.begin();
    if (shown.contacts || shown.impulses || shown.friction || shown.pairs || shown.colours) {
      const scale = this.scaleOf(frame, shown);
      this.least = leastDrawn(frame);
      this.pairColours = shown.colours ? coloursOf(this.run.header, frame) : null;
      for (let k = 0; 2 * k < frame.between.length; ++k) this.drawContact(frame, k, shown, unit, scale);
    }
    if (shown.velocities) this.drawVelocities(frame, unit, shown);
    for (const crowd of all) crowd.end();
  }

  drawContact(frame, k, shown, unit, scale) {
    const { colours } = this;
    const numbers = frame.contacts.subarray(10 * k, 10 * k + 10);
    const point = Array.from(numbers.subarray(0, 3)), normal = Array.from(numbers.subarray(3, 6));
    const impulse = Array.from(numbers.subarray(7, 10));
    if (shown.contacts) {
      this.points.addBall(...point, 3 * unit, colours.contact);
      this.pipes.addBetween(...point, ...point.map((value, axis) => value + 18 * unit * normal[axis]), 0.8 * unit,
                            colours.contact);
    }
    if (shown.colours) this.drawPair(frame, k, point, 1.5 * unit, hue(this.pairColours[k]));
    else if (shown.pairs) this.drawPair(frame, k, point, unit, colours.pair);
    if (shown.friction && this.mu > 0) this.drawLimit(point, normal, impulse, scale, colours.impulse);
    const arrows = this.least > 0 ? this.crowded : this.arrows;
    if (shown.impulses && Math.hypot(...impulse) >= this.least) arrows.add(point, impulse, scale, unit, colours.impulse);
  }

  drawPair(frame, k, point, unit, colour) {
    const bodies = this.run.header.bodies;
    const [i, j] = [frame.between[2 * k], frame.between[2 * k + 1]]
      .map((body) => bodies[body].shape === "plane" ? point : placeOf(frame, body));
    this.pipes.addBetween(...i, ...j, unit, colour);
  }

  /** Draws the friction limit: as high as the normal impulse, and mu times as wide. */
  drawLimit(point, normal, impulse, scale, colour) {
    const press = normal.reduce((sum, value, axis) => sum + value * impulse[axis], 0);
    if (!(press > 0)) return;
    const along = impulse.map((value, axis) => value - press * normal[axis]);
    const rubbing = Math.hypot(...along), sliding = this.run.header.method.tangents === "sliding" && rubbing > 0;
    let [a, b] = acrossOf(...normal);
    if (sliding) {
      a = along.map((value) => value / rubbing);
      b = cross(normal, a);
    }
    const height = press * scale, wide = this.mu * height;
    this.limits.add(...a.map((value) => wide * value), ...b.map((value) => wide * value),
                    ...normal.map((value) => height * value), ...point, colour);
  }

  drawVelocities(frame, unit, shown) {
    if (!frame.v) return;
    const scale = this.fixed.velocity * (shown.automatic ? 1 : shown.scale);
    for (let body = 0; 3 * body < frame.v.length; ++body)
      if (!this.run.header.bodies[body].fixed)
        this.arrows.add(placeOf(frame, body), Array.from(frame.v.subarray(3 * body, 3 * body + 3)), scale, unit,
                        this.colours.velocity);
  }

  /** Returns the metres per newton second: the frame's own scale if automatic, otherwise one scale for the run. */
  scaleOf(frame, shown) {
    if (!shown.automatic) return this.fixed.impulse * shown.scale;
    const largest = largestOf(impulsesOf(frame));
    return largest > 0 ? LONGEST * this.size / largest : 0;
  }
}

function* impulsesOf(frame) {
  for (let k = 0; k < frame.contacts.length; k += 10)
    yield Math.hypot(frame.contacts[k + 7], frame.contacts[k + 8], frame.contacts[k + 9]);
}

/** Returns the colour of each contact's pair of bodies, 0, 1, 2 ...: Eq. (14.7). Static bodies have none. */
function coloursOf({ bodies }, { between }) {
  const used = bodies.map(() => new Set()), known = new Map(), colours = [];
  for (let k = 0; k < between.length; k += 2) {
    const [i, j] = [between[k], between[k + 1]], pair = `${i} ${j}`;
    if (!known.has(pair)) {
      const taken = [i, j].filter((body) => !bodies[body].fixed).map((body) => used[body]);
      let colour = 0;
      while (taken.some((set) => set.has(colour))) ++colour;
      for (const set of taken) set.add(colour);
      known.set(pair, colour);
    }
    colours.push(known.get(pair));
  }
  return colours;
}

/** Returns the least impulse that has an arrow: among many contacts a part of the largest, otherwise 0. */
function leastDrawn(frame) {
  return frame.contacts.length > 10 * CROWDED ? LEAST * largestOf(impulsesOf(frame)) : 0;
}

function* velocitiesOf(frame) {
  for (let k = 0; frame.v && k < frame.v.length; k += 3) yield Math.hypot(frame.v[k], frame.v[k + 1], frame.v[k + 2]);
}

function largestOf(values) {
  let largest = 0;
  for (const value of values) if (value > largest && Number.isFinite(value)) largest = value;
  return largest;
}

/** Returns the median over frames of the largest value in each, so that an impact does not set the scale. */
function typicalLargest(run, valuesOf) {
  const each = run.frames.map((frame) => largestOf(valuesOf(frame))).filter((value) => value > 0).sort((a, b) => a - b);
  return each.length ? each[each.length >> 1] : 1;
}

/** Returns a friction cone, or the pyramid of a friction box, of height 1 with its tip at the contact. */
function limitShape(model) {
  const shape = model === "cone" ? new THREE.CylinderBufferGeometry(1, 0, 1, 32, 1, true)
    : new THREE.CylinderBufferGeometry(Math.SQRT2, 0, 1, 4, 1, true, Math.PI / 4);
  return shape.rotateX(Math.PI / 2).translate(0, 0, 0.5);
}
