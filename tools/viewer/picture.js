"use strict";
// The picture: draws the runs side by side under one camera, or over each other.

const POINT = 5;      // the radius of a point mass on the screen [pixels]
const ALONE = 0.12;   // radius of a single point mass that does not move, over the picture's size
const RUN_OPACITY = 0.55;  // of the runs that are drawn over the first

class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setScissorTest(true);
    this.camera = new Camera(canvas);
    this.shown = { contacts: false, impulses: false, friction: false, velocities: false, pairs: false, colours: false, ghosts: true,
                   paths: false, shadows: true, automatic: true, scale: 1, overlaid: false, tint: "plain" };
    this.hand = null;  // { body, local, to } of a pull: the point of the body, and its target
    this.runs = [];
  }

  /** Shows runs; `keep` leaves the camera where it is. */
  show(runs, keep = false) {
    this.runs = runs;
    this.box = boundsOf(runs);
    this.shown.paths = this.shown.paths || runs.every((run) => !run.live && movingBodies(run).length <= FEW);
    this.build();
    if (!keep) this.fit();
  }

  build() {
    if (this.scene) this.scene.traverse((object) => object.geometry && object.geometry.dispose());
    this.scene = new THREE.Scene();
    this.renderer.setClearColor(colourOf(palette().paper));
    this.parts = this.runs.map((run, index) => this.part(run, index));
    const dot = Object.assign(bodyMaterial([], 1), { transparent: true, depthTest: false });
    this.pull = new Arrows(this.scene, dot);
  }

  part(run, index) {
    const group = new THREE.Group(), scenery = new THREE.Group();
    const behind = this.shown.overlaid && index > 0;
    const floor = this.shown.shadows && !behind ? floorOf(run) : null;
    const style = { colour: palette().runs[this.runs.length > 1 ? index % palette().runs.length : 0],
                    opacity: behind ? RUN_OPACITY : 1, order: behind ? 3 : 0,
                    shade: floor && shadeMaterial(floor.n, floor.offset) };
    const spacing = addPlanes(scenery, run, this.box);
    scenery.visible = !behind;
    group.add(scenery);
    this.scene.add(group);
    return { run, group, spacing, bodies: new Bodies(group, run, style), joints: new Joints(group, run, style),
             ghosts: new Bodies(group, run, { ghost: true, opacity: 0.1, colour: palette().ghost }),
             paths: new Paths(group, run), marks: new Marks(group, run, this.box.size) };
  }

  fit() {
    const { width, height } = this.panel(0);
    this.camera.followed = null;
    // A small picture of two runs has their names above it.
    const part = this.runs.length > 1 && document.body.classList.contains("figure") ? 0.74 : 0.88;
    this.camera.fit(this.box, directionFor(this.box, this.runs.some(floorOf)), width / height, part);
  }

  /** Draws one frame of each run. */
  draw(frames) {
    this.frames = frames;
    const unit = this.camera.pixel(this.panel(0).height);
    const [leader] = this.parts;
    if (this.camera.followed !== null && leader) this.camera.keepUpWith(placeOf(frames[0], this.camera.followed));
    for (const [k, part] of this.parts.entries()) {
      const frame = frames[k];
      const point = this.box.empty ? ALONE * this.box.size : POINT * unit * part.joints.closeness(unit);
      part.bodies.tint = tintOf(this.shown.tint, part.run, frame);
      part.bodies.draw(frame, point);
      part.ghosts.draw(this.shown.ghosts ? frame : { ...frame, ghostBodies: [] },
                       this.box.empty ? 1.03 * point : 1.25 * point);
      part.joints.draw(frame, unit, this.shown.ghosts);
      part.paths.draw(frame, this.shown.paths);
      part.marks.draw(frame, this.shown, unit);
    }
    this.drawHand(unit);
    this.render();
  }

  drawHand(unit) {
    this.pull.begin();
    if (this.hand) {
      const from = placeOf(this.frames[0], this.hand.body, this.hand.local);
      this.pull.add(from, this.hand.to.map((value, axis) => value - from[axis]), 1, unit, colourOf(palette().hand));
    }
    this.pull.end();
  }

  render() {
    const panels = this.shown.overlaid ? 1 : Math.max(1, this.parts.length);
    // Panels may not cover the canvas, as with three runs in two columns.
    this.renderer.setScissor(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    this.renderer.clear();
    for (let k = 0; k < panels; ++k) {
      const { left, top, width, height } = this.panel(k);
      const bottom = this.canvas.clientHeight - top - height;
      if (!this.shown.overlaid) for (const [other, part] of this.parts.entries()) part.group.visible = other === k;
      else for (const part of this.parts) part.group.visible = true;
      this.renderer.setViewport(left, bottom, width, height);
      this.renderer.setScissor(left, bottom, width, height);
      this.renderer.render(this.scene, this.camera.eye);
    }
  }

  /** Returns the panel of a run [CSS pixels]: side by side on a wide canvas, otherwise below each other. */
  panel(index) {
    const width = this.canvas.clientWidth || 1, height = this.canvas.clientHeight || 1;
    const count = this.shown.overlaid ? 1 : Math.max(1, this.runs.length);
    const columns = Math.min(count, Math.max(1, Math.round(Math.sqrt(count * width / height))));
    const rows = Math.ceil(count / columns), place = this.shown.overlaid ? 0 : index;
    const w = Math.floor(width / columns), h = Math.floor(height / rows);
    return { left: place % columns * w, top: Math.floor(place / columns) * h, width: w, height: h };
  }

  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    const untouched = this.camera.untouched();
    this.renderer.setSize(width, height, false);
    const panel = this.panel(0);
    this.camera.eye.aspect = panel.width / panel.height;
    this.camera.eye.updateProjectionMatrix();
    if (untouched) this.fit();
  }

  /** Returns the place on the canvas of a point of the world, in the panel of a run [CSS pixels]. */
  project(place, index = 0) {
    this.camera.eye.updateMatrixWorld();
    const p = new THREE.Vector3(...place).project(this.camera.eye), panel = this.panel(index);
    return [panel.left + (p.x + 1) / 2 * panel.width, panel.top + (1 - p.y) / 2 * panel.height];
  }

  /** Returns the run whose panel is at a place on the canvas, and the ray of sight through that place. */
  rayAt(x, y) {
    let run = this.runs.findIndex((_, k) => {
      const panel = this.panel(k);
      return x >= panel.left && x < panel.left + panel.width && y >= panel.top && y < panel.top + panel.height;
    });
    run = Math.max(0, run);
    const panel = this.panel(run), caster = new THREE.Raycaster();
    caster.setFromCamera({ x: 2 * (x - panel.left) / panel.width - 1, y: 1 - 2 * (y - panel.top) / panel.height },
                         this.camera.eye);
    return { run, ray: caster.ray };
  }
}
