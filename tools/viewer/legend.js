"use strict";
// The legend over the picture: names of runs, colours of tension, length of arrows, spacing of the grid.

class Legend {
  constructor(node) {
    this.names = element("div", { id: "names" });
    this.keys = element("div", { id: "keys" });
    node.append(this.names, this.keys);
  }

  show(picture) {
    this.names.replaceChildren(...(picture.runs.length < 2 ? [] : picture.runs.map((run, k) => {
      const name = element("span", { className: "run" }, element("i"), run.label), panel = picture.panel(k);
      name.firstChild.style.background = palette().runs[k % palette().runs.length];
      const place = { position: "absolute", left: `${panel.left + 12}px`, top: `${panel.top + 10}px` };
      if (!picture.shown.overlaid) Object.assign(name.style, place);
      return name;
    })));
    const [part] = picture.parts, keys = [];
    const hasPlane = part && part.run.header.bodies.some((body) => body.shape === "plane");
    if (!hasPlane && part) keys.push(element("span", { id: "height" }));
    else if (part) keys.push(element("span", { textContent: `grid ${inUnit(part.spacing, "m")}` }));
    const scale = Math.max(0, ...picture.parts.map(({ joints }) => joints.scale));
    if (scale > 0) keys.push(tensionKey(scale));
    this.arrows = element("span", { id: "arrow-key" });
    this.keys.replaceChildren(...keys, this.arrows);
    this.update(picture);
  }

  /** Updates the values of the longest arrows. */
  update(picture) {
    const [part] = picture.parts, { shown } = picture, said = [];
    if (!part || !picture.frames) return;
    if (shown.impulses) said.push(`longest impulse ${inUnit(largestOf(impulsesOf(picture.frames[0])), "N s")}`);
    if (shown.impulses && leastDrawn(picture.frames[0]) > 0) said.push("impulses below a fifth of it have no arrow");
    if (shown.velocities || shown.tint === "speed") said.push(`fastest ${inUnit(largestOf(velocitiesOf(picture.frames[0])), "m/s")}`);
    const node = document.getElementById("height"), { height } = picture.panel(0);
    if (node) node.textContent = `from bottom to top ${inUnit(picture.camera.pixel(height) * height, "m")}`;
    this.arrows.textContent = said.join(" · ");
  }
}

function tensionKey(scale) {
  const bar = element("i", { className: "ramp" }), { push, rod, pull } = palette();
  bar.style.background = `linear-gradient(to right, ${push}, ${rod}, ${pull})`;
  return element("span", { id: "tension" }, `pushes ${inUnit(scale, "N")}`, bar, `pulls ${inUnit(scale, "N")}`);
}
