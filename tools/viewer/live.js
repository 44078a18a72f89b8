"use strict";
// A live run, or two side by side: receives frames and sends commands through one of transports.js for each.

const KEPT = 1200;      // past frames that remain available
const GROWN = 1.1;      // growth of the bodies' box after which the view is fitted again, unless a hand moves bodies
const FARTHEST = 4;     // largest size that is still fitted, over the first size
const GRAPHS_EVERY = 150;  // [ms]

/** A run and its engine. The parameters in `named` label it; no command sets those in `keeps`. */
class Side {
  constructor(transport, named = [], keeps = []) {
    Object.assign(this, { transport, named, keeps, run: null, pending: null });
  }

  labelOf({ controls = [] }) {
    return controls.filter(({ name }) => this.named.includes(name))
      .map(({ name, value }) => `${name} ${value}`.replaceAll("_", " ")).join(", ");
  }

  send(command) {
    if (!command.set) return this.transport.send(command);
    const set = Object.fromEntries(Object.entries(command.set).filter(([name]) => !this.keeps.includes(name)));
    return this.transport.send({ ...command, set });
  }
}

class Live {
  constructor(viewer, sides, figure = null) {
    this.viewer = viewer;
    this.sides = sides;
    this.figure = figure;
    this.running = true;
    this.sent = Promise.resolve();
    this.handled = false;  // a reader has pulled, pushed or dropped a body since the run began
    document.body.classList.add("live");
    document.getElementById("drop").onclick = () => this.drop();
    document.getElementById("reset").onclick = () => this.reset();
    document.getElementById("next").title = "next step (right)";
    for (const side of sides) side.transport.open((line) => this.take(line, side), (why) => this.lose(why));
  }

  /** The first run, whose controls and clock are those of the page. */
  get run() {
    return this.sides[0].run;
  }

  lose(why) {
    this.viewer.say(why);
    if (this.figure && why) this.figure.lost(why);
  }

  take(line, side) {
    try {
      if ("said" in line) this.show(line.said);
      else if ("clock" in line) this.takeClock(line.clock);
      else if ("refused" in line) this.flash(`Refused: ${line.refused}`);
      else if ("end" in line) this.viewer.say(endOf(line));
      else if ("format" in line) side.pending = checkedHeader(line);  // until its first frame
      else this.frame(frameOf(line, side.pending || side.run.header), side);
    } catch (error) {
      this.flash(`A line of the run cannot be read: ${error.message}.`);
    }
  }

  /** Restores the clock after the page was reloaded. */
  takeClock({ pause, rate }) {
    this.running = !pause;
    const { speed } = this.viewer.controls;
    speed.value = String(rate);
    this.viewer.dirty();
  }

  /** Shows the messages of a build until a run continues. */
  show(text) {
    const box = document.getElementById("said");
    box.textContent = text;
    box.hidden = !text;
  }

  flash(text) {
    this.viewer.say(text);
    clearTimeout(this.flashing);
    this.flashing = setTimeout(() => this.viewer.say(""), 5000);
  }

  frame(frame, side) {
    if (side.pending) this.begin(frame, side);
    const { frames } = side.run;
    if (frames.length && frame.time < lastOf(frames).time) frames.length = 0;
    frames.push(frame);
    if (frames.length > KEPT) frames.splice(0, frames.length - KEPT);
    if (side !== this.sides[0] || !this.sides.every(({ run }) => run)) return;
    this.viewer.player.goTo(frames.length - 1);
    document.body.classList.toggle("touched", Boolean(frame.touched));
    this.refresh();
  }

  begin(frame, side) {
    const header = side.pending, first = !side.run;
    side.pending = null;
    // After a drop the graphs keep their past; after a restart they begin again.
    const more = first ? 0 : header.bodies.length - side.run.header.bodies.length;
    const before = first || more < 0 || frame.time < lastOf(side.run.frames).time ? [] : side.run.frames;
    const same = !first && more === 0;
    side.run = { header, frames: [...before, frame], notice: "", label: side.labelOf(header), live: true };
    if (this.sides.every(({ run }) => run)) this.showRuns(same || before.length > 0 || frame.touched, first);
    if (!before.length) this.firstSize = this.viewer.picture.box && this.viewer.picture.box.size;
    side.run.frames.pop();  // frame() adds it
    if (side === this.sides[0]) this.begun(header, first);
  }

  /** Shows all runs; `keep` leaves the camera where it is. */
  showRuns(keep, first) {
    const { viewer } = this;
    if (first && this.figure) this.figure.begun(this.run.header);
    viewer.show(this.sides.map(({ run }) => run), keep);
    viewer.player.lead = this.run;
    viewer.player.goTo(this.run.frames.length - 1);
  }

  /** Takes the controls of the first run. */
  begun(header, first) {
    if (first) this.first = header.controls || [];
    this.makeSliders(header.controls || []);
    document.getElementById("reset").hidden = Object.keys(this.changed()).length === 0;
  }

  /** Redraws the graphs at intervals, and fits the view unless the reader has turned it. */
  refresh() {
    const now = performance.now(), { viewer } = this;
    if (now - (this.refreshed || 0) < GRAPHS_EVERY) return;
    this.refreshed = now;
    for (const graph of viewer.graphs) graph.prepare();
    const last = lastOf(this.run.frames);
    if (this.figure && this.figure.lasts && last.time >= this.figure.lasts && !this.handled) this.again();
    if (!viewer.picture.camera.untouched() || this.handled) return;
    const runs = this.sides.map(({ run }) => run), box = boundsOf(runs), left = box.size >= FARTHEST * this.firstSize;
    if (box.size > GROWN * viewer.picture.box.size && !left) {
      viewer.picture.show(runs);
      viewer.legend.show(viewer.picture);
    }
    // A figure has no button to fit the view, so it restarts when its bodies leave. A lost run stays and is reported.
    if (left && this.figure && last.state !== "lost") this.again();
  }

  /** Begins the run again, once for as long as its frames are those of the past. */
  again() {
    const { frames } = this.run;
    if (this.left === frames) return;
    this.left = frames;
    this.handled = false;
    this.send({ restart: true });
  }

  makeSliders(controls) {
    const parent = document.getElementById("sliders");
    if (parent.contains(document.activeElement)) return;
    parent.replaceChildren(...this.shownOf(controls).map((control) => controlNode(control, (value) =>
      this.send({ set: { [control.name]: value } }))));
  }

  shownOf(controls) {
    return this.figure ? this.figure.controlsOf(controls) : controls;
  }

  /** Returns the first values of all controls that have changed since the page was opened. */
  changed() {
    const first = new Map(this.first.map((control) => [control.name, control.value]));
    return Object.fromEntries(this.shownOf(this.run.header.controls || [])
      .filter(({ name, value }) => first.has(name) && first.get(name) !== value).map(({ name }) => [name, first.get(name)]));
  }

  /** Restores the first settings of the page and restarts. */
  reset() {
    const set = this.changed();
    document.activeElement.blur();  // so that the sliders follow
    if (Object.keys(set).length) this.send({ set });
    this.restart();
  }

  /** Sends commands one at a time, in order. */
  send(command) {
    this.sent = this.sent.then(() => Promise.all(this.sides.map((side) => side.send(command))));
    return this.sent;
  }

  hold(on) {
    this.running = !on;
    this.viewer.dirty();
    return this.send({ pause: on });
  }

  /** Steps the engine forwards, or shows earlier frames. */
  step(count) {
    const { player } = this.viewer;
    if (this.running) this.hold(true);
    if (count > 0 && player.index === player.count - 1) this.send({ step: count });
    else player.goTo(player.index + count);
  }

  restart() {
    this.running = true;
    this.handled = false;
    this.send({ restart: true });
    return this.send({ pause: false });
  }

  pull(hit, to) {
    this.handled = true;
    this.viewer.picture.hand = { body: hit.body, local: hit.local, to };
    this.viewer.dirty();
    this.wanted = { pull: { body: hit.body, point: hit.local, to } };
    if (!this.pulling) this.sendPulls();
  }

  /** Sends the latest place of the pointer; the places that it passes during a request are skipped. */
  async sendPulls() {
    this.pulling = true;
    while (this.wanted) {
      const { wanted } = this;
      this.wanted = null;
      await this.send(wanted);
    }
    this.pulling = false;
  }

  release() {
    this.wanted = null;
    this.viewer.picture.hand = null;
    this.viewer.dirty();
    this.send({ release: true });
  }

  /** Pushes a body away from the eye. The impulse gives a mass of 1 kg a speed of the scene's size per second. */
  push(hit, eye) {
    this.handled = true;
    const along = eye.getWorldDirection(new THREE.Vector3()).multiplyScalar(this.viewer.picture.box.size);
    this.send({ push: { body: hit.body, impulse: along.toArray() } });
  }

  drop() {
    this.handled = true;
    const { box } = this.viewer.picture, like = this.run.header.bodies.find((body) => body.shape === "ball");
    const radius = like ? like.radius : 0.05 * box.size;
    this.send({ drop: { x: [box.centre.x, box.centre.y, box.high.z + 2 * radius], radius, mass: 1 } });
  }
}

/** Returns a control's name and meaning: the first part as text, all of it in the tooltip. */
function controlName({ name, meaning }) {
  const spoken = name.replaceAll("_", " ");
  const words = element("span", { className: "words", textContent: (meaning || "").split(";")[0] });
  return element("span", { className: "control", title: `${spoken}: ${meaning}` }, element("b", { textContent: spoken }),
                 " ", words);
}

function controlNode(control, send) {
  const label = element("label", {}, controlName(control));
  if (control.choices) {
    const select = element("select", { name: control.name }, ...control.choices.map((choice) => element("option", {
      value: JSON.stringify(choice), textContent: String(choice), selected: choice === control.value })));
    select.onchange = () => send(JSON.parse(select.value));
    label.append(select);
    return label;
  }
  const { low, high, logarithmic, whole, value } = control;
  const position = (number) =>
    logarithmic ? Math.log(number / low) / Math.log(high / low) : (number - low) / (high - low);
  const shown = element("output", { textContent: inUnit(value, control.unit) });
  const slider = element("input", { type: "range", name: control.name, min: 0, max: 1, step: "any",
                                    value: position(value) });
  slider.oninput = () => {
    const part = Number(slider.value);
    let chosen = logarithmic ? low * (high / low) ** part : low + part * (high - low);
    chosen = whole ? Math.round(chosen) : Number(chosen.toPrecision(3));
    chosen = clamp(chosen, low, high);
    shown.textContent = inUnit(chosen, control.unit);
    send(chosen);
  };
  label.append(slider, shown);
  return label;
}
