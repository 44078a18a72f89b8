"use strict";
// Colours bodies by their number, their speed, or their island: the bodies that contacts and joints connect.

const TINTS = [["plain", "one colour"], ["body", "a colour each"], ["speed", "by speed"], ["island", "by island"]];
const TURN = 0.618034;  // of the circle of hues between consecutive bodies, so that neighbours differ for any number

/** Returns the colour of each moving body in this frame; null if bodies keep the run's colour. */
function tintOf(kind, { header }, frame) {
  if (kind === "body") return hue;
  if (kind === "speed" && frame.v) {
    const fastest = largestOf(velocitiesOf(frame)), slow = colourOf(palette().body), fast = colourOf(palette().impulse);
    const speed = (body) => Math.hypot(...frame.v.subarray(3 * body, 3 * body + 3));
    return (body) => slow.clone().lerp(fast, fastest > 0 ? speed(body) / fastest : 0);
  }
  if (kind === "island") {
    const first = islandsOf(header, frame);
    return (body) => hue(first[body]);
  }
  return null;
}

const hue = (k) => new THREE.Color().setHSL(TURN * k % 1, 0.5, 0.55);

/** Returns for each body the first body of its island. A static body connects nothing. */
function islandsOf({ bodies, joints }, frame) {
  const first = bodies.map((_, body) => body);
  const find = (body) => {
    while (first[body] !== body) body = first[body] = first[first[body]];
    return body;
  };
  const connect = (i, j) => {
    if (bodies[i].fixed || bodies[j].fixed) return;
    const [a, b] = [find(i), find(j)];
    first[Math.max(a, b)] = Math.min(a, b);
  };
  for (let k = 0; k < frame.between.length; k += 2) connect(frame.between[k], frame.between[k + 1]);
  for (const { i, j } of joints) connect(i, j);
  return bodies.map((_, body) => find(body));
}
