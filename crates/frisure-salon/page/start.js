// Loads the salon and starts it.
//
// In the address: ?backend=webgl or webgpu, ?scene=NAME, ?hairs=N (draw so many), ?samples=1 (rough
// edges, for slow devices).

import { loading, ready, trouble } from "./notice.js?v={{build}}";

window.salonOpens = true;

const { build, bytes } = document.documentElement.dataset;
const asked = new URLSearchParams(location.search);
const at = (name) => new URL(`${name}?v=${build}`, import.meta.url).href;

const KEPT = "What you did is kept in this browser up to a few seconds ago. Reload the page to go on.";

const TROUBLES = {
  panic: { title: "The salon stopped", text: `That is a mistake in the program, not yours. ${KEPT}` },
  graphics: { title: "The graphics were lost", text: `The browser took them away, as it does when they are short or restart. ${KEPT}` },
};

/** What the salon calls when it cannot go on. */
const broken = (kind, report) => trouble({ ...(TROUBLES[kind] ?? TROUBLES.panic), report });

/** The program, and how far it is while it comes. */
async function download(address) {
  loading("Loading the salon.", 0);
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  count(answer.clone()).catch(() => {});
  // Compiled while it comes, and kept compiled by the browser; some hosts do not say what it is.
  const known = answer.headers.get("Content-Type")?.startsWith("application/wasm");
  return known ? WebAssembly.compileStreaming(answer) : WebAssembly.compile(await answer.arrayBuffer());
}

async function count(answer) {
  let had = 0;
  const reader = answer.body.getReader();
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    had += next.value.byteLength;
    loading("Loading the salon.", had / Number(bytes));
  }
  loading("Preparing the first head.");
}

/** Why this browser cannot run the salon, or nothing. */
async function missing() {
  if (typeof WebAssembly !== "object" || !simd()) {
    return "It needs WebAssembly with vector instructions. Every browser has it since 2023: update yours, or switch WebAssembly on.";
  }
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl2");
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  if (!gl && !(await adapter())) {
    return "It needs WebGL 2 or WebGPU, and this browser has neither. Switch on hardware acceleration in its settings, or try another browser.";
  }
}

/** What WebGPU would draw with; many browsers know WebGPU and have nothing to draw with. */
const adapter = async () => navigator.gpu?.requestAdapter().catch(() => null);

/** Whether a module of one vector instruction is understood. */
function simd() {
  const module = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
  return WebAssembly.validate(new Uint8Array(module));
}

/** A canvas that was used for one kind of graphics is of no use for the other. */
function freshCanvas() {
  const old = document.getElementById("salon");
  const canvas = old.cloneNode();
  old.replaceWith(canvas);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    broken("graphics", "webglcontextlost");
  });
  return canvas;
}

/** Starts with the graphics that are asked for; else with WebGPU, and if that fails with WebGL 2. */
async function start(salon, module) {
  const wanted = asked.get("backend");
  const ways = ["webgl", "webgpu"].includes(wanted) ? [wanted] : ["any", "webgl"];
  for (const [tried, backend] of ways.entries()) {
    try {
      await salon.start(freshCanvas(), {
        backend, module, build,
        worker: at("worker.js"),
        scene: asked.get("scene") ?? undefined,
        hairs: Number(asked.get("hairs")) || undefined,
        samples: [1, 4].find((n) => String(n) === asked.get("samples")),
        broken,
      });
      return;
    } catch (error) {
      if (tried + 1 === ways.length) throw error;
      console.warn(`no graphics with ${backend}: ${error}`);
    }
  }
}

/** For tests, and for whoever wants to drive the salon by program. */
function automation(salon) {
  const text = (json) => (json === undefined ? undefined : JSON.parse(json));
  return {
    state: () => text(salon.state()),
    command: (name) => salon.command(name),
    widget: (label) => text(salon.widget(label)),
    widgets: () => text(salon.widgets()),
    breakDown: () => salon.break_down(),
    measured: () => text(salon.measured()),
  };
}

/** Lets a screen reader have the salon in words. */
function describe(salon) {
  const button = document.getElementById("spoken");
  button.hidden = false;
  button.addEventListener("click", () => {
    salon.describe(document.getElementById("mirror"));
    button.hidden = true;
  });
}

async function open() {
  const reason = await missing();
  if (reason) {
    trouble({ title: "This browser cannot show the salon", text: reason, again: false });
    return;
  }
  const module = await download(at("salon_bg.wasm"));
  const salon = await import(at("salon.js"));
  await salon.default({ module_or_path: module });
  // Whatever breaks from here on ends the program: better told than a canvas that no longer moves.
  addEventListener("error", ({ error, message }) => {
    if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) broken("panic", `${message}\n${error.stack}`);
  });
  await start(salon, module);
  window.frisure = automation(salon);
  describe(salon);
  ready();
}

open().catch((error) => trouble({
  title: "The salon could not be opened",
  text: "Perhaps the connection broke off, or the graphics are busy. Reload the page; if that does not help, try another browser.",
  report: String(error?.stack ?? error),
}));
