// Loads the salon and starts it.
//
// Query parameters: ?backend=webgl or webgpu, ?scene=NAME or the code of a link, ?exercise=NAME or a code, ?language=fr, ?hairs=N (number of drawn hairs), ?samples=1 (no
// antialiasing, for slow devices).

import { loading, ready, showError } from "./notice.js?v={{build}}";

window.salonOpens = true;

const { build, bytes } = document.documentElement.dataset;
const query = new URLSearchParams(location.search);
const at = (name) => new URL(`${name}?v=${build}`, import.meta.url).href;

const AUTOSAVED = "Your work is autosaved in this browser, up to a few seconds ago. Reload the page to continue.";

const FAILURES = {
  panic: { title: "The salon stopped", text: `This is an error in the program. ${AUTOSAVED}` },
  graphics: { title: "The graphics were lost", text: `The graphics device is no longer available. ${AUTOSAVED}` },
};

/** Called by the salon on a failure. */
const failed = (kind, report) => showError({ ...(FAILURES[kind] ?? FAILURES.panic), report });

/** Downloads and compiles the program, and shows the progress. */
async function download(address) {
  loading("Loading the salon.", 0);
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
  count(answer.clone()).catch(() => {});
  // Compiled while it downloads, and cached by the browser; some hosts do not send the content type.
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

/** The reason why this browser cannot run the salon, or undefined. */
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

/** The WebGPU adapter; many browsers have the interface without an adapter. */
const adapter = async () => navigator.gpu?.requestAdapter().catch(() => null);

/** Whether the browser accepts a module with a vector instruction. */
function simd() {
  const module = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
  return WebAssembly.validate(new Uint8Array(module));
}

/** Replaces the canvas: one that was used with WebGPU cannot be used with WebGL. */
function freshCanvas() {
  const old = document.getElementById("salon");
  const canvas = old.cloneNode();
  old.replaceWith(canvas);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    failed("graphics", "webglcontextlost");
  });
  return canvas;
}

/** Starts with the backend of the query; by default WebGPU, and if that fails WebGL 2. */
async function start(salon, module) {
  const wanted = query.get("backend");
  const backends = ["webgl", "webgpu"].includes(wanted) ? [wanted] : ["any", "webgl"];
  for (const [tried, backend] of backends.entries()) {
    try {
      await salon.start(freshCanvas(), {
        backend, module, build,
        worker: at("worker.js"),
        scene: query.get("scene") ?? undefined,
        exercise: query.get("exercise") ?? undefined,
        language: query.get("language") ?? undefined,
        hairs: Number(query.get("hairs")) || undefined,
        samples: [1, 4].find((n) => String(n) === query.get("samples")),
        failed,
      });
      return;
    } catch (error) {
      if (tried + 1 === backends.length) throw error;
      console.warn(`no graphics with ${backend}: ${error}`);
    }
  }
}

/** The functions of window.frisure, for tests and other programs. */
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

/** Connects the button that describes the salon for screen readers. */
function describe(salon) {
  const button = document.getElementById("describe");
  button.hidden = false;
  button.addEventListener("click", () => {
    salon.describe(document.getElementById("aria-tree"));
    button.hidden = true;
  });
}

/** Has the browser keep the files for visits without a connection; once they are kept, the page's element says so. */
function keep() {
  const { serviceWorker } = navigator;
  // Browsers have it on secure origins only.
  if (!serviceWorker) return;
  serviceWorker.register("sw.js").catch((error) => console.warn(`not kept for offline use: ${error}`));
  serviceWorker.ready.then(() => { document.documentElement.dataset.kept = "yes"; });
}

async function open() {
  const reason = await missing();
  if (reason) {
    showError({ title: "This browser cannot show the salon", text: reason, again: false });
    return;
  }
  const module = await download(at("salon_bg.wasm"));
  const salon = await import(at("salon.js"));
  await salon.default({ module_or_path: module });
  // From here on an error in the program ends it.
  addEventListener("error", ({ error, message }) => {
    if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) failed("panic", `${message}\n${error.stack}`);
  });
  await start(salon, module);
  window.frisure = automation(salon);
  describe(salon);
  ready();
  keep();
}

open().catch((error) => showError({
  title: "The salon could not be opened",
  text: "The connection may be lost, or the graphics device busy. Reload the page; if that does not help, try another browser.",
  report: String(error?.stack ?? error),
}));
