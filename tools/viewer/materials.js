"use strict";
// Shaders of bodies, marks and planes. The light comes from above, behind the viewer's left shoulder.

const POSED = `
  varying vec3 vNormal, vBody, vTint; varying vec2 vUv;
  attribute vec3 tint;
  void pose() {
    vBody = position; vUv = uv; vTint = tint;
    mat3 m = mat3(instanceMatrix);  // rotation times scaling, so normals are divided by the squared scale
    vNormal = m * (normal / vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2])));
  }`;

const BODY_VERTEX = `${POSED}
  varying vec3 vToEye;
  void main() {
    pose();
    vec4 world = modelMatrix * (instanceMatrix * vec4(position, 1.0));
    vToEye = cameraPosition - world.xyz;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

// The octants of a ball alternate between two tones, which shows any turn. Edges of a box have a fixed width in pixels.
const BODY_FRAGMENT = `
  uniform vec3 mark, edge; uniform float opacity;
  varying vec3 vNormal, vBody, vTint, vToEye; varying vec2 vUv;
  float over(float value) { return clamp(value / max(fwidth(value), 1e-5) + 0.5, 0.0, 1.0); }
  void main() {
    vec3 normal = normalize(vNormal), colour = vTint;
    float alpha = opacity;
    #ifdef BALL
      colour = mix(colour, mark, over(vBody.x * vBody.y * vBody.z));
    #endif
    #ifdef DISC
      colour = mix(colour, mark, over(vBody.x * vBody.y));
    #endif
    #ifdef LIT
      colour *= 0.72 + 0.20 * dot(normal, normalize(vec3(-0.35, -0.55, 0.76))) + 0.14 * normal.z;
    #endif
    #ifdef BOX
      vec2 border = min(vUv, 1.0 - vUv) / max(fwidth(vUv), vec2(1e-5));
      float line = 1.0 - smoothstep(0.6, 1.6, min(border.x, border.y));
      #ifdef GHOST
        alpha = mix(alpha, 0.9, line);
      #else
        colour = mix(colour, edge, 0.75 * line);
      #endif
    #elif defined(GHOST)
      float rim = 1.0 - abs(dot(normal, normalize(vToEye)));
      alpha = mix(alpha, 0.9, smoothstep(0.55, 0.85, rim));
    #endif
    gl_FragColor = vec4(colour, alpha);
  }`;

// Shadows: the bodies projected onto the floor along its normal.
const SHADE_VERTEX = `
  uniform vec4 floor;
  attribute vec3 tint;
  void main() {
    vec3 world = (modelMatrix * (instanceMatrix * vec4(position, 1.0))).xyz;
    world -= (dot(floor.xyz, world) - floor.w) * floor.xyz;
    gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
  }`;
const SHADE_FRAGMENT = `
  uniform vec3 colour; uniform float opacity;
  void main() { gl_FragColor = vec4(colour, opacity); }`;

const FLOOR_VERTEX = `
  varying vec2 vPlace;
  void main() {
    vPlace = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;
const FLOOR_FRAGMENT = `
  uniform vec3 colour, line; uniform vec2 origin; uniform float spacing, radius;
  varying vec2 vPlace;
  void main() {
    vec2 place = (vPlace + origin) / spacing, width = fwidth(place);
    vec2 off = abs(fract(place - 0.5) - 0.5) / max(width, vec2(1e-6));
    float grid = (1.0 - smoothstep(0.5, 1.5, min(off.x, off.y))) * (1.0 - smoothstep(0.15, 0.5, max(width.x, width.y)));
    float fade = 1.0 - smoothstep(0.45, 1.0, length(vPlace) / radius);
    gl_FragColor = vec4(mix(colour, line, grid), 0.95 * fade);
  }`;

/** Returns the material of a crowd of bodies; `kinds` selects parts of the shader (BALL, BOX, DISC, LIT, GHOST). */
function bodyMaterial(kinds, opacity = 1) {
  const defines = Object.fromEntries(kinds.map((kind) => [kind, 1]));
  const isGhost = kinds.includes("GHOST");  // drawn slightly behind, so that a body at its right place hides its ghost
  return new THREE.ShaderMaterial({
    vertexShader: BODY_VERTEX, fragmentShader: BODY_FRAGMENT, defines, extensions: { derivatives: true },
    transparent: opacity < 1, depthWrite: opacity === 1,
    polygonOffset: isGhost, polygonOffsetFactor: 2, polygonOffsetUnits: 8,
    uniforms: { mark: { value: colourOf(palette().mark) }, edge: { value: colourOf(palette().edge) },
                opacity: { value: opacity } },
  });
}

/** Returns the material of shadows, which darkens a pixel once for any number of bodies. */
function shadeMaterial(normal, offset) {
  return new THREE.ShaderMaterial({
    vertexShader: SHADE_VERTEX, fragmentShader: SHADE_FRAGMENT, transparent: true, depthWrite: false,
    polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1, side: THREE.DoubleSide,
    stencilWrite: true, stencilRef: 1, stencilFunc: THREE.NotEqualStencilFunc, stencilZPass: THREE.ReplaceStencilOp,
    uniforms: { floor: { value: new THREE.Vector4(normal.x, normal.y, normal.z, offset) },
                colour: { value: colourOf(palette().shade) }, opacity: { value: IN_THE_DARK.matches ? 0.4 : 0.16 } },
  });
}

function floorMaterial(spacing, radius, origin) {
  return new THREE.ShaderMaterial({
    vertexShader: FLOOR_VERTEX, fragmentShader: FLOOR_FRAGMENT, extensions: { derivatives: true },
    transparent: true, depthWrite: false,
    uniforms: { colour: { value: colourOf(palette().floor) }, line: { value: colourOf(palette().line) },
                spacing: { value: spacing }, radius: { value: radius }, origin: { value: origin } },
  });
}

function wallMaterial() {
  return new THREE.MeshBasicMaterial({ color: palette().edge, transparent: true, opacity: 0.05, depthWrite: false });
}
