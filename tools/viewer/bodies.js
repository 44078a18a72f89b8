"use strict";
// The bodies of a run, each as its shape says; and the same shapes as ghosts, where the answer says they should be.

const NO_TURN = [1, 0, 0, 0];

const TURNING_POINT = 2.4;  // what has an orientation is drawn so much larger, with its pattern

class Bodies {
  constructor(parent, run, style) {
    this.run = run;
    this.forms = run.header.bodies.map((body) => formOf(body));
    this.style = style;
    const turns = run.frames.some((frame) => frame.q);
    this.crowds = crowdsOf(parent, this.forms, style, turns);
    this.places = new Array(this.forms.length).fill(null);  // [crowd, its index] of each body
    this.chosen = null;  // the body that stands out
    const own = colourOf(style.colour), standing = colourOf(palette().hand);
    this.tint = null;  // a colour of each body that moves: tinting.js
    this.colourAt = (body) => body === this.chosen ? standing
      : this.tint && !run.header.bodies[body].fixed ? this.tint(body) : this.colours[body];
    this.colours = run.header.bodies.map((body) => body.fixed ? own.clone().lerp(colourOf(palette().line), 0.5) : own);
  }

  /** `point` is the radius in which a point mass is drawn. */
  draw(frame, point) {
    const posed = this.style.ghost ? ghostsOf(frame) : posesOf(frame);
    for (const crowd of Object.values(this.crowds)) crowd.begin();
    this.places.fill(null);
    for (const { body, x, at, q, turn } of posed) {
      const form = this.forms[body];
      if (!form.kind || !Number.isFinite(x[at] + x[at + 1] + x[at + 2])) continue;
      const r = frame.q ? TURNING_POINT * point : point;
      const [sx, sy, sz] = form.kind === "point" ? [r, r, r] : form.sides;
      const crowd = this.crowds[form.kind];
      this.places[body] = [crowd, crowd.addPosed(x[at], x[at + 1], x[at + 2], q[turn], q[turn + 1], q[turn + 2],
                                                 q[turn + 3], sx, sy, sz, this.colourAt(body))];
    }
    for (const crowd of Object.values(this.crowds)) crowd.end();
  }

  /** Where a body is drawn: read off the matrix that was drawn. */
  drawnAt(body) {
    if (!this.places[body]) return null;
    const [crowd, index] = this.places[body];
    return Array.from(crowd.mesh.instanceMatrix.array.subarray(16 * index + 12, 16 * index + 15));
  }

  /** The colour in which a body is drawn: likewise. */
  tintAt(body) {
    const [crowd, index] = this.places[body];
    return Array.from(crowd.mesh.geometry.attributes.tint.array.subarray(3 * index, 3 * index + 3));
  }

  count() {
    return Object.values(this.crowds).reduce((sum, crowd) => sum + crowd.count, 0);
  }
}

/** What a body is drawn as, its half extents, and the radius around it. No kind for planes. */
function formOf(body) {
  const three = (r) => [r, r, r];
  if (body.shape === "ball") return { kind: "ball", sides: three(body.radius), radius: body.radius };
  if (body.shape === "box")
    return { kind: "box", sides: body.half_sides, radius: Math.hypot(...body.half_sides) };
  if (body.shape === "capsule")
    return { kind: `capsule ${body.half_length / body.radius}`, sides: three(body.radius),
             radius: body.radius + body.half_length };
  if (body.shape === "corners") return formOfCorners(triples(body.points));
  if (body.shape === "plane" || body.shape === "hand") return { kind: "", sides: three(0), radius: 0 };
  return { kind: "point", sides: three(0), radius: 0 };
}

/** A box if one of the points is a corner of what holds them all, or else a disc. */
function formOfCorners(points) {
  const sides = [0, 1, 2].map((axis) => Math.max(...points.map((p) => Math.abs(p[axis]))));
  const largest = Math.max(...sides);
  const round = Math.max(...points.map((p) => Math.hypot(p[0], p[1])));
  const boxed = points.some((p) => Math.abs(p[0]) > 0.99 * sides[0] && Math.abs(p[1]) > 0.99 * sides[1]);
  const height = Math.max(sides[2], 0.03 * largest);
  return { kind: boxed ? "box" : "disc", sides: boxed ? [sides[0], sides[1], height] : [round, round, height],
           radius: Math.hypot(...sides), points };
}

/** A capsule of radius 1 about the z axis, whose segment has this half length: a kind for each proportion. */
function capsule(halfLength) {
  const steps = 12, profile = [];
  for (let k = 0; k <= 2 * steps + 1; ++k) {
    const upper = k > steps, angle = -Math.PI / 2 + (Math.PI / 2) * ((k - (upper ? 1 : 0)) / steps);
    profile.push(new THREE.Vector2(Math.max(Math.cos(angle), 0), Math.sin(angle) + (upper ? halfLength : -halfLength)));
  }
  return new THREE.LatheBufferGeometry(profile, 32).rotateX(Math.PI / 2);
}

function triples(points) {
  if (points.length && Array.isArray(points[0])) return points;
  const flat = numbers(points, Float32Array, "points");
  return Array.from({ length: flat.length / 3 }, (_, k) => Array.from(flat.subarray(3 * k, 3 * k + 3)));
}

function* posesOf(frame) {
  for (let body = 0; 3 * body < frame.x.length; ++body)
    yield { body, x: frame.x, at: 3 * body, q: frame.q || NO_TURN, turn: frame.q ? 4 * body : 0 };
}

function* ghostsOf(frame) {
  const turned = frame.ghost.length === 7 * frame.ghostBodies.length;
  for (const [k, body] of frame.ghostBodies.entries()) {
    const at = (turned ? 7 : 3) * k;
    // Without an orientation of its own a ghost turns as the body does.
    if (turned) yield { body, x: frame.ghost, at, q: frame.ghost, turn: at + 3 };
    else yield { body, x: frame.ghost, at, q: frame.q || NO_TURN, turn: frame.q ? 4 * body : 0 };
  }
}

function crowdsOf(parent, forms, style, turns) {
  const many = forms.length > 200, ball = many ? [1, 14, 10] : [1, 32, 24];
  const point = forms.length > 50 ? [1, 16, 12] : ball;
  const disc = new THREE.CylinderBufferGeometry(1, 1, 2, 48).rotateX(Math.PI / 2);
  const shapes = { ball: [new THREE.SphereBufferGeometry(...ball), ["BALL"]],
                   box: [new THREE.BoxBufferGeometry(2, 2, 2), ["BOX"]], disc: [disc, ["DISC"]],
                   point: [new THREE.SphereBufferGeometry(...point), turns ? ["BALL"] : []] };
  for (const { kind } of forms)
    if (kind.startsWith("capsule ")) shapes[kind] = [capsule(Number(kind.slice(8))), ["BALL"]];
  const used = Object.keys(shapes).filter((kind) => forms.some((form) => form.kind === kind));
  return Object.fromEntries(used.map((kind) => {
    const [geometry, marks] = shapes[kind];
    // A run beside another is see-through, and has no pattern that would hide its colour.
    const kinds = style.ghost ? [...marks.filter((mark) => mark === "BOX"), "GHOST"] : [...marks, "LIT"];
    // Shadows are half of all corners, and need few of them.
    if (many && kind === "ball") geometry.forShade = new THREE.IcosahedronBufferGeometry(1, 1);
    const material = bodyMaterial(kinds, style.opacity);
    return [kind, new Crowd(parent, geometry, material, style.ghost ? 4 : style.order, style.shade)];
  }));
}
