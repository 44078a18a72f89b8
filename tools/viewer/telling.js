"use strict";
// Shows the numbers of the clicked body: its position, its velocities, and the impulses on it.

class Telling {
  constructor(viewer) {
    this.viewer = viewer;
    this.node = element("div", { id: "body", hidden: true });
    document.getElementById("stage").append(this.node);
    this.chosen = null;  // { run, body }
  }

  choose(hit) {
    this.chosen = hit && { run: hit.run, body: hit.body };
    this.viewer.dirty();
  }

  /** Shows the numbers at each run's present frame. The chosen body may have been removed. */
  draw(frames) {
    const { runs, picture } = this.viewer;
    if (this.chosen && !(this.chosen.run < runs.length && this.chosen.body < runs[this.chosen.run].header.bodies.length))
      this.chosen = null;
    for (const [k, part] of picture.parts.entries())
      part.bodies.chosen = this.chosen && this.chosen.run === k ? this.chosen.body : null;
    this.node.hidden = !this.chosen;
    if (!this.chosen) return;
    const { run, body } = this.chosen, { header, label } = runs[run], { shape, fixed } = header.bodies[body];
    const title = [`body ${body}`, shape, fixed && "fixed", label].filter(Boolean).join(" · ");
    const rows = numbersOf(frames[run], body).map(([name, text]) =>
      element("tr", {}, element("th", { textContent: name }), element("td", { textContent: text })));
    this.node.replaceChildren(element("table", {}, element("caption", { textContent: title }), ...rows));
  }
}

/** Returns names and values of the quantities in the frame. */
function numbersOf(frame, body) {
  const three = (list) => list && Array.from(list.subarray(3 * body, 3 * body + 3));
  const x = three(frame.x), v = three(frame.v), turn = three(frame.omega), rows = [["position", vectorText(x, "m")]];
  if (v) rows.push(["velocity", vectorText(v, "m/s")], ["speed", inUnit(Math.hypot(...v), "m/s")]);
  if (turn) rows.push(["turning", vectorText(turn, "rad/s")]);
  const pressing = [];
  for (let k = 0; 2 * k < frame.between.length; ++k)
    if (frame.between[2 * k] === body || frame.between[2 * k + 1] === body)
      pressing.push(Math.hypot(...frame.contacts.subarray(10 * k + 7, 10 * k + 10)));
  if (pressing.length) rows.push([`${pressing.length} contact${pressing.length > 1 ? "s" : ""}`,
                                  `largest impulse ${inUnit(largestOf(pressing), "N s")}`]);
  return rows;
}

const vectorText = (values, unit) => `(${values.map(short).join(", ")}) ${unit}`;
