"use strict";
// The pointer on the picture: a click on a body shows its numbers, and a double click follows it. In a live run a drag
// pulls a body, and shift with a click pushes it.

const STILL = 4;  // a shorter move of the pointer is a click [pixels]

/** Returns the help text for a mouse or a finger. */
function howTo(live) {
  const touch = window.matchMedia("(pointer: coarse)").matches;
  if (touch) return live ? "drag a body: pull · tap it: its numbers" : "drag: turn · tap a body: its numbers";
  return live ? "drag a body: pull · shift and click: push · click: its numbers · double click: follow · drag beside it: turn"
    : "drag: turn · wheel: zoom · click on a body: its numbers · double click: follow";
}

class Pointing {
  constructor(viewer) {
    this.viewer = viewer;
    document.getElementById("how").textContent = howTo(Boolean(document.getElementById("live")));
    const { canvas } = viewer.picture;
    // Captured, so that it precedes the camera's own listeners.
    canvas.addEventListener("pointerdown", (event) => this.down(event), true);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", () => this.letGo());
    canvas.addEventListener("dblclick", (event) => {
      const hit = this.hit(event);
      viewer.follow(hit ? hit.body : null);
    });
  }

  hit(event) {
    const { left, top } = this.viewer.picture.canvas.getBoundingClientRect();
    return this.viewer.runs ? pick(this.viewer.picture, event.clientX - left, event.clientY - top) : null;
  }

  down(event) {
    const { live, picture } = this.viewer, hit = event.button === 0 ? this.hit(event) : null;
    this.pressed = { hit, x: event.clientX, y: event.clientY };
    if (!live || !hit || this.viewer.runs[0].header.bodies[hit.body].fixed) return;
    picture.camera.orbit.enabled = false;  // this drag must not turn the camera
    if (event.shiftKey) {
      this.pressed = null;
      return live.push(hit, picture.camera.eye);
    }
    picture.canvas.setPointerCapture(event.pointerId);
    this.held = hit;
  }

  hasMoved(event) {
    return !this.pressed || Math.hypot(event.clientX - this.pressed.x, event.clientY - this.pressed.y) >= STILL;
  }

  /** Pulls the body in the plane through the grasped point, parallel to the screen. */
  move(event) {
    if (this.held && this.hasMoved(event)) this.pulled = this.held;
    if (!this.pulled) return;
    const { picture, live } = this.viewer, { left, top } = picture.canvas.getBoundingClientRect();
    const { ray } = picture.rayAt(event.clientX - left, event.clientY - top);
    const facing = picture.camera.eye.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(facing, new THREE.Vector3(...this.pulled.place));
    const to = ray.intersectPlane(plane, new THREE.Vector3());
    if (to) live.pull(this.pulled, to.toArray());
  }

  up(event) {
    if (!this.hasMoved(event)) this.viewer.telling.choose(this.pressed.hit);
    this.letGo();
  }

  letGo() {
    this.viewer.picture.camera.orbit.enabled = true;
    if (this.pulled) this.viewer.live.release();
    this.held = this.pulled = this.pressed = null;
  }
}
