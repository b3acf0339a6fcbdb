// The page: opens the groom, and turns what is pressed, dragged and typed into views.

const canvas = document.getElementById("hair");

function tell(text) {
  document.getElementById("text").textContent = text;
  document.getElementById("notice").hidden = !text;
}

class Viewer {
  constructor(groom) {
    this.groom = groom;
    this.drawing = new Drawing(canvas, groom);
    const { own, bounds } = this.drawing.grid;
    // Above all the hair; of a head, its upper part.
    const low = [0, 1, 2].map((k) => Math.max(bounds.low[k], own.low[k] - 0.06));
    this.camera = new Camera(low, bounds.high, groom.hair.places);
    this.turning = this.moving = false;
    this.light(window.matchMedia("(prefers-color-scheme: light)").matches);
    this.listen();
    this.asked = false;
    this.ask(false);
  }

  light(on) {
    this.bright = on;
    document.body.classList.toggle("light", on);
    this.drawing.ground = on ? [0.79, 0.79, 0.775] : [0.008, 0.009, 0.011];
    this.drawing.still = 0;
  }

  // Asks for a picture.
  ask(moving) {
    this.moving ||= moving;
    if (moving) this.moved = performance.now();
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => this.picture());
  }

  picture() {
    this.asked = false;
    if (this.drawing.gl.isContextLost()) return;
    if (this.turning) {
      this.camera.turn(0.02, 0);
      this.moving = true;
    }
    this.drawing.resize();
    this.drawing.draw(this.camera, this.moving);
    const rested = performance.now() - this.moved > 150;
    if (this.moving && rested && !this.turning) {
      this.moving = false;
      this.drawing.still = 0;
    }
    if (this.turning || this.moving || this.drawing.unfinished()) this.ask(false);
  }

  listen() {
    new ResizeObserver(() => this.ask(false)).observe(canvas);
    const pointers = new Map();
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      pointers.set(e.pointerId, [e.clientX, e.clientY]);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
    canvas.addEventListener("pointermove", (e) => {
      if (pointers.has(e.pointerId)) this.drag(pointers, e);
    });
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.camera.scale(Math.exp(-0.0015 * e.deltaY * (e.deltaMode ? 30 : 1)));
      this.ask(true);
    }, { passive: false });
    canvas.addEventListener("contextmenu", (e) => e.preventDefault());
    canvas.addEventListener("dblclick", () => this.home());
    window.addEventListener("keydown", (e) => {
      if (!e.ctrlKey && !e.metaKey && !e.altKey && this.key(e.key, e.shiftKey)) e.preventDefault();
    });
    canvas.addEventListener("webglcontextlost", () => tell("The graphics were lost. Reload the page."));
    document.getElementById("home").addEventListener("click", () => this.home());
    document.getElementById("ground").addEventListener("click", () => this.key("b"));
    document.getElementById("turn").addEventListener("click", () => this.key("t"));
  }

  // One pointer turns, or moves with another button or Shift; two zoom and move.
  drag(pointers, event) {
    const before = [...pointers.values()].map((p) => [...p]);
    const own = pointers.get(event.pointerId);
    const step = [event.clientX - own[0], event.clientY - own[1]];
    [own[0], own[1]] = [event.clientX, event.clientY];
    const height = canvas.clientHeight;
    if (pointers.size === 2) {
      const after = [...pointers.values()];
      const spread = ([p, q]) => Math.hypot(p[0] - q[0], p[1] - q[1]) || 1;
      this.camera.scale(spread(after) / spread(before));
      this.camera.move(0.5 * step[0] / height, 0.5 * step[1] / height);
    } else if (event.buttons & 6 || event.shiftKey) {
      this.camera.move(step[0] / height, step[1] / height);
    } else {
      this.camera.turn(-4 * step[0] / height, 3 * step[1] / height);
    }
    this.ask(true);
  }

  home() {
    this.camera.reset();
    this.ask(true);
  }

  // Does what a key stands for; false where it stands for nothing.
  key(key, shift) {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = ways[key];
    if (way && shift) this.camera.move(0.05 * way[0], -0.05 * way[1]);
    else if (way) this.camera.turn(0.1 * way[0], 0.1 * way[1]);
    else if (key === "+" || key === "=") this.camera.scale(1.15);
    else if (key === "-" || key === "_") this.camera.scale(1 / 1.15);
    else if (key === "Home" || key === "0") this.camera.reset();
    else if (key === "b" || key === "B") this.light(!this.bright);
    else if (key === "t" || key === "T") {
      this.turning = !this.turning;
      document.getElementById("turn").setAttribute("aria-pressed", this.turning);
    } else return false;
    this.ask(true);
    return true;
  }

  // For tests: what is seen, and whether the picture is complete.
  state() {
    const { azimuth, height, zoom, target } = this.camera;
    const { still, width, part } = this.drawing;
    const { strands, points } = this.groom.header;
    return { azimuth, height, zoom, target, width, part, strands, points, bright: this.bright,
      complete: !this.moving && !this.drawing.unfinished(), still };
  }
}

async function open() {
  if (typeof DecompressionStream === "undefined") {
    tell("This browser is too old for this page: it lacks DecompressionStream. Browsers since May 2023 have it.");
    return;
  }
  if (!document.createElement("canvas").getContext("webgl2")) {
    tell("This page needs WebGL 2, which this browser does not have or has switched off. Switch on hardware acceleration in its settings, or open the page in another browser.");
    return;
  }
  try {
    window.viewer = new Viewer(await readGroom());
    tell("");
  } catch (error) {
    tell(`The hair cannot be drawn: ${error.message}`);
    throw error;
  }
}

open();
