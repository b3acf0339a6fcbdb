// Where the eye is: around a middle, at a distance, by two angles.

// Angle of view from top to bottom (rad).
const FIELD = 0.5;

class Camera {
  constructor(low, high) {
    this.middle = low.map((x, k) => 0.5 * (x + high[k]));
    this.radius = 0.5 * Math.hypot(...low.map((x, k) => high[k] - x));
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
    const distance = 0.92 * this.radius / (Math.sin(FIELD / 2) * narrow * this.zoom);
    const eye = this.target.map((x, k) => x - distance * forward[k]);
    return { eye, forward, right, above, distance };
  }
}
