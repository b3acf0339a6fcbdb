// The notice over the canvas: progress of loading, or an error with what the user can do.

const part = (id) => document.getElementById(id);

part("again").addEventListener("click", () => location.reload());

/** Shows the progress of loading: 0 to 1, or undefined if it is not known. */
export function loading(text, fraction) {
  part("text").textContent = text;
  if (fraction === undefined) part("progress").removeAttribute("value");
  else part("progress").value = Math.min(fraction, 1);
}

/** Hides the notice once the salon runs. */
export function ready() {
  part("notice").hidden = true;
  part("salon").focus();
}

let failed = false;

/** Shows an error and what the user can do. The first error stays: later ones follow from it. */
export function showError({ title, text, report = "", again = true }) {
  if (failed) {
    part("report").textContent += `\n\n${report}`;
    return;
  }
  failed = true;
  part("notice").hidden = false;
  part("notice").setAttribute("role", "alert");
  part("title").textContent = title;
  part("text").textContent = text;
  part("progress").hidden = true;
  part("again").hidden = !again;
  part("details").hidden = report === "";
  part("report").textContent = report;
  if (again) part("again").focus();
}
