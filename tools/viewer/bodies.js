"use strict";
// Draws the bodies of a run in their shapes, and ghosts of them at the places of the known answer.

const NO_TURN = [1, 0, 0, 0];

const TURNING_POINT = 2.4;  // how much larger a point with an orientation is drawn, to show its pattern

class Bodies {
  constructor(parent, run, style) {
    this.run = run;
    this.forms = run.header.bodies.map((body) => formOf(body));
    this.style = style;
    const turns = run.frames.some((frame) => frame.q);
    this.crowds = crowdsOf(parent, this.forms, style, turns);
    this.places = new Array(this.forms.length).fill(null);  // [crowd, its index] of each body
    this.chosen = null;  // the highlighted body
    const own = colourOf(style.colour), standing = colourOf(palette().hand);
    this.tint = null;  // the colour of each moving body, from tinting.js
    this.colourAt = (body) => body === this.chosen ? standing
      : this.tint && !run.header.bodies[body].fixed ? this.tint(body) : this.colours[body];
    this.colours = run.header.bodies.map((body) => body.fixed ? own.clone().lerp(colourOf(palette().line), 0.5) : own);
  }

  /** Draws a frame; `point` is the radius of a point mass in the picture. */
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

  /** Returns the place at which a body was drawn, from its matrix. */
  drawnAt(body) {
    if (!this.places[body]) return null;
    const [crowd, index] = this.places[body];
    return Array.from(crowd.mesh.instanceMatrix.array.subarray(16 * index + 12, 16 * index + 15));
  }

  /** Returns the colour in which a body was drawn. */
  tintAt(body) {
    const [crowd, index] = this.places[body];
    return Array.from(crowd.mesh.geometry.attributes.tint.array.subarray(3 * index, 3 * index + 3));
  }

  count() {
    return Object.values(this.crowds).reduce((sum, crowd) => sum + crowd.count, 0);
  }
}

/** Returns a body's drawn kind, its half extents, and its bounding radius. Planes have an empty kind. */
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

/** Returns a box if one of the points is a corner of their bounding box, otherwise a disc. */
function formOfCorners(points) {
  const sides = [0, 1, 2].map((axis) => Math.max(...points.map((p) => Math.abs(p[axis]))));
  const largest = Math.max(...sides);
  const round = Math.max(...points.map((p) => Math.hypot(p[0], p[1])));
  const boxed = points.some((p) => Math.abs(p[0]) > 0.99 * sides[0] && Math.abs(p[1]) > 0.99 * sides[1]);
  const height = Math.max(sides[2], 0.03 * largest);
  return { kind: boxed ? "box" : "disc", sides: boxed ? [sides[0], sides[1], height] : [round, round, height],
           radius: Math.hypot(...sides), points };
}

/** Returns a capsule of radius 1 about the z axis with this half length. Each proportion is a kind of its own. */
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
    // A ghost without an orientation takes that of its body.
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
    // A ghost is transparent. Of its patterns only edges are drawn, so that its colour can be seen.
    const kinds = style.ghost ? [...marks.filter((mark) => mark === "BOX"), "GHOST"] : [...marks, "LIT"];
    // Shadows double the number of vertices; a coarse ball is enough for them.
    if (many && kind === "ball") geometry.forShade = new THREE.IcosahedronBufferGeometry(1, 1);
    const material = bodyMaterial(kinds, style.opacity);
    return [kind, new Crowd(parent, geometry, material, style.ghost ? 4 : style.order, style.shade)];
  }));
}
