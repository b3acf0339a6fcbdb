// Runs the page's compiled program in a worker, so that computing does not block the window.

self.onmessage = async ({ data }) => {
  // Messages that arrive before the program is ready.
  const early = [];
  self.onmessage = (event) => early.push(event.data);
  try {
    const salon = await import(new URL(`salon.js?v=${data.build}`, import.meta.url));
    await salon.default({ module_or_path: data.module });
    salon.worker_main(data.cancel);
    self.onmessage = (event) => salon.worker_message(event.data);
    early.forEach((message) => salon.worker_message(message));
  } catch (error) {
    self.postMessage([-1, String(error?.stack ?? error)]);
  }
};
