// The salon's other half: it computes, so that the window never waits. The same program as the
// page's, already compiled.

self.onmessage = async ({ data }) => {
  // What comes before the program is ready waits for it.
  const early = [];
  self.onmessage = (event) => early.push(event.data);
  try {
    const salon = await import(new URL(`salon.js?v=${data.build}`, import.meta.url));
    await salon.default({ module_or_path: data.module });
    salon.worker_main(data.stop);
    self.onmessage = (event) => salon.worker_message(event.data);
    early.forEach((message) => salon.worker_message(message));
  } catch (error) {
    self.postMessage([-1, String(error?.stack ?? error)]);
  }
};
