"use strict";
// The pointer on the picture: a double click follows a body. In a live run a drag pulls one, and with shift pushes it.

class Pointing {
  constructor(viewer) {
    this.viewer = viewer;
    document.getElementById("how").textContent = document.getElementById("live")
      ? "drag a body: pull · shift and click: push · drag beside it: turn · wheel: zoom · double click: follow"
      : "drag: turn · wheel: zoom · double click on a body: follow";
    const { canvas } = viewer.picture;
    // Before the camera's own listeners, which begin with the mouse events that follow.
    canvas.addEventListener("pointerdown", (event) => this.down(event), true);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => this.up());
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
    const { live, picture } = this.viewer, hit = live && event.button === 0 ? this.hit(event) : null;
    if (!hit || this.viewer.runs[0].header.bodies[hit.body].fixed) return;
    picture.camera.orbit.enabled = false;  // this drag is not the camera's
    if (event.shiftKey) return live.push(hit, picture.camera.eye);
    picture.canvas.setPointerCapture(event.pointerId);
    this.pulled = hit;
    this.move(event);
  }

  /** In the plane through the point that was hit, parallel to the screen. */
  move(event) {
    if (!this.pulled) return;
    const { picture, live } = this.viewer, { left, top } = picture.canvas.getBoundingClientRect();
    const { ray } = picture.rayAt(event.clientX - left, event.clientY - top);
    const facing = picture.camera.eye.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(facing, new THREE.Vector3(...this.pulled.place));
    const to = ray.intersectPlane(plane, new THREE.Vector3());
    if (to) live.pull(this.pulled, to.toArray());
  }

  up() {
    this.viewer.picture.camera.orbit.enabled = true;
    if (!this.pulled) return;
    this.pulled = null;
    this.viewer.live.release();
  }
}
