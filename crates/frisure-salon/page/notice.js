// What lies over the canvas: how far loading is, or what went wrong and what to do.

const part = (id) => document.getElementById(id);

part("again").addEventListener("click", () => location.reload());

/** Says how far loading is: 0 to 1, or nothing if it is not known. */
export function loading(text, fraction) {
  part("text").textContent = text;
  if (fraction === undefined) part("progress").removeAttribute("value");
  else part("progress").value = Math.min(fraction, 1);
}

/** Takes the notice away: the salon is there. */
export function ready() {
  part("notice").hidden = true;
  part("salon").focus();
}

let told = false;

/** Says what is wrong and what to do. The first reason stays: others follow from it. */
export function trouble({ title, text, report = "", again = true }) {
  if (told) {
    part("report").textContent += `\n\n${report}`;
    return;
  }
  told = true;
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
