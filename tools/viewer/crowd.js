"use strict";
// Many of one shape in one call of the graphics card: a matrix and a colour each.

class Crowd {
  /** With `shade`, a material, all is drawn a second time in that: of `geometry.forShade`, if it is there. */
  constructor(parent, geometry, material, order = 0, shade = null) {
    Object.assign(this, { parent, geometry, material, order, shadeMaterial: shade });
    this.count = 0;
    this.resize(16);
  }

  resize(capacity) {
    const mesh = new THREE.InstancedMesh(this.geometry.clone(), this.material, capacity);
    mesh.geometry.setAttribute("tint", new THREE.InstancedBufferAttribute(new Float32Array(3 * capacity), 3));
    mesh.frustumCulled = false;  // its bounding sphere is that of one
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
    shade.renderOrder = 2;  // after the floor that it falls on
    return shade;
  }

  begin() {
    this.count = 0;
  }

  /** The columns of the matrix: three axes with their lengths, and the place. */
  add(ax, ay, az, bx, by, bz, cx, cy, cz, x, y, z, colour) {
    if (this.count === this.capacity) this.resize(2 * this.capacity);
    this.mesh.instanceMatrix.array.set([ax, ay, az, 0, bx, by, bz, 0, cx, cy, cz, 0, x, y, z, 1], 16 * this.count);
    const tint = this.mesh.geometry.attributes.tint.array;
    tint[3 * this.count] = colour.r;
    tint[3 * this.count + 1] = colour.g;
    tint[3 * this.count + 2] = colour.b;
    return this.count++;
  }

  /** A ball of that radius. */
  addBall(x, y, z, r, colour) {
    return this.add(r, 0, 0, 0, r, 0, 0, 0, r, x, y, z, colour);
  }

  /** Turned by the quaternion (w, x, y, z), with an extent along each of its axes. */
  addPosed(x, y, z, w, i, j, k, sx, sy, sz, colour) {
    return this.add(sx * (1 - 2 * (j * j + k * k)), sx * 2 * (i * j + w * k), sx * 2 * (i * k - w * j),
                    sy * 2 * (i * j - w * k), sy * (1 - 2 * (i * i + k * k)), sy * 2 * (j * k + w * i),
                    sz * 2 * (i * k + w * j), sz * 2 * (j * k - w * i), sz * (1 - 2 * (i * i + j * j)),
                    x, y, z, colour);
  }

  /** Its z axis from one point to another, with a width. */
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

/** Two unit vectors at right angles to n and each other: Eq. (5.1), as the friction box has them. */
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
