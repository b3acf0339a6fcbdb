// Where the eye is: around a middle, at a distance, by two angles.

// Angle of view from top to bottom (rad).
const FIELD = 0.5;

class Camera {
  // A box (m), and points in it, four numbers each, that are all seen from everywhere at first.
  constructor(low, high, points) {
    this.middle = low.map((x, k) => 0.5 * (x + high[k]));
    // Heads do not reach into the corners of their box.
    this.radius = 0.92 * 0.5 * Math.hypot(...low.map((x, k) => high[k] - x));
    const [x, y, z] = this.middle;
    for (let i = 0; i < points.length; i += 4) {
      const reach = Math.hypot(points[i] - x, points[i + 1] - y, points[i + 2] - z);
      if (reach > this.radius) this.radius = reach;
    }
    this.reset();
  }

  reset() {
    // Radians to the left of the face, and up.
    this.azimuth = 0.5;
    this.height = 0.08;
    this.zoom = 1;
    this.target = [...this.middle];
  }

  turn(across, up) {
    this.azimuth += across;
    this.height = Math.max(-1.5, Math.min(1.5, this.height + up));
  }

  scale(factor) {
    this.zoom = Math.max(0.2, Math.min(40, this.zoom * factor));
  }

  // Moves the picture, by parts of its height.
  move(across, up) {
    const { right, above, distance } = this.frame(1);
    const size = 2 * distance * Math.tan(FIELD / 2);
    for (let k = 0; k < 3; k++) {
      this.target[k] -= size * (across * right[k] - up * above[k]);
      const from = this.middle[k], far = 2 * this.radius;
      this.target[k] = Math.max(from - far, Math.min(from + far, this.target[k]));
    }
  }

  // Eye (m) and unit vectors, in a picture of this width over height.
  frame(aspect) {
    const [sa, ca] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const [sh, ch] = [Math.sin(this.height), Math.cos(this.height)];
    const forward = [-sa * ch, ca * ch, -sh], right = [ca, sa, 0], above = [-sa * sh, ca * sh, ch];
    const narrow = Math.min(1, aspect);
    const distance = this.radius / (Math.sin(FIELD / 2) * narrow * this.zoom);
    const eye = this.target.map((x, k) => x - distance * forward[k]);
    return { eye, forward, right, above, distance };
  }
}
