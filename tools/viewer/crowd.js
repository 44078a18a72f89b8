"use strict";
// Draws many copies of one shape in a single draw call, with a matrix and a colour each.

class Crowd {
  /** The material `shade` draws each copy a second time, as a shadow, from `geometry.forShade` if there is one. */
  constructor(parent, geometry, material, order = 0, shade = null) {
    Object.assign(this, { parent, geometry, material, order, shadeMaterial: shade });
    this.count = 0;
    this.resize(16);
  }

  resize(capacity) {
    const mesh = new THREE.InstancedMesh(this.geometry.clone(), this.material, capacity);
    mesh.geometry.setAttribute("tint", new THREE.InstancedBufferAttribute(new Float32Array(3 * capacity), 3));
    mesh.frustumCulled = false;  // the bounding sphere is that of a single copy
    mesh.renderOrder = this.order;
    if (this.mesh) {
      mesh.instanceMatrix.array.set(this.mesh.instanceMatrix.array);
      mesh.geometry.attributes.tint.array.set(this.mesh.geometry.attributes.tint.array);
      this.dispose();
    }
    this.mesh = mesh;
    this.meshes = [mesh];
    this.capacity = capacity;
    if (this.shadeMaterial) this.meshes.push(this.shadeOf(mesh));
    this.parent.add(...this.meshes);
  }

  shadeOf(mesh) {
    const shade = new THREE.InstancedMesh(this.geometry.forShade || mesh.geometry, this.shadeMaterial, 0);
    shade.instanceMatrix = mesh.instanceMatrix;
    shade.frustumCulled = false;
    shade.renderOrder = 2;  // after the floor under the shadow
    return shade;
  }

  begin() {
    this.count = 0;
  }

  /** Adds a copy by the columns of its matrix: three scaled axes and the place. */
  add(ax, ay, az, bx, by, bz, cx, cy, cz, x, y, z, colour) {
    if (this.count === this.capacity) this.resize(2 * this.capacity);
    this.mesh.instanceMatrix.array.set([ax, ay, az, 0, bx, by, bz, 0, cx, cy, cz, 0, x, y, z, 1], 16 * this.count);
    const tint = this.mesh.geometry.attributes.tint.array;
    tint[3 * this.count] = colour.r;
    tint[3 * this.count + 1] = colour.g;
    tint[3 * this.count + 2] = colour.b;
    return this.count++;
  }

  /** Adds a ball of radius r. */
  addBall(x, y, z, r, colour) {
    return this.add(r, 0, 0, 0, r, 0, 0, 0, r, x, y, z, colour);
  }

  /** Adds a copy turned by the quaternion (w, i, j, k), with the extents sx, sy, sz along its axes. */
  addPosed(x, y, z, w, i, j, k, sx, sy, sz, colour) {
    return this.add(sx * (1 - 2 * (j * j + k * k)), sx * 2 * (i * j + w * k), sx * 2 * (i * k - w * j),
                    sy * 2 * (i * j - w * k), sy * (1 - 2 * (i * i + k * k)), sy * 2 * (j * k + w * i),
                    sz * 2 * (i * k + w * j), sz * 2 * (j * k - w * i), sz * (1 - 2 * (i * i + j * j)),
                    x, y, z, colour);
  }

  /** Adds a copy whose z axis leads from one point to another. */
  addBetween(x, y, z, toX, toY, toZ, width, colour) {
    const dx = toX - x, dy = toY - y, dz = toZ - z;
    const length = Math.hypot(dx, dy, dz);
    if (!(length > 0) || !Number.isFinite(length)) return -1;
    const [a, b] = acrossOf(dx / length, dy / length, dz / length);
    return this.add(width * a[0], width * a[1], width * a[2], width * b[0], width * b[1], width * b[2], dx, dy, dz,
                    x, y, z, colour);
  }

  end() {
    for (const mesh of this.meshes) {
      mesh.count = this.count;
      mesh.visible = this.count > 0;
    }
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.geometry.attributes.tint.needsUpdate = true;
  }

  dispose() {
    this.parent.remove(...this.meshes);
    this.mesh.geometry.dispose();
  }
}

/** Returns two unit vectors perpendicular to n and to each other: the tangents of Eq. (5.1). */
function acrossOf(x, y, z) {
  const size = [Math.abs(x), Math.abs(y), Math.abs(z)];
  const axis = size.indexOf(Math.min(...size));
  const unit = [0, 0, 0];
  unit[axis] = 1;
  const first = cross([x, y, z], unit);
  const length = Math.hypot(...first);
  const a = first.map((value) => value / length);
  return [a, cross([x, y, z], a)];
}
