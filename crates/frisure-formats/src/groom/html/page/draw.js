// Draws hair and head with WebGL 2.

// Pictures that are averaged while nothing moves: each is drawn elsewhere within a pixel.
const STILL = 16;
// Seconds for one picture while something moves; hairs are left out until it is kept.
const QUICK = 0.04;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, name] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, document.getElementById(name).textContent.trim());
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(made).map((s) => gl.getShaderInfoLog(s));
    throw new Error([gl.getProgramInfoLog(made), ...logs].join("\n"));
  }
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
    const { name } = gl.getActiveUniform(made, i);
    uniforms[name.replace("[0]", "")] = gl.getUniformLocation(made, name);
  }
  return { made, uniforms };
}

function buffer(gl, target, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return made;
}

class Drawing {
  constructor(canvas, groom) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("no WebGL 2");
    Object.assign(this, { gl, canvas, groom, part: 1, still: 0, ground: [0.008, 0.009, 0.011] });
    this.hair = program(gl, "hair.vert", "hair.frag");
    this.skin = program(gl, "skin.vert", "skin.frag");
    this.whole = program(gl, "whole.vert", "whole.frag");
    // Sums of half precision need an extension; without it each picture is shown as it is.
    this.sums = Boolean(gl.getExtension("EXT_color_buffer_float") || gl.getExtension("EXT_color_buffer_half_float"));
    this.grid = room(groom);
    this.light(visibility(this.grid, matter(this.grid, groom)));
    this.loadHair();
    if (groom.head) this.loadHead();
    this.nothing = gl.createVertexArray();
  }

  light(seen) {
    const gl = this.gl, [x, y, z] = this.grid.size;
    gl.bindTexture(gl.TEXTURE_3D, gl.createTexture());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, x, y, z, 0, gl.RGBA, gl.UNSIGNED_BYTE, seen);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) gl.texParameteri(gl.TEXTURE_3D, side, gl.CLAMP_TO_EDGE);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_3D, filter, gl.LINEAR);
  }

  // Each piece of hair is an instance that reads two neighbouring points.
  loadHair() {
    const gl = this.gl, { hair, tangents } = this.groom;
    this.hairs = gl.createVertexArray();
    gl.bindVertexArray(this.hairs);
    const read = (data, first, kind, bytes, normalised) => {
      buffer(gl, gl.ARRAY_BUFFER, data);
      for (const next of [0, 1]) {
        gl.enableVertexAttribArray(first + next);
        gl.vertexAttribPointer(first + next, 4, kind, normalised, bytes, next * bytes);
        gl.vertexAttribDivisor(first + next, 1);
      }
    };
    read(hair.places, 0, gl.FLOAT, 16, false);
    read(tangents, 2, gl.BYTE, 4, true);
    read(hair.colours, 4, gl.UNSIGNED_BYTE, 4, true);
    const pieces = hair.places.length / 4;
    this.divisions = pieces < 300000 ? 4 : 2;
  }

  loadHead() {
    const gl = this.gl, { head } = this.groom;
    this.head = gl.createVertexArray();
    gl.bindVertexArray(this.head);
    [head.places, head.normals].forEach((data, i) => {
      buffer(gl, gl.ARRAY_BUFFER, data);
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 0, 0);
    });
    buffer(gl, gl.ELEMENT_ARRAY_BUFFER, head.corners);
  }

  // Targets of the canvas's size: samples, the picture from them, and the sum.
  resize() {
    const gl = this.gl, dots = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * dots));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * dots));
    if (this.width === width && this.height === height) return;
    Object.assign(this, { width, height, still: 0 });
    this.canvas.width = width;
    this.canvas.height = height;
    for (const old of this.targets || []) gl.deleteFramebuffer(old.frame);
    for (const old of this.stores || []) gl.deleteRenderbuffer(old);
    for (const old of this.targets || []) gl.deleteTexture(old.texture);
    const samples = Math.min(4, gl.getParameter(gl.MAX_SAMPLES));
    const sampled = { frame: gl.createFramebuffer(), texture: null };
    gl.bindFramebuffer(gl.FRAMEBUFFER, sampled.frame);
    this.stores = [[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]].map(([place, kind]) => {
      const store = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, kind, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
      return store;
    });
    this.targets = [sampled, this.target(gl.RGBA8), this.target(this.sums ? gl.RGBA16F : gl.RGBA8)];
  }

  target(kind) {
    const gl = this.gl, frame = gl.createFramebuffer(), texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, kind, this.width, this.height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return { frame, texture };
  }

  // The numbers that both hair and head are drawn with.
  use({ made, uniforms }, camera, shift) {
    const gl = this.gl, { low, side, size } = this.grid;
    const { eye, right, above, forward, distance } = camera.frame(this.width / this.height);
    gl.useProgram(made);
    const set = (name, values) => uniforms[name] && gl[`uniform${values.length}fv`](uniforms[name], values);
    set("eye", eye);
    set("right", right);
    set("above", above);
    set("forward", forward);
    set("size", [this.width, this.height]);
    set("shift", shift);
    set("lens", [0.5 * this.height / Math.tan(FIELD / 2), 0.02 * distance, distance + 4 * camera.radius]);
    set("low", low);
    set("cells", size.map((n) => 1 / (n * side)));
    set("sky", SKY);
    gl.uniform3fv(uniforms.lamps, LAMPS.flat());
    gl.uniform3fv(uniforms.lamp_light, LAMP_LIGHT.flat());
    return set;
  }

  // One picture; while nothing moves, one more of the mean.
  draw(camera, moving) {
    const gl = this.gl, start = performance.now();
    if (moving) this.still = 0;
    const part = moving ? this.part : 1;
    const n = this.still;
    // Halton's points in the bases 2 and 3, for places within the pixel.
    const shift = n ? [halton(n, 2) - 0.5, halton(n, 3) - 0.5] : [0, 0];
    const [sampled, single, sum] = this.targets;
    gl.bindFramebuffer(gl.FRAMEBUFFER, sampled.frame);
    gl.viewport(0, 0, this.width, this.height);
    gl.clearColor(...this.ground.map((x) => 12.92 * x < 0.04 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    if (this.head) {
      this.use(this.skin, camera, shift);
      gl.bindVertexArray(this.head);
      gl.drawElements(gl.TRIANGLES, this.groom.head.corners.length, gl.UNSIGNED_INT, 0);
    }
    const set = this.use(this.hair, camera, shift);
    set("shape", [this.divisions, (1 / part) ** 0.7, n]);
    gl.bindVertexArray(this.hairs);
    const { offsets } = this.groom.hair;
    const pieces = offsets[Math.ceil(part * (offsets.length - 1))] - 1;
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * this.divisions + 2, pieces);
    gl.disable(gl.DEPTH_TEST);

    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, sampled.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, single.frame);
    gl.blitFramebuffer(0, 0, this.width, this.height, 0, 0, this.width, this.height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.useProgram(this.whole.made);
    gl.bindVertexArray(this.nothing);
    if (this.sums) {
      gl.enable(gl.BLEND);
      gl.blendColor(0, 0, 0, 1 / (n + 1));
      gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
      this.copy(single.texture, sum.frame);
      gl.disable(gl.BLEND);
    }
    this.copy(this.sums ? sum.texture : single.texture, null);
    if (moving) {
      // A pixel that is read waits until all is drawn.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      const seconds = 0.001 * (performance.now() - start);
      this.part = Math.max(0.05, Math.min(1, this.part * Math.max(0.5, Math.min(1.2, QUICK / seconds))));
    }
    this.still = n + 1;
  }

  copy(texture, frame) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Whether more pictures make this one better.
  unfinished() {
    return this.still < (this.sums ? STILL : 1);
  }
}

function halton(n, base) {
  let value = 0;
  for (let part = 1 / base; n > 0; n = Math.floor(n / base), part /= base) value += part * (n % base);
  return value;
}
